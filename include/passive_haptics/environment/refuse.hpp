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

#include <concepts>
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

// These are cold, so that a user's compiler does not inline them.
[[gnu::cold, gnu::noinline]] inline void append(std::string& text, std::string_view part) {
  text += part;
}
template <class Part>
requires(!std::convertible_to<const Part&, std::string_view>)
    [[gnu::cold, gnu::noinline]] void append(std::string& text, const Part& part) {
  if constexpr (std::integral<Part> && sizeof(Part) > 1) {
    text += std::to_string(part);
  } else {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream << part;
    text += stream.str();
  }
}

/// Joins the parts to one text. Numbers are written in the "C" locale, whatever locale the application has set. Parts
/// are taken by value, so that texts of all lengths share one function.
template <class... Parts>
[[nodiscard, gnu::cold, gnu::noinline]] std::string sentence(Parts... parts) {
  std::string text;
  (append(text, parts), ...);
  return text;
}

/// A mesh that cannot be used. what() is complete: "<where>: <what is wrong>; <what to do>".
class mesh_error : public std::runtime_error {
 public:
  mesh_error(std::string_view where, std::string_view problem, std::string_view remedy)
      : std::runtime_error(sentence(where, ": ", problem, "; ", remedy)) {}
};

/// Throws the error; a program compiled without exceptions ends with its text.
template <class Error>
[[noreturn, gnu::cold, gnu::noinline]] void refuse(const Error& error) {
#if defined(__cpp_exceptions)
  throw error;
#else
  std::fprintf(stderr, "passive_haptics, environment: %s\n", error.what());
  std::abort();
#endif
}

/// Refuses an argument with a std::invalid_argument of these parts.
template <class... Parts>
[[noreturn, gnu::cold, gnu::noinline]] void refuse_argument(Parts... parts) {
  refuse(std::invalid_argument(sentence(parts...)));
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
