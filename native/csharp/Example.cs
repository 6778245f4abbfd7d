// SPDX-License-Identifier: GPL-3.0-or-later
// An octahedron, filled: prints how many points the line has, and how many strands.
using System;
using Meander;
using static Meander.Api;

static class Example
{
    static int Main()
    {
        double[] vertices = { 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1 };
        uint[] faces = { 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5 };
        UIntPtr size, none = UIntPtr.Zero;
        var error = New<Error>(out size);
        meander_error_init(error, size);
        var options = New<FlowOptions>(out size);
        meander_flow_options_init(options, size, Preset.EVEN);
        options.radius = 0.1; // half the spacing
        IntPtr surface, flow;
        if (meander_surface_create(vertices, (UIntPtr)6, faces, (UIntPtr)8, null, out surface, IntPtr.Zero, error) != Status.OK
            || meander_flow_create(surface, null, null, none, options, out flow, IntPtr.Zero, error) != Status.OK
            || meander_flow_run(flow, IntPtr.Zero, error) != Status.OK)
        {
            Console.Error.WriteLine(Sentence(error));
            return 1;
        }
        var curve = New<Polylines>(out size);
        meander_polylines_init(curve, size);
        meander_flow_get_polylines(flow, curve, error);
        double[] points = Doubles(curve.positions, 3 * (int)curve.point_count);
        meander_result_destroy(curve.result);
        meander_flow_destroy(flow);
        meander_surface_destroy(surface);
        Console.WriteLine("{0} points, {1} strand", points.Length / 3, curve.strand_count);
        return 0;
    }
}
