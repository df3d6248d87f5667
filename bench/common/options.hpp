// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The options of a program in one list, from which come the parser, its complaints and --help; and the exit codes.

#include "text.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace experiments {

/// "--quick", "--out DIR", "--merge FILE..." for one or several.
struct option {
  std::string form, help;
  std::function<void(const std::string& value)> take;  ///< each value; a switch gives an empty one
};

/// --help was given; what() is the usage.
struct asked_for_help : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The program was stopped before its end; what() says what is on disk.
struct interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] inline void complain(const std::string& what) {
  throw std::invalid_argument(what);
}

inline int whole_number(const std::string& name, const std::string& text, int least) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc::result_out_of_range && text[0] != '-') {
    complain(name + " " + text + ": give at most " +
             std::to_string(std::numeric_limits<int>::max()));
  }
  if (error != std::errc{} || rest != end || value < least) {
    complain(name + " " + text + ": give a whole number of at least " + std::to_string(least));
  }
  return value;
}

inline option a_switch(const std::string& name, const std::string& help, bool& where) {
  return {name, help, [&where](const std::string&) { where = true; }};
}
inline option a_text(const std::string& form, const std::string& help, std::string& where) {
  return {form, help, [&where](const std::string& text) { where = text; }};
}
inline option a_number(const std::string& name, const std::string& help, int& where,
                       int least = 1) {
  return {name + " N", help, [&where, name, least](const std::string& text) {
            where = whole_number(name, text, least);
          }};
}

/// What is drawn at random comes from this seed; `of` says what that is.
inline option a_seed(const std::string& of, int& where) {
  return a_number("--seed", of + " (default: 1)", where);
}

/// Gives every value to its option, then calls `last`, which may refuse their combination. Throws
/// std::invalid_argument with the value, the remedy and the usage.
inline void read_options(
    const std::string& program, const std::vector<option>& all,
    const std::vector<std::string>& arguments, const std::function<void()>& last = [] {}) {
  std::string usage = "usage: " + program + " [OPTION...]";
  std::size_t widest = 0;
  for (const auto& o : all) widest = std::max(widest, o.form.size());
  for (const auto& o : all) {
    usage += "\n  " + o.form + std::string(widest - o.form.size() + 2, ' ') +
             paragraph(o.help, widest + 4);
  }
  try {
    for (auto at = arguments.begin(); at != arguments.end();) {
      const std::string& name = *at++;
      if (name == "--help" || name == "-h") throw asked_for_help(usage);
      const auto found = std::find_if(all.begin(), all.end(), [&name](const option& o) {
        return o.form.substr(0, o.form.find(' ')) == name;
      });
      if (found == all.end()) complain(name + ": no such option");
      if (found->form == name) {
        found->take("");
        continue;
      }
      const auto is_value = [&] { return at != arguments.end() && at->rfind("--", 0) != 0; };
      if (!is_value()) complain(name + ": its value is missing");
      do {
        found->take(*at++);
      } while (found->form.ends_with("...") && is_value());
    }
    last();
  } catch (const std::invalid_argument& problem) {
    complain(problem.what() + ("\n" + usage));
  }
}

/// The main() of a program. It returns the result of `body`, or 0 after --help, 2 for a wrong argument, 130 if
/// stopped, and 1 for any other problem, which it prints.
template <class Body>
int guarded(const std::string& program, Body body) {
  const auto said = [&program](const std::exception& problem, int code) {
    std::cerr << program << ": " << problem.what() << '\n';
    return code;
  };
  try {
    return body();
  } catch (const asked_for_help& help) {
    std::cout << help.what() << '\n';
    return 0;
  } catch (const std::invalid_argument& problem) {
    return said(problem, 2);
  } catch (const interrupted& stopped) {
    return said(stopped, 130);
  } catch (const std::exception& problem) {
    return said(problem, 1);
  }
}

}  // namespace experiments
