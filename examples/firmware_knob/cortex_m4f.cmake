# SPDX-License-Identifier: BSD-3-Clause
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m4)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_FLAGS_INIT "-mthumb -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard \
-O2 -DNDEBUG -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-math-errno \
-ffunction-sections -fdata-sections")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib -Wl,--gc-sections")
set(CMAKE_CXX_STANDARD_LIBRARIES "-lm -lc -lgcc")
set(CMAKE_CROSSCOMPILING_EMULATOR "qemu-system-arm;-M;mps2-an386;-display;none;-monitor;none;\
-serial;none;-icount;shift=4,align=off,sleep=off;\
-semihosting-config;enable=on,target=native;-kernel")
