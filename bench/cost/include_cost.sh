#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# include_cost.sh INCLUDE EIGEN [CXX]: what g++ takes to read the core, over
# <Eigen/Core> alone, in instructions of the compiler itself as callgrind counts
# them: exact to a few in ten thousand, whatever else the machine does. Fails
# above 15 %. Some minutes.
set -euo pipefail
case ${1:-} in -h | --help) sed -n '3,/^set /s/^# \?//p' "$0"; exit ;; esac
include=$1 eigen=$2 cxx=${3:-g++}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
valgrind --tool=callgrind --callgrind-out-file=/dev/null true 2>/dev/null ||
  { echo 'skipped: there is no valgrind that works'; exit 0; }
cc1plus=$("$cxx" -print-prog-name=cc1plus)
[ -x "$cc1plus" ] || { echo "skipped: $cxx has no cc1plus, this measures g++"; exit 0; }

# instructions HEADER: to read it, and no more.
instructions() {
  echo "#include <$1>" >"$scratch/one.cpp"
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$cc1plus" -quiet -std=c++20 \
    -fsyntax-only -imultiarch "$("$cxx" -print-multiarch)" -D_GNU_SOURCE "-I$include" \
    -isystem "$eigen" "$scratch/one.cpp" -o /dev/null 2>"$scratch/log"
  sed -n 's/.*Collected : \([0-9]*\).*/\1/p' "$scratch/log"
}
alone=$(instructions Eigen/Core)
core=$(instructions passive_haptics/passive_haptics.hpp)
awk -v a="$alone" -v c="$core" 'BEGIN {
  printf "Eigen/Core %.3fe9 instructions, the core with it %.3fe9: %.1f %% more\n", a/1e9, c/1e9,
         100 * (c / a - 1)
  exit c > 1.15 * a
}'
