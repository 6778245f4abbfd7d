# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of edges without faces, and strokes of Grease Pencil, as seeds, guides and directions."""

from __future__ import annotations

import math

import bmesh
import bpy
import numpy as np
import pytest
from meander.run import seeds
from meander.scene import curve_reader, fillable
from meander.scene.seeds import mesh_of_seed
from scenes import (
    NEW_STROKES,
    activate,
    circle_points,
    fill,
    grease_pencil,
    grid,
    matrix_of,
    mesh_object,
    packing,
    refused,
)


def edges(name: str, vertices, pairs) -> bpy.types.Object:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, v)) for v in vertices], list(pairs), [])
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def ring(count: int = 24, radius: float = 0.4) -> bpy.types.Object:
    places = circle_points(radius, 0.0, count)
    # Not in the order of the way round: edges are what counts.
    order = [(7 * k) % count for k in range(count)]
    place_of = {place: number for number, place in enumerate(order)}
    pairs = [(place_of[k], place_of[(k + 1) % count]) for k in range(count)]
    return edges("Ring", [places[k] for k in order], pairs)


def read(thing: bpy.types.Object, **options):
    bpy.context.view_layer.update()
    return curve_reader.strands_of_curve(thing, bpy.context.evaluated_depsgraph_get(), **options)


ROW = [(x, 0.1, 0.0) for x in np.linspace(-0.8, 0.8, 9)]
CIRCLE = circle_points(0.4, 0.0)


def test_a_mesh_of_edges_is_a_seed_with_its_modifiers_and_its_place():
    surface, seed = grid(20), ring()
    surface.meander.seed = seed
    result = fill(surface, 0.2)
    assert [spline.use_cyclic_u for spline in result.data.splines] == [True]
    assert packing(surface, result) == pytest.approx(1.0, abs=0.15)
    seed.location, seed.scale = (0.1, 0.0, 0.0), (1.5, 1.5, 1.5)
    array = seed.modifiers.new("Array", "ARRAY")
    array.use_relative_offset, array.use_constant_offset = False, True
    array.constant_offset_displace = (0.0, 0.0, 2.0)
    found = read(seed)
    assert found.closed.tolist() == [1, 1] and found.offsets.tolist() == [0, 24, 48]
    radii = np.linalg.norm(found.points[:, :2] - [0.1, 0.0], axis=1)
    assert np.allclose(radii, 0.6, atol=1e-6)
    assert {round(z, 4) for z in found.points[:, 2]} == {0.0, 3.0}
    # Neighbours follow one another round the ring, however the vertices are numbered.
    steps = np.linalg.norm(np.diff(found.points[:24], axis=0), axis=1)
    assert np.allclose(steps, 2 * 0.6 * math.sin(math.pi / 24), atol=1e-6)
    seed.hide_viewport = True
    assert np.array_equal(read(seed).points, found.points)


def test_open_chains_of_edges_keep_their_ends_and_lone_vertices_are_left_out():
    surface = grid(20)
    places = [*ROW, (0.0, 0.9, 0.0)]
    surface.meander.seed = edges("Chain", places, [(k, k + 1) for k in range(8)])
    result = fill(surface, 0.2, fixed_ends=True)
    (spline,) = result.data.splines
    assert not spline.use_cyclic_u
    ends = {tuple(np.round(spline.points[k].co[:2], 4)) for k in (0, -1)}
    assert ends == {(-0.8, 0.1), (0.8, 0.1)}


def test_edges_are_followed_when_they_are_moved_in_edit_mode():
    seed = activate(ring())
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    made = bmesh.from_edit_mesh(seed.data)
    for vertex in made.verts:
        vertex.co.z = 0.25
    bmesh.update_edit_mesh(seed.data)
    assert np.allclose(read(seed).points[:, 2], 0.25)
    bpy.ops.object.mode_set(mode="OBJECT")


def test_edges_that_branch_are_no_seed_and_guides():
    places = [(0, 0, 0), (0.9, 0, 0), (-0.9, 0, 0), (0, 0.9, 0)]
    cross = edges("Cross", places, [(0, 1), (0, 2), (0, 3)])
    surface = grid(20)
    assert "branches" in refused(surface, 0.3, seed=cross)
    result = fill(surface, 0.3, seed=None, guides=cross)
    assert result.meander.figures.guides == 3


def test_the_panel_fills_the_mesh_of_a_seed_of_edges_or_strokes():
    surface, chain, strokes = grid(20), ring(), grease_pencil("Sketch", [CIRCLE], True)
    surface.meander.iteration_limit, surface.meander.spacing = 100, 0.3
    for seed in (chain, strokes):
        surface.meander.seed = seed
        activate(seed)
        assert mesh_of_seed(seed, bpy.context.scene) == surface
        assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
        found = bpy.context.view_layer.objects.active
        assert found.type == "CURVE" and found.meander.surface == surface
    # A seed that is selected with its mesh is not filled itself.
    for thing in (surface, chain):
        thing.select_set(True)
    activate(surface)
    chain.select_set(True)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert chain.meander.last_result is None
    assert fillable.why_not_this(chain) == (
        "'Ring' has no faces; choose a mesh with faces as the surface"
    )


@pytest.mark.parametrize("cyclic", (False, True))
def test_strokes_of_grease_pencil_are_a_seed(cyclic: bool):
    surface = grid(20)
    surface.meander.seed = grease_pencil("Sketch", [CIRCLE if cyclic else ROW], cyclic)
    result = fill(surface, 0.2)
    assert [spline.use_cyclic_u for spline in result.data.splines] == [cyclic]
    assert packing(surface, result) == pytest.approx(1.0, abs=0.15)


def test_strokes_are_where_they_are_seen():
    thing = grease_pencil("Sketch", [ROW, [(0, 0, 0)], CIRCLE])
    thing.location = (0.0, 0.0, 1.0)
    (layer,) = thing.data.layers
    setattr(layer, "translation" if NEW_STROKES else "location", (0.0, 0.0, 2.0))
    found = read(thing)
    assert found.offsets.tolist() == [0, 9, 33] and found.closed.tolist() == [0, 0]
    assert np.allclose(found.points[:9], np.add(ROW, (0, 0, 3)), atol=1e-6)
    # A layer with a parent goes with that.
    thing.location = (0.0, 0.0, 0.0)
    read(thing)  # Blender 3.4 takes the object's place from the update before
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    parent.rotation_euler, parent.location = (0.0, 0.0, math.pi / 2), (0.0, 0.0, 5.0)
    layer.parent = parent
    matrix = matrix_of(parent)
    moved = read(thing).points[:9]
    inverse = np.array(layer.matrix_parent_inverse if NEW_STROKES else layer.matrix_inverse)
    wanted = np.add(ROW, (0, 0, 2)) @ (matrix @ inverse)[:3, :3].T + (matrix @ inverse)[:3, 3]
    assert np.allclose(moved, wanted, atol=1e-5)
    thing.hide_viewport = True
    assert np.allclose(read(thing).points[:9], moved, atol=1e-6)
    layer.hide = True
    with pytest.raises(ValueError, match="shows no stroke"):
        read(thing)


def test_modifiers_and_frames_of_strokes_count():
    thing = grease_pencil("Sketch", [ROW])
    if NEW_STROKES:
        more = thing.modifiers.new("More", "GREASE_PENCIL_SUBDIV")
    else:
        more = thing.grease_pencil_modifiers.new("More", "GP_SUBDIV")
    more.subdivision_type, more.level = "SIMPLE", 1
    assert len(read(thing).points) > len(ROW)
    thing.data.layers[0].frames.new(10)  # an empty drawing
    thing.data.update_tag()
    assert len(read(thing).points) > len(ROW)
    bpy.context.scene.frame_set(12)
    with pytest.raises(ValueError, match="no stroke of two or more points at this frame"):
        read(thing)


@pytest.mark.skipif(not NEW_STROKES, reason="all strokes are poly curves before Blender 4.3")
def test_strokes_that_are_curves_are_refused():
    thing = grease_pencil("Sketch", [ROW])
    thing.data.layers[0].frames[0].drawing.set_types(type="BEZIER")
    with pytest.raises(ValueError, match="'Sketch' has strokes that are Bezier or NURBS curves"):
        read(thing)


def test_a_preview_goes_when_its_strokes_are_others():
    surface = grid(20)
    sketch = surface.meander.seed = grease_pencil("Sketch", [CIRCLE], True)
    surface.meander.spacing = 0.3
    seeds.show(surface, bpy.context)
    assert seeds.is_shown(surface)
    (layer,) = sketch.data.layers
    frame = layer.frames[0]
    stroke = (frame.drawing if NEW_STROKES else frame).strokes[0]
    setattr(stroke.points[0], "position" if NEW_STROKES else "co", (0.5, 0.0, 0.0))
    sketch.data.update_tag()
    bpy.context.view_layer.update()
    assert not seeds.is_shown(surface)
    seeds.hide()


def test_strokes_and_edges_are_directions_and_guides_of_a_collection():
    surface = grid(20)
    guides = bpy.data.collections.new("Guides")
    bpy.context.scene.collection.children.link(guides)
    sketch = grease_pencil("Sketch", [[(x, 0.6, 0.0) for x in np.linspace(-0.8, 0.8, 9)]])
    chain = edges("Chain", [(-0.8, -0.6, 0), (0.8, -0.6, 0)], [(0, 1)])
    for thing in (sketch, chain):
        guides.objects.link(thing)
    surface.meander.alignment_source = "STROKES"
    surface.meander.alignment_strokes = chain
    result = fill(surface, 0.2, guide_collection=guides)
    assert result.meander.figures.guides == 2


# What is wrong with a seed, each in one sentence that says what to do.
def nothing():
    return edges("Bare", [], [])


def lone_vertices():
    return edges("Bare", [(0, 0, 0), (1, 0, 0)], [])


def with_faces():
    return mesh_object("Bare", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])


def made_solid():
    thing = ring()
    thing.name = "Bare"
    thing.modifiers.new("Screw", "SCREW")
    return thing


def no_strokes():
    return grease_pencil("Bare", [])


def one_point():
    return grease_pencil("Bare", [[(0, 0, 0)]])


def an_empty():
    thing = bpy.data.objects.new("Bare", None)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def far_away():
    return edges("Bare", [(0, 0, 50), (0.5, 0, 50)], [(0, 1)])


def not_a_number():
    return edges("Bare", [(0, 0, 0), (math.nan, 0, 0), (0.5, 0.5, 0)], [(0, 1), (1, 2)])


def points_in_one_place():
    return edges("Bare", [(0, 0, 0)] * 3, [(0, 1), (1, 2)])


def crossing_strokes():
    return grease_pencil("Bare", [ROW, [(0, y, 0) for y in np.linspace(-0.8, 0.8, 9)]])


def crossing_edges():
    places = [(-0.5, 0, 0), (0.5, 0.01, 0), (0, -0.5, 0), (0.01, 0.5, 0)]
    return edges("Bare", places, [(0, 1), (2, 3)])


@pytest.mark.parametrize(
    ("made", "says"),
    (
        (nothing, "'Bare' has no edges; add some, or choose another seed"),
        (lone_vertices, "'Bare' has no edges; add some, or choose another seed"),
        (with_faces, "'Bare' has faces; choose a curve, a text, Grease Pencil or a mesh of edges"),
        (made_solid, "The modifiers of 'Bare' turn it into a surface"),
        (no_strokes, "'Bare' shows no stroke of two or more points at this frame"),
        (one_point, "'Bare' shows no stroke of two or more points at this frame"),
        (an_empty, "'Bare' is not a curve; choose a curve, a text, Grease Pencil or a mesh"),
        (far_away, "of chain 1 of 'Bare' is"),
        (not_a_number, "of chain 1 of 'Bare' "),
        (points_in_one_place, "'Bare'"),
        (crossing_strokes, "of stroke 1 of 'Bare' and point 5 of stroke 2 of 'Bare'"),
        (crossing_edges, "of chain 2 of 'Bare'"),
    ),
)
def test_what_is_no_seed_is_said(made, says: str):
    thing = made()
    surface = grid(20)
    sentence = refused(surface, 0.3, seed=thing)
    assert says in sentence
