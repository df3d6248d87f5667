#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A body like an organ, in tetrahedra: some 10 cm, rounded, thick at one end,
bent and lopsided.

    make_organ.py > organ.msh       Gmsh MSH 2.2, ASCII, millimetres

An icosahedron whose faces are cut into 9 triangles, blown up to a ball of one
middle node and two shells, and the ball pressed into shape by polynomials.
Nothing but + - * / and square roots, so that every machine prints the same
bytes.
"""

import sys
from math import sqrt

CUTS = 3
SHELLS = (0.55, 1.0)


def icosahedron():
    golden = (1 + sqrt(5)) / 2
    corners = []
    for a in (-1, 1):
        for b in (-golden, golden):
            corners += [(0, a, b), (a, b, 0), (b, 0, a)]
    near = [(i, j) for i in range(12) for j in range(12)
            if i != j and sum((p - q) ** 2 for p, q in zip(corners[i], corners[j])) < 4.5]
    faces = [(i, j, k) for i in range(12) for j in range(i + 1, 12) for k in range(j + 1, 12)
             if (i, j) in near and (j, k) in near and (i, k) in near]
    return corners, faces


def sphere():
    """Unit directions, and triangles of them."""
    corners, faces = icosahedron()
    numbers, points, triangles = {}, [], []

    def number(key):
        """Of the node with these shares of these corners."""
        key = tuple(sorted((corner, share) for corner, share in key if share))
        if key not in numbers:
            numbers[key] = len(points)
            p = [0.0, 0.0, 0.0]
            for corner, share in key:
                p = [a + share * b for a, b in zip(p, corners[corner])]
            length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2])
            points.append([x / length for x in p])
        return numbers[key]

    for face in faces:
        def node(i, j):
            return number(zip(face, (CUTS - i - j, i, j)))
        for i in range(CUTS):
            for j in range(CUTS - i):
                triangles.append((node(i, j), node(i + 1, j), node(i, j + 1)))
                if i + j < CUTS - 1:
                    triangles.append((node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)))
    return points, triangles


def pressed(x, y, z):
    """From the unit ball to the organ [mm]."""
    thick = 1 - 0.38 * x                                  # a thick end and a thin one
    return (50 * x + 6 * y * y,
            33 * y * thick + 9 * x * x + 4 * x * y,       # bent
            20 * z * thick + 5 * x * x - 4 * y * y * x)   # saddled, and flat below


def volume(nodes, t):
    a, b, c = ([nodes[t[k]][axis] - nodes[t[0]][axis] for axis in range(3)] for k in (1, 2, 3))
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6


def organ():
    points, triangles = sphere()
    size = len(points)
    nodes = [pressed(0.0, 0.0, 0.0)]
    for radius in SHELLS:
        nodes += [pressed(*(radius * x for x in p)) for p in points]
    tetrahedra = []
    for triangle in triangles:
        low = sorted(1 + corner for corner in triangle)  # sorted, so that neighbours cut alike
        tetrahedra.append([0, *low])
        for _ in SHELLS[1:]:
            high = [corner + size for corner in low]
            tetrahedra += [[*low[:k + 1], *high[k:]] for k in range(3)]
            low = high
    for t in tetrahedra:
        if volume(nodes, t) < 0:
            t[2], t[3] = t[3], t[2]
    return nodes, tetrahedra


def main():
    nodes, tetrahedra = organ()
    print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nSPDX-License-Identifier: BSD-3-Clause\n"
          "A body like an organ, in millimetres; made by make_organ.py\n$EndComments")
    print(f"$Nodes\n{len(nodes)}")
    for i, p in enumerate(nodes, 1):
        print(i, *(f"{round(10000 * x) / 10000:.4f}" for x in p))  # no minus in front of zero
    print(f"$EndNodes\n$Elements\n{len(tetrahedra)}")
    for i, t in enumerate(tetrahedra, 1):
        print(i, 4, 2, 1, 1, *(node + 1 for node in t))
    print("$EndElements")


if __name__ == "__main__":
    if {"-h", "--help"} & set(sys.argv[1:]):
        print(__doc__)
    else:
        main()
