# SPDX-License-Identifier: GPL-3.0-or-later
"""Two scenes of the gallery whose lines have the tones of something: a bust engraved by its baked
light, and a tattoo on an arm by an image."""

from __future__ import annotations

import math

import bpy
import numpy as np
import studio
from gallery_scenes import active, dress, fill, on_a_plinth, place, scene, suzanne

SKIN = (0.70, 0.37, 0.23)
INK = (0.010, 0.018, 0.030)
PAPER = (0.80, 0.72, 0.56)
PRINT = (0.010, 0.028, 0.024)
# Pixels of a side of the tattoo's image; where along the arm it is, and how wide.
_SIDE = 1024
_MIDDLE, _WIDE = 0.0, 0.66
# Petals of a ring, how far they reach, where they begin, and how far the ring is turned.
_RINGS = ((9, 0.98, 0.42, 0.0), (9, 0.68, 0.16, 0.5), (5, 0.36, 0.1, 0.0))


@scene
def engraving() -> None:
    """A bust on paper, in level rows: the line alone shows its form, by the light that is baked to
    its points."""
    figure = on_a_plinth(suzanne(3), -4.0, 64, 0.02)
    dress(figure, (0.8, 0.8, 0.8), 1.0)
    bake_light(figure)
    rows_across(figure, (0.25, -0.45, 1.0))
    settings = figure.meander
    settings.density_source, settings.density_color = "COLOR", "Light"
    settings.density_interpolation = "TONE"
    settings.alignment_source, settings.alignment_attribute = "ATTRIBUTE", "Rows"
    line = fill(
        figure, 0.04, start="FULL", tone_line=0.45, tone_darkest=0.85, tone_lightest=0.16,
        alignment_weight=4.0,
    )
    print_on_paper(figure, line)
    studio.add_camera((2.0, -7.2, 1.3), (0.0, 0.0, 0.68), 78.0)


def bake_light(figure: bpy.types.Object) -> None:
    """Bakes the light of two lamps into a colour of the points, as Render > Bake does."""
    studio.add_light("Lamp", (-6.5, -3.2, 4.2), 1.0, 900.0, (1.0, 1.0, 1.0))
    studio.add_light("Back", (5.0, -1.0, 2.5), 3.0, 130.0, (1.0, 1.0, 1.0))
    figure.data.color_attributes.new("Light", "FLOAT_COLOR", "POINT")
    figure.data.color_attributes.active_color = figure.data.color_attributes["Light"]
    scene_of = bpy.context.scene
    scene_of.render.engine, scene_of.cycles.samples = "CYCLES", 64
    scene_of.render.bake.target = "VERTEX_COLORS"
    bpy.context.view_layer.objects.active = figure
    figure.select_set(True)
    bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "COLOR"})
    for name in ("Lamp", "Back"):
        bpy.data.objects.remove(bpy.data.objects[name])


def rows_across(figure: bpy.types.Object, axis: tuple[float, float, float]) -> None:
    """Directions along which the surface stays at one height over a slanted table."""
    mesh = figure.data
    normals = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("normal", normals)
    rows = np.cross(np.asarray(axis), normals.reshape(-1, 3))
    made = mesh.attributes.new("Rows", "FLOAT_VECTOR", "POINT")
    made.data.foreach_set("vector", rows.astype(np.float32).ravel())


def print_on_paper(figure: bpy.types.Object, line: bpy.types.Object) -> None:
    """Ink and paper that no lamp shades: all form is in the line."""
    world = bpy.data.worlds.new("Paper")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (*PAPER, 1.0)
    bpy.context.scene.world = world
    for thing, colour in ((figure, PAPER), (line, PRINT)):
        dress(thing, (0.0, 0.0, 0.0), 1.0)
        shader = thing.active_material.node_tree.nodes["Principled BSDF"]
        shader.inputs["Specular"].default_value = 0.0
        shader.inputs["Emission"].default_value = (*colour, 1.0)


@scene
def tattoo() -> None:
    """A flower on a forearm: only the part of the arm that the image covers is drawn."""
    limb = arm()
    lay_out(limb)
    settings = limb.meander
    settings.density_source, settings.density_image = "IMAGE", flower()
    settings.density_interpolation, settings.density_uv_map = "TONE", "Tattoo"
    settings.mask_source, settings.mask_group = "GROUP", "Tattoo"
    line = fill(
        limb, 0.0072, start="FULL", tone_kind="VALUE", tone_line=0.55, tone_darkest=0.9,
        tone_lightest=0.2, alignment_source="ATTRIBUTE", alignment_attribute="Rows",
    )
    dress(limb, SKIN, 0.5)
    dress(line, INK, 0.7)
    eye, target = (_MIDDLE + 1.0, -6.0, 1.1), (_MIDDLE + 0.06, 0.0, 0.01)
    place(limb, line, camera=eye, target=target, lens=205.0)


def arm() -> bpy.types.Object:
    """An upper arm, an elbow, a forearm and a fist, along x: a skin round a few points."""
    points = [
        (-1.3, 0.12, -0.05, 0.30), (-0.75, 0.03, -0.05, 0.31), (-0.35, 0.0, 0.0, 0.33),
        (0.1, 0.0, 0.03, 0.30), (0.6, 0.0, 0.05, 0.21), (0.85, 0.0, 0.06, 0.19),
        (1.2, 0.0, 0.07, 0.26), (1.5, 0.0, 0.06, 0.24),
    ]  # fmt: skip
    data = bpy.data.meshes.new("Arm")
    edges = [(k, k + 1) for k in range(len(points) - 1)]
    data.from_pydata([point[:3] for point in points], edges, [])
    thing = bpy.data.objects.new("Arm", data)
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    thing.modifiers.new("Skin", "SKIN")
    for vertex, point in zip(data.skin_vertices[0].data, points):
        vertex.radius = (0.85 * point[3], point[3])
    smooth = thing.modifiers.new("Subdivision", "SUBSURF")
    smooth.levels = smooth.render_levels = 3
    remesh = thing.modifiers.new("Remesh", "REMESH")
    remesh.mode, remesh.voxel_size, remesh.use_smooth_shade = "VOXEL", 0.005, True
    softer = thing.modifiers.new("Smooth", "SMOOTH")
    softer.iterations = 40
    bpy.ops.object.convert(target="MESH")
    return active()


def lay_out(limb: bpy.types.Object) -> None:
    """A UV map that wraps the image round the front of the forearm, and the group of what it
    covers; rows lead out from its middle."""
    mesh = limb.data
    places = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", places)
    x, y, z = places.reshape(-1, 3).T
    u = 0.5 + (x - _MIDDLE) / _WIDE
    v = 0.5 + np.arctan2(z - 0.03, -y) * 0.32 / _WIDE
    out = np.column_stack([u - 0.5, np.zeros_like(u), v - 0.5])
    rows = mesh.attributes.new("Rows", "FLOAT_VECTOR", "POINT")
    rows.data.foreach_set("vector", out.astype(np.float32).ravel())
    uv = mesh.uv_layers.new(name="Tattoo")
    corners = np.empty(len(mesh.loops), dtype=np.int64)
    mesh.loops.foreach_get("vertex_index", corners)
    uv.data.foreach_set("uv", np.column_stack([u, v])[corners].ravel())
    group = limb.vertex_groups.new(name="Tattoo")
    group.add(np.flatnonzero(petals(u - 0.5, v - 0.5) < 1.0).tolist(), 1.0, "REPLACE")


def petals(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The brightness of a flower of rings of petals, dark at their roots, at places from -.5 to .5;
    1 beside it."""
    far, turn = 2.0 * np.hypot(x, y), np.arctan2(y, x)
    bright = np.ones_like(far)
    for count, reach, root, shift in _RINGS:
        across = np.abs((turn / (2.0 * math.pi) * count + shift) % 1.0 - 0.5) * 2.0
        rim = reach * (1.0 - 0.3 * across**2.5)
        shade = ((far - root) / (rim - root)).clip(0.0, 1.0) * (1.0 - across**4)
        bright = np.where(far < rim, 0.02 + 0.78 * shade**1.3, bright)
    return np.where(far < 0.14, 0.05, bright)


def flower() -> bpy.types.Image:
    """The same as an image."""
    place_of = (np.arange(_SIDE) + 0.5) / _SIDE - 0.5
    bright = petals(*np.meshgrid(place_of, place_of))
    image = bpy.data.images.new("Flower", _SIDE, _SIDE, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    pixels = np.dstack([bright, bright, bright, np.ones_like(bright)])
    image.pixels.foreach_set(pixels.astype(np.float32).ravel())
    return image
