#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Falcon's kinematics in sixty digits, to judge
include/passive_haptics/falcon/ by.

    falcon_vectors.py FILE      the table, its exact_ columns anew, to stdout

What a row asks is kept: the counts, or where they are empty the position, and
the force. The method is another than the library's: the closure of the loops
as it stands in falcon/kinematics.hpp, its derivatives by differences, the
rates and the torques from those. The other_ columns are what an open driver
answers, recorded once; they are kept, too.
"""

import sys
from decimal import Decimal, getcontext

getcontext().prec = 60
THIGH, PARALLELOGRAM, GRIP = Decimal("0.060"), Decimal("0.1025"), Decimal("0.01443")
HINGES, SIDE, BASE, OFFSET = (
    Decimal("0.0225"), Decimal("-0.025"), Decimal("0.0400"), Decimal("-0.02309"))
TINY = Decimal(10) ** -40
STEP = Decimal(10) ** -20


def arctangent(x):
    """For |x| < 1, by halving the angle and the series."""
    halvings = 0
    while abs(x) > Decimal("0.05"):
        x = x / (1 + (1 + x * x).sqrt())
        halvings += 1
    total, power, n = Decimal(0), x, 1
    while abs(power) > TINY * TINY:
        total += power / n
        power *= -x * x
        n += 2
    return total * 2**halvings


PI = 4 * (4 * arctangent(Decimal(1) / 5) - arctangent(Decimal(1) / 239))


def angle(y, x):
    """Of the point (x, y), from -pi to pi."""
    if abs(y) > abs(x):
        return PI / 2 - arctangent(x / y) if y > 0 else -PI / 2 - arctangent(x / y)
    if x > 0:
        return arctangent(y / x)
    return arctangent(y / x) + (PI if y >= 0 else -PI)


def sine(x):
    total, term, n = Decimal(0), x, 1
    while abs(term) > TINY * TINY:
        total += term
        term *= -x * x / ((n + 1) * (n + 2))
        n += 2
    return total


def cosine(x):
    return sine(x + PI / 2)


LEGS = [(cosine(PI * degrees / 180), sine(PI * degrees / 180)) for degrees in (105, -15, -135)]


def leg(p, i):
    """U, v and L of leg i at position p."""
    c, s = LEGS[i]
    v = p[1] * c - p[0] * s - OFFSET
    cos3 = (v + SIDE) / PARALLELOGRAM
    return p[0] * c + p[1] * s - BASE + GRIP, v, HINGES + PARALLELOGRAM * (1 - cos3 * cos3).sqrt()


def gap(p, theta, i):
    """Of the loop of leg i [m^2]: zero when it is closed."""
    U, _, L = leg(p, i)
    return (U - THIGH * cosine(theta)) ** 2 + (p[2] - THIGH * sine(theta)) ** 2 - L * L


def gradient(p, theta, i):
    """d gap / dp, by differences."""
    def along(axis, step):
        moved = list(p)
        moved[axis] += step
        return gap(moved, theta, i)
    return [(along(axis, STEP) - along(axis, -STEP)) / (2 * STEP) for axis in range(3)]


def slope(p, theta, i):
    """d gap / d theta, by differences."""
    return (gap(p, theta + STEP, i) - gap(p, theta - STEP, i)) / (2 * STEP)


def determinant(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))


def solve(rows, right):
    """x with rows x = right, by Cramer's rule."""
    columns = list(zip(*rows))
    whole = determinant(*columns)
    return [determinant(*(right if j == k else columns[j] for j in range(3))) / whole
            for k in range(3)]


def position_of(theta):
    p = [Decimal(0), Decimal(0), Decimal("0.125")]
    for _ in range(40):
        rows = [gradient(p, theta[i], i) for i in range(3)]
        step = solve(rows, [-gap(p, theta[i], i) for i in range(3)])
        p = [a + b for a, b in zip(p, step)]
        if max(map(abs, step)) < TINY:
            return p
    raise SystemExit("no position for these angles")


def angles_of(p):
    found = []
    for i in range(3):
        theta = Decimal("0.6")
        for _ in range(40):
            step = gap(p, theta, i) / slope(p, theta, i)
            theta -= step
            if abs(step) < TINY:
                break
        else:
            raise SystemExit("no angle for this position")
        found.append(theta)
    return found


def torques(p, theta, force):
    """tau with F.v = tau.theta' for every v: the columns of the Jacobian, times F."""
    rates = []
    for i in range(3):
        down = -slope(p, theta[i], i)
        rates.append([g / down for g in gradient(p, theta[i], i)])
    return solve(list(zip(*rates)), force)


def swings(p, theta, i):
    """theta2 and theta3 of leg i."""
    U, v, _ = leg(p, i)
    cos3 = (v + SIDE) / PARALLELOGRAM
    return (angle(p[2] - THIGH * sine(theta), U - THIGH * cosine(theta)),
            angle((1 - cos3 * cos3).sqrt(), cos3))


def to_nearest(x):
    return str(int(x.to_integral_value()))


def digits(x):
    return f"{x:.12f}" if abs(x) > Decimal("5e-13") else f"{0:.12f}"


def computed(row):
    force = [Decimal(row[f"f{axis}_N"]) for axis in "xyz"]
    if row["enc0"]:
        counts = [Decimal(row[f"enc{i}"]) for i in range(3)]
        theta = [PI * (35 + Decimal("5.13") / Decimal("140.8") * n) / 180 for n in counts]
        p = position_of(theta)
    else:
        p = [Decimal(row[f"exact_{axis}_m"]) for axis in "xyz"]
        theta = angles_of(p)
    tau = torques(p, theta, force)
    for i, axis in enumerate("xyz"):
        row[f"exact_theta1_leg{i}"] = digits(theta[i])
        two, three = swings(p, theta[i], i)
        row[f"exact_theta2_leg{i}"], row[f"exact_theta3_leg{i}"] = digits(two), digits(three)
        row[f"exact_{axis}_m"] = digits(p[i])
        row[f"exact_tau{i}_Nm"] = digits(tau[i])
        row[f"exact_dac{i}_1e4"] = to_nearest(-10000 * tau[i])
    return row


def main(path):
    names = None
    with open(path, encoding="utf-8") as file:
        for line in file.read().splitlines():
            if line.startswith("#"):
                print(line)
            elif names is None:
                names = line.split(",")
                print(line)
            else:
                row = computed(dict(zip(names, line.split(","))))
                print(",".join(row[name] for name in names))


if __name__ == "__main__":
    if {"-h", "--help"} & set(sys.argv[1:]):
        print(__doc__)
    elif len(sys.argv) != 2:
        sys.exit(__doc__)
    else:
        main(sys.argv[1])
