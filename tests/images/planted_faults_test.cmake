# cmake -DSOURCE=tests/images -DPROGRAM=bruma-osmesa -DSCRATCH=FOLDER -P THIS
# Whether draw_and_compare.cmake fails, and keeps the new picture, where there is no previous one or another.
cmake_minimum_required(VERSION 3.25)

function(expect_fault what sentence)
  execute_process(COMMAND ${CMAKE_COMMAND} -DFOLDER=${SCRATCH}/case -DPROGRAM=${PROGRAM} -DKEEP=${SCRATCH}/kept
                          -P ${SOURCE}/draw_and_compare.cmake
                  RESULT_VARIABLE failed OUTPUT_VARIABLE words ERROR_VARIABLE words)
  string(REGEX REPLACE "[ \n]+" " " words "${words}")
  if(NOT failed OR NOT words MATCHES "${sentence}" OR NOT EXISTS ${SCRATCH}/kept/picture.png)
    message(FATAL_ERROR "${what} was not seen, or the new picture was not kept: ${words}")
  endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH}/case)
file(WRITE ${SCRATCH}/case/tolerance.json
     [[{"scene": "builtin:sphere", "size": "64x48", "rmse": 0.001, "reason": "planted"}]])
expect_fault("A missing picture" "holds no picture.png to compare with")
# A density 5 % too high: the smallest fault that these tests are asked to see.
execute_process(COMMAND ${PROGRAM} render builtin:sphere --size 64x48 --set volume.density_scale=1.05
                        -o ${SCRATCH}/case/picture.png COMMAND_ERROR_IS_FATAL ANY)
expect_fault("A changed picture" "the new picture is")
execute_process(COMMAND ${PROGRAM} render builtin:sphere --size 64x48 -o ${SCRATCH}/case/picture.png
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -DFOLDER=${SCRATCH}/case -DPROGRAM=${PROGRAM} -DKEEP=${SCRATCH}/kept
                        -P ${SOURCE}/draw_and_compare.cmake COMMAND_ERROR_IS_FATAL ANY)
