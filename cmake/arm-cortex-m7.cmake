# SPDX-License-Identifier: Apache-2.0
# Toolchain file: a bare cortex-m7 with double-precision FPU, by Debian's gcc-arm-none-eabi.
#   cmake -S libnc -B build/arm -DCMAKE_TOOLCHAIN_FILE=$PWD/cmake/arm-cortex-m7.cmake -DNC_SHARED=OFF
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(nc_cpu "-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard -ffunction-sections -fdata-sections")
set(CMAKE_C_FLAGS_INIT "${nc_cpu}")
set(CMAKE_CXX_FLAGS_INIT "${nc_cpu}")
# Nothing is linked here: a firmware brings its own start-up code and linker script.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
