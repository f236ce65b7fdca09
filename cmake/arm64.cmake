# Debian's cross compiler for boards with ARM64. Programs that run while building (glb2idl, tests) run by qemu-user. See
# docs/building.md.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
# All of it is compiled by one compiler: how GCC 9 passed a pair of numbers does not matter.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/bin/qemu-aarch64)
