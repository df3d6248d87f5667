# SPDX-License-Identifier: BSD-3-Clause
# In `include` one header names the attribute no_unique_address; all others use its macro.
file(GLOB_RECURSE headers ${include}/*.hpp)
set(users 0)
foreach(header IN LISTS headers)
  file(READ ${header} code)
  if(code MATCHES "PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS [a-z]")
    math(EXPR users "${users} + 1")
  endif()
  if(code MATCHES "no_unique_address\\]" AND NOT header MATCHES "/no_unique_address\\.hpp$")
    message(SEND_ERROR "${header} names an attribute that MSVC ignores: write "
      "PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS (no_unique_address.hpp)")
  endif()
endforeach()
if(users LESS 5)
  message(SEND_ERROR "only ${users} headers use the macro: is it written in another way?")
endif()
