# SPDX-License-Identifier: BSD-3-Clause
# Runs `compile` (a command line), which must fail and say `expect` (a regular expression). Where that is
# a sentence of ours, one of ours comes first of all errors.
execute_process(COMMAND ${compile} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
if(code STREQUAL "0")
  message(FATAL_ERROR "this compiles, and should not:\n${compile}")
endif()
if(NOT said MATCHES "${expect}")
  message("${said}")
  message(FATAL_ERROR "the compiler did not say: ${expect}")
endif()
string(REGEX MATCH "(^|\n)[^\n]*error: [^\n]*" first "${said}")
if(expect MATCHES "^passive_haptics: " AND NOT first MATCHES "passive_haptics: ")
  message("${said}")
  message(FATAL_ERROR "the compiler said this first:${first}\nand should begin with a sentence of ours")
endif()
