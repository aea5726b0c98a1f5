# SPDX-License-Identifier: MIT
# Cross build for arm64 (Raspberry Pi class) with Debian's g++-aarch64-linux-gnu:
#
#   export PLUMBLINE_SYSROOT=DIR
#   cmake --workflow --preset arm64        leaves build/arm64/plumbline
#
# DIR is the root of an arm64 Debian file system with the packages of `scripts/setup --build --list`
# in it: a copy of the drone's own, or one made for the purpose. Libraries and headers come only
# from there, programs (compilers, cmake) only from this machine.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)

if("$ENV{PLUMBLINE_SYSROOT}" STREQUAL "" OR NOT IS_DIRECTORY "$ENV{PLUMBLINE_SYSROOT}/usr/include")
  message(FATAL_ERROR "PLUMBLINE_SYSROOT=\"$ENV{PLUMBLINE_SYSROOT}\" is not the root of an arm64 "
                      "file system with usr/include in it; see cmake/toolchain-arm64.cmake.")
endif()
get_filename_component(CMAKE_SYSROOT "$ENV{PLUMBLINE_SYSROOT}" ABSOLUTE)

set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(CMAKE_FIND_ROOT_PATH "${CMAKE_SYSROOT}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

set(ENV{PKG_CONFIG_SYSROOT_DIR} "${CMAKE_SYSROOT}")
set(ENV{PKG_CONFIG_DIR} "")
set(ENV{PKG_CONFIG_LIBDIR}
    "${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig")
