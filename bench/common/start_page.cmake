# SPDX-License-Identifier: BSD-3-Clause
# Writes <folder>/index.html: a card for each page that stands below it, by its title and description.
#     cmake -Dfolder=build -P bench/common/start_page.cmake
cmake_minimum_required(VERSION 3.24)
if(NOT IS_DIRECTORY "${folder}")
  message(FATAL_ERROR "-Dfolder=${folder} is no folder: name the one that the builds stand in, as build")
endif()

# The look has one home, and so have the cards.
file(READ ${CMAKE_CURRENT_LIST_DIR}/page.hpp style)
string(REGEX REPLACE "^.*page_style = R\"css\\(" "" style "${style}")
string(REGEX REPLACE "\\)css\";.*$" "" style "${style}")

# found(variable text regex): what the first group finds, or nothing.
function(found variable text regex)
  set(${variable} "" PARENT_SCOPE)
  if(text MATCHES "${regex}")
    set(${variable} "${CMAKE_MATCH_1}" PARENT_SCOPE)
  endif()
endfunction()

file(GLOB pages RELATIVE ${folder} ${folder}/*/index.html ${folder}/*/*/index.html)
# Of docs and of what is below it, the site alone.
list(FILTER pages EXCLUDE REGEX "^docs/.+/")
set(cards "")
set(count 0)
foreach(page IN LISTS pages)
  file(READ ${folder}/${page} text LIMIT 20000)
  found(title "${text}" "<title>([^<]*)</title>")
  found(about "${text}" "<meta name=\"description\" content=\"([^\"]*)\"")
  if(title STREQUAL "")
    set(title "${page}")
  endif()
  string(REGEX REPLACE "^passive_haptics: " "" title "${title}")
  string(REGEX REPLACE "/index.html$" "" where "${page}")
  string(APPEND cards "<li><a href=\"${page}\"><b>${title}</b><span>${about}</span> \
<span>${where}</span></a></li>\n")
  math(EXPR count "${count} + 1")
endforeach()
if(count EQUAL 0)
  set(cards "<li>Nothing yet: <code>cmake --workflow --preset demo</code> makes the first page.</li>\n")
endif()
file(WRITE ${folder}/index.html "<!doctype html>
<html lang=\"en\">
<head>
<meta charset=\"utf-8\">
<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">
<title>passive_haptics: what has been built</title>
<style>${style}</style>
</head>
<body>
<header>
<h1>passive_haptics: what has been built</h1>
<p>Every page that a build on this machine has left behind. Each can be opened without a network.</p>
</header>
<main>
<ul class=\"cards\">
${cards}</ul>
</main>
<footer><p>Written anew by each program that leaves a page.</p></footer>
</body>
</html>
")
message(STATUS "start page: ${folder}/index.html, ${count} pages")
