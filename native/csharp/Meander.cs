// SPDX-License-Identifier: GPL-3.0-or-later
// Made from meander.h by scripts/write_csharp.py; changes are lost.
//
// meander.h as C# calls it, for Rhino, Grasshopper, Unity and .NET; what each call and each field
// means stands there. Names of functions and fields are those of C.
//
//   handles          IntPtr, of the _create functions by `out`
//   structs          classes, which marshal as pointers: null is NULL. New<T>() makes one with
//                    struct_size set, for the _init function
//   arrays           pinned while a call lasts; null is NULL. Arrays of a result are IntPtr in its
//                    struct: copy them before meander_result_destroy
//
// The library is meander.dll, libmeander.so or libmeander.dylib on the path of the program.
using System;
using System.Runtime.InteropServices;

namespace Meander
{
    public static class Api
    {
        const string Library = "meander";

        public const uint VERSION_MAJOR = 0;
        public const uint VERSION_MINOR = 1;
        public const uint VERSION_PATCH = 0;
        public const uint ABI_VERSION = 3;

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr meander_version();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern uint meander_abi_version();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern UIntPtr meander_struct_layout(string name, [In, Out] UIntPtr[] layout, UIntPtr capacity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void meander_result_destroy(IntPtr result);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr meander_status_name(Status status);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_error_init([In, Out] Error error, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_context_create(out IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void meander_context_destroy(IntPtr context);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void meander_context_cancel(IntPtr context);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void meander_context_reset(IntPtr context);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern double meander_context_progress(IntPtr context);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Phase meander_context_phase(IntPtr context);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_polygons_init([In, Out] Polygons polygons, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_text_read_polygons([In, Out] byte[] text, UIntPtr size, Text kind, [In, Out] Polygons polygons, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_text_read_numbers([In, Out] byte[] text, UIntPtr size, [In, Out] double[] numbers, UIntPtr capacity, [In, Out] UIntPtr[] count, [In, Out] UIntPtr[] end, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_text_write_rows(string pattern, [In, Out] double[] values, UIntPtr row_count, UIntPtr column_count, string text, UIntPtr capacity, [In, Out] UIntPtr[] size, [In, Out] UIntPtr[] rows, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_triangles_init([In, Out] Triangles triangles, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_polygons_triangulate([In, Out] double[] vertices, UIntPtr vertex_count, [In, Out] uint[] corners, UIntPtr corner_count, [In, Out] ulong[] ends, UIntPtr polygon_count, [In, Out] Triangles triangles, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_options_init([In, Out] SurfaceOptions options, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_create([In, Out] double[] vertices, UIntPtr vertex_count, [In, Out] uint[] faces, UIntPtr face_count, [In, Out] SurfaceOptions options, out IntPtr surface, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void meander_surface_destroy(IntPtr surface);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_statistics_init([In, Out] SurfaceStatistics statistics, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_get_statistics(IntPtr surface, [In, Out] SurfaceStatistics statistics, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_faults_init([In, Out] Faults faults, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_mesh_find_faults([In, Out] double[] vertices, UIntPtr vertex_count, [In, Out] uint[] faces, UIntPtr face_count, double weld_distance, [In, Out] Faults faults, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_mesh_find_closest([In, Out] double[] vertices, UIntPtr vertex_count, [In, Out] uint[] faces, UIntPtr face_count, [In, Out] double[] points, UIntPtr point_count, uint threads, [In, Out] uint[] closest_faces, [In, Out] double[] weights, [In, Out] double[] distances, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_find_closest(IntPtr surface, [In, Out] double[] points, UIntPtr point_count, uint threads, [In, Out] uint[] closest_faces, [In, Out] double[] weights, [In, Out] double[] distances, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_compute_curvature(IntPtr surface, Curvature curvature, double smoothing, [In, Out] double[] values, UIntPtr vertex_count, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_compute_directions(IntPtr surface, Directions kind, double smoothing, [In, Out] double[] directions, UIntPtr vertex_count, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_compute_stroke_directions(IntPtr surface, [In, Out] double[] points, UIntPtr point_count, [In, Out] ulong[] offsets, UIntPtr stroke_count, [In, Out] double[] directions, UIntPtr vertex_count, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_turn_directions(IntPtr surface, [In, Out] double[] directions, [In, Out] double[] angles, UIntPtr vertex_count, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_outlines_init([In, Out] Outlines outlines, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_find_outlines(IntPtr surface, double distance, double spacing, [In, Out] Outlines outlines, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_seed_init([In, Out] Seed seed, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_options_init([In, Out] FlowOptions options, UIntPtr struct_size, Preset preset);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_options_get_warning([In, Out] FlowOptions options, UIntPtr index, [In, Out] byte[] text, UIntPtr capacity, [In, Out] UIntPtr[] size, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr meander_tuning_name(UIntPtr index);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_options_set_tuning([In, Out] FlowOptions options, string name, double value, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_options_get_tuning([In, Out] FlowOptions options, string name, [In, Out] double[] value, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_extent_init([In, Out] Extent extent, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_surface_measure_extent(IntPtr surface, [In, Out] double[] density, UIntPtr density_count, [In, Out] Extent extent, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_cost_init([In, Out] Cost cost, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_extent_estimate_cost([In, Out] Extent extent, [In, Out] FlowOptions options, [In, Out] Cost cost, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_create(IntPtr surface, [In, Out] Seed seed, [In, Out] double[] density, UIntPtr density_count, [In, Out] FlowOptions options, out IntPtr flow, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void meander_flow_destroy(IntPtr flow);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_set_directions(IntPtr flow, [In, Out] double[] directions, UIntPtr vertex_count, Alignment alignment, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_step(IntPtr flow, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_run(IntPtr flow, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern StopReason meander_flow_stop_reason(IntPtr flow);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_start(IntPtr flow, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern uint meander_flow_is_running(IntPtr flow);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_wait(IntPtr flow, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_preview_init([In, Out] Preview preview, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_keep_growth(IntPtr flow, double length_step, UIntPtr point_limit, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_take_preview(IntPtr flow, [In, Out] Preview preview, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_set_radius(IntPtr flow, double radius, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_set_density(IntPtr flow, [In, Out] double[] density, UIntPtr density_count, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_set_options(IntPtr flow, [In, Out] FlowOptions options, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_set_vertices(IntPtr flow, [In, Out] double[] vertices, UIntPtr vertex_count, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_statistics_init([In, Out] FlowStatistics statistics, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_compute_statistics(IntPtr flow, [In, Out] FlowStatistics statistics, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_get_history(IntPtr flow, [In, Out] Iteration records, UIntPtr record_size, UIntPtr capacity, [In, Out] UIntPtr[] count, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_opening_create(out IntPtr opening, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void meander_opening_destroy(IntPtr opening);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_opening_start_surface(IntPtr opening, [In, Out] double[] vertices, UIntPtr vertex_count, [In, Out] uint[] faces, UIntPtr face_count, [In, Out] SurfaceOptions options, out IntPtr surface, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_opening_start_flow(IntPtr opening, IntPtr surface, [In, Out] Seed seed, [In, Out] double[] density, UIntPtr density_count, [In, Out] FlowOptions options, out IntPtr flow, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_opening_start_curvature(IntPtr opening, IntPtr surface, Curvature kind, double smoothing, [In, Out] double[] values, UIntPtr vertex_count, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_opening_start_directions(IntPtr opening, IntPtr surface, Directions kind, double smoothing, [In, Out] double[] directions, UIntPtr vertex_count, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_opening_start_extent(IntPtr opening, IntPtr surface, [In, Out] double[] density, UIntPtr density_count, [In, Out] Extent extent, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern uint meander_opening_is_running(IntPtr opening);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_opening_wait(IntPtr opening, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_polylines_init([In, Out] Polylines polylines, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_get_polylines(IntPtr flow, [In, Out] Polylines polylines, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_nodes_init([In, Out] Nodes nodes, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_get_nodes(IntPtr flow, [In, Out] Nodes nodes, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_point_data_init([In, Out] PointData point_data, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_compute_point_data(IntPtr flow, PointParts parts, [In, Out] PointData point_data, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_round_curve(IntPtr flow, double tolerance, [In, Out] Polylines polylines, [In, Out] PointData point_data, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_gaps_init([In, Out] Gaps gaps, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_find_gaps(IntPtr flow, double least_size, [In, Out] Gaps gaps, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_start_finding(IntPtr flow, [In, Out] Polylines polylines, [In, Out] PointData point_data, [In, Out] FlowStatistics statistics, [In, Out] Gaps gaps, double least_size, [In, Out] Polylines drawn, [In, Out] PointData drawn_data, double tolerance, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_cut_init([In, Out] Cut cut, UIntPtr struct_size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_flow_cut_surface(IntPtr flow, double detail, uint middle_lines, [In, Out] Cut cut, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_map_find_pixels([In, Out] double[] drawing, UIntPtr face_count, uint side, uint margin, uint threads, [In, Out] int[] nearest, [In, Out] float[] weights, [In, Out] UIntPtr[] covered, [In, Out] UIntPtr[] twice, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_cut_measure_distances([In, Out] Cut cut, double distance, [In, Out] int[] nearest, [In, Out] float[] weights, UIntPtr point_count, uint threads, [In, Out] double[] distances, [In, Out] double[] away, IntPtr context, [In, Out] Error error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern Status meander_cut_find_places([In, Out] Cut cut, double distance, [In, Out] int[] nearest, [In, Out] float[] weights, UIntPtr point_count, uint threads, [In, Out] double[] distances, [In, Out] double[] away, [In, Out] uint[] strands, [In, Out] double[] along, IntPtr context, [In, Out] Error error);

        /// <summary>A struct of zeros, and its size for its _init function.</summary>
        public static T New<T>(out UIntPtr size) where T : class, new()
        {
            size = (UIntPtr)(uint)Marshal.SizeOf(typeof(T));
            return new T();
        }

        /// <summary>A text of the library, such as that of meander_version.</summary>
        public static string Text(IntPtr text)
        {
            return Marshal.PtrToStringAnsi(text);
        }

        /// <summary>The sentence of an error.</summary>
        public static string Sentence(Error error)
        {
            byte[] text = error.text ?? new byte[0];
            int end = Array.IndexOf(text, (byte)0);
            return System.Text.Encoding.UTF8.GetString(text, 0, end < 0 ? text.Length : end);
        }

        /// <summary>An array of a result, whose pointer and count the struct has.</summary>
        public static double[] Doubles(IntPtr array, int count)
        {
            var copy = new double[count];
            if (count > 0) Marshal.Copy(array, copy, 0, count);
            return copy;
        }

        /// <summary>The same of indices, offsets of 32 bits.</summary>
        public static int[] Integers(IntPtr array, int count)
        {
            var copy = new int[count];
            if (count > 0) Marshal.Copy(array, copy, 0, count);
            return copy;
        }

        /// <summary>The same of offsets of 64 bits.</summary>
        public static long[] Longs(IntPtr array, int count)
        {
            var copy = new long[count];
            if (count > 0) Marshal.Copy(array, copy, 0, count);
            return copy;
        }
    }

    public enum Status : int
    {
        OK = 0,
        INVALID_ARGUMENT = 1,
        INVALID_MESH = 2,
        INVALID_SEED = 3,
        CANCELLED = 4,
        OUT_OF_MEMORY = 5,
        INTERNAL = 6,
    }

    public enum Element : uint
    {
        NONE = 0,
        VERTEX = 1,
        FACE = 2,
        EDGE = 3,
        SEED_POINT = 4,
    }

    public enum Phase : uint
    {
        NONE = 0,
        GROWTH = 1,
        HAIRPIN_REMOVAL = 2,
        POLISH = 3,
    }

    public enum Text : uint
    {
        OBJ_FACES = 0,
        OBJ_LINES = 1,
        STL = 2,
    }

    public enum Fault : uint
    {
        NOT_FINITE = 0,
        NO_AREA = 1,
        DOUBLED_FACE = 2,
        CROWDED_EDGE = 3,
        BOW_TIE = 4,
        ONE_SIDED = 5,
        SEAM = 6,
    }

    public enum Curvature : uint
    {
        GAUSSIAN = 0,
        MEAN = 1,
        ABSOLUTE_GAUSSIAN = 2,
        ABSOLUTE_MEAN = 3,
        CURVEDNESS = 4,
    }

    public enum Directions : uint
    {
        CURVATURE_MIN = 0,
        CURVATURE_MAX = 1,
        SMOOTH = 2,
        BOUNDARY = 3,
    }

    public enum Preset : uint
    {
        EVEN = 0,
        PAPER = 1,
        FINEST = 2,
    }

    public enum BoundaryRule : uint
    {
        CENTRE = 0,
        OBSTACLE = 1,
    }

    public enum MedialAxis : uint
    {
        EUCLIDEAN = 0,
        GEODESIC = 1,
    }

    public enum StopRule : uint
    {
        SETTLED = 0,
        PAPER = 1,
    }

    public enum Start : uint
    {
        GROW = 0,
        FULL = 1,
    }

    public enum Alignment : uint
    {
        ALONG = 0,
        ACROSS = 1,
    }

    public enum StopReason : uint
    {
        RUNNING = 0,
        CONVERGED = 1,
        ITERATION_LIMIT = 2,
        STALLED = 3,
        CANCELLED = 4,
    }

    public enum PointParts : uint
    {
        ARC_LENGTHS = 1,
        NORMALS = 2,
        TANGENTS = 4,
        RADII = 8,
        PLACES = 16,
        ALL = 31,
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Error
    {
        public uint struct_size;
        public Status status;
        public Element element_kind;
        public uint element_index;
        public uint element_index2;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 492)]
        public byte[] text;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Polygons
    {
        public uint struct_size;
        public uint reserved32;
        public UIntPtr point_count;
        public UIntPtr corner_count;
        public UIntPtr polygon_count;
        public UIntPtr left_out;
        public IntPtr positions;
        public IntPtr corners;
        public IntPtr ends;
        public IntPtr lines;
        public IntPtr result;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Triangles
    {
        public uint struct_size;
        public uint reserved32;
        public UIntPtr count;
        public IntPtr corners;
        public IntPtr polygons;
        public IntPtr result;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class SurfaceOptions
    {
        public uint struct_size;
        public uint drop_degenerate;
        public uint split_bow_ties;
        public uint cut_non_manifold;
        public double merge_distance;
        public IntPtr face_mask;
        public IntPtr vertex_mask;
        public UIntPtr face_mask_count;
        public UIntPtr vertex_mask_count;
        public double mask_threshold;
        public uint threads;
        public uint make_manifold;
        public double weld_distance;
        public double smallest_part;
        public IntPtr polygons;
        public UIntPtr polygons_count;
        public uint drop_doubled;
        public uint reserved32;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 1)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class SurfaceStatistics
    {
        public uint struct_size;
        public uint vertices;
        public uint faces;
        public uint components;
        public uint boundary_loops;
        public uint flipped_faces;
        public uint unused_vertices;
        public uint merged_vertices;
        public uint dropped_faces;
        public uint split_vertices;
        public uint cut_edges;
        public uint masked_faces;
        public uint clipped_faces;
        public uint welded_edges;
        public double area;
        public double diagonal;
        public uint opened_edges;
        public uint doubled_faces;
        public uint split_edges;
        public uint small_parts;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Faults
    {
        public uint struct_size;
        public uint reserved32;
        public UIntPtr count;
        public IntPtr kinds;
        public IntPtr elements;
        public IntPtr result;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Outlines
    {
        public uint struct_size;
        public uint reserved32;
        public UIntPtr point_count;
        public UIntPtr strand_count;
        public UIntPtr skipped_count;
        public IntPtr positions;
        public IntPtr offsets;
        public IntPtr closed;
        public IntPtr result;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Seed
    {
        public uint struct_size;
        public uint fill_regions;
        public UIntPtr point_count;
        public UIntPtr strand_count;
        public IntPtr points;
        public IntPtr offsets;
        public IntPtr closed;
        public IntPtr @fixed;
        public IntPtr guides;
        public double max_distance;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class FlowOptions
    {
        public uint struct_size;
        public Preset preset;
        public double radius;
        public double segment_length;
        public double max_radius;
        public double max_radius_factor;
        public double length_weight;
        public double bending_weight;
        public double medial_weight;
        public double alignment_weight;
        public double length_power;
        public double medial_power;
        public double step;
        public double start_spacing_factor;
        public double boundary_distance;
        public double polish_bending_weight;
        public BoundaryRule boundary_rule;
        public MedialAxis medial_axis;
        public StopRule stop_rule;
        public uint grow_into_empty;
        public uint widen_loops;
        public uint hold_ends;
        public uint hairpin_removal_iterations;
        public uint polish;
        public uint iteration_limit;
        public uint threads;
        public double roughness;
        public Start start;
        public uint variation;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 16)]
        public double[] tunings;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 5)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Extent
    {
        public uint struct_size;
        public uint faces;
        public double length_area;
        public double node_area;
        public double edge_density;
        public double curvature;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Cost
    {
        public uint struct_size;
        public uint reserved32;
        public double nodes;
        public double points;
        public double length;
        public double memory;
        public double processor_seconds;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Preview
    {
        public uint struct_size;
        public uint serial;
        public uint iterations;
        public uint nodes;
        public double length;
        public double seconds;
        public ulong kept;
        public UIntPtr point_count;
        public UIntPtr strand_count;
        public IntPtr positions;
        public IntPtr offsets;
        public IntPtr closed;
        public IntPtr result;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class FlowStatistics
    {
        public uint struct_size;
        public StopReason stop_reason;
        public uint iterations;
        public uint nodes;
        public uint strands;
        public uint closed_strands;
        public uint crossings;
        public uint polishing;
        public uint guides;
        public uint empty_components;
        public double length;
        public double energy;
        public double mean_step;
        public double spacing_target;
        public double spacing_p05;
        public double spacing_median;
        public double spacing_p95;
        public double seconds_total;
        public double seconds_medial_axis;
        public double seconds_solve;
        public double seconds_retract;
        public double seconds_reconnect;
        public double seconds_crossings;
        public double seconds_refine;
        public double seed_distance;
        public double seed_jump_length;
        public uint seed_point;
        public uint seed_jumps;
        public uint seed_jump_point;
        public uint seed_jump_point2;
        public double evenness;
        public uint small_components;
        public float roughness;
        public float smoothing;
        public float stretch;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 1)]
        public ulong[] reserved;
        public uint start_asked_full;
        public uint start_full_parts;
        public uint start_grown_parts;
        public uint start_no_room_parts;
        public uint start_crossing_parts;
        public uint completed_parts;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Iteration
    {
        public uint iteration;
        public uint nodes;
        public double length;
        public double mean_step;
        public double energy;
        public double seconds;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Polylines
    {
        public uint struct_size;
        public uint reserved32;
        public UIntPtr point_count;
        public UIntPtr strand_count;
        public IntPtr positions;
        public IntPtr offsets;
        public IntPtr closed;
        public IntPtr guides;
        public IntPtr result;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Nodes
    {
        public uint struct_size;
        public uint reserved32;
        public UIntPtr count;
        public IntPtr faces;
        public IntPtr barycentrics;
        public IntPtr radii;
        public IntPtr @fixed;
        public IntPtr result;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class PointData
    {
        public uint struct_size;
        public uint reserved32;
        public UIntPtr count;
        public IntPtr arc_lengths;
        public IntPtr normals;
        public IntPtr tangents;
        public IntPtr radii;
        public IntPtr faces;
        public IntPtr barycentrics;
        public IntPtr result;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Gaps
    {
        public uint struct_size;
        public uint reserved32;
        public UIntPtr count;
        public IntPtr positions;
        public IntPtr radii;
        public IntPtr sizes;
        public IntPtr faces;
        public IntPtr result;
        public double empty_share;
        public double narrow_share;
        public IntPtr narrow;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 1)]
        public ulong[] reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public class Cut
    {
        public uint struct_size;
        public uint reserved32;
        public UIntPtr vertex_count;
        public UIntPtr face_count;
        public UIntPtr point_count;
        public UIntPtr strand_count;
        public IntPtr positions;
        public IntPtr distances;
        public IntPtr vertex_faces;
        public IntPtr vertex_weights;
        public IntPtr faces;
        public IntPtr origins;
        public IntPtr strands;
        public IntPtr regions;
        public IntPtr sides;
        public IntPtr nearest_sides;
        public IntPtr along;
        public IntPtr face_distances;
        public IntPtr corner_weights;
        public IntPtr line_vertices;
        public IntPtr arc_lengths;
        public IntPtr offsets;
        public IntPtr line_strands;
        public IntPtr closed;
        public IntPtr lengths;
        public IntPtr result;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)]
        public ulong[] reserved;
    }
}
