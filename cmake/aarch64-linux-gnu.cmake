# SPDX-License-Identifier: Apache-2.0
# Toolchain file: Linux on 64-bit ARM, by Debian's crossbuild-essential-arm64, against the arm64 packages of the libraries, which Debian installs beside those
# of this machine. The packages for it are made by scripts/cross-packages.sh:
#   cmake --preset release -DCMAKE_TOOLCHAIN_FILE=$PWD/cmake/aarch64-linux-gnu.cmake -DBUILD_TESTING=OFF
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
# What pkg-config says is of these libraries alone.
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
# CPack makes packages for the architecture of the computer that it runs on unless it is told.
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
