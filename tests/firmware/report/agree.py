# SPDX-License-Identifier: BSD-3-Clause
"""Compares what host and target printed: agree.py HOST TARGET [BOUND].

Without BOUND every bit must agree, and composed and by hand must agree on each side. With BOUND
(contraction on) forces, depths and energies may differ by BOUND times the largest of their scene,
events in no tick, and in one tick of a thousand a comparison that is nearly equal may decide that
the bound has, or has not, changed the force."""

import struct
import sys


def ticks(path):
    found = {}
    with open(path, encoding="ascii") as stream:
        for line in stream:
            words = line.split()
            if words[0] == "tick":
                found.setdefault((words[1], words[2]), []).append(words[4:])
    return found


def number(bits):
    if bits == "nan":
        return float("nan")
    code = ">f" if len(bits) == 8 else ">d"
    return struct.unpack(code, bytes.fromhex(bits))[0]


def identical(name, one, other, left, right):
    if len(left) != len(right) or not left:
        sys.exit(f"{name}: {len(left)} ticks of {one}, {len(right)} of {other}")
    for n, (a, b) in enumerate(zip(left, right)):
        if a != b:
            sys.exit(f"{name}: tick {n}: {one} has {' '.join(a)}, {other} {' '.join(b)}")


def farthest(name, left, right):
    """The largest difference of any number, over the largest of its column, and the number of ticks
    in which `limited` differs."""
    worst, decided = 0.0, 0
    columns = len(left[0]) - 2
    scales = [max(abs(number(tick[c])) for tick in left) for c in range(columns)]
    scales[:columns - 2] = [max(scales[:columns - 2])] * (columns - 2)  # one scale for the force
    for n, (a, b) in enumerate(zip(left, right)):
        if a[-2] != b[-2]:
            sys.exit(f"{name}: tick {n}: event {a[-2]} on the host, {b[-2]} here")
        decided += a[-1] != b[-1]
        for c in range(columns):
            difference = abs(number(a[c]) - number(b[c]))
            if not difference == difference:
                sys.exit(f"{name}: tick {n}: not a number")
            worst = max(worst, difference / scales[c])
    return worst, decided


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    host, target = ticks(sys.argv[1]), ticks(sys.argv[2])
    if set(host) != set(target) or not host:
        sys.exit(f"other scenes: {sorted(host)} and {sorted(target)}")
    worst, decided = 0.0, 0
    for key in host:
        name = " ".join(key)
        if len(sys.argv) == 3:
            identical(name, "host", "target", host[key], target[key])
            identical(key[0], "composed", "by_hand", target[key[0], "composed"],
                      target[key[0], "by_hand"])
        else:
            far, other = farthest(name, host[key], target[key])
            worst, decided = max(worst, far), decided + other
    count = sum(map(len, host.values()))
    if len(sys.argv) == 3:
        print(f"{count} ticks: forces, depths, energies and events agree bit for bit")
        return
    bound = float(sys.argv[3])
    print(f"{count} ticks: events agree, numbers within {worst:.3g} of the largest "
          f"(bound {bound:g}), `limited` differs in {decided}")
    if worst > bound or decided * 1000 > count:
        sys.exit("that is too far")


if __name__ == "__main__":
    main()
