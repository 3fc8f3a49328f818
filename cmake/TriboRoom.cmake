# What every target shares, and how a room, a test and a kernel file become targets.

add_library(tribo_options INTERFACE)
# The core gives the same bits on every compiler: no fused multiply-add, no reordering (CONTRIBUTING.md, "Same bits").
target_compile_options(tribo_options INTERFACE $<BUILD_INTERFACE:-Wall;-Wextra;-Wconversion> -ffp-contract=off -fno-math-errno
                                               $<BUILD_INTERFACE:-Wno-psabi>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # `"literal" + std::string` warns falsely in g++ 12 (GCC bug 105651).
  target_compile_options(tribo_options INTERFACE $<BUILD_INTERFACE:-Wno-restrict>)
endif()
if(TRIBO_WARNINGS_AS_ERRORS)
  target_compile_options(tribo_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
target_compile_features(tribo_options INTERFACE cxx_std_23)
target_include_directories(tribo_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                                   $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/tribo>)

# tribo_standard_headers(TARGET FIRST extra...): the compiler reads the standard headers, and those named, once for FIRST and keeps them
# for all targets that share it: a quarter of a build's time with g++, half of it with clang. The preset `dev` reads them in every
# file, so that a file that forgets one is found there.
function(tribo_standard_headers target first)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # ccache asks for the first; the next are false where g++ 12 inlines what it did not read in this file, the last where it
    # reads several files as one.
    target_compile_options(${target} PRIVATE -fpch-preprocess -Wno-array-bounds -Wno-maybe-uninitialized
                           -Wno-stringop-overflow -Wno-stringop-overread -Wno-subobject-linkage)
  else()
    # ccache knows what was read by its content, not by its time.
    target_compile_options(${target} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
  endif()
  if(target STREQUAL first)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <expected> <functional> <map> <memory> <optional> <span>
                              <string> <string_view> <utility> <vector> ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${first})
  endif()
endfunction()

# tribo_compile_fast(TARGET FIRST extra...): for what computes nothing per sample. Less optimised, it compiles in two thirds of the time, and
# in half with the sanitizers, whose build type is None. FIRST keeps the standard headers with g++; clang shares none with what is
# optimised otherwise.
function(tribo_compile_fast target first)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1> $<$<CONFIG:None>:-O0>)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(first ${target})
  endif()
  tribo_standard_headers(${target} ${first} ${ARGN})
endfunction()

# tribo_compile_together(TARGET source...): in a unity build, up to eight neighbours of one folder are read as one source. Each then reads
# the headers once, which takes less than half of the time. CMake leaves out sources with options of their own.
function(tribo_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  foreach(source ${ARGN})
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    string(REPLACE "/" "_" group ${folder})
    if(NOT DEFINED count_${group})
      set(count_${group} 0)
    endif()
    math(EXPR part "${count_${group}} / 8")
    math(EXPR count_${group} "${count_${group}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
endfunction()

# tribo_room(NAME LINKS room... [PRIVATE lib...] [FINDS package...] [WASI_LEAVES stem...] [OWN_HEADERS] [FAST]): all sources of src/NAME
# as the library tribo::NAME, linking only the rooms that its row of the table in README.md allows. FINDS are the packages that
# an installed tribo::NAME needs: a CMake package, or PREFIX=module for pkg-config. WASI_LEAVES are sources that no page's module
# takes. OWN_HEADERS: for a room that is compiled with other options than most, its own or its libraries'. FAST: compiled by
# tribo_compile_fast.
function(tribo_room name)
  cmake_parse_arguments(ROOM "OWN_HEADERS;FAST" "" "LINKS;PRIVATE;FINDS;WASI_LEAVES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  if(WASI)
    foreach(stem ${ROOM_WASI_LEAVES})
      list(FILTER sources EXCLUDE REGEX "/${stem}\\.cpp$")
    endforeach()
  endif()
  if(NOT sources)
    return()
  endif()
  add_library(tribo_${name} STATIC ${sources})
  add_library(tribo::${name} ALIAS tribo_${name})
  tribo_compile_together(tribo_${name} ${sources})
  target_link_libraries(tribo_${name} PUBLIC tribo_options)
  # What reads foreign bytes tells the fuzzer where it was; numbers are computed without that.
  if(TRIBO_FUZZ AND name MATCHES "^(readers|files|material|job|protocol)$")
    target_compile_options(tribo_${name} PRIVATE -fsanitize=fuzzer-no-link)
    set(ROOM_OWN_HEADERS ON)
  endif()
  foreach(room ${ROOM_LINKS})
    if(TARGET tribo_${room})
      target_link_libraries(tribo_${name} PUBLIC tribo_${room})
    endif()
  endforeach()
  target_link_libraries(tribo_${name} PRIVATE ${ROOM_PRIVATE})
  set_target_properties(tribo_${name} PROPERTIES EXPORT_NAME ${name})
  set(first tribo_base)
  if(ROOM_OWN_HEADERS)
    set(first tribo_${name})
  endif()
  if(ROOM_FAST)
    tribo_compile_fast(tribo_${name} ${first})
  else()
    tribo_standard_headers(tribo_${name} ${first})
  endif()
  # For the installed package (TriboInstall.cmake).
  set_property(GLOBAL APPEND PROPERTY TRIBO_ROOMS ${name})
  set_property(GLOBAL PROPERTY TRIBO_LINKS_${name} ${ROOM_LINKS})
  set_property(GLOBAL PROPERTY TRIBO_FINDS_${name} ${ROOM_FINDS})
  # A hot kernel `NAME_v3.cpp` is the same source as `NAME_sse2.cpp`, compiled for x86-64-v3 and chosen at start.
  foreach(source ${sources})
    if(source MATCHES "_(sse2|v3)\\.cpp$")
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
    if(source MATCHES "_v3\\.cpp$" AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
      set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "-march=x86-64-v3" SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()
