# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: frames a second while a curve follows a tube that an armature bends.

    blender --background --factory-startup --python-exit-code 1 \\
        --python benchmarks/bench_motion.py -- [--spacing S] [--steps N] [--threads T]

Prints a JSON object for Blender's own evaluation, the frame set and nothing following, and for both
kinds of motion: medians over the frames of clock seconds and of seconds of all processors, and the
frames a second by the clock; `least_seconds` is the best frame, which tells most on a machine that
is busy with other things.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import time
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "docs" / "pictures")]

import bake_picture  # noqa: E402
import meander  # noqa: E402


def timed() -> tuple[list[float], list[float]]:
    scene = bpy.context.scene
    seconds, processors = [], []
    for frame in range(2, bake_picture.FRAMES + 1):
        begin, begin_processors = time.perf_counter(), time.process_time()
        scene.frame_set(frame)
        seconds.append(time.perf_counter() - begin)
        processors.append(time.process_time() - begin_processors)
    return seconds, processors


def _way(result: bpy.types.Object) -> list[tuple]:
    # Of all points: half of the tube does not move, so single ones may not.
    return [tuple(point.co) for point in result.data.splines[0].points]


def main(given: argparse.Namespace) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    meander.register()
    bpy.context.scene.frame_end = bake_picture.FRAMES
    surface = bake_picture.tube(bake_picture.armature())
    bpy.context.scene.frame_set(1)
    bpy.context.view_layer.objects.active = surface
    surface.meander.spacing = given.spacing
    surface.meander.threads = given.threads
    surface.meander.use_bevel = False
    assert bpy.ops.meander.run() == {"FINISHED"}
    result = bpy.context.view_layer.objects.active
    result.meander.motion_steps = given.steps
    nodes = result.meander.figures.nodes
    points = sum(len(spline.points) for spline in result.data.splines)
    curve = result.data
    for motion in (None, "STICK", "EVEN"):
        bpy.context.scene.frame_set(1)
        result.data = curve.copy()  # as it was in the first frame
        if motion is not None:
            result.meander.motion = motion
            result.meander.follow = True
        before = _way(result)
        seconds, processors = timed()
        result.meander.follow = False
        if motion is not None:
            assert _way(result) != before
        row = {"row": "motion", "motion": motion or "none", "nodes": nodes, "points": points}
        row |= {"faces": 2 * len(surface.data.polygons), "steps": given.steps}
        row["frames_per_second"] = round(len(seconds) / sum(seconds), 1)
        row["seconds"] = round(statistics.median(seconds), 4)
        row["least_seconds"] = round(min(seconds), 4)
        row["cpu_seconds"] = round(statistics.median(processors), 4)
        print(json.dumps(row), flush=True)
    meander.unregister()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--spacing", type=float, default=0.15)
    parser.add_argument("--steps", type=int, default=3)
    parser.add_argument("--threads", type=int, default=0)
    main(parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []))
