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

    /// What a tick answers: newtons, metres, joules, a ph_event.
    [StructLayout(LayoutKind.Sequential)]
    public struct Result
    {
        internal uint size;
        public int Event;
        public Vector Force;
        public double Depth, Energy;
        public int Limited, Capped;
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
            int status = ph_create(composition, ref stated, out port, why, (UIntPtr)why.Length);
            if (status == 0) return;
            int end = Array.IndexOf(why, (byte)0);
            throw new ArgumentException(Encoding.UTF8.GetString(why, 0, end));
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

        public static string TextOf(int happened)
        {
            return Marshal.PtrToStringAnsi(ph_event_text(happened));
        }

        private static readonly uint resultSize = (uint)Marshal.SizeOf(typeof(Result));

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
        private static extern int ph_tick(IntPtr port, ref Vector position, double dt, ref Result result);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_tick_wanted(IntPtr port, ref Vector position, double dt,
                                                 ref Vector wanted, ref Result result);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern IntPtr ph_event_text(int happened);
    }
}
