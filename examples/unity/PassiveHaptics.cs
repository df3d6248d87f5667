// SPDX-License-Identifier: BSD-3-Clause
// The C interface of passive_haptics for C# and Unity: structs, functions, and one class that owns a port.
// In Unity put this file under Assets/ and the library that CMake's target passive_haptics_c makes under
// Assets/Plugins/. Publish in Update(), 20 to 100 times a second. Tick in a thread of your own, 1000 times a
// second, never in FixedUpdate(). C# collects its garbage in the loop's time: a tick allocates nothing
// here, but what else your process allocates can make one late, which is reported.
//
// Tried with Mono 6.8 on Linux, as Program.cs says. Not tried: Unity itself, IL2CPP, Windows.

using System;
using System.Runtime.InteropServices;
using System.Text;

namespace PassiveHaptics
{
    /// The device and the hand on it, as ph_parameters in passive_haptics.h, with its units. 0: not stated.
    [StructLayout(LayoutKind.Sequential)]
    public struct Parameters
    {
        private uint size;
        public uint Latency;
        public double Mass, Damping, HandForce, ForceLimit, LongestTick;
        public double Friction, Presliding, Quantum, ContinuousForce, WindingTime;
        public double TurnRate, StaleAfter, TopSpeed, Workspace, Watchdog;
        public double StaticFriction, KineticFriction; // of contacts, stylus and tool
        public Vector Tip;                             // of a stylus
        public double LeastInertia, InertiaSpread, InertiaOffset, AngularDamping; // of a tool
        public double DampingMost, AngularDampingMost, HandTorque, TorqueLimit, Lever;

        internal Parameters WithSize()
        {
            Parameters p = this;
            p.size = (uint)Marshal.SizeOf(typeof(Parameters));
            return p;
        }
    }

    public struct Vector
    {
        public double X, Y, Z;
        public Vector(double x, double y, double z) { X = x; Y = y; Z = z; }
    }

    /// The unit quaternion that turns the frame of a stylus or a tool into the world's. Unity's has its w last.
    public struct Rotation
    {
        public double W, X, Y, Z;
        public Rotation(double w, double x, double y, double z) { W = w; X = x; Y = y; Z = z; }
    }

    /// As ph_surface_kind, which says what of a surface each of them takes.
    public enum Kind : uint { Plane, Sphere, Cavity, Quadric, Capsule, Box, Plate }

    /// A piece of the world for a slot, as ph_surface.
    [StructLayout(LayoutKind.Sequential)]
    public struct Surface
    {
        internal uint size;
        public Kind Kind;
        public double Stiffness;
        public Vector A, B, C;
        public double Radius;
        public Vector Half;
        public double Curvature, CrossCurvature, Thickness, Reach;
        public Vector At; // the point of a tool
    }

    /// How stiff a surface is shown, and why no stiffer, as ph_explanation.
    [StructLayout(LayoutKind.Sequential)]
    public struct Explanation
    {
        internal uint size;
        public int Now;
        public double Asked, Shown, Depth, Force;
        private IntPtr because;
        public string Because { get { return Marshal.PtrToStringAnsi(because); } }
    }

    /// What a tick answers: newtons, metres, joules, a ph_event.
    [StructLayout(LayoutKind.Sequential)]
    public struct Result
    {
        internal uint size;
        public int Event;
        public Vector Force;
        public double Depth, Energy;
        public int Limited, Capped;
        public Vector Torque; // of a tool
    }

    /// One device. ONE PORT PER DEVICE: two would spend the same damping twice.
    public sealed class Port : IDisposable
    {
        private const string library = "passive_haptics_c";
        private IntPtr port;

        /// Throws an ArgumentException that names the parameter, its value and the remedy.
        public Port(string composition, Parameters device)
        {
            Parameters stated = device.WithSize();
            byte[] why = new byte[512];
            if (ph_create(composition, ref stated, out port, why, (UIntPtr)why.Length) != 0) Refuse(why);
        }
        ~Port() { Close(); }
        /// No thread may still tick or publish.
        public void Dispose()
        {
            Close();
            GC.SuppressFinalize(this);
        }

        /// The newest surface, from one thread. False: it is no plane, and the last good one stays.
        public bool Publish(Vector point, Vector normal, double stiffness)
        {
            int status = ph_publish_plane(port, ref point, ref normal, stiffness);
            GC.KeepAlive(this);
            return status == 0;
        }
        /// The newest surface in a slot of contacts, stylus or tool: planes, and what is curved, each from 0.
        public bool Publish(int slot, Surface surface)
        {
            surface.size = surfaceSize;
            int status = ph_publish(port, (uint)slot, ref surface);
            GC.KeepAlive(this);
            return status == 0;
        }
        /// Nothing is in it any more.
        public bool Release(int slot, Kind kind)
        {
            int status = ph_release(port, (uint)slot, kind);
            GC.KeepAlive(this);
            return status == 0;
        }
        /// Nothing is there any more.
        public bool PublishNothing()
        {
            int status = ph_publish_nothing(port);
            GC.KeepAlive(this);
            return status == 0;
        }

        /// One tick, from one thread: the device is at `position` [m], dt [s] after the last tick. The force
        /// of the result is what must be commanded, whatever happened.
        public Result Tick(Vector position, double dt)
        {
            Result result = new Result { size = resultSize };
            ph_tick(port, ref position, dt, ref result);
            GC.KeepAlive(this);
            return result;
        }
        /// The same for a guard, with the force that is wanted [N].
        public Result Tick(Vector position, double dt, Vector wanted)
        {
            Result result = new Result { size = resultSize };
            ph_tick_wanted(port, ref position, dt, ref wanted, ref result);
            GC.KeepAlive(this);
            return result;
        }

        /// The same for a stylus and a tool.
        public Result Tick(Vector position, Rotation orientation, double dt)
        {
            Result result = new Result { size = resultSize };
            ph_tick_pose(port, ref position, ref orientation, dt, ref result);
            GC.KeepAlive(this);
            return result;
        }

        /// Other parameters, the ledger kept, from the thread that ticks. Throws as the constructor does.
        public void Set(Parameters device)
        {
            Parameters stated = device.WithSize();
            byte[] why = new byte[512];
            int status = ph_set(port, ref stated, why, (UIntPtr)why.Length);
            GC.KeepAlive(this);
            if (status != 0) Refuse(why);
        }
        /// All but the parameters back to the start, from the thread that ticks.
        public void Reset()
        {
            ph_reset(port);
            GC.KeepAlive(this);
        }
        /// The driver has taken the forces away, or given them back: from the thread that ticks.
        public void EnableForces(bool on)
        {
            ph_enable_forces(port, on ? 1 : 0);
            GC.KeepAlive(this);
        }
        /// From the thread that ticks, not in every tick. False: this composition does not explain itself.
        public bool Explain(out Explanation explanation)
        {
            explanation = new Explanation { size = explanationSize };
            int status = ph_explain(port, ref explanation);
            GC.KeepAlive(this);
            return status == 0;
        }

        public static string TextOf(int happened)
        {
            return Marshal.PtrToStringAnsi(ph_event_text(happened));
        }

        private static readonly uint resultSize = (uint)Marshal.SizeOf(typeof(Result));
        private static readonly uint surfaceSize = (uint)Marshal.SizeOf(typeof(Surface));
        private static readonly uint explanationSize = (uint)Marshal.SizeOf(typeof(Explanation));

        private static void Refuse(byte[] why)
        {
            throw new ArgumentException(Encoding.UTF8.GetString(why, 0, Array.IndexOf(why, (byte)0)));
        }

        private void Close()
        {
            ph_destroy(port);
            port = IntPtr.Zero;
        }

        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_create(string composition, ref Parameters parameters, out IntPtr port,
                                            byte[] why, UIntPtr room);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern void ph_destroy(IntPtr port);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_publish_plane(IntPtr port, ref Vector point, ref Vector normal,
                                                   double stiffness);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_publish_nothing(IntPtr port);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_publish(IntPtr port, uint slot, ref Surface surface);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_release(IntPtr port, uint slot, Kind kind);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_tick_pose(IntPtr port, ref Vector position, ref Rotation orientation,
                                               double dt, ref Result result);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_set(IntPtr port, ref Parameters parameters, byte[] why, UIntPtr room);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_reset(IntPtr port);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_enable_forces(IntPtr port, int on);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_explain(IntPtr port, ref Explanation explanation);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_tick(IntPtr port, ref Vector position, double dt, ref Result result);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_tick_wanted(IntPtr port, ref Vector position, double dt,
                                                 ref Vector wanted, ref Result result);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern IntPtr ph_event_text(int happened);
    }
}
