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
        public double StaticFriction, KineticFriction; // of contacts, stylus, tool, mesh_touch and mesh_tool
        public Vector Tip;                             // of a stylus
        public double LeastInertia, InertiaSpread, InertiaOffset, AngularDamping; // of tool and mesh_tool
        public double DampingMost, AngularDampingMost, HandTorque, TorqueLimit, Lever;
        public double Stiffness, Viscosity, Radius; // of mesh_touch and mesh_tool
        public double Pitch, DetentStiffness, FirstStop, LastStop, StopStiffness; // of detents
        public uint Rotary;
        private uint pointCount;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 8)]
        public Vector[] Points; // of a mesh_tool, at most 8, in the frame of its handle
        public double RendererPeriod; // of a guard, longest time from one new force to the next

        internal Parameters WithSize()
        {
            Parameters p = this;
            p.size = (uint)Marshal.SizeOf(typeof(Parameters));
            p.pointCount = Points == null ? 0 : (uint)Points.Length;
            p.Points = new Vector[8];
            if (Points != null) Array.Copy(Points, p.Points, Math.Min(Points.Length, 8));
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

    /// What a probe's step answers, as ph_probe_result.
    [StructLayout(LayoutKind.Sequential)]
    public struct Touched
    {
        internal uint size;
        public int Placed, Mesh, Triangle;
        public Vector Place, Normal; // m
        public double Depth;         // m
        public double Stiffness, Friction, Viscosity;
    }

    /// Triangles that ports and probes touch while another thread moves them. What touches a mesh keeps it.
    public sealed class Mesh : IDisposable
    {
        internal IntPtr mesh;
        private readonly uint triangleCount;
        private byte[] why = new byte[512];

        /// x, y, z of each vertex [m], three vertices of each triangle; stiffness, friction and viscosity of each
        /// material, and the number of each triangle's: null for one material, that who touches the mesh states.
        public Mesh(double[] vertices, int[] triangles, double[] materials = null, byte[] materialOf = null)
        {
            object[] arrays = { vertices, triangles, materials, materialOf };
            GCHandle[] pins = Array.ConvertAll(arrays, a => GCHandle.Alloc(a, GCHandleType.Pinned));
            try
            {
                Data data = new Data
                {
                    size = (uint)Marshal.SizeOf(typeof(Data)), vertices = pins[0].AddrOfPinnedObject(),
                    triangles = pins[1].AddrOfPinnedObject(), materials = pins[2].AddrOfPinnedObject(),
                    materialOf = pins[3].AddrOfPinnedObject()
                };
                data.vertexCount = Count(vertices) / 3;
                data.triangleCount = triangleCount = Count(triangles) / 3;
                data.materialCount = Count(materials) / 3;
                Check(materialOf);
                if (ph_mesh_create(ref data, out mesh, why, (UIntPtr)why.Length) != 0) Port.Refuse(why);
            }
            finally
            {
                Array.ForEach(pins, pin => pin.Free());
            }
        }
        ~Mesh() { Close(); }
        public void Dispose()
        {
            Close();
            GC.SuppressFinalize(this);
        }

        /// All vertices are at other places, or the whole mesh is: from one thread, 20 to 100 times a second. False: it
        /// is refused, Fault says why, and the last good shape stays.
        public bool Update(double[] vertices)
        {
            int status = ph_mesh_update(mesh, vertices, Count(vertices) / 3, why, (UIntPtr)why.Length);
            GC.KeepAlive(this);
            return status == 0;
        }
        public bool Move(Vector position, Rotation orientation)
        {
            int status = ph_mesh_move(mesh, ref position, ref orientation);
            GC.KeepAlive(this);
            return status == 0;
        }
        /// Other materials, as the constructor's; null: who touches the mesh states one again.
        public bool SetMaterials(double[] materials, byte[] materialOf)
        {
            Check(materialOf);
            int status = ph_mesh_set_materials(mesh, materials, Count(materials) / 3, materialOf, why,
                                               (UIntPtr)why.Length);
            GC.KeepAlive(this);
            return status == 0;
        }
        /// What is almost surely a slip, as millimetres for metres; "" if nothing is. It takes as long as the constructor.
        public string Doubt()
        {
            byte[] doubt = new byte[why.Length];
            if (ph_mesh_doubt(mesh, doubt, (UIntPtr)doubt.Length) != 0) Port.Refuse(doubt);
            GC.KeepAlive(this);
            return Encoding.UTF8.GetString(doubt, 0, Array.IndexOf(doubt, (byte)0));
        }
        public string Fault { get { return Encoding.UTF8.GetString(why, 0, Array.IndexOf(why, (byte)0)); } }

        private void Check(byte[] materialOf)
        {
            if (materialOf != null && Count(materialOf) != triangleCount)
                throw new ArgumentException("materialOf has not a number for each triangle");
        }
        private static uint Count(Array numbers) { return numbers == null ? 0 : (uint)numbers.Length; }
        private void Close()
        {
            ph_mesh_destroy(mesh);
            mesh = IntPtr.Zero;
        }

        [StructLayout(LayoutKind.Sequential)]
        private struct Data
        {
            public uint size, vertexCount, triangleCount, materialCount;
            public IntPtr vertices, triangles, materials, materialOf;
        }
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_mesh_create(ref Data data, out IntPtr mesh, byte[] why, UIntPtr room);
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern void ph_mesh_destroy(IntPtr mesh);
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_mesh_update(IntPtr mesh, double[] vertices, uint count, byte[] why,
                                                 UIntPtr room);
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_mesh_set_materials(IntPtr mesh, double[] materials, uint count,
                                                        byte[] materialOf, byte[] why, UIntPtr room);
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_mesh_doubt(IntPtr mesh, byte[] doubt, UIntPtr room);
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_mesh_move(IntPtr mesh, ref Vector position, ref Rotation orientation);
    }

    /// A ball that no triangle lets through, without a port: for a renderer of your own, whose force a guard bounds.
    public sealed class Probe : IDisposable
    {
        private IntPtr probe;

        /// 0 in a parameter stands for its default.
        public Probe(double radius = 0, double friction = 0)
        {
            Stated stated = new Stated { radius = radius, friction = friction };
            stated.size = (uint)Marshal.SizeOf(typeof(Stated));
            byte[] why = new byte[512];
            if (ph_probe_create(ref stated, out probe, why, (UIntPtr)why.Length) != 0) Port.Refuse(why);
        }
        ~Probe() { Close(); }
        public void Dispose()
        {
            Close();
            GC.SuppressFinalize(this);
        }

        /// This mesh as well. False: there is no place for it.
        public bool Touch(Mesh mesh)
        {
            int status = ph_probe_touch(probe, mesh.mesh);
            GC.KeepAlive(mesh);
            GC.KeepAlive(this);
            return status == 0;
        }
        public void LetGo(Mesh mesh)
        {
            ph_probe_let_go(probe, mesh.mesh);
            GC.KeepAlive(mesh);
            GC.KeepAlive(this);
        }
        /// Forgets which side was touched.
        public void Reset()
        {
            ph_probe_reset(probe);
            GC.KeepAlive(this);
        }
        /// The device is at `position` [m], dt [s] after the last step.
        public Touched Step(Vector position, double dt)
        {
            Touched result = new Touched { size = (uint)Marshal.SizeOf(typeof(Touched)) };
            ph_probe_step(probe, ref position, dt, ref result);
            GC.KeepAlive(this);
            return result;
        }

        private void Close()
        {
            ph_probe_destroy(probe);
            probe = IntPtr.Zero;
        }

        [StructLayout(LayoutKind.Sequential)]
        private struct Stated
        {
            public uint size, reserved;
            public double radius, friction, newsSpeed, longestWay;
        }
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_probe_create(ref Stated stated, out IntPtr probe, byte[] why,
                                                  UIntPtr room);
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern void ph_probe_destroy(IntPtr probe);
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_probe_touch(IntPtr probe, IntPtr mesh);
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_probe_let_go(IntPtr probe, IntPtr mesh);
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_probe_reset(IntPtr probe);
        [DllImport(Port.library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_probe_step(IntPtr probe, ref Vector position, double dt,
                                                ref Touched result);
    }

    /// One device. ONE PORT PER DEVICE: two would spend the same damping twice.
    public sealed class Port : IDisposable
    {
        internal const string library = "passive_haptics_c";
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

        /// A mesh_touch or mesh_tool touches this mesh as well, from the thread that ticks. False: there is no place.
        public bool Touch(Mesh mesh)
        {
            int status = ph_mesh_touch(port, mesh.mesh);
            GC.KeepAlive(mesh);
            GC.KeepAlive(this);
            return status == 0;
        }
        /// It touches this mesh no more.
        public void LetGo(Mesh mesh)
        {
            ph_mesh_let_go(port, mesh.mesh);
            GC.KeepAlive(mesh);
            GC.KeepAlive(this);
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

        /// The same for a stylus, a tool and a mesh_tool.
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

        internal static void Refuse(byte[] why)
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
        private static extern int ph_mesh_touch(IntPtr port, IntPtr mesh);
        [DllImport(library, CallingConvention = CallingConvention.Cdecl)]
        private static extern int ph_mesh_let_go(IntPtr port, IntPtr mesh);
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
