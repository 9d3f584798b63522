# cmake -DPROGRAM=bruma-osmesa -DFOLDER=FOLDER -P reference_test.cmake
# What the verb 'reference' says a picture is must be what 'render' draws, for scenes that no other test takes through
# both verbs: a translucent mesh by either truth, and clouds under a sky by paths of all orders.

cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})

function(run)
  execute_process(COMMAND ${PROGRAM} ${ARGN} WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE status OUTPUT_VARIABLE out
                  ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "'${ARGN}' ended with ${status}:\n${out}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

# Refused in one sentence, with exit code 2 and no picture.
function(refused words)
  execute_process(COMMAND ${PROGRAM} ${ARGN} -o refused.exr WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE status
                  OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 2 OR NOT out MATCHES "${words}" OR EXISTS ${FOLDER}/refused.exr)
    message(FATAL_ERROR "'${ARGN}' ended with ${status}, not 2, or without '${words}':\n${out}")
  endif()
endfunction()

set(body builtin:mesh-sphere --set mesh.shading=translucent --set mesh.material=marble --size 24x24
         --set mesh.subsurface.highlight=false --set mesh.subsurface.unscattered=false --set environment.radiance=0,0,0)
run(render ${body} --set rendering.samples=1 -o drawn.exr)
run(reference ${body} -o quadrature.exr)
if(NOT out MATCHES "by quadrature" OR out MATCHES "alone; a picture to compare")
  message(FATAL_ERROR "the reference should speak of quadrature, and of nothing left out:\n${out}")
endif()
# Found 0.0005: maps are within a per cent of the local value, which is at most 0.4 here, and no outline is off by a pixel.
run(compare drawn.exr quadrature.exr --tolerance 0.003)
# Photons follow no model. The dipole is some per cent from them on a sphere this large; a thousand photons for each
# pixel that is lit leave noise: 0.02 together.
run(reference ${body} -o photons.exr --inside photons --photons 100000)
run(compare quadrature.exr photons.exr --tolerance 0.04)
refused("opaque" reference builtin:mesh-sphere)
refused("one mesh at a time" reference builtin:translucent)

# The model of light is fitted to such paths; with the noise of 32 of them 0.02 of display range.
set(sky builtin:clouds-under-sky --size 16x9)
run(reference ${sky} -o modelled.exr --tolerance 0.01)
run(reference ${sky} -o paths.exr --light multiple --samples 32)
run(compare modelled.exr paths.exr --tolerance 0.04)
