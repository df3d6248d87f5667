// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tags of an XML text one after the other, as far as VTU files need them: no entities, no DTD.

#include <passive_haptics/base/language.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// What stands between angle brackets: name key="value" ..., with a slash in front or at the end.
struct xml_tag {
  std::string_view name;  ///< without the slash
  std::string_view attributes;
  bool opens = false;
  bool closes = false;  ///< with a slash at the end it does both

  [[nodiscard]] std::optional<std::string_view> operator[](std::string_view key) const {
    for (std::string_view left = attributes;;) {
      const std::size_t begin = left.find_first_not_of(" \t\r\n");
      const std::size_t equal = left.find('=');
      const std::size_t quote = left.find_first_of("\"'");
      if (begin == left.npos || equal == left.npos || quote == left.npos) return std::nullopt;
      const std::size_t end = left.find(left[quote], quote + 1);
      if (end == left.npos) return std::nullopt;
      std::string_view found = left.substr(begin, (std::max)(begin, equal) - begin);
      found = found.substr(0, found.find_last_not_of(" \t\r\n") + 1);
      if (found == key) return left.substr(quote + 1, end - quote - 1);
      left.remove_prefix(end + 1);
    }
  }
};

class xml_tags {
 public:
  explicit xml_tags(std::string_view text) : left_(text) {}

  /// What follows the last tag.
  [[nodiscard]] std::string_view left() const noexcept { return left_; }

  /// The next tag; none at the end, or where a tag does not end. Comments and instructions are passed over.
  [[nodiscard]] std::optional<xml_tag> next() {
    while (pass(left_.find('<'))) {
      if (left_.starts_with("<!--")) {
        if (!pass_over("-->")) break;
      } else if (left_.starts_with("<?") || left_.starts_with("<!")) {
        if (!pass_over(">")) break;
      } else {
        return tag();
      }
    }
    left_ = {};
    return std::nullopt;
  }

 private:
  bool pass(std::size_t bytes) {
    if (bytes == std::string_view::npos) return false;
    left_.remove_prefix(bytes);
    return true;
  }
  bool pass_over(std::string_view end) {
    const std::size_t at = left_.find(end);
    return at != std::string_view::npos && pass(at + end.size());
  }

  /// A > between quotes does not end it.
  [[nodiscard]] std::optional<xml_tag> tag() {
    char quote = 0;
    std::size_t end = 1;
    for (; end < left_.size() && (quote != 0 || left_[end] != '>'); ++end) {
      const char c = left_[end];
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
      }
    }
    if (end == left_.size()) return std::nullopt;
    std::string_view inside = left_.substr(1, end - 1);
    left_.remove_prefix(end + 1);
    xml_tag found;
    found.opens = !inside.starts_with('/');
    if (!found.opens) inside.remove_prefix(1);
    found.closes = !found.opens || inside.ends_with('/');
    if (found.opens && found.closes) inside.remove_suffix(1);
    found.name = inside.substr(0, inside.find_first_of(" \t\r\n"));
    found.attributes = inside.substr(found.name.size());
    return found;
  }

  std::string_view left_;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
