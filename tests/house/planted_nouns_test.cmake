# cmake -DSCRATCH=FOLDER -P planted_nouns_test.cmake
# nouns_test.cmake must fail on a circle and on a crowd, and pass without.

cmake_minimum_required(VERSION 3.25)

function(expect outcome what)
  execute_process(COMMAND ${CMAKE_COMMAND} -DTOP=${SCRATCH} -P ${CMAKE_CURRENT_LIST_DIR}/nouns_test.cmake
                  RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if((outcome STREQUAL "pass" AND NOT status EQUAL 0) OR (outcome STREQUAL "fail" AND status EQUAL 0))
    message(FATAL_ERROR "${what}: expected to ${outcome}, exit ${status}:\n${out}")
  endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
file(WRITE ${SCRATCH}/src/render/sky/sky.h "#include \"render/products/picture.h\"\n#include \"render/graph.h\"\n")
file(WRITE ${SCRATCH}/src/render/clouds/clouds.h "#include \"render/sky/sky.h\"\n")
file(WRITE ${SCRATCH}/src/render/products/picture.h "#include <vector>\n")
expect(pass "arrows in one direction")
file(WRITE ${SCRATCH}/src/render/products/back.cpp "  #include \"render/clouds/clouds.h\"\n")
expect(fail "a circle of three")
file(REMOVE ${SCRATCH}/src/render/products/back.cpp)
foreach(n RANGE 30)
  file(WRITE ${SCRATCH}/src/render/sky/more_${n}.h "#pragma once\n")
endforeach()
expect(fail "a crowd")
file(REMOVE_RECURSE ${SCRATCH})
