# SPDX-License-Identifier: BSD-3-Clause
# Every EXPECT of the wrong uses in `folder` must be found in one section of `page`.
file(READ ${page} text)
string(REGEX REPLACE "[][;]" " " text "${text}")  # they mean something in a list
string(REPLACE "\n## " ";" sections "${text}")
file(GLOB files ${folder}/*.cpp)
foreach(file IN LISTS files)
  file(STRINGS ${file} expect REGEX "^// EXPECT: ")
  string(REPLACE "// EXPECT: " "" expect "${expect}")
  set(found FALSE)
  foreach(section IN LISTS sections)
    if(section MATCHES "${expect}")
      set(found TRUE)
    endif()
  endforeach()
  if(NOT expect OR NOT found)
    message(SEND_ERROR "${file} expects \"${expect}\", which ${page} does not explain")
  endif()
endforeach()
