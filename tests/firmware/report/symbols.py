# SPDX-License-Identifier: BSD-3-Clause
"""Says what the ticks in object files need from outside: symbols.py CROSS ALLOWED OBJECT...

ALLOWED is a comma-separated list. Fails when one needs something else, and when nothing needs all
of it: then the list tests nothing."""

import subprocess
import sys


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    cross, allowed, used = sys.argv[1], set(sys.argv[2].split(",")), set()
    for path in sys.argv[3:]:
        listed = subprocess.run([cross + "nm", "-u", path], check=True, capture_output=True,
                                text=True).stdout
        undefined = {line.split()[-1] for line in listed.splitlines()}
        print(f"{path}: {' '.join(sorted(undefined)) or 'nothing'}")
        if undefined - allowed:
            sys.exit(f"needs {' '.join(sorted(undefined - allowed))} from outside")
        used |= undefined
    if used != allowed:
        sys.exit(f"nothing needs {' '.join(sorted(allowed - used))}")


if __name__ == "__main__":
    main()
