# cmake -DFOLDER=tests/images/NAME -DPROGRAM=bruma-osmesa -DKEEP=folder for new pictures [-DRENEW=ON] -P THIS
# Draws the scene of a folder and compares it with the folder's picture, or makes it that picture.
cmake_minimum_required(VERSION 3.25)

file(READ ${FOLDER}/tolerance.json about)
string(JSON tolerance GET "${about}" rmse)
string(JSON reason GET "${about}" reason)
string(JSON size ERROR_VARIABLE no_size GET "${about}" size)
if(no_size)
  set(size 320x240)
endif()
string(JSON scene ERROR_VARIABLE no_scene GET "${about}" scene)
if(no_scene)
  set(scene ${FOLDER}/scene.json)
endif()

file(MAKE_DIRECTORY ${KEEP})
set(new ${KEEP}/picture.png)
file(REMOVE ${new} ${KEEP}/difference.png)
execute_process(COMMAND ${PROGRAM} render ${scene} --size ${size} -o ${new} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${scene} could not be drawn")
endif()
if(RENEW)
  file(COPY ${new} DESTINATION ${FOLDER})
  message("${FOLDER}/picture.png is new; look at it before you commit it")
  return()
endif()
if(NOT EXISTS ${FOLDER}/picture.png)
  message(FATAL_ERROR "${FOLDER} holds no picture.png to compare with; the new picture is ${new}")
endif()
execute_process(COMMAND ${PROGRAM} compare ${new} ${FOLDER}/picture.png --tolerance ${tolerance}
                        --heatmap ${KEEP}/difference.png
                RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${FOLDER}/picture.png was ${tolerance} or nearer before (${reason}); the new picture is ${new}, "
                      "the difference ${KEEP}/difference.png")
endif()
