# SPDX-License-Identifier: BSD-3-Clause
"""The Python module finds what the library finds without it, to the bit. Argument: the reference program."""
import subprocess
import sys

import numpy
import passive_haptics as ph

exact = ph.Device(mass=0.1, damping=0.03, force_limit=9.0)
steps = ph.Device(mass=0.045, damping=0.05, friction=0.13, presliding=15e-6, quantum=20e-6, force_limit=3.3)


def figures(now):
    total = 0.0
    for force in now["force"]:  # from the first to the last, as the reference sums them
        total += float(force)
    return [float(now["x"][-1]), float(now["port_energy"].min()), total]


def refused(call, *what):
    try:
        call()
    except (ValueError, TypeError) as error:
        assert all(part in str(error) for part in what), f"{error}: not {what}"
    else:
        raise AssertionError(f"nothing is refused: {what}")


printed = subprocess.run([sys.argv[1]], capture_output=True, text=True, check=True).stdout
wanted = [[float.fromhex(number) for number in row.split()] for row in printed.splitlines()]
touch = ph.simulate("touch", 3000, exact, seconds=1)
found = [figures(touch), figures(ph.simulate("encoder_touch", 2000, steps, seconds=1))]
assert found == wanted, f"{found}\n{wanted}"
assert figures(ph.simulate("touch", 3001, exact, seconds=1)) != wanted[0]  # the control

for name, values in touch.items():
    assert isinstance(values, numpy.ndarray) and values.shape == (1000,), name
assert abs(touch["t"][0] - 1e-3) < 1e-12 and (numpy.diff(touch["t"]) > 0).all()
assert ph.event_text(int(touch["event"].max())) == "nominal"

# Only the bare spring feeds the hand.
for name in ph.compositions:
    device = steps if "encoder" in name or "quantised" in name else exact
    assert ph.simulate(name, 3000, device)["port_energy"].min() >= -1e-12, name
assert ph.simulate("none", 3000, exact)["port_energy"].min() < -1e-4

# Detents hold a hand that lets go at one of them, wherever they are.
for name in ph.detents:
    device = steps if "encoder" in name else exact
    for pitch in (4e-3, 3e-3):  # one is the control of the other
        now = ph.simulate(name, 300, device, ph.Hand(target=-9.5e-3, lets_go=1.0), seconds=3, pitch=pitch)
        assert now["port_energy"].min() >= -1e-12, name
        off = now["x"][-1] / pitch
        assert abs(off - round(off)) < 0.2 and round(off) != 0, f"{name}: {off} pitches of {pitch}"
        assert abs(now["force"]).max() > 0.05, name
refused(lambda: ph.simulate("detents", 300, exact, pitch=0), "pitch = 0 is refused")

stiffness, because = ph.stiffness_budget(steps)
assert 1000 < stiffness < 10000 and "raise" in because
refused(lambda: ph.simulate("touch", 3000, ph.Device(mass=0)), "mass = 0 is refused")
refused(lambda: ph.simulate("touch", -1, exact), "stiffness")
refused(lambda: ph.simulate("tuch", 3000, exact), "tuch", "one of touch")
refused(lambda: ph.simulate("tool", 3000, exact), "tool", "turns")
refused(lambda: ph.simulate("none", 3000, exact, seconds=-1), "seconds")
refused(lambda: ph.Device(weight=1), "weight")

# A leaf holds a probe off from both sides, wherever it goes; bare, the place of the device is beyond it.
corners = [[-0.05, -0.05, 0], [0.05, -0.05, 0], [0, 0.05, 0]]
for side in (1, -1):
    leaf, probe = ph.Mesh(corners, [[0, 1, 2]]), ph.Probe(1e-3)
    probe.touch(leaf)
    for n in range(400):
        if n == 300:
            leaf.update(numpy.array(corners) + [0, 0, 0.001])
        place, depth, normal = probe.step([0, 0, side * (2e-3 - 1e-5 * n)])
        assert side * (place[2] - (0.001 if n >= 300 else 0)) > 0 or n < 360, (n, place)
    assert abs(place[2] - (0.001 + side * 1e-3)) < 1e-9 and normal[2] == side, (place, normal)
    assert abs(depth - side * (place[2] + side * 1.99e-3)) < 1e-12, depth
refused(lambda: ph.Mesh(corners, [[0, 1, 3]]), "triangle 0 names node 3 of 3")
refused(lambda: ph.Mesh(corners, []), "triangles is refused")
refused(lambda: leaf.update(corners[:2]), "news of 2 nodes")
refused(lambda: ph.Probe(radius=-1), "radius = -1 is refused")
refused(lambda: probe.step([0, 0, float("nan")]), "out of its range")
for name in ("mesh_touch", "mesh_tool"):
    refused(lambda: ph.simulate(name, 3000, exact), "Probe touches a Mesh")
print("the module and the library agree")
