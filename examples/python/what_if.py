#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What if my device were this one? A hand comes down on a wall, presses, and lets go after a second.

usage: what_if.py [STIFFNESS...] [--plot FILE.png]    N/m, 500 2000 8000 unless given

Prints a row for each composition and stiffness; draws the traces where matplotlib is installed. Build the
module first, with pybind11-dev, python3-dev and python3-numpy, and say where it is:

    cmake --preset full && cmake --build --preset full --target passive_haptics_python
    PYTHONPATH=build/full/examples/python /usr/bin/python3 examples/python/what_if.py
"""
import sys


def main(arguments):
    if "--help" in arguments:
        print(__doc__)
        return 0
    picture = None
    if "--plot" in arguments:
        at = arguments.index("--plot")
        picture = arguments[at + 1]
        del arguments[at:at + 2]
    import passive_haptics as ph

    device = ph.Device(mass=0.045, damping=0.05, friction=0.13, presliding=15e-6, quantum=20e-6, force_limit=3.3)
    exact = ph.Device(mass=0.045, damping=0.05, force_limit=3.3)  # the same without steps and friction
    hand = ph.Hand(lets_go=1.0, load=-0.3)
    stiffest, because = ph.stiffness_budget(device)
    print(f"The ledger of a device with steps of 20 um sustains {stiffest:.0f} N/m. {because}\n")
    print("composition             device  N/m    least port energy  held with  at the end")
    traces = {}
    for stiffness in [float(a) for a in arguments] or [500.0, 2000.0, 8000.0]:
        for name in ("none",) + ph.compositions:
            steps = "encoder" in name or "quantised" in name
            now = ph.simulate(name, stiffness, device if steps else exact, hand)
            traces[name, stiffness] = now
            pressed = now["force"][(now["t"] > 0.8) & (now["t"] < 1.0)].mean()
            print(f"{name:23} {'steps' if steps else 'exact':7} {stiffness:<6.0f} "
                  f"{1e3 * now['port_energy'].min():10.3f} mJ   {pressed:8.2f} N {1e3 * now['x'][-1]:9.2f} mm")
    if picture:
        draw(traces, picture)
    return 0


def draw(traces, picture):
    try:
        import matplotlib
    except ImportError:
        print("no plot: matplotlib is not installed (Debian: python3-matplotlib)")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    names = list(dict.fromkeys(name for name, _ in traces))
    figure, axes = plt.subplots(2, len(names), figsize=(3 * len(names), 6), sharex=True, sharey="row")
    for (name, stiffness), now in traces.items():
        column = names.index(name)
        axes[0, column].plot(now["t"], now["force"], linewidth=0.7, label=f"{stiffness:.0f} N/m")
        axes[1, column].plot(now["t"], 1e3 * now["port_energy"], linewidth=0.7)
        axes[0, column].set_title(name)
        axes[1, column].set_xlabel("t / s")
    axes[0, 0].set_ylabel("force / N")
    axes[1, 0].set_ylabel("port energy / mJ")
    axes[0, 0].legend()
    figure.tight_layout()
    figure.savefig(picture)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
