# SPDX-License-Identifier: BSD-3-Clause
# Each header of `folder` must compile by itself: `compile` is a command line that takes one more file.
file(GLOB headers RELATIVE ${include} ${folder}/*.hpp)
set(failed "")
foreach(header IN LISTS headers)
  file(WRITE ${scratch} "#include <${header}>\n")
  execute_process(COMMAND ${compile} ${scratch} ERROR_VARIABLE said RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    string(APPEND failed "${header}:\n${said}\n")
  endif()
endforeach()
if(failed)
  message(FATAL_ERROR "${failed}")
endif()
