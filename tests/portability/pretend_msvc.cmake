# SPDX-License-Identifier: BSD-3-Clause
# A toolchain file that tells CMake the compiler is MSVC, where there is none: enough to configure and
# to read what it would be called with, not to build anything.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_CXX_COMPILER_ID MSVC)
set(CMAKE_CXX_COMPILER_ID_RUN TRUE)
set(CMAKE_CXX_COMPILER_VERSION 19.38)
set(CMAKE_CXX_COMPILER_WORKS TRUE)
set(CMAKE_CXX_STANDARD_COMPUTED_DEFAULT 14)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
foreach(tool IN ITEMS CXX_COMPILER LINKER AR MT RC_COMPILER)
  set(CMAKE_${tool} true)
endforeach()
