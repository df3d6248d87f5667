// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// This room refuses an input that it cannot use with a sentence that names the value and the remedy.
//
//   as a value, to ask first   find_fault(mesh), rigid_modes_left(mesh, fixed), load_msh(file)
//   as an exception            mesh_error, singular_stiffness, std::invalid_argument
//
// Under -fno-exceptions the values are the same, and the text of an exception goes to stderr and the program
// ends, because a constructor has no other way to refuse.

#include <passive_haptics/base/language.hpp>

#include <cstdio>
#include <cstdlib>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// Joins the parts to one text. Numbers are written in the "C" locale, whatever locale the application has set.
template <class... Parts>
[[nodiscard]] std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  (text << ... << parts);
  return text.str();
}

/// A mesh that cannot be used. what() is complete: "<where>: <what is wrong>; <what to do>".
class mesh_error : public std::runtime_error {
 public:
  mesh_error(std::string_view where, std::string_view problem, std::string_view remedy)
      : std::runtime_error(sentence(where, ": ", problem, "; ", remedy)) {}
};

/// Throws the error; a program compiled without exceptions ends with its text.
template <class Error>
[[noreturn]] void refuse(const Error& error) {
#if defined(__cpp_exceptions)
  throw error;
#else
  std::fprintf(stderr, "passive_haptics, environment: %s\n", error.what());
  std::abort();
#endif
}

/// Refuses an argument with a std::invalid_argument of these parts.
template <class... Parts>
[[noreturn]] void refuse_argument(const Parts&... parts) {
  refuse(std::invalid_argument(sentence(parts...)));
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
