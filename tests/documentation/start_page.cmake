# SPDX-License-Identifier: BSD-3-Clause
# The start page names every page below it, by its title, and nothing that is not there.
file(REMOVE_RECURSE ${scratch})
file(MAKE_DIRECTORY ${scratch}/demo/demo ${scratch}/docs/html ${scratch}/empty)
file(WRITE ${scratch}/demo/demo/index.html
  "<title>passive_haptics: a; b</title><meta name=\"description\" content=\"It [is]; c.\">")
file(WRITE ${scratch}/docs/index.html "<title>The site</title>")
file(WRITE ${scratch}/docs/html/index.html "<title>Inside</title>")
function(start_page folder expect)
  execute_process(COMMAND ${CMAKE_COMMAND} -Dfolder=${folder}
    -P ${root}/bench/common/start_page.cmake RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE said)
  if(NOT code STREQUAL "${expect}")
    message(FATAL_ERROR "${folder}: ended with ${code}, not ${expect}\n${said}")
  endif()
endfunction()
start_page(${scratch} 0)
file(READ ${scratch}/index.html page)
foreach(wanted IN ITEMS "href=\"demo/demo/index.html\"><b>a; b</b><span>It [is]; c.</span>"
    "href=\"docs/index.html\"><b>The site</b>" "--paper:")
  string(FIND "${page}" "${wanted}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "the start page lacks ${wanted}")
  endif()
endforeach()
if(page MATCHES "Inside|http:|https:")
  message(FATAL_ERROR "the start page names ${CMAKE_MATCH_0}")
endif()
start_page(${scratch}/empty 0)
start_page(${scratch}/nowhere 1)  # the control
