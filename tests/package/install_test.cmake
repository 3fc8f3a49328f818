# Installs a finished build under a staging root, links a project of its own to the package there, runs that and the
# installed program, with its pages where they are built. BUILD, SOURCE, WORK, CXX, CXX_FLAGS come from the command line.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${code}:\n${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
# DESTDIR as packagers use it: files lie under it, and nothing remembers it.
set(ENV{DESTDIR} ${WORK}/stage)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix /opt/tribo)
unset(ENV{DESTDIR})
set(prefix ${WORK}/moved)
file(RENAME ${WORK}/stage/opt/tribo ${prefix})

run(${prefix}/bin/tribo --version)
if(NOT said MATCHES "^tribo ${VERSION}")
  message(FATAL_ERROR "tribo --version says: ${said}")
endif()
# Its pages, at work.
if(EXISTS ${BUILD}/../web/viewer/index.html AND EXISTS ${BUILD}/../web/site/index.html)
  run(${prefix}/bin/tribo site --out ${WORK}/site)
  if(NOT EXISTS ${WORK}/site/index.html)
    message(FATAL_ERROR "tribo site of the installation wrote no page")
  endif()
  # Until the time is over: 130 as after Ctrl-C.
  execute_process(COMMAND timeout --preserve-status -s INT 2 ${prefix}/bin/tribo live --port 0 RESULT_VARIABLE code
                  OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT code EQUAL 130 OR NOT said MATCHES "An empty bench is live at http://127.0.0.1:")
    message(FATAL_ERROR "tribo live of the installation ended with ${code}:\n${said}")
  endif()
else()
  message(STATUS "the pages are not built here: tribo live and tribo site of the installation were not tried")
endif()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CXX}
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" -DTRIBO_INCLUDES=${prefix}/include/tribo
    -DTRIBO_EXAMPLES=${SOURCE}/../../examples)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/stranger)
message(STATUS "a stranger computes ${said}")
set(examples ${SOURCE}/../../examples)
run(${WORK}/build/mill ${examples}/plate/plate.toml ${WORK}/sound.f32)
if(NOT said MATCHES "line +[0-9]+: peak [0-9.]+ N" OR NOT said MATCHES "energy balance (0\\.99|1\\.00)")
  message(FATAL_ERROR "the example that mills says:\n${said}")
endif()
run(${WORK}/build/touch ${examples}/materials/sponge.json ${WORK}/pressed.ppm ${WORK}/rubbed.f32)
if(NOT said MATCHES "pressed in by 0\\.[0-9]+ mm")
  message(FATAL_ERROR "the example that touches says:\n${said}")
endif()
run(${WORK}/build/hand ${examples}/plate/plate.toml 5 5 12)
if(NOT said MATCHES "pushed up with 0\\.5")
  message(FATAL_ERROR "the example that presses says:\n${said}")
endif()
file(REMOVE_RECURSE ${WORK})
