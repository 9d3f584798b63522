# cmake -DPROGRAM=bruma-osmesa -DFOLDER=FOLDER -P bench_light_smoke_test.cmake
# A short bench of light must leave rows, finite errors, and a page that needs nothing from elsewhere; and direct light
# at half resolution must be as near to single scattering as the program promises.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/expect_bench.cmake)
file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${PROGRAM} bench light --quick --size 48x48 --repeats 1 -o ${FOLDER} RESULT_VARIABLE status
                OUTPUT_VARIABLE out ERROR_VARIABLE out)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "bench light ended with ${status}:\n${out}")
endif()
# One scene, four ways, two resolutions, near steps or not; and the names of the columns.
expect_bench(${FOLDER} light 17 "nan|inf")
file(READ ${FOLDER}/light.json document)
string(JSON builds LENGTH "${document}" builds)
string(JSON launches LENGTH "${document}" launches)
if(NOT builds EQUAL 4 OR NOT launches EQUAL 24)
  message(FATAL_ERROR "light.json holds ${builds} builds and ${launches} launches, not 4 and 24")
endif()
string(JSON way GET "${document}" scenes 0 rows 1 way)
string(JSON resolution GET "${document}" scenes 0 rows 1 resolution)
string(JSON near_steps GET "${document}" scenes 0 rows 1 near_steps)
if(NOT "${way}, ${resolution}, ${near_steps}" STREQUAL "physical, direct, half, 2")
  message(FATAL_ERROR "the second row is '${way}, ${resolution}, ${near_steps}'")
endif()
string(JSON rmse GET "${document}" scenes 0 rows 1 rmse_single)
if(NOT rmse LESS 0.02 OR NOT rmse GREATER 0)
  message(FATAL_ERROR "direct light at half resolution is ${rmse} from single scattering, not within 0.02")
endif()
# The paper's look is no measure of light: if it were as near, the pictures compared would not be what they seem.
string(JSON way GET "${document}" scenes 0 rows 9 way)
string(JSON paper GET "${document}" scenes 0 rows 9 rmse_single)
if(NOT way STREQUAL "paper" OR NOT paper GREATER 0.1)
  message(FATAL_ERROR "row 10 is '${way}' with an error of ${paper}; the paper's mode, far from the truth, stands there")
endif()
