# SPDX-License-Identifier: BSD-3-Clause
# Compiles `source` with `compile` unoptimised, where every function that is instantiated stays a
# symbol, and looks in symbols (`nm`) and included files for each of `words`. WANTED: all must be
# there; otherwise none may be.
execute_process(COMMAND ${compile} -O0 -c ${source} -o ${object} -MD -MF ${object}.d
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${nm} -C ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
file(READ ${object}.d files)
string(APPEND symbols "${files}")
foreach(word IN LISTS words)
  if(symbols MATCHES "${word}")
    set(found TRUE)
  else()
    set(found FALSE)
  endif()
  if(WANTED AND NOT found)
    message(SEND_ERROR "${source} should hold \"${word}\" and does not: the search finds nothing")
  elseif(NOT WANTED AND found)
    message(SEND_ERROR "${source} holds \"${CMAKE_MATCH_0}\", which it has no use for")
  endif()
endforeach()
