# Finds the clang of the presets: the version that CI uses, else the newest one from 17 on. CMAKE_CXX_COMPILER on the command line wins.
if(NOT CMAKE_CXX_COMPILER)
  find_program(TRIBO_CLANG NAMES clang++-19 clang++-22 clang++-21 clang++-20 clang++-18 clang++-17 clang++)
  if(NOT TRIBO_CLANG)
    message(FATAL_ERROR "no clang++ is here: install clang-17 or newer, or use the preset `release` (g++)")
  endif()
  set(CMAKE_CXX_COMPILER ${TRIBO_CLANG})
endif()
