# cmake -DNM=NM -DCOMPILER=COMPILER -DSCRATCH=FOLDER -P planted_symbols_test.cmake
# symbols_test.cmake must fail where two files define one symbol, and pass where they do not.

cmake_minimum_required(VERSION 3.25)

function(expect outcome first second)
  file(REMOVE_RECURSE ${SCRATCH})
  set(objects "")
  foreach(name first second)
    file(WRITE ${SCRATCH}/${name}.cpp "namespace bruma { ${${name}} }\n")
    execute_process(COMMAND ${COMPILER} -c ${SCRATCH}/${name}.cpp -o ${SCRATCH}/${name}.o COMMAND_ERROR_IS_FATAL ANY)
    list(APPEND objects ${SCRATCH}/${name}.o)
  endforeach()
  list(JOIN objects "," objects)
  execute_process(COMMAND ${CMAKE_COMMAND} -DNM=${NM} -DOBJECTS=${objects} -P ${CMAKE_CURRENT_LIST_DIR}/symbols_test.cmake
                  RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(outcome STREQUAL "pass" AND NOT status EQUAL 0)
    message(FATAL_ERROR "'${first}' and '${second}' were refused:\n${out}")
  elseif(outcome STREQUAL "fail" AND status EQUAL 0)
    message(FATAL_ERROR "two definitions were not found: '${first}' and '${second}'")
  endif()
endfunction()

set(plain "double f(double x, double y) { return x - y;} ")
set(other "double g(double x) { return x;} ")
set(inlined "inline double f(double y, double x) { return x - y;} double h() { return f(1.0, 2.0);} ")
set(local "namespace { double f(double x, double y) { return y - x;} } double h() { return f(1.0, 2.0);} ")
expect(pass "${plain}" "${other}")
expect(pass "${plain}" "${local}")
expect(fail "${plain}" "${inlined}")
expect(fail "${plain}" "${plain}")
file(REMOVE_RECURSE ${SCRATCH})

