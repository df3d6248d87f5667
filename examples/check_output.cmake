# SPDX-License-Identifier: BSD-3-Clause
# Runs `program` (a command line) and compares what it prints with the file `expected`, exactly.
execute_process(COMMAND ${program}
  OUTPUT_VARIABLE printed ERROR_VARIABLE complaint RESULT_VARIABLE code)
file(READ ${expected} wanted)
if(NOT code STREQUAL "0")
  message(FATAL_ERROR "${program} ended with ${code}\n${complaint}")
endif()
if(NOT printed STREQUAL wanted)
  message("printed\n${printed}\nwanted\n${wanted}")
  message(FATAL_ERROR "the output is not the text of ${expected}")
endif()
