# cmake -DPROGRAM=bruma-osmesa -DFOLDER=FOLDER -P bench_smoke_test.cmake
# A short bench must leave rows, finite errors, and a page that needs nothing from elsewhere.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/expect_bench.cmake)
file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${PROGRAM} bench volume --quick --size 64x64 --repeats 1 -o ${FOLDER} RESULT_VARIABLE status
                OUTPUT_VARIABLE out ERROR_VARIABLE out)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "bench volume ended with ${status}:\n${out}")
endif()
# Three scenes, three steps, two classifications, skipping or not, stopping or not; and the names of the columns.
expect_bench(${FOLDER} volume 73 "nan|inf|,0\n")
file(READ ${FOLDER}/volume.json document)
string(JSON scenes LENGTH "${document}" scenes)
if(NOT scenes EQUAL 3)
  message(FATAL_ERROR "volume.json holds ${scenes} scenes, not 3")
endif()
execute_process(COMMAND ${PROGRAM} bench frames builtin:bucky --size 32x32 --repeats 2 -o ${FOLDER}
                        --picture-frame0 ${FOLDER}/frame.exr RESULT_VARIABLE status OUTPUT_VARIABLE line)
string(JSON frames GET "${line}" n)
if(NOT status EQUAL 0 OR NOT frames EQUAL 2 OR NOT EXISTS ${FOLDER}/frame.exr)
  message(FATAL_ERROR "bench frames ended with ${status}: ${line}")
endif()
