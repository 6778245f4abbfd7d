# SPDX-License-Identifier: GPL-3.0-or-later
"""Every sentence of the table that scenes have comes up: what it is said of is tried here, or in
the test that ELSEWHERE names, which must quote it."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from meander import core
from meander.model.density import Choice
from meander.model.geometry.simplification import Light
from meander.model.preparation import Mask
from meander.model.strands import Part
from meander.scene import (
    attributes,
    curve_reader,
    density,
    image_material,
    layouts,
    look_upgrade,
    preparation,
    seeds,
    strands,
)
from meander.scene import (
    light as light_curve,
)
from meander.scene import (
    preparation as mesh_faults,
)
from meander.scene.alignment import angle_source_of
from meander.scene.density import pixels_of
from meander.scene.errors import DataError
from meander.scene.meshes import triangles_of, vertex_group_weights
from meander.scene.points import strands_of_result
from said_sentences import OF_SCENES, missing
from scenes import cube, fill, grease_pencil, grid, mesh_object, poly_curve, refused
from sentences import assert_sentence

HERE = Path(__file__).parent
# A part of the sentence, the test of this folder that sees it come up, and what it quotes of it. Or
# no test, and why there is none.
ELSEWHERE = {
    "of the add-on is missing; install": ("test_assets.py", "install Meander again"),
    "was deleted while the curve": ("test_other_scenes.py", "was deleted while the curve was"),
    "The add-on's file has no": ("test_assets.py", "install Meander again"),
    "is hidden by its animation": ("test_hidden_data.py", "hidden by its animation at frame"),
    "is hidden, so that Blender": ("test_hidden_data.py", "that Blender does not"),
    "renders otherwise than": ("test_rendered_surface.py", "renders otherwise"),
    "has strokes that are Bezier": ("test_edges_and_strokes.py", "Bezier or NURBS curves"),
    "shows curves only, which": ("test_first_try.py", "shows curves only"),
    "is not a finite number at vertex \0 of": ("test_density_sources.py", "The UV map '"),
    "instances with": ("test_instances.py", "shows 4 instances with 1,280 faces"),
    "shows points only": ("test_instances.py", "shows points only"),
    "shows instances, none of": ("test_instances.py", "none of them of a mesh"),
    "shows instances, which a": ("test_instances.py", "bake the frames"),
    "so that its bridges cannot": ("test_strands.py", "its bridges cannot be taken out"),
    "cannot be read as a picture": ("test_picture.py", "cannot be read as a picture; save it as"),
    "has no camera; add": ("test_camera_drawing.py", "has no camera; add one"),
    "is no camera; make": ("test_camera_drawing.py", "is no camera; make a camera"),
    "is in what this view layer": ("test_made_objects.py", "does not show; show 'Elsewhere'"),
    "takes panoramas": ("test_camera_drawing.py", "takes panoramas, which no page"),
    "shows a collection without meshes": ("test_refusals.py", "shows a collection without"),
    "cannot be turned into a mesh": ("", "no object with faces refuses it; Blender's own words"),
    "cannot be written by scripts before": ("", "Blender 3.4 alone says it, and 4.2 never"),
}


class Said:
    """What calls have said."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def by(self, call: Callable[[], object]) -> None:
        with pytest.raises((DataError, core.MeanderError)) as refusal:
            call()
        self.lines.append(str(refusal.value))

    def filling(self, thing: bpy.types.Object, **settings: object) -> None:
        names = thing.meander.bl_rna.properties.keys()
        before = {name: getattr(thing.meander, name) for name in settings if name in names}
        self.lines.append(refused(thing, **settings))
        for name, value in before.items():
            setattr(thing.meander, name, value)


def depsgraph() -> bpy.types.Depsgraph:
    return bpy.context.evaluated_depsgraph_get()


@pytest.fixture
def said() -> Said:
    return Said()


def of_attributes(said: Said) -> None:
    thing = grid(cells=4)
    said.by(lambda: vertex_group_weights(thing, depsgraph(), "None"))
    thing.vertex_groups.new(name="Other")
    said.by(lambda: vertex_group_weights(thing, depsgraph(), "None"))
    mesh = thing.data
    kind = (attributes.is_number, "attribute of numbers")
    said.by(lambda: attributes.named_attribute(mesh, "None", thing, *kind))
    mesh.attributes.new("Vector", "FLOAT_VECTOR", "POINT")
    said.by(lambda: attributes.named_attribute(mesh, "Vector", thing, *kind))
    mesh.attributes.new("Float", "FLOAT", "POINT").data.foreach_set(
        "value", [float("nan")] * len(mesh.vertices)
    )
    said.by(lambda: attributes.named_attribute(mesh, "None", thing, *kind))
    said.by(lambda: density.density_of(Choice("ATTRIBUTE", "Float"), thing, depsgraph()))
    said.by(lambda: attributes.uv_layer_of(mesh, "None", thing))
    mesh.uv_layers.remove(mesh.uv_layers[0])
    said.by(lambda: attributes.uv_layer_of(mesh, "", thing))
    options = core.SurfaceOptions()
    for mask in (
        Mask("GROUP", ""), Mask("GROUP", "Other", threshold=0.5), Mask("MATERIAL", "None"),
        Mask("ATTRIBUTE", "None"), Mask("ATTRIBUTE", "Float"),
    ):  # fmt: skip
        said.by(partial(preparation.surface_options, options, mask, thing, depsgraph()))
    mesh.materials.append(bpy.data.materials.new("Stone"))
    mesh.attributes.new("Part", "BOOLEAN", "FACE")
    said.by(lambda: preparation.face_mask(Mask("MATERIAL", "None"), thing, depsgraph()))
    said.by(lambda: preparation.face_mask(Mask("ATTRIBUTE", "None"), thing, depsgraph()))
    bare = mesh_object("Bare", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    for name in [known.name for known in bare.data.attributes if known.domain == "FACE"]:
        bare.data.attributes.remove(bare.data.attributes[name])  # Blender 4 makes some by itself
    said.by(lambda: preparation.face_mask(Mask("ATTRIBUTE", "None"), bare, depsgraph()))


def of_densities_and_directions(said: Said) -> None:
    thing = grid(cells=4)
    for source in ("ATTRIBUTE", "COLOR", "IMAGE"):
        said.filling(thing, density_source=source)
    said.filling(thing, density_source="NONE", alignment_source="STROKES")
    said.filling(thing, density_source="NONE", alignment_source="ATTRIBUTE")
    said.filling(
        thing, density_source="NONE", alignment_source="AXIS", alignment_angle="GROUP"
    )
    said.by(lambda: angle_source_of("None", thing, depsgraph()))
    said.by(lambda: pixels_of("None"))
    image = bpy.data.images.new("Map", 4, 4)
    image.source = "MOVIE"
    said.by(lambda: pixels_of("Map"))
    image.source = "FILE"
    image.filepath = "//none.png"
    image.reload()
    said.by(lambda: pixels_of("Map"))


def of_seeds(said: Said) -> None:
    thing = grid(cells=4)
    said.by(lambda: curve_reader.strands_of_curve(thing, depsgraph()))
    empty = bpy.data.objects.new("Empty", bpy.data.curves.new("Empty", "CURVE"))
    bpy.context.scene.collection.objects.link(empty)
    said.by(lambda: curve_reader.strands_of_curve(empty, depsgraph()))
    said.by(lambda: curve_reader.strands_of_curve(mesh_object("Bare", [], []), depsgraph()))
    said.by(lambda: curve_reader.strands_of_curve(grease_pencil("Sketch", []), depsgraph()))
    said.by(lambda: curve_reader.strands_of_curve(bpy.data.objects.new("No", None), depsgraph()))
    solid = poly_curve("Solid", [[(0, 0, 0), (1, 0, 0), (1, 1, 0)]], False)
    solid.modifiers.new("Screw", "SCREW")
    said.by(lambda: curve_reader.strands_of_curve(solid, depsgraph()))
    forked = poly_curve("Forked", [[(0, 0, 0), (1, 0, 0)], [(1, 0, 0), (2, 1, 0)],
                                   [(1, 0, 0), (2, -1, 0)]], False)  # fmt: skip
    forked.modifiers.new("Weld", "WELD")
    said.by(lambda: curve_reader.strands_of_curve(forked, depsgraph()))
    for edge in thing.data.edges:
        edge.select = False
    said.by(lambda: seeds.strands_of_edges(thing, depsgraph(), branches=False))
    for edge in thing.data.edges:
        edge.select = True
    said.by(lambda: seeds.strands_of_edges(thing, depsgraph(), branches=False))
    said.by(lambda: seeds.strands_of_boundary(cube(), depsgraph(), selected=False))
    corners = [(0, 0, 0), (1, 1, 0), (1, -1, 0), (-1, 1, 0), (-1, -1, 0)]
    bow = mesh_object("Bow", corners, [(0, 1, 2), (0, 3, 4)])
    said.by(lambda: seeds.strands_of_boundary(bow, depsgraph(), selected=False))
    said.filling(thing, stroke_from=empty)
    said.filling(thing, guide_collection=bpy.data.collections.new("No Curves"))
    said.filling(thing, use_outline=True, border_distance=0.05)


def of_surfaces(said: Said) -> None:
    points = mesh_object("Points", [(0, 0, 0)], [])
    said.by(lambda: triangles_of(points, depsgraph()))
    said.by(lambda: mesh_faults.locate_faults(points, 0.1))
    thing = cube()
    said.by(lambda: mesh_faults.locate_faults(thing, 0.1))
    for scale in (0.0, float("nan")):
        thing.scale.x = scale
        bpy.context.view_layer.update()
        said.by(lambda: triangles_of(thing, depsgraph()))
    flat = grid(cells=2)
    for corner in flat.data.uv_layers.active.data:
        corner.uv = (0.5, 0.5)
    result = fill(flat, 0.4)
    every = strands_of_result(result, depsgraph())
    said.by(lambda: layouts.unrolled_strands(every, flat, depsgraph(), ""))
    said.by(lambda: layouts.axes_of_view(None))


def of_results(said: Said) -> None:
    light = Light(0.01)
    result = fill(grid(), 0.4)
    result.modifiers.clear()
    spacing, result.meander.spacing = result.meander.spacing, 0.0
    figures, result.meander.figures.least_spacing = result.meander.figures.least_spacing, 0.0
    said.by(lambda: light_curve.make_light(result, light))
    said.by(lambda: look_upgrade.add_look(result, depsgraph()))
    result.meander.spacing, result.meander.figures.least_spacing = spacing, figures
    result.data.splines.new("POLY")
    said.by(lambda: look_upgrade.add_look(result, depsgraph()))
    spline = result.data.splines[-1]
    spline.points.add(1)
    spline.points[1].co = (1.0, 0.0, 0.0, 1.0)
    result.meander.figures.guides = 1
    said.by(lambda: strands.parts_of(result, depsgraph(), False))
    result.data.splines.new("NURBS").points.add(3)
    said.by(lambda: light_curve.make_light(result, light))
    said.by(lambda: look_upgrade.add_look(result, depsgraph()))
    part = Part("Curve", core.Seed(np.eye(3)[:2] + 9.0, [0, 2], [0]), drawn=False)
    said.by(lambda: strands.check_on_surface([part], *triangles_of(grid(), depsgraph()), 0.1))
    said.by(lambda: image_material.map_name(result))
    linked = SimpleNamespace(name="Linked", library="a.blend")
    said.by(lambda: image_material.give(linked, None))
    result.shape_key_add(name="Basis")
    said.by(lambda: light_curve.make_light(result, light))


def test_the_tests_that_are_named_quote_their_sentence():
    for part, (name, quoted) in ELSEWHERE.items():
        if name:
            text = re.sub(r'"\s*\n\s*f?"', "", (HERE / name).read_text(encoding="utf-8"))
            assert quoted in text, (part, name)


def test_every_sentence_of_scenes_comes_up(said):
    for part in (of_attributes, of_densities_and_directions, of_seeds, of_surfaces, of_results):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        part(said)
    found = missing([path for path in OF_SCENES if path.parent.name == "scene"], said.lines,
                    {part: name for part, (name, _quoted) in ELSEWHERE.items()})  # fmt: skip
    assert found == []
    for line in said.lines:
        assert_sentence(line)
