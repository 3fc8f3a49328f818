# What makes a fault of the program hard to use: options of the OpenSSF guide for C and C++ (2024). scripts/check_hardening.sh shows
# that the program has them. The modules of the pages run in the browser's sandbox, and sanitizers have checks of their own.
if(WASI OR CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  return()
endif()
include(CheckCXXCompilerFlag)
set(hardening -fstack-protector-strong -fPIE)
# Without optimisation the C library warns that it cannot check.
list(APPEND hardening $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE> $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=3>)
# The large-stack probe, and the marks of jump targets: x86 CET, and its twin of ARM.
foreach(flag -fstack-clash-protection -fcf-protection=full -mbranch-protection=standard)
  string(MAKE_C_IDENTIFIER "TRIBO_HAS${flag}" has)
  check_cxx_compiler_flag(${flag} ${has})
  if(${has})
    list(APPEND hardening ${flag})
  endif()
endforeach()
target_compile_options(tribo_options INTERFACE $<BUILD_INTERFACE:${hardening}>)
# A place in memory that changes with every start, and no table of addresses that can be written.
target_link_options(tribo_options INTERFACE $<BUILD_INTERFACE:$<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-pie>>
                    $<BUILD_INTERFACE:LINKER:-z,relro,-z,now,-z,noexecstack>)
