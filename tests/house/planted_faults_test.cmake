# cmake -DSCRATCH=FOLDER -P planted_faults_test.cmake
# arrows_test.cmake must fail on each fault it is there for, and pass without one.

cmake_minimum_required(VERSION 3.25)

function(expect outcome file text)
  file(REMOVE_RECURSE ${SCRATCH})
  file(WRITE ${SCRATCH}/src/base/good.h "#pragma once\n")
  file(WRITE ${SCRATCH}/${file} "${text}")
  execute_process(COMMAND ${CMAKE_COMMAND} -DTOP=${SCRATCH} -P ${CMAKE_CURRENT_LIST_DIR}/arrows_test.cmake
                  RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(outcome STREQUAL "pass" AND NOT status EQUAL 0)
    message(FATAL_ERROR "a good tree was refused:\n${out}")
  elseif(outcome STREQUAL "fail" AND (status EQUAL 0 OR NOT out MATCHES "${file}"))
    message(FATAL_ERROR "the fault planted in ${file} was not found:\n${out}")
  endif()
endfunction()

expect(pass src/scene/fine.h "#include \"base/good.h\"\n#include <vector>\n")
expect(fail src/scene/upward.h "#include \"gl/texture.h\"\n")
expect(fail src/reference/peeks.cpp "#include <vector>\n  #include \"render/graph.h\"\n")
expect(fail src/base/upward.h "#include \"scene/scene.h\"\n")
expect(fail src/utils/new.h "#pragma once\n")
expect(fail src/scene/prints.cpp "#include <cstdio>\n  std::printf(\"words\");\n")
expect(fail src/base/prints.cpp "std::cerr << 1;\n")
string(REPEAT "// line\n" 501 long)
expect(fail src/base/long.cpp "${long}")
string(CONCAT loose "TO" "DO")
expect(fail shaders/volume/loose.frag "// ${loose}: later\n")
file(REMOVE_RECURSE ${SCRATCH})
