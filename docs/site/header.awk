# SPDX-License-Identifier: BSD-3-Clause
# How doxygen sees a header: the comment that follows `#pragma once` is the page of the file, and after its first
# paragraph set as it stands, for it may hold a menu or a drawing; the inline namespace is left out, which would be part of
# every name; an alias that has no comment gets one, since doxygen leaves out what has none; and as pages.py says in
# `examples`, a function that composes something shows a program, and a type names programs that use it.
BEGIN {
  header = ARGV[1]
  sub(/.*\/passive_haptics\//, "", header)
  while (examples != "" && (getline < examples) > 0) {
    if ($1 != header) continue
    if ($3 == "=") {
      used[$2] = ""
      for (i = 4; i <= NF; ++i) used[$2] = used[$2] (i == 4 ? "" : ", ") ($i ~ /^example_/ ? "@ref " $i : "`" $i "`")
      continue
    }
    program[$2] = $3
    for (i = 4; i <= NF; ++i) others[$2] = others[$2] (i == 4 ? "" : ", ") "@ref " $i
  }
  while ((getline < ARGV[1]) > 0) {  # after which line of comment
    ++line
    if (/^\/\/\/ /) {
      commented = line
      continue
    }
    if (match($0, /^([^;{}\/]*\) )?(struct|class|using|concept) [a-z_0-9]+/)) {
      n = split(substr($0, RSTART, RLENGTH), part, " ")
      if (commented && part[n] in used) shows[commented] = part[n]
      else if (part[n - 1] != "using" && part[n] in used) before[begun ? begun : line] = part[n]
    } else if (match($0, /make_[a-z_]+\(/)) {
      name = substr($0, RSTART, RLENGTH - 1)
      if (commented && name in program) shows[commented] = name
    }
    if (/^template/) begun = line
    if (/[;}]$|^}|^$/) begun = 0
    if (/;$|^}/) commented = 0
  }
}
function named(name) {
  return "/// @par " (used[name] ~ /^@ref/ ? "Example" : "Tried in") "\n/// " used[name]
}
FNR in before { print named(before[FNR]) }
/^inline namespace v[0-9]+ \{$/ || /^}  \/\/ namespace v[0-9]+$/ { $0 = "" }
# A template argument that is left out is no tag of HTML.
/^ *\/\/\/.*<…>/ { gsub(/<…>/, "\\<…\\>") }
opening == "menu" {
  if (sub(/^\/\/ ?/, "")) { print; next }
  print "@endverbatim */"
  opening = ""
}
opening == "due" || opening == "brief" {
  if (sub(/^\/\/ /, "")) {
    gsub(/[<>@\\#&]/, "\\\\&")
    print (opening == "due" ? "/** @file\n@brief " : "") $0
    opening = "brief"
    next
  }
  if (opening == "brief") print /^\/\// ? "\n@verbatim" : "*/"
  opening = opening == "brief" && /^\/\// ? "menu" : ""
  if (opening == "menu") next
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
FNR in shows {
  name = shows[FNR]
  if (name in program) {
    print "///\n/// @par Example\n/// @code{.cpp}"
    while ((getline code < program[name]) > 0) if (code !~ /SPDX/) print "/// " code
    print "/// @endcode"
    if (name in others) print "/// Others: " others[name] "."
  } else {
    print "///\n" named(name)
  }
}
