#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The library by other compilers, standard libraries and machines: a row for each, and in it
#
#   headers    all compile, by the strict flags
#   bits       of five controllers in a closed loop, in float, are those of this machine
#   examples   print what is committed beside them
#   numbers    no bound is overdrawn in exact arithmetic: tests/flags/numbers.cpp
#   tests      the core tests pass
#
#     tests/portability/matrix.sh [ROW...]            every row, or those
#     tests/portability/matrix.sh --quick [ROW...]    two examples, neither numbers nor tests nor the
#                                                     headers of environment/, and not the rare rows
#     tests/portability/matrix.sh --missing           Debian's packages for what --quick would skip
#     tests/portability/matrix.sh --list              the rows and their commands
#
# What the tools can do is tried: a row whose compiler builds no trial program is skipped, and where
# the trial does not run, programs are built and no more. A table comes last; exit code 1 if a row
# fails. Needs g++, CMake, and Eigen in /usr/include/eigen3 or EIGEN=DIR. docs/portability.md says what
# was run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
mode=full
case ${1:-} in
  --quick | --list | --missing) mode=${1#--} && shift ;;
esac
chosen=("$@")
eigen=${EIGEN:-/usr/include/eigen3}
stand_ins=()  # for the SDKs that the adapters include
for sdk in tests/adapters/stand_in/*/; do stand_ins+=("-I$sdk"); done
out=$(mktemp -d)
export WINEPREFIX=$out/wine WINEDEBUG=-all
finish() {
  if [ -d "$WINEPREFIX" ]; then wineserver -k || true; fi
  rm -rf "$out"
}
trap finish EXIT

# ------------------------------------------------------------------------------ the steps of a row
# They know the row's folder, here, its command line, compile, what runs a program, emulator, and
# whether anything does, runs.

build() { "${compile[@]}" "${@:2}" -o "$here/$1"; }

# run PROGRAM ARGUMENTS...: in the row's folder; lines end as here. Through a file, not a pipe: wine
# leaves servers behind that hold it open.
run() {
  local program=./$1
  if [ -e "$here/$1.exe" ]; then program+=.exe; fi
  (cd "$here" && $emulator "$program" "${@:2}" >printed) && tr -d '\r' <"$here/printed"
}

headers() {
  cmake "-Dinclude=$PWD/include" "-Dout=$here" "-Dwithout=$without" \
    -P tests/portability/every_header.cmake &&
    "${compile[@]}" -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Werror \
      -fsyntax-only -x c++ "$here/ours.hpp"
}

# The recorder of the firmware tests, in one piece: where its device goes depends on every force.
record() {
  printf '#include "%s"\n' "$PWD"/tests/firmware/{composed/*,replay/record}.cpp >"$here/record.cpp"
  build record -O2 -ffp-contract=off "$@" "$here/record.cpp" || return
  if [ -n "$runs" ]; then run record bits; fi
}
same_bits() { tr -d '\r' <"$here/bits" | cmp - "$out/reference/bits"; }
bits() { record && { [ -z "$runs" ] || same_bits; }; }
# The control: arithmetic that rounds otherwise is found out.
other_bits() { record "${other:?}" && { [ -z "$runs" ] || ! same_bits; }; }

# Those of the Falcon may want libusb; tests/falcon is about them. The remote ones are a pair, and wait.
examples() {
  local name names=(03_two_threads 08_no_eigen)
  if [[ $mode = full ]]; then
    mapfile -t names < <(cd examples && printf '%s\n' *.cpp | sed '/falcon/d; /remote/d; s/[.]cpp$//')
  fi
  for name in "${names[@]}"; do
    build "$name" -O1 -pthread "examples/$name.cpp" || return
    if [ -z "$runs" ]; then continue; fi
    run "$name" | diff - "examples/${name%_by_hand}.txt" || return
  done
}

numbers() {
  build numbers -O2 -DNDEBUG -frounding-math tests/flags/numbers.cpp || return
  if [ -n "$runs" ]; then run numbers nearest; fi
}

# Catch2 v2 is a header; v3 would have to be built for each.
tests() {
  mkdir "$here/catch"
  ln -s /usr/include/catch2 "$here/catch/catch2"
  build tests -O1 -isystem "$here/catch" "-DPASSIVE_HAPTICS_TEST_DATA=\"$PWD/tests/data\"" \
    tests/{support/main,*,base/*,device/*,port/*,motion_estimator/*,energy_observer/*}.cpp \
    tests/{force_bound,shaper,contact,laws,design}/*.cpp \
    tests/{constraint_geometry,normal_interpolation}/*.cpp || return
  if [ -n "$runs" ]; then run tests; fi
}

# The attribute that MSVC honours, by MSVC's rules of layout; without its library this is all.
layout() { "${compile[@]}" -fsyntax-only tests/portability/layout.cpp; }

# ------------------------------------------------------------------------------------------- rows

names=()
declare -A command packages_of

# row NAME EMULATOR COMPILER FLAGS...
#   packages=NAMES   Debian's, beside g++; rare=yes: only where it is installed, and not in --quick
#   only=STEPS       not the usual ones; other=FLAGS for other_bits
#   needs=LINES      of the trial program
row() {
  local name=$1 emulator=$2 compiler=("${@:3}") here=$out/$1
  if [ ${#chosen[@]} -gt 0 ] && [[ " ${chosen[*]} " != *" $name "* ]]; then return; fi
  if [[ ${rare:-} && $mode = @(quick|missing) ]]; then return; fi
  names+=("$name")
  command[$name]="${compiler[*]}${other:+ $other}${emulator:+, $emulator}"
  packages_of[$name]=${packages:-}
  if [[ $mode = list ]]; then return; fi
  while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n || true; done
  mkdir "$here"
  try >"$here/log" 2>&1 &
}

# Leaves its result in the row's folder.
try() {
  local compile=("${compiler[@]}" -std=c++20 -Iinclude -Itests "${stand_ins[@]}" -isystem "$eigen")
  local step steps=(headers bits examples numbers tests)
  local runs=yes passed='' built='' failed='' start=$SECONDS without=''
  case $mode in
    quick) steps=(headers bits examples) without=/environment/ ;;
    missing) steps=() only='' ;;
  esac
  printf '%s\n' "${needs:-#include <concepts>}" 'extern "C" int puts(const char*);' \
    'int main() { puts("runs"); }' >"$here/trial.cpp"
  if ! command -v "${compiler[0]}"; then
    echo "skipped: no ${compiler[0]}" >"$here/result"
    return
  elif ! build trial "$here/trial.cpp"; then
    echo "skipped: it builds no trial program" >"$here/result"
    return
  fi
  [[ $(run trial) = runs ]] || runs=
  for step in ${only:-${steps[@]}}; do
    printf '\n== %s\n' "$step"
    if ! "$step"; then
      failed+=" $step"
    elif [ -z "$runs" ] && [[ $step != @(headers|layout) ]]; then
      built+=" $step"
    else
      passed+=" $step"
    fi
  done
  if [[ $mode = missing ]]; then
    echo "${runs:+all there}" >"$here/result"
  else
    echo "${failed:+FAILED:$failed; }${built:+built, not run:$built; }passed:${passed:- nothing}" \
      "($((SECONDS - start)) s)" >"$here/result"
  fi
}

# newest_clang LINE FLAGS...: that compiles the line so.
newest_clang() {
  local name
  if [[ $mode = list ]]; then echo clang++ && return; fi
  for name in clang++-{22,21,20,19,18,17,16,15} clang++; do
    if echo "$1" | "$name" -std=c++20 "${@:2}" -fsyntax-only -x c++ - 2>/dev/null; then break; fi
  done
  echo "$name"
}

if [[ $mode = full || $mode = quick ]]; then  # what the bits are compared with
  mkdir "$out/reference"
  here=$out/reference emulator='' runs=yes compile=(g++ -std=c++20 -O0 -Iinclude -isystem "$eigen")
  record
fi

row g++ '' g++
only='headers examples' row no-exceptions '' g++ -fno-exceptions
only='headers examples' row no-rtti '' g++ -fno-rtti
packages=clang row clang++ '' clang++
libcxx=-stdlib=libc++
packages='clang-22 libc++-22-dev libc++abi-22-dev' \
  row libc++ '' "$(newest_clang '#include <concepts>' $libcxx)" $libcxx
# Debian's gcc-multilib, which has a link to these headers, cannot be had beside cross compilers.
packages=g++-$(g++ -dumpversion)-multilib \
  row x86-32 '' g++ -m32 -msse2 -mfpmath=sse -idirafter /usr/include/x86_64-linux-gnu
packages='g++-aarch64-linux-gnu qemu-user' row aarch64 qemu-aarch64 aarch64-linux-gnu-g++ -static
packages='g++-riscv64-linux-gnu qemu-user' row riscv64 qemu-riscv64 riscv64-linux-gnu-g++ -static
rare=yes row s390x qemu-s390x s390x-linux-gnu-g++ -static
windows=(-static -include windows.h)
packages='g++-mingw-w64-x86-64-posix wine wine64' \
  row mingw-64 wine x86_64-w64-mingw32-g++-posix "${windows[@]}"
rare=yes row mingw-32 wine i686-w64-mingw32-g++-posix "${windows[@]}"
attribute='static_assert(__has_cpp_attribute(msvc::no_unique_address));'
msvc=(-target x86_64-pc-windows-msvc -fsyntax-only)
packages=clang-22 only=layout needs=$attribute \
  row msvc-layout '' "$(newest_clang "$attribute" "${msvc[@]}")" "${msvc[@]}"
only=other_bits other=-mfpmath=387 row control-x87 '' g++
packages='g++-aarch64-linux-gnu qemu-user' only=other_bits other=-ffp-contract=fast \
  row control-fused qemu-aarch64 aarch64-linux-gnu-g++ -static
wait

failed=0
for name in "${names[@]}"; do
  if [[ $mode = list ]]; then
    echo "$name: ${command[$name]}"
    continue
  fi
  result=$(cat "$out/$name/result" || echo 'FAILED: it did not finish')
  if [[ $mode = missing ]]; then
    if [[ $result != 'all there' ]]; then echo "${packages_of[$name]}"; fi
    continue
  fi
  if [[ $result = FAILED* ]]; then
    failed=1
    printf '\n-- %s: %s\n' "$name" "${command[$name]}"
    tail -n 60 "$out/$name/log"
  fi
  table+=$(printf '%-14s %-70s %s' "$name" "$result" "${command[$name]}")$'\n'
done
printf '%s' "${table:-}"
exit $failed
