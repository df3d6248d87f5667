#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# numbers.cpp under the flags and on the machines that change arithmetic, each
# in four rounding modes.
#
#     tests/flags/numbers.sh            all that the installed tools allow
#     tests/flags/numbers.sh --quick    the host: -O0, -O3 -march=native,
#                                       with and without contraction
#
# Needs Eigen in /usr/include/eigen3 or EIGEN=DIR. Cross: g++-i686-linux-gnu,
# g++-s390x-linux-gnu and qemu-user; one that is missing is skipped, and it says
# so. Exit code 1 if one fails.
set -euo pipefail
case ${1:-} in -h | --help) sed -n '3,/^set /s/^# \?//p' "$0"; exit ;; esac
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
failed=0
modes=
printf '#include <concepts>\nint main() {}\n' >"$out/trial.cpp"

# check COMPILER RUNNER FLAGS...
check() {
  local compiler=$1 runner=$2
  shift 2
  if ! "$compiler" -std=c++20 "$@" "$out/trial.cpp" -o "$out/trial" 2>/dev/null ||
    ! $runner "$out/trial" 2>/dev/null; then
    echo "== $compiler $*: skipped, no $compiler${runner:+ or $runner} that works"
    return
  fi
  echo "== $compiler $*"
  "$compiler" -std=c++20 -DNDEBUG -frounding-math "$@" -Iinclude -Itests \
    -isystem "${EIGEN:-/usr/include/eigen3}" tests/flags/numbers.cpp -o "$out/numbers"
  $runner "$out/numbers" ${modes:+"$modes"} || failed=1
}

check g++ '' -O0
check g++ '' -O3 -march=native -ffp-contract=fast
check g++ '' -O3 -march=native -ffp-contract=off
if [ "${1:-}" != --quick ]; then
  check g++ '' -O2
  check clang++ '' -O2 -ffp-contract=off
  check clang++ '' -O3 -march=native -ffp-contract=fast
  check i686-linux-gnu-g++ '' -O2 -static -mfpmath=387 -mno-sse
  # With -frounding-math this compiler and qemu 7.2 disagree even on a sum of floats; to nearest alone.
  modes=nearest check s390x-linux-gnu-g++ qemu-s390x -O2 -static -fno-rounding-math
fi
exit $failed
