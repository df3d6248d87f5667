# SPDX-License-Identifier: BSD-3-Clause
# Every header in `include`, included first, must fail under `compile` (a command line that takes one
# more file) with one error, and that one must say `expect` (a regular expression). A header that is not there ends
# a compilation while it is preprocessed, so no more than that is asked for, which takes a tenth of the time.
file(GLOB_RECURSE headers RELATIVE ${include} ${include}/*.hpp)
list(LENGTH headers count)
if(count LESS 50)
  message(FATAL_ERROR "only ${count} headers in ${include}")
endif()
foreach(header IN LISTS headers)
  file(WRITE ${scratch} "#include <${header}>\n")
  execute_process(COMMAND ${compile} -E ${scratch} OUTPUT_QUIET ERROR_VARIABLE said)
  string(REGEX MATCHALL "error: [^\n]*" errors "${said}")
  list(LENGTH errors count)
  if(NOT count EQUAL 1 OR NOT errors MATCHES "${expect}")
    message(SEND_ERROR "${header}: ${count} errors, and not one that says ${expect}\n${said}")
  endif()
endforeach()
