# SPDX-License-Identifier: BSD-3-Clause
# `program` (a command line) explains itself for --help and for -h: it ends with 0, says `expect` in one screen of 80
# columns and 24 lines, the folder it lies in not counted, and leaves nothing behind in `scratch`, where it runs.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${scratch})
file(MAKE_DIRECTORY ${scratch})
foreach(asked IN ITEMS --help -h)
  execute_process(COMMAND ${program} ${asked} WORKING_DIRECTORY ${scratch}
    OUTPUT_VARIABLE said ERROR_VARIABLE complaint RESULT_VARIABLE code)
  if(NOT code STREQUAL "0" OR NOT said MATCHES "${expect}")
    message(FATAL_ERROR "${program} ${asked}: ended with ${code} and does not say ${expect}\n"
      "${said}${complaint}")
  endif()
  cmake_path(GET program PARENT_PATH folder)
  string(REPLACE "${folder}/" "" said "${said}")
  string(REGEX REPLACE "[][;]" " " said "${said}")  # they mean something in a list
  string(REGEX REPLACE "\n$" "" said "${said}")
  string(REPLACE "\n" ";" lines "${said}")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "[^ -~]" "" line "${line}")  # the bytes of characters beyond ASCII
    string(LENGTH "${line}" length)
    if(length GREATER 80)
      message(FATAL_ERROR "${program} ${asked}: longer than 80 columns: ${line}")
    endif()
  endforeach()
  list(LENGTH lines count)
  if(count GREATER 24)
    message(FATAL_ERROR "${program} ${asked}: longer than 24 lines: ${count}")
  endif()
endforeach()
file(GLOB left ${scratch}/*)
if(left)
  message(FATAL_ERROR "${program} --help leaves ${left}")
endif()
