# SPDX-License-Identifier: BSD-3-Clause
# How doxygen sees a header: the comment that follows `#pragma once` is the page of the file, set as it
# stands, for it may hold a menu or a drawing; the inline namespace is left out, which would be part of
# every name; and an alias that has no comment gets one, since doxygen leaves out what has none.
/^inline namespace v[0-9]+ \{$/ || /^}  \/\/ namespace v[0-9]+$/ { $0 = "" }
# A template argument that is left out is no tag of HTML.
/^ *\/\/\/.*<…>/ { gsub(/<…>/, "\\<…\\>") }
opening == "menu" {
  if (sub(/^\/\/ ?/, "")) { print; next }
  print "@endverbatim */"
  opening = ""
}
opening == "due" {
  opening = ""
  if (sub(/^\/\/ ?/, "")) {
    brief = $0
    gsub(/[<>@\\#&]/, "\\\\&", brief)
    print "/** @file"
    print "@brief " brief
    print "@verbatim"
    print
    opening = "menu"
    next
  }
}
/^#pragma once/ { opening = "due" }
/^ *\/\/\// { said = 1 }
/^using [a-z_]+ =/ && !said { alias = $0 }
/;$|^}/ { said = 0 }
alias != "" && /;$/ {
  sub(/^using [a-z_]+ = */, "", alias)
  sub(/;$/, "", alias)
  gsub(/[<>@\\#&]|::/, "\\\\&", alias)
  $0 = $0 "  ///< Short for " (alias == "" ? "what stands there" : alias) "."
  alias = ""
}
{ print }
