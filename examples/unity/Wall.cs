// SPDX-License-Identifier: BSD-3-Clause
// The shortest program in C#: a wall of 2 kN/m, and a device of 0.1 kg that is pressed onto it with 2 N.

using System;
using System.Globalization;
using PassiveHaptics;

internal static class Wall
{
    private static void Main()
    {
        Parameters device = new Parameters { Mass = 0.1, Damping = 0.1, ForceLimit = 9, LongestTick = 1e-3, HandForce = 5 };
        using (Port port = new Port("touch", device))
        {
            port.Publish(new Vector(0, 0, 0), new Vector(0, 0, 1), 2000);
            double z = 0.02, v = 0; // of the device: m, m/s
            for (int ms = 0; ms < 3000; ++ms)
            {
                double force = port.Tick(new Vector(0, 0, z), 1e-3).Force.Z; // N, for your motors
                v += 1e-3 * (force - 2 - 0.1 * v) / 0.1;
                z += 1e-3 * v;
            }
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture, "at rest {0:0.00} mm deep", -1e3 * z));
        }
    }
}
