# SPDX-License-Identifier: BSD-3-Clause
# Compiles falcon_tick.cpp for a Cortex-M4F without exceptions and RTTI, and looks at what it asks
# the linker for. -D COMPILER, NM, SIZE, SOURCE, INCLUDE, OUT
cmake_minimum_required(VERSION 3.24)

execute_process(
  COMMAND ${COMPILER} -std=c++20 -Os -DNDEBUG -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16
    -mfloat-abi=hard -fno-exceptions -fno-rtti -fno-math-errno -ffunction-sections
    -fno-threadsafe-statics -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow
    -Werror -I${INCLUDE} -c ${SOURCE} -o ${OUT}
  RESULT_VARIABLE failed ERROR_VARIABLE text)
if(failed)
  message(FATAL_ERROR "does not compile for the Cortex-M4F:\n${text}")
endif()
execute_process(COMMAND ${NM} --undefined-only --format=just-symbols ${OUT}
  OUTPUT_VARIABLE symbols OUTPUT_STRIP_TRAILING_WHITESPACE)
string(REPLACE "\n" ";" symbols "${symbols}")
set(allowed sinf cosf sqrtf memcpy memset memmove)
foreach(symbol IN LISTS symbols)
  if(NOT symbol IN_LIST allowed)
    list(APPEND strange ${symbol})
  endif()
endforeach()
if(strange)
  message(FATAL_ERROR "asks the linker for ${strange}, beyond ${allowed}")
endif()
execute_process(COMMAND ${SIZE} ${OUT} OUTPUT_VARIABLE size)
message("asks the linker for: ${symbols}\n${size}")
