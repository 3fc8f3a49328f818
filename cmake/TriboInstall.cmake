# `make install`: the program, its pages, the rooms with their headers, and a CMake package: find_package(tribo COMPONENTS milling)
# gives tribo::milling and the rooms that it links, and asks only for the packages that these need.
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/tribo)
get_property(rooms GLOBAL PROPERTY TRIBO_ROOMS)
install(TARGETS tribo)
set(products tribo)
set_target_properties(tribo_options PROPERTIES EXPORT_NAME options)
install(TARGETS tribo_options EXPORT tribo-options)
install(EXPORT tribo-options NAMESPACE tribo:: FILE tribo-options-targets.cmake DESTINATION ${package})
# One file of targets a room, so that a room is found without the packages of the others.
foreach(room ${rooms})
  install(TARGETS tribo_${room} EXPORT tribo-${room})
  install(EXPORT tribo-${room} NAMESPACE tribo:: FILE tribo-${room}-targets.cmake DESTINATION ${package})
  list(APPEND products tribo_${room})
  get_property(links GLOBAL PROPERTY TRIBO_LINKS_${room})
  get_property(finds GLOBAL PROPERTY TRIBO_FINDS_${room})
  string(APPEND TRIBO_ROOM_TABLE "set(tribo_links_${room} ${links})\nset(tribo_finds_${room} ${finds})\n")
endforeach()
set(TRIBO_ROOM_LIST ${rooms})
# What an installation holds, without the tests.
add_custom_target(product DEPENDS ${products})
# Headers that others may use, by what they do with them.
include(${PROJECT_SOURCE_DIR}/cmake/public_headers.cmake)
foreach(header ${TRIBO_PUBLIC_HEADERS})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tribo/${folder})
endforeach()
# The pages, where there was a Node.js to build them (scripts/web.sh): `tribo live` and `tribo site` look for them beside the program.
install(DIRECTORY ${PROJECT_BINARY_DIR}/../web/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/tribo/web OPTIONAL)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/tribo)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/tribo-config.cmake.in ${PROJECT_BINARY_DIR}/tribo-config.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tribo-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tribo-config.cmake ${PROJECT_BINARY_DIR}/tribo-config-version.cmake DESTINATION ${package})
