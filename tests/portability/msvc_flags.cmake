# SPDX-License-Identifier: BSD-3-Clause
# Configures `source` in `build` for MSVC (pretend_msvc.cmake) with `options`: the compiler is told that
# the headers are UTF-8, and is given no flag of g++.
file(REMOVE_RECURSE ${build})
execute_process(COMMAND ${CMAKE_COMMAND} -Wno-dev -S ${source} -B ${build} -G Ninja
  -DCMAKE_TOOLCHAIN_FILE=${CMAKE_CURRENT_LIST_DIR}/pretend_msvc.cmake
  -DPASSIVE_HAPTICS_TESTS=full ${options}
  OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${said}")
endif()
file(STRINGS ${build}/build.ninja flags REGEX "^ *FLAGS = ")
list(JOIN flags "\n" flags)
if(NOT flags MATCHES " /utf-8 .*std:c\\+\\+20")
  message(FATAL_ERROR "no /utf-8 in\n${flags}")
endif()
if(flags MATCHES " -[WfgmO][^\n]*")
  message(FATAL_ERROR "flags of g++, not of cl: ${CMAKE_MATCH_0}")
endif()
