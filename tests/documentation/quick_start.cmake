# SPDX-License-Identifier: BSD-3-Clause
# What README.md promises a newcomer, as it stands there: the quick start is saved, its command run, and
# what it prints compared, numbers within 2 %; then the library is installed and found as it says.
# root, scratch, compiler (used where README's g++ is not the one that builds the tests), eigen (where
# README's is not here), options (of consumers)
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${scratch})
file(MAKE_DIRECTORY ${scratch})
file(READ ${root}/README.md readme)

# fenced(variable mark language): the fenced block under `<!-- mark -->`.
function(fenced variable mark language)
  string(FIND "${readme}" "<!-- ${mark} -->\n```${language}\n" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "README.md has no ${language} block under <!-- ${mark} -->")
  endif()
  string(LENGTH "<!-- ${mark} -->\n```${language}\n" heading)
  math(EXPR at "${at} + ${heading}")
  string(SUBSTRING "${readme}" ${at} -1 rest)
  string(FIND "${rest}" "```" end)
  string(SUBSTRING "${rest}" 0 ${end} text)
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

function(must result what said)
  if(NOT result STREQUAL "0")
    message(FATAL_ERROR "${what}: ended with ${result}\n${said}")
  endif()
endfunction()

# ------------------------------------------------------------------------------- the quick start
fenced(program "quick start: quick.cpp" cpp)
fenced(command "quick start: command" sh)
fenced(wanted "quick start: prints" text)
file(WRITE ${scratch}/quick.cpp "${program}")
file(CREATE_LINK ${root}/include ${scratch}/include SYMBOLIC)
if(compiler)
  string(REPLACE "g++ " "${compiler} " command "${command}")
endif()
if(NOT EXISTS /usr/include/eigen3/Eigen/Core)
  string(REPLACE "/usr/include/eigen3" "${eigen}" command "${command}")
endif()
execute_process(COMMAND sh -c "${command}" WORKING_DIRECTORY ${scratch}
  OUTPUT_VARIABLE printed ERROR_VARIABLE said RESULT_VARIABLE code)
must("${code}" "${command}" "${printed}${said}")
if(said)
  message(FATAL_ERROR "${command} is not silent:\n${said}")
endif()

# In hundredths, as all of them are printed.
set(number "-?[0-9]+[.][0-9][0-9]")
string(REGEX REPLACE "${number}" "#" shape_printed "${printed}")
string(REGEX REPLACE "${number}" "#" shape_wanted "${wanted}")
string(REGEX REPLACE " +" " " shape_printed "${shape_printed}")
string(REGEX REPLACE " +" " " shape_wanted "${shape_wanted}")
string(REGEX MATCHALL "${number}" numbers_printed "${printed}")
string(REGEX MATCHALL "${number}" numbers_wanted "${wanted}")
set(same TRUE)
if(NOT shape_printed STREQUAL shape_wanted OR NOT numbers_wanted)
  set(same FALSE)
else()
  foreach(a b IN ZIP_LISTS numbers_printed numbers_wanted)
    string(REGEX REPLACE "[.]" "" a "${a}")
    string(REGEX REPLACE "[.]" "" b "${b}")
    string(REGEX REPLACE "^(-?)0+([0-9])" "\\1\\2" a "${a}")
    string(REGEX REPLACE "^(-?)0+([0-9])" "\\1\\2" b "${b}")
    math(EXPR off "(${a}) - (${b})")
    math(EXPR most "(${b}) / 50")
    string(REPLACE "-" "" off "${off}")
    string(REPLACE "-" "" most "${most}")
    if(off GREATER most)
      set(same FALSE)
    endif()
  endforeach()
endif()
if(NOT same)
  message(FATAL_ERROR "quick.cpp prints\n${printed}and README.md says\n${wanted}")
endif()

# ------------------------------------------------------------------------------ installed, and found
fenced(commands "ci: install" sh)
string(REGEX MATCH "cmake --preset ([a-z]+)" preset "${commands}")
if(NOT preset)
  message(FATAL_ERROR "README.md installs by no preset:\n${commands}")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} --preset ${CMAKE_MATCH_1} -B ${scratch}/build ${options}
  WORKING_DIRECTORY ${root} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
must("${code}" "${preset}" "${said}")
execute_process(COMMAND ${CMAKE_COMMAND} --install ${scratch}/build --prefix ${scratch}/prefix
  OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
must("${code}" "cmake --install" "${said}")

fenced(lists "ci: find_package" cmake)
file(WRITE ${scratch}/consumer/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.24)\nproject(consumer LANGUAGES CXX)\n${lists}")
file(WRITE ${scratch}/consumer/my_loop.cpp "${program}")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${scratch}/consumer -B ${scratch}/consumer/build -G Ninja
  -D CMAKE_PREFIX_PATH=${scratch}/prefix ${options}
  OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
must("${code}" "find_package(passive_haptics)" "${said}")
execute_process(COMMAND ${CMAKE_COMMAND} --build ${scratch}/consumer/build
  OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
must("${code}" "my_loop" "${said}")
