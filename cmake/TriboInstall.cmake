# `make install`: the program, the rooms with their headers, and a CMake package: find_package(tribo) gives tribo::<room>.
include(CMakePackageConfigHelpers)

set(rooms)
foreach(folder src src/files src/report src/app)
  get_property(targets DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} PROPERTY BUILDSYSTEM_TARGETS)
  list(APPEND rooms ${targets})
endforeach()
set(libraries tribo_options)
foreach(room ${rooms})
  get_target_property(type ${room} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    list(APPEND libraries ${room})
    list(APPEND products ${room})
  elseif(type STREQUAL "EXECUTABLE" AND room STREQUAL "tribo")
    install(TARGETS ${room})
    list(APPEND products ${room})
  endif()
endforeach()
set_target_properties(tribo_options PROPERTIES EXPORT_NAME options)
# What an installation holds, without the tests.
add_custom_target(product DEPENDS ${products})
install(TARGETS ${libraries} EXPORT tribo)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tribo FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
# The pages, where there was a Node.js to build them (scripts/web.sh): `tribo live` and `tribo site` look for them beside the program.
install(DIRECTORY ${PROJECT_BINARY_DIR}/../web/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/tribo/web OPTIONAL)
install(EXPORT tribo NAMESPACE tribo:: FILE tribo-targets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tribo)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/tribo-config.cmake.in ${PROJECT_BINARY_DIR}/tribo-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tribo)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tribo-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tribo-config.cmake ${PROJECT_BINARY_DIR}/tribo-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tribo)
