# cmake -DPROGRAM=bruma-osmesa -DFOLDER=FOLDER -P bench_mesh_smoke_test.cmake
# A tiny bench of meshes must leave rows, finite errors, exact counts and a page that needs nothing from elsewhere; and the
# densities must save what the program promises.

cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/expect_bench.cmake)
file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${PROGRAM} bench mesh --quick --size 12x12 --repeats 1 -o ${FOLDER} RESULT_VARIABLE status
                OUTPUT_VARIABLE out ERROR_VARIABLE out)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "bench mesh ended with ${status}:\n${out}")
endif()
# One scene, three models, two numbers of maps, two sizes, two of passes; and the names of the columns.
expect_bench(${FOLDER} mesh 25 "nan|inf|null")
file(READ ${FOLDER}/mesh.json document)
# Eight passes are eight times the evaluations of one.
string(JSON one GET "${document}" scenes 0 rows 0 evaluations)
string(JSON eight GET "${document}" scenes 0 rows 1 evaluations)
math(EXPR expected "8 * ${one}")
if(NOT one GREATER 0 OR NOT eight EQUAL expected)
  message(FATAL_ERROR "one pass counts ${one} evaluations, eight count ${eight}")
endif()
# The last row is the finest: 64 samples per texel on eight small maps. Twice what was measured.
string(JSON rmse GET "${document}" scenes 0 rows 23 rmse_quadrature)
if(NOT rmse GREATER 0 OR NOT rmse LESS 0.03)
  message(FATAL_ERROR "the picture is ${rmse} from quadrature of the same model, not within 0.03")
endif()
# Cream in green on a lit slab, by quadrature: no chance is in it.
string(JSON times GET "${document}" sampling noise 1 times_fewer_than_disk)
if(NOT times GREATER 50)
  message(FATAL_ERROR "core and tail need ${times} times fewer evaluations than the published disk, not 50")
endif()
# Marble in blue behind the side of a ball, beside the disk cut at the body: the least of all.
string(JSON times GET "${document}" sampling noise 20 times_fewer_than_cut_disk)
if(NOT times GREATER 3)
  message(FATAL_ERROR "behind a body ${times} times fewer evaluations than the cut disk, not 3")
endif()
