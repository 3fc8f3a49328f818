# Toolchain of the `wasm` preset: Debian's clang with wasi-libc; no threads, no exceptions, zero imports (src/wasm/README.md).
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(WASI TRUE)
include(${CMAKE_CURRENT_LIST_DIR}/clang.cmake)
# Binutils' ar cannot index WebAssembly, and lld does without an index: no need for the llvm package.
set(CMAKE_AR ar)
set(CMAKE_RANLIB ranlib)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fno-exceptions -fno-rtti")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-mexec-model=reactor -Wl,--strip-all -Wl,--gc-sections -Wl,-z,stack-size=262144")
