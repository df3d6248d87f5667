// SPDX-License-Identifier: BSD-3-Clause
// examples/c_interface/wall.c in C#, without Unity: the same device, the same wall, the same figures; a guard
// for a force that you have already, a ball in a corner, a peg that turns, and a mesh that heaves.
//
//     mcs -out:wall.exe PassiveHaptics.cs Program.cs
//     LD_LIBRARY_PATH=<where libpassive_haptics_c.so is> mono wall.exe

using System;
using System.Globalization;
using PassiveHaptics;

internal static class Program
{
    private const double mass = 0.1, damping = 0.03, load = -1.0; // kg, N·s/m, N: the device falls along −z

    private struct Device
    {
        public double Z, V;   // m, m/s
        public double Energy; // that has flowed in at its port, J

        // One millisecond under the force of the motors, in a hundred small steps.
        public void Hold(double force)
        {
            for (int i = 0; i < 100; ++i)
            {
                double before = V;
                V += 1e-5 * (force + load - damping * before) / mass;
                double middle = (before + V) / 2;
                Z += 1e-5 * middle;
                Energy += 1e-5 * middle * (damping * middle - force);
            }
        }
    }

    private static void Drop(string wall, Port port)
    {
        Device now = new Device { Z = 0.02 };
        double least = 0;
        for (int ms = 1; ms < 5000; ++ms)
        {
            double force = now.Z < 0 ? -1e4 * now.Z : 0;
            if (port != null) force = port.Tick(new Vector(0, 0, now.Z), 1e-3).Force.Z;
            now.Hold(force);
            least = Math.Min(least, now.Energy);
        }
        Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
            "{0,-8} after 5 s at {1,6:0.00} mm, {2,5:0.00} m/s; the wall has created {3,4:0.00} J",
            wall, 1e3 * now.Z, now.V, 0 - least));
    }

    private static string Newtons(Result tick)
    {
        return string.Format(CultureInfo.InvariantCulture, "{0:0.00} N", tick.Force.Z);
    }

    private static void Main()
    {
        Parameters device = new Parameters { Damping = damping, ForceLimit = 9, LongestTick = 1e-3 };
        try
        {
            new Port("touch", device);
        }
        catch (ArgumentException refused)
        {
            Console.WriteLine(refused.Message);
        }
        device.Mass = mass;
        device.HandForce = 5;
        using (Port port = new Port("touch", device))
        {
            port.Publish(new Vector(0, 0, 0), new Vector(0, 0, 1), 1e4);
            Drop("spring:", null);
            Drop("touch:", port);
            Result lost = port.Tick(new Vector(0, 0, double.NaN), 1e-3);
            Console.WriteLine("NaN:     " + Port.TextOf(lost.Event) + ", " + lost.Force.Z + " N");
        }
        device.StaticFriction = 0.4;
        using (Port corner = new Port("contacts", device))
        {
            corner.Publish(0, new Surface { Kind = Kind.Plane, B = new Vector(0, 0, 1), Stiffness = 800 });
            corner.Publish(0, new Surface
            {
                Kind = Kind.Sphere, A = new Vector(-0.05, 0, 0), Radius = 0.05, Stiffness = 800
            });
            Explanation why;
            Result now = new Result();
            for (int n = 0; n < 400; ++n)
            {
                now = corner.Tick(new Vector(Math.Max(-1e-5 * n, -1e-3), 0, Math.Max(1e-3 - 1e-5 * n, -1e-3)), 1e-3);
            }
            corner.Explain(out why);
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "corner:  {0:0.00} N up, {1:0.00} N off the ball, shows {2:0} of {3:0} N/m",
                now.Force.Z, now.Force.X, why.Shown, why.Asked));
            device.ForceLimit = 0.5;
            corner.Set(device);
            now = corner.Tick(new Vector(-1e-3, 0, -1e-3), 1e-3);
            Console.WriteLine("         " + Newtons(now) + " up from weaker motors");
            corner.Release(0, Kind.Plane);
            corner.Reset();
            now = corner.Tick(new Vector(-1e-3, 0, -1e-3), 1e-3);
            Console.WriteLine("         " + Port.TextOf(now.Event) + " after a new start");
            device.ForceLimit = 9;
            try
            {
                device.Mass = 0.2;
                corner.Set(device);
            }
            catch (ArgumentException refused)
            {
                Console.WriteLine("         " + refused.Message);
                device.Mass = mass;
            }
        }
        Parameters handle = device;
        handle.LeastInertia = 1e-4;
        handle.AngularDamping = 1e-4;
        handle.DampingMost = 0.06;
        handle.AngularDampingMost = 2e-4;
        handle.TorqueLimit = 0.5;
        using (Port peg = new Port("tool", handle))
        {
            peg.Publish(0, new Surface
            {
                Kind = Kind.Plane, B = new Vector(0, 0, 1), Stiffness = 800, At = new Vector(0.02, 0, 0)
            });
            Result now = new Result();
            for (int n = 0; n < 300; ++n)
            {
                now = peg.Tick(new Vector(0, 0, Math.Max(1e-3 - 1e-5 * n, -1e-3)), new Rotation(1, 0, 0, 0), 1e-3);
            }
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "peg:     {0:0.00} N and {1:0.0000} N m, by a point 20 mm off", now.Force.Z, now.Torque.Y));
        }
        double[] vertices = { -0.05, -0.05, 0, 0.05, -0.05, 0, 0, 0.05, 0 };
        try
        {
            new Mesh(vertices, new int[] { 0, 1, 3 });
        }
        catch (ArgumentException refused)
        {
            Console.WriteLine(refused.Message);
        }
        device.Stiffness = 800;
        device.Radius = 1e-3;
        using (Port finger = new Port("mesh_touch", device))
        using (Probe probe = new Probe(1e-3))
        using (Mesh leaf = new Mesh(vertices, new int[] { 0, 1, 2 }))
        {
            finger.Touch(leaf);
            probe.Touch(leaf);
            Result now = new Result();
            Touched ball = new Touched();
            for (int n = 0; n < 400; ++n)
            {
                if (n == 300) leaf.Update(new double[] { -0.05, -0.05, 1e-3, 0.05, -0.05, 1e-3, 0, 0.05, 1e-3 });
                Vector there = new Vector(0, 0, Math.Max(2e-3 - 1e-5 * n, 0));
                now = finger.Tick(there, 1e-3);
                ball = probe.Step(there, 1e-3);
            }
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "mesh:    {0:0.00} N up, {1:0.00} mm off at {2:0.00} mm", now.Force.Z, 1e3 * ball.Depth,
                1e3 * ball.Place.Z));
            handle.Points = new Vector[] { new Vector(0.02, 0, 0), new Vector(-0.02, 0, 0.01) };
            using (Port peg = new Port("mesh_tool", handle))
            {
                peg.Touch(leaf);
                for (int n = 0; n < 300; ++n)
                {
                    now = peg.Tick(new Vector(0, 0, Math.Max(3e-3 - 1e-5 * n, 0)), new Rotation(1, 0, 0, 0), 1e-3);
                }
                Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                    "         {0:0.00} N and {1:0.0000} N m, by a point 20 mm off", now.Force.Z, now.Torque.Y));
            }
            handle.Points = new Vector[9];
            try
            {
                new Port("mesh_tool", handle);
            }
            catch (ArgumentException refused)
            {
                Console.WriteLine("         " + refused.Message);
            }
            vertices[4] = double.NaN;
            if (!leaf.Update(vertices)) Console.WriteLine("         " + leaf.Fault);
        }
        using (Port guard = new Port("guard", device))
        {
            Result first = guard.Tick(new Vector(0, 0, 0.01), 1e-3, new Vector(0, 0, 5));
            for (int n = 1; n < 10; ++n)
            {
                Result now = guard.Tick(new Vector(0, 0, 0.01 - 1e-4 * n), 1e-3, new Vector(0, 0, 5));
                if (n < 9) continue;
                Console.WriteLine("guard:   wants 5 N, has " + Newtons(first) + ", moving in " + Newtons(now));
            }
        }
    }
}
