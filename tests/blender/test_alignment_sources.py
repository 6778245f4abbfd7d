# SPDX-License-Identifier: GPL-3.0-or-later
"""Every source of directions against vectors worked out by hand, and curves that follow them."""

from __future__ import annotations

import math
from dataclasses import asdict

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from meander import core
from meander.model.alignment import Alignment
from meander.model.options import option, table
from meander.run.plan import plan_run
from meander.scene import alignment as scene_alignment
from meander.scene import attributes
from meander.scene.errors import DataError
from scenes import fill, grid, poly_curve, refused, sphere, world_splines, world_triangles


def directions(thing: bpy.types.Object, alignment: Alignment) -> np.ndarray:
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = scene_alignment.directions_of(alignment, thing, depsgraph, 0.1)
    if callable(found):
        with core.Surface(*world_triangles(thing)) as surface:
            found = found(surface)
    return found


def assert_lines(found: np.ndarray, wanted: np.ndarray) -> None:
    """The same lines, whatever their signs and lengths."""
    lengths = np.linalg.norm(found, axis=1) * np.linalg.norm(wanted, axis=1)
    assert (lengths > 0.0).all()
    assert np.abs((found * wanted).sum(axis=1)) / lengths == pytest.approx(1.0, abs=1e-5)


def turned_grid() -> bpy.types.Object:
    thing = grid(cells=6)
    thing.matrix_world = Matrix.Rotation(math.radians(30.0), 4, "Z") @ Matrix.Diagonal(
        (1.0, 2.0, 1.0, 1.0)
    )
    bpy.context.view_layer.update()
    return thing


def test_axes_of_the_world_and_of_the_object():
    thing = turned_grid()
    count = len(thing.data.vertices)
    found = directions(thing, Alignment("AXIS", choice="X"))
    assert_lines(found, np.tile((1.0, 0.0, 0.0), (count, 1)))
    found = directions(thing, Alignment("AXIS", choice="X", local=True))
    assert_lines(found, np.tile((math.cos(math.pi / 6), math.sin(math.pi / 6), 0.0), (count, 1)))


def test_the_axis_that_lies_best_is_followed_unless_another_is_chosen():
    """A plane in x and z, and one in y and z: what stands straight up from it is never followed."""
    for euler, expected in (((math.pi / 2, 0.0, 0.0), "X"), ((0.0, math.pi / 2, 0.0), "Y")):
        thing = grid(cells=4)
        thing.rotation_euler = euler
        bpy.context.view_layer.update()
        assert thing.meander.alignment_axis == "AUTO"
        found = directions(thing, Alignment("AXIS", choice="AUTO"))
        assert_lines(found, directions(thing, Alignment("AXIS", choice=expected)))
        # Of the object it is its own X.
        found = directions(thing, Alignment("AXIS", choice="AUTO", local=True))
        assert_lines(found, directions(thing, Alignment("AXIS", choice="X", local=True)))
    with pytest.raises(DataError, match="The X axis stands straight up .*; choose Y$"):
        directions(thing, Alignment("AXIS", choice="X"))


def test_a_vector_attribute_turns_with_the_object():
    thing = turned_grid()
    attribute = thing.data.attributes.new("flow", "FLOAT_VECTOR", "POINT")
    vectors = np.random.default_rng(4).normal(size=(len(thing.data.vertices), 3))
    attribute.data.foreach_set("vector", vectors.ravel())
    found = directions(thing, Alignment("ATTRIBUTE", name="flow"))
    matrix = np.array([row[:3] for row in thing.matrix_world[:3]])
    assert_lines(found, np.array([matrix @ vector for vector in vectors]))
    names = attributes.vector_names(thing.meander, bpy.context, "")
    assert "flow" in names


@pytest.mark.parametrize(("choice", "column"), [("U", 0), ("V", 1)])
def test_uv_lines(choice, column):
    """The grid's own map has u along x and v along y; the object stretches and turns both."""
    thing = turned_grid()
    found = directions(thing, Alignment("UV", choice=choice))
    matrix = np.array([row[:3] for row in thing.matrix_world[:3]])
    assert_lines(found, np.tile(matrix[:, column], (len(found), 1)))


@pytest.mark.parametrize(("choice", "along"), [("MIN", True), ("MAX", False)])
def test_principal_directions_of_a_tube(choice, along):
    bpy.ops.mesh.primitive_cylinder_add(vertices=48, radius=1.0, depth=4.0, end_fill_type="NOTHING")
    tube = bpy.context.active_object
    tube.modifiers.new("Triangulate", "TRIANGULATE")
    found = directions(tube, Alignment("CURVATURE", choice=choice, smoothing=2.0))
    steepness = np.abs(found[:, 2]) / np.linalg.norm(found, axis=1)
    assert (steepness > 0.98).all() if along else (steepness < 0.2).all()


def test_strokes_are_continued():
    """Lines at 45 degrees across a square: so is everything between them."""
    thing = grid(cells=10)
    lines = [[(-0.8 + s, -0.8 - s, 0.0), (0.8 + s, 0.8 - s, 0.0)] for s in (-0.1, 0.1)]
    poly_curve("Lines", lines, False)
    bpy.context.view_layer.update()
    found = directions(thing, Alignment("STROKES", name="Lines"))
    assert_lines(found, np.tile((1.0, 1.0, 0.0), (len(found), 1)))
    assert np.isfinite(directions(thing, Alignment("SMOOTH"))).all()


@pytest.mark.parametrize("across", [False, True])
def test_a_curve_follows_an_axis(across):
    surface = grid(cells=20)
    settings = {"alignment_source": "AXIS", "alignment_axis": "X", "alignment_weight": 2.0}
    result = fill(surface, 0.2, align_across=across, **settings)
    ((points, _cyclic),) = world_splines(result)
    pieces = np.abs(np.roll(points, -1, axis=0) - points)
    share = pieces[:, 0].sum() / pieces[:, :2].sum()
    assert share < 0.35 if across else share > 0.65
    assert result.meander.alignment_source == "AXIS"
    assert plan_run(bpy.context).problem.options.alignment_weight == 2.0


def test_without_a_source_the_weight_counts_nothing():
    surface = grid(cells=4)
    surface.meander.alignment_weight = 3.0
    assert plan_run(bpy.context).problem.options.alignment_weight == 0.0
    assert plan_run(bpy.context).problem.directions is None


def test_alignments_and_terms_go_into_settings_and_out_again():
    thing = sphere()
    poly_curve("Lines", [[(0, 0, 1), (1, 0, 0)]], False)
    for alignment in (
        Alignment(),
        Alignment("AXIS", 0.5, True, choice="Y", local=True),
        Alignment("CURVATURE", choice="MAX", smoothing=3.0),
        Alignment("SMOOTH", 2.0),
        Alignment("STROKES", name="Lines"),
        Alignment("UV", choice="V", name="Flat"),
        Alignment("ATTRIBUTE", name="flow"),
    ):
        scene_alignment.store_alignment(alignment, thing.meander)
        assert asdict(scene_alignment.alignment_of(thing.meander)) == asdict(alignment)


def test_options_survive_the_settings_of_an_object():
    settings = sphere().meander
    untouched = option.chosen(table.TABLE, settings)
    assert untouched["length_weight"] is untouched["segment_share"] is untouched["reach"] is None
    assert untouched["start_spacing_factor"] == 1.0 and untouched["preset"] == "even"
    assert untouched["medial_axis"] == "preset"
    for values in (
        {"start_spacing_factor": 1.0},
        {
            "preset": "paper",
            "medial_axis": "geodesic",
            "iteration_limit": 70,
            "length_weight": 0.3,
            "bending_weight": 1.7,
            "length_power": 3.0,
            "medial_power": 2.5,
            "segment_share": 0.35,
            "reach": 4.5,
            "start_spacing_factor": 2.0,
            "border_distance": 0.75,
            "use_outline": True,
            "merge_distance": 0.002,
            "motion": "stick",
        },
    ):
        option.store(table.TABLE, values, settings)
        found = option.chosen(table.TABLE, settings)
        assert {name: found[name] for name in values} == values
    option.store(table.TABLE, {}, settings)
    again = option.chosen(table.TABLE, settings)
    assert again["length_weight"] is again["reach"] is again["merge_distance"] is None
    assert again["border_distance"] == 0.75  # what is not named stays


def test_terms_reach_the_options():
    surface = sphere()
    settings = surface.meander
    settings.spacing = 0.25
    before = plan_run(bpy.context).problem.options
    assert (before.segment_length, before.max_radius) == (0.0, 0.0)
    settings.length_weight, settings.bending_weight = 0.3, 2.0
    assert plan_run(bpy.context).problem.options == before  # not without the tick
    settings.use_weights = True
    settings.segment_share, settings.reach, settings.start_spacing_factor = 0.4, 2.4, 2.0
    found = plan_run(bpy.context).problem.options
    assert (found.length_weight, found.bending_weight) == (0.3, 2.0)
    assert found.segment_length == pytest.approx(0.05)
    assert found.max_radius == pytest.approx(0.3)
    assert found.start_spacing_factor == 2.0


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"alignment_source": "ATTRIBUTE"}, "no attribute"),
        ({"alignment_source": "ATTRIBUTE", "alignment_attribute": "x"}, "no vector attribute"),
        ({"alignment_source": "STROKES"}, "no curves to follow"),
        ({"alignment_source": "UV", "alignment_uv_map": "Nowhere"}, "no UV map 'Nowhere'"),
        ({"alignment_source": "AXIS", "alignment_axis": "Z"}, "The Z axis stands straight up"),
    ],
    ids=lambda value: value if isinstance(value, str) else "-".join(value.values()),
)
def test_what_gives_no_directions(settings, words):
    assert words in refused(grid(cells=4), **settings)


def test_a_direction_starts_full_unless_growth_or_a_seed_says_otherwise():
    thing = grid(cells=6)
    settings = thing.meander
    settings.spacing = 0.1
    assert settings.start == "PRESET"
    started = lambda: plan_run(bpy.context).problem.options.start  # noqa: E731
    assert started() == core.Start.GROW
    settings.alignment_source = "AXIS"
    assert started() == core.Start.FULL
    settings.start = "GROW"
    assert started() == core.Start.GROW
    settings.start = "PRESET"
    settings.preset = "FINEST"
    settings.alignment_source = "NONE"
    assert started() == core.Start.FULL
    settings.preset, settings.alignment_source = "EVEN", "AXIS"
    triangle = [(0.2, 0.2, 0.0), (0.6, 0.3, 0.0), (0.3, 0.6, 0.0)]
    settings.seed = poly_curve("Drawn", [triangle], cyclic=True)
    assert started() == core.Start.GROW
