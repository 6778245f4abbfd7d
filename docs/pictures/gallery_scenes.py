# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes of the gallery: what an artist would click, as a script, a function for each picture.

Every function begins with an empty scene and leaves it ready for the camera.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import studio
from meander import core
from meander.scene import curve_writer
from meander.scene.look import modifier_of, ramp_node_of, set_value

DARK = (0.012, 0.016, 0.028)
PALE = (0.78, 0.76, 0.72)
GOLD = (0.83, 0.46, 0.13)
ORANGE = (1.0, 0.20, 0.035)
TEAL = (0.02, 0.36, 0.38)

SCENES: dict[str, Callable[[], None]] = {}


def scene(make: Callable[[], None]) -> Callable[[], None]:
    """Enters a function into the gallery under its name."""
    SCENES[make.__name__] = make
    return make


def active() -> bpy.types.Object:
    """What has just been added, shaded smooth."""
    thing = bpy.context.object
    for polygon in thing.data.polygons:
        polygon.use_smooth = True
    return thing


def subdivided(thing: bpy.types.Object, levels: int) -> bpy.types.Object:
    """The object with a subdivision surface."""
    modifier = thing.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = levels
    return thing


def suzanne(levels: int = 2) -> bpy.types.Object:
    """Suzanne, leaning back on her chin and the back of her head."""
    bpy.ops.mesh.primitive_monkey_add(size=2.0, rotation=(math.radians(-30.0), 0.0, 0.0))
    return subdivided(active(), levels)


def fill(thing: bpy.types.Object, spacing: float, **settings: Any) -> bpy.types.Object:
    """Presses Fill with Curve on an object: the result."""
    thing.meander.spacing = spacing
    for name, value in settings.items():
        setattr(thing.meander, name, value)
    bpy.ops.object.select_all(action="DESELECT")
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    bpy.ops.meander.run()
    return thing.meander.last_result


def dress(thing: bpy.types.Object, colour: studio.Colour, roughness: float) -> None:
    """Gives an object one material."""
    thing.data.materials.clear()
    thing.data.materials.append(studio.material(thing.name, colour, roughness))


def place(
    *things: bpy.types.Object,
    camera: tuple[float, float, float] = (2.5, -6.2, 3.6),
    target: tuple[float, float, float] = (0.03, -0.05, -0.08),
    lens: float = 88.0,
    strength: float = 1.0,
) -> None:
    """Puts what is shown on a floor, with lights and a camera."""
    studio.add_lights(strength)
    studio.add_floor(studio.lowest_point(things))
    studio.add_camera(camera, target, lens)


@scene
def filigree() -> None:
    """The curve alone, as if bent from gold wire."""
    head = suzanne()
    wire = fill(head, 0.11, bevel_share=0.26)
    dress(wire, GOLD, 0.25)
    wire.active_material.node_tree.nodes["Principled BSDF"].inputs["Metallic"].default_value = 1.0
    place(wire)
    head.hide_render = True


@scene
def painted() -> None:
    """A vertex group that is 1 at the top makes the strands four times as close there."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)
    ball = active()
    group = ball.vertex_groups.new(name="Fine")
    for vertex in ball.data.vertices:
        group.add([vertex.index], max(0.0, 0.5 + 0.6 * vertex.co.z), "REPLACE")
    line = fill(ball, 0.12, density_group="Fine", factor_0=1.0, factor_1=0.25)
    dress(ball, DARK, 0.4)
    dress(line, ORANGE, 0.4)
    place(ball, line, lens=78.0)


@scene
def rows() -> None:
    """Strands that follow the long way round of a torus."""
    bpy.ops.mesh.primitive_torus_add(
        major_segments=96, minor_segments=32, major_radius=1.0, minor_radius=0.42
    )
    ring = active()
    line = fill(ring, 0.09, alignment_source="CURVATURE", alignment_weight=4.0)
    dress(ring, PALE, 0.5)
    dress(line, TEAL, 0.4)
    place(ring, line, lens=85.0)


@scene
def symmetry() -> None:
    """One half of Suzanne is filled; the other is its mirror image, and both are one line."""
    head = suzanne(3)
    head.rotation_euler.x = 0.0
    line = fill(head, 0.1, mirror="X", bevel_share=0.24)
    dress(head, DARK, 0.4)
    dress(line, ORANGE, 0.4)
    place(head, line, camera=(0.0, -7.0, 0.9), target=(0.0, 0.0, -0.05), lens=88.0)


@scene
def one_stroke() -> None:
    """One stroke from ear to ear: an open strand whose ends stay where they are."""
    head = suzanne()
    mesh = head.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    for setting, side in (("stroke_from", max), ("stroke_to", min)):
        tip = side(mesh.vertices, key=lambda vertex: vertex.co.x)
        end = bpy.data.objects.new(setting, None)
        end.location = head.matrix_world @ tip.co
        bpy.context.scene.collection.objects.link(end)
        setattr(head.meander, setting, end)
    line = fill(head, 0.075)
    dress(head, PALE, 0.6)
    dress(line, DARK, 0.5)
    place(head, line)


@scene
def flowing() -> None:
    """The same head grown, and from a start that fills it already."""
    shown = []
    for side, start, colour in ((-1, "GROW", ORANGE), (1, "FULL", TEAL)):
        head = suzanne()
        head.location.x = 1.4 * side
        bpy.context.view_layer.update()
        line = fill(head, 0.09, start=start)
        dress(head, PALE, 0.6)
        dress(line, colour, 0.4)
        shown += [head, line]
    place(*shown, camera=(0.4, -6.8, 3.2), target=(0.1, 0.0, -0.1), lens=47.0)


def on_a_plinth(
    head: bpy.types.Object, lean: float, sides: int, voxel: float
) -> bpy.types.Object:
    """A bust: a head that leans back by so many degrees, a neck and shoulders, as one surface."""
    head.rotation_euler = (math.radians(lean), 0.0, 0.0)
    head.location.z = 1.1
    bpy.ops.mesh.primitive_cylinder_add(
        vertices=sides, radius=0.48, depth=1.4, location=(0, 0.2, 0.2)
    )
    neck = active()
    bpy.ops.mesh.primitive_uv_sphere_add(
        segments=sides, ring_count=sides // 2, location=(0, 0.2, -0.35)
    )
    shoulders = active()
    shoulders.scale = (1.35, 0.62, 0.42)
    return carved("Bust", [head, neck, shoulders], voxel)


@scene
def bust() -> None:
    """Rows that follow strokes: round neck and shoulders, and down the face."""
    figure = on_a_plinth(suzanne(), -12.0, 48, 0.035)

    rings = [
        [(radius * math.cos(t), 0.2 + depth * math.sin(t), height) for t in _ROUND]
        for radius, depth, height in ((0.48, 0.48, 0.25), (1.1, 0.5, -0.1), (1.35, 0.62, -0.45))
    ]
    lines = [[(x, y, z / 10) for z in range(4, 20)] for x, y in ((-0.4, -2), (0.4, -2), (0.0, 2))]
    figure.meander.alignment_strokes = strokes_on(figure, rings + lines)
    line = fill(figure, 0.075, alignment_source="STROKES", alignment_weight=4.0)
    dress(figure, PALE, 0.6)
    dress(line, DARK, 0.45)
    place(figure, line, camera=(2.6, -7.0, 2.6), target=(0.0, 0.0, 0.62), lens=66.0)


# Angles of a ring.
_ROUND = [2.0 * math.pi * k / 40 for k in range(41)]


def carved(name: str, parts: list[bpy.types.Object], voxel: float) -> bpy.types.Object:
    """One surface round all parts, which go."""
    bpy.ops.object.select_all(action="DESELECT")
    for part in parts:
        part.select_set(True)
    bpy.context.view_layer.objects.active = parts[0]
    bpy.ops.object.convert(target="MESH")
    bpy.ops.object.join()
    figure = active()
    bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
    figure.name = name
    remesh = figure.modifiers.new("Remesh", "REMESH")
    remesh.mode, remesh.voxel_size, remesh.use_smooth_shade = "VOXEL", voxel, True
    smooth = figure.modifiers.new("Smooth", "SMOOTH")
    smooth.iterations = 12
    bpy.ops.object.convert(target="MESH")
    return figure


def strokes_on(
    thing: bpy.types.Object, lines: list[list[tuple[float, float, float]]]
) -> bpy.types.Object:
    """A curve object of lines, each point where the surface is nearest to it."""
    data = bpy.data.curves.new("Strokes", "CURVE")
    data.dimensions = "3D"
    for line in lines:
        spline = data.splines.new("POLY")
        spline.points.add(len(line) - 1)
        for point, place_of in zip(spline.points, line):
            point.co = (*thing.closest_point_on_mesh(place_of)[1], 1.0)
    strokes = bpy.data.objects.new("Strokes", data)
    bpy.context.scene.collection.objects.link(strokes)
    strokes.hide_render = True
    return strokes


@scene
def concentric() -> None:
    """A plate with holes: strands parallel to its borders."""
    corners = [(-1.2, -0.9), (1.2, -0.9), (1.2, 0.9), (-1.2, 0.9)]
    holes = [ring((-0.55, -0.2), 0.36), ring((0.55, 0.15), 0.45)]
    plate = sheet("Plate", corners, 0.0, holes)
    studio.divide(plate.data, 0.08)
    line = fill(plate, 0.07, alignment_source="BOUNDARY", alignment_weight=3.0)
    dress(plate, DARK, 0.5)
    dress(line, GOLD, 0.35)
    place(plate, line, camera=(0.0, -4.4, 5.2), target=(0.0, 0.0, 0.0), lens=78.0)


@scene
def leaf() -> None:
    """A leaf, with strands along its rim and the vein."""
    half = [(math.sin(t) * 0.62 * math.sin(t) ** 0.5, 1.3 * math.cos(t)) for t in _UP]
    piece = sheet("Leaf", half + [(-x, y) for x, y in reversed(half[1:-1])], 0.02)
    studio.divide(piece.data, 0.07)
    for vertex in piece.data.vertices:
        vertex.co.z += 0.25 * abs(vertex.co.x) + 0.1 * math.cos(1.6 * vertex.co.y)
    line = fill(piece, 0.06, alignment_source="BOUNDARY", alignment_weight=3.0)
    dress(piece, (0.05, 0.20, 0.06), 0.5)
    dress(line, (0.75, 0.85, 0.35), 0.4)
    place(piece, line, camera=(1.0, -3.6, 4.6), target=(0.0, -0.05, 0.05), lens=66.0)


# Angles from the tip of the leaf to its stalk.
_UP = [math.pi * k / 40 for k in range(41)]


def ring(middle: tuple[float, float], radius: float) -> list[tuple[float, float]]:
    """A circle as a polygon."""
    turns = (2.0 * math.pi * k / 48 for k in range(48))
    return [(middle[0] + radius * math.cos(t), middle[1] + radius * math.sin(t)) for t in turns]


def sheet(
    name: str,
    outline: list[tuple[float, float]],
    height: float,
    holes: list[list[tuple[float, float]]] | None = None,
) -> bpy.types.Object:
    """A flat piece with an outline, and holes, at a height."""
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions, data.fill_mode = "2D", "BOTH"
    for loop in (outline, *(holes or ())):
        spline = data.splines.new("POLY")
        spline.points.add(len(loop) - 1)
        spline.use_cyclic_u = True
        for point, (x, y) in zip(spline.points, loop):
            point.co = (x, y, 0.0, 1.0)
    curve = bpy.data.objects.new(name, data)
    mesh = bpy.data.meshes.new_from_object(curve)
    bpy.data.objects.remove(curve)
    thing = bpy.data.objects.new(name, mesh)
    thing.location.z = height
    bpy.context.scene.collection.objects.link(thing)
    return thing


def heart() -> list[tuple[float, float]]:
    """The outline of a heart, about 2 wide."""
    turns = [2.0 * math.pi * i / 120 for i in range(120)]
    return [
        (
            math.sin(t) ** 3,
            (13 * math.cos(t) - 5 * math.cos(2 * t) - 2 * math.cos(3 * t) - math.cos(4 * t)) / 16,
        )
        for t in turns
    ]


@scene
def embroidery() -> None:
    """A heart of one thread on linen, in rows like satin stitch."""
    piece = sheet("Heart", heart(), 0.01)
    thread = fill(
        piece, 0.045, bevel_share=0.42, alignment_source="AXIS", alignment_axis="X",
        alignment_weight=2.0, border_distance=0.4,
    )
    dress(piece, (0.35, 0.02, 0.03), 0.9)
    dress(thread, (0.62, 0.03, 0.05), 0.45)
    studio.add_lights()
    studio.add_floor(0.0, (0.62, 0.58, 0.50))
    studio.add_camera((0.0, -3.2, 4.6), (0.0, -0.02, 0.0), 72.0)


@scene
def one_line_print() -> None:
    """Layers of a printed star, each one line from a nozzle that never lifts."""
    spikes = [
        (r * math.cos(a), r * math.sin(a))
        for i in range(5)
        for r, a in (
            (1.25, math.radians(90 + 72 * i)),
            (0.62, math.radians(126 + 72 * i)),
        )
    ]
    colours = ((0.02, 0.25, 0.45), (0.03, 0.36, 0.60), (0.05, 0.48, 0.75))
    for layer, colour in enumerate(colours):
        share = 1.0 - 0.24 * layer
        piece = sheet("Star", [(share * x, share * y) for x, y in spikes], 0.05 + 0.1 * layer)
        line = fill(piece, 0.11, bevel_share=0.5)
        dress(line, colour, 0.35)
        piece.hide_render = True
    studio.add_lights()
    studio.add_floor(0.0, (0.05, 0.05, 0.06))
    studio.add_camera((0.0, -4.6, 4.2), (0.0, 0.05, 0.0), 80.0)


def make_of(line: bpy.types.Object, what: str, **settings: Any) -> bpy.types.Object:
    """Presses a button of the panel Make on a result: the new object."""
    bpy.context.view_layer.objects.active = line
    getattr(bpy.ops.meander, what)(**settings)
    return bpy.context.object


@scene
def two_tone() -> None:
    """The head of Suzanne parted in two by one closed line, and each eye by its own."""
    shell = make_of(fill(suzanne(), 0.11), "two_tone")
    place(shell)


@scene
def inlay() -> None:
    """A ring whose material is made of images alone: there is no curve in the picture."""
    bpy.ops.mesh.primitive_torus_add(
        major_segments=96, minor_segments=40, major_radius=1.3, minor_radius=0.62
    )
    ring = active()
    ring.data.polygons.foreach_set("use_smooth", [True] * len(ring.data.polygons))
    line = fill(ring, 0.14)
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "ring.png")
        bpy.ops.meander.maps(filepath=path, kinds={"MASK", "NORMAL"}, line_width=0.32, depth=0.12)
        images = {kind: image_of(f"{folder}/ring_{kind}.png") for kind in ("mask", "normal")}
    bpy.data.objects.remove(line)
    ring.data.materials.append(inlaid(images))
    place(ring, lens=60.0)


@scene
def glaze() -> None:
    """A vase glazed with the colours of the line and its ridges, all of it images."""
    outline = ((0.0, 0.0), (0.55, 0.0), (0.86, 0.5), (0.95, 0.9), (0.72, 1.5), (0.36, 1.9),
               (0.30, 2.1), (0.44, 2.35))  # fmt: skip
    vase = turned(outline, 96)
    line = fill(vase, 0.13)
    ramp = ramp_node_of(line.active_material).color_ramp
    for element, colour in zip(ramp.elements, ((0.01, 0.08, 0.16), (0.02, 0.42, 0.38), PALE)):
        element.color = (*colour, 1.0)
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "vase.exr")
        bpy.ops.meander.maps(filepath=path, kinds={"COLOR", "NORMAL"}, depth=0.2)
        images = {kind: image_of(f"{folder}/vase_{kind}.exr") for kind in ("color", "normal")}
    bpy.data.objects.remove(line)
    vase.data.materials.append(glazed(images))
    place(vase, camera=(2.4, -6.4, 3.6), target=(0.0, 0.0, 1.12), lens=76.0)


def turned(outline: tuple[tuple[float, float], ...], around: int) -> bpy.types.Object:
    """A vase from its outline, radius and height, with a UV map that goes round it."""
    data = bpy.data.curves.new("Vase", "CURVE")
    spline = data.splines.new("NURBS")
    spline.points.add(len(outline) - 1)
    for point, (radius, height) in zip(spline.points, outline):
        point.co = (radius, 0.0, height, 1.0)
    spline.use_endpoint_u, spline.order_u, spline.resolution_u = True, 4, 10
    half = bpy.data.objects.new("Vase", data)
    profile = [vertex.co.copy() for vertex in half.to_mesh().vertices]
    bpy.data.objects.remove(half)
    rows = len(profile)
    points, faces, places = [], [], []
    for step in range(around):
        turn = 2.0 * math.pi * step / around
        points += [(p.x * math.cos(turn), p.x * math.sin(turn), p.z) for p in profile[1:]]
    bottom = len(points)
    points.append((0.0, 0.0, profile[0].z))
    for step in range(around):
        here, there = step * (rows - 1), (step + 1) % around * (rows - 1)
        u, v = step / around, (step + 1) / around
        faces.append((bottom, there, here))
        places += [(u, 0.0), (v, 1.0 / rows), (u, 1.0 / rows)]
        for row in range(rows - 2):
            low, high = (row + 1) / rows, (row + 2) / rows
            faces.append((here + row, there + row, there + row + 1, here + row + 1))
            places += [(u, low), (v, low), (v, high), (u, high)]
    mesh = bpy.data.meshes.new("Vase")
    mesh.from_pydata(points, [], faces)
    layer = mesh.uv_layers.new(name="Round")
    for corner, uv in zip(layer.data, places):
        corner.uv = uv
    thing = bpy.data.objects.new("Vase", mesh)
    bpy.context.scene.collection.objects.link(thing)
    for polygon in mesh.polygons:
        polygon.use_smooth = True
    return thing


def glazed(images: dict[str, bpy.types.Image]) -> bpy.types.Material:
    """The colours of the line under a glaze that lies on its ridges."""
    made = studio.material("Glaze", PALE, 0.12)
    nodes, links = made.node_tree.nodes, made.node_tree.links
    shader = nodes["Principled BSDF"]
    colour, normal = (nodes.new("ShaderNodeTexImage") for _ in range(2))
    colour.image, normal.image = images["color"], images["normal"]
    bump = nodes.new("ShaderNodeNormalMap")
    links.new(colour.outputs["Color"], shader.inputs["Base Color"])
    links.new(normal.outputs["Color"], bump.inputs["Color"])
    links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    return made


def image_of(path: str) -> bpy.types.Image:
    """A file as numbers and not as colours, held in the scene."""
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    image.pack()
    return image


def inlaid(images: dict[str, bpy.types.Image]) -> bpy.types.Material:
    """Brass where the mask is white, polished dark wood between, which bulges by the normals."""
    made = studio.material("Inlay", (0.035, 0.012, 0.006), 0.35)
    nodes, links = made.node_tree.nodes, made.node_tree.links
    shader = nodes["Principled BSDF"]
    textures = {}
    for kind, image in images.items():
        textures[kind] = nodes.new("ShaderNodeTexImage")
        textures[kind].image = image
    mix = nodes.new("ShaderNodeMixRGB")
    mix.inputs["Color1"].default_value = shader.inputs["Base Color"].default_value
    mix.inputs["Color2"].default_value = (0.85, 0.52, 0.16, 1.0)
    bump = nodes.new("ShaderNodeNormalMap")
    links.new(textures["mask"].outputs["Color"], mix.inputs["Fac"])
    links.new(mix.outputs["Color"], shader.inputs["Base Color"])
    links.new(textures["mask"].outputs["Color"], shader.inputs["Metallic"])
    links.new(textures["normal"].outputs["Color"], bump.inputs["Color"])
    links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    return made


@scene
def brain_coral() -> None:
    """The same line as the furrow of a relief."""
    coral = make_of(fill(suzanne(), 0.13), "relief")
    place(coral)


@scene
def maze() -> None:
    """A round board with the line as walls, two doors, and a ball on its way."""
    board = sheet("Board", ring((0.0, 0.0), 1.35), 0.0)
    line = fill(board, 0.15, border_distance=0.4)
    walls = make_of(line, "maze", height=0.75, solution=True)
    dress(board, (0.52, 0.30, 0.13), 0.55)
    dress(walls, (0.16, 0.055, 0.018), 0.4)
    way = bpy.data.objects[f"{walls.name} Solution"]
    dress(way, ORANGE, 0.4)
    points = way.data.splines[0].points
    bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, radius=0.052)
    ball = active()
    ball.location = (*points[0].co[:2], 0.052)
    dress(ball, (0.8, 0.8, 0.82), 0.08)
    ball.active_material.node_tree.nodes["Principled BSDF"].inputs["Metallic"].default_value = 1.0
    studio.add_lights()
    studio.add_floor(-0.03, (0.30, 0.32, 0.30))
    studio.add_camera((0.0, -3.6, 4.4), (0.0, -0.04, 0.0), 70.0)


@scene
def running_lights() -> None:
    """Comets of light on a ribbon that lies along the line."""
    bpy.ops.mesh.primitive_torus_add(
        major_segments=96, minor_segments=32, major_radius=1.0, minor_radius=0.42
    )
    band = make_of(fill(active(), 0.11), "ribbon")
    place(band, lens=85.0, strength=0.25)


def striped(thing: bpy.types.Object, colour: studio.Colour, every: float) -> None:
    """Rings of another colour along the line, one for each length `every`."""
    nodes = thing.active_material.node_tree.nodes
    links = thing.active_material.node_tree.links
    along = nodes.new("ShaderNodeAttribute")
    along.attribute_name = "arc_length"
    fraction = nodes.new("ShaderNodeMath")
    fraction.operation = "WRAP"
    fraction.inputs[1].default_value, fraction.inputs[2].default_value = every, 0.0
    ring = nodes.new("ShaderNodeMath")
    ring.operation = "LESS_THAN"
    ring.inputs[1].default_value = every / 2.0
    mix = nodes.new("ShaderNodeMixRGB")
    shader = nodes["Principled BSDF"]
    mix.inputs["Color1"].default_value = shader.inputs["Base Color"].default_value
    mix.inputs["Color2"].default_value = (*colour, 1.0)
    links.new(along.outputs["Fac"], fraction.inputs[0])
    links.new(fraction.outputs[0], ring.inputs[0])
    links.new(ring.outputs[0], mix.inputs["Fac"])
    links.new(mix.outputs["Color"], shader.inputs["Base Color"])


@scene
def cable() -> None:
    """One cable with rings, wound over the whole of a ring of three lobes."""
    bpy.ops.mesh.primitive_torus_add(
        major_segments=96, minor_segments=32, major_radius=1.0, minor_radius=0.5
    )
    ring = active()
    for vertex in ring.data.vertices:  # three lobes
        turn = math.atan2(vertex.co.y, vertex.co.x)
        vertex.co *= 1.0 + 0.22 * math.cos(3.0 * turn)
    line = fill(ring, 0.17, bevel_share=0.34)
    dress(ring, DARK, 0.5)
    dress(line, (0.85, 0.55, 0.02), 0.35)
    striped(line, (0.02, 0.02, 0.02), 0.4)
    place(ring, line, lens=62.0)


@scene
def plugs() -> None:
    """A cable coiled over a reel, with a plug on both of its ends."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)
    reel = active()
    reel.scale.z = 0.62
    for setting, x in (("stroke_from", -0.34), ("stroke_to", 0.34)):
        end = bpy.data.objects.new(setting, None)
        end.location = (x, -0.62, 0.42)
        bpy.context.scene.collection.objects.link(end)
        setattr(reel.meander, setting, end)
    line = fill(reel, 0.2, bevel_share=0.34, preset="EVEN")
    modifier = modifier_of(line)
    set_value(modifier, "Lift", 1.0)
    set_value(modifier, "Resolution", 16)
    line.meander.shown_ends = "PLUG"
    dress(reel, (0.35, 0.36, 0.38), 0.5)
    dress(line, (0.85, 0.24, 0.02), 0.4)
    place(reel, line, camera=(0.6, -6.2, 4.2), target=(0.0, -0.05, -0.02), lens=86.0)


@scene
def yarn() -> None:
    """A ball of yarn, from one line, of three plies with loose fibres."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)
    ball = active()
    line = fill(ball, 0.2, profile="ROPE", bevel_share=0.45)
    modifier = modifier_of(line)
    for name, value in (("Lift", 0.6), ("Twist", 1.8), ("Fuzz", 0.7), ("Resolution", 12)):
        set_value(modifier, name, value)
    dress(ball, (0.20, 0.02, 0.03), 0.9)
    dress(line, (0.55, 0.06, 0.07), 0.9)
    place(ball, line, lens=80.0)


@scene
def neon() -> None:
    """A heart of one neon tube, with its sleeves and wires."""
    piece = sheet("Heart", heart(), 0.01)
    for setting, x in (("stroke_from", -0.12), ("stroke_to", 0.12)):
        end = bpy.data.objects.new(setting, None)
        end.location = (x, 0.3, 0.01)
        bpy.context.scene.collection.objects.link(end)
        setattr(piece.meander, setting, end)
    tube = fill(piece, 0.2, bevel_share=0.13, border_distance=0.5)
    modifier = modifier_of(tube)
    set_value(modifier, "Lift", 2.5)
    set_value(modifier, "Resolution", 16)
    tube.meander.shown_ends = "NEON"
    dress(piece, (0.02, 0.022, 0.03), 0.6)
    dress(tube, (1.0, 0.25, 0.35), 0.3)
    shader = tube.active_material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Emission"].default_value = (1.0, 0.06, 0.16, 1.0)
    shader.inputs["Emission Strength"].default_value = 6.0
    studio.add_lights(0.25)
    studio.add_floor(0.0, (0.05, 0.05, 0.06))
    studio.add_camera((0.6, -3.2, 4.4), (0.0, 0.02, 0.0), 72.0)


@scene
def growth() -> None:
    """How a line grew: one object, whose modifier is at three places of its factor."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)
    ball = active()
    line = fill(ball, 0.17, bevel_share=0.28)
    bpy.ops.meander.animate_growth(frames=96)
    (grown,) = line.meander.bake.objects
    grown.animation_data_clear()
    shown = []
    for number, factor in enumerate((0.2, 0.5, 1.0)):
        surface, stage = ball.copy(), grown.copy()
        bpy.context.scene.collection.objects.link(surface)
        bpy.context.scene.collection.objects.link(stage)
        surface.location.x = 2.3 * (number - 1)
        surface.rotation_euler = (0.6, 0.0, 2.8)  # towards who looks, where it began
        stage.parent = surface
        set_value(stage.modifiers["Growth"], "Factor", factor)
        shown += [surface, stage]
    dress(ball, PALE, 0.6)
    dress(grown, TEAL, 0.4)
    for stage in shown[1::2]:
        set_value(modifier_of(stage), "Material", grown.active_material)
    ball.hide_render = grown.hide_render = True
    place(*shown, camera=(1.0, -10.5, 4.6), target=(0.0, 0.0, -0.2), lens=60.0)


@scene
def moving_character() -> None:
    """A limb in three poses; the line flows on, and keeps its spacing where the skin stretches."""
    around, along, spacing = 48, 64, 0.16
    grid = np.array(
        [
            (math.cos(2 * math.pi * i / around), math.sin(2 * math.pi * i / around), j / along)
            for j in range(along + 1) for i in range(around)
        ]
    )
    faces = [
        [j * around + i, j * around + (i + 1) % around, (j + 1) * around + (i + 1) % around,
         (j + 1) * around + i]
        for j in range(along) for i in range(around)
    ]
    triangles = np.array([[a, b, c] for a, b, c, _ in faces] + [[a, c, d] for a, _, c, d in faces])
    options = core.default_options()
    options.radius = spacing / 2.0
    with core.Surface(limb(grid, 0.0), triangles.astype(np.uint32)) as surface:
        flow = core.Flow(surface, options)
    flow.run()
    shown = []
    for frame in range(49):
        pose = limb(grid, frame / 48.0)
        if frame:
            flow.set_vertices(pose)
            for _ in range(3):
                flow.step()
        if frame % 24 == 0:
            shown += posed(pose, faces, flow.polylines(), 2.1 * (frame / 24 - 1.0), spacing)
    place(*shown, camera=(0.7, -9.0, 6.0), target=(0.75, 0.0, 1.05), lens=45.0)


def limb(grid: np.ndarray, bend: float) -> np.ndarray:
    """A tapered limb of length 2.4; at 1 it is bent by a quarter turn and half as long again."""
    height = grid[:, 2] * 2.4 * (1.0 + 0.5 * bend)
    radius = 0.5 - 0.26 * grid[:, 2]
    x, y = radius * grid[:, 0], radius * grid[:, 1]
    if bend == 0.0:
        return np.column_stack([x, y, height])
    centre = 2.4 * (1.0 + 0.5 * bend) / (0.5 * math.pi * bend)
    turn = height / centre
    return np.column_stack(
        [centre - (centre - x) * np.cos(turn), y, (centre - x) * np.sin(turn)]
    )


def posed(
    vertices: np.ndarray, faces: list[list[int]], polylines: core.Polylines, x: float,
    spacing: float,
) -> list[bpy.types.Object]:
    """A limb and its line at a place."""
    mesh = bpy.data.meshes.new("Limb")
    mesh.from_pydata(vertices.tolist(), [], faces)
    thing = bpy.data.objects.new("Limb", mesh)
    thing.location.x = x
    bpy.context.scene.collection.objects.link(thing)
    for polygon in mesh.polygons:
        polygon.use_smooth = True
    bpy.context.view_layer.update()
    moved = polylines._replace(positions=polylines.positions + [x, 0.0, 0.0])
    line = curve_writer.write_curve(moved, thing, "Line", bevel_depth=0.24 * spacing)
    dress(thing, PALE, 0.5)
    dress(line, ORANGE, 0.4)
    return [thing, line]


@scene
def letters() -> None:
    """A word that is one line: short bridges lead from letter to letter."""
    data = bpy.data.curves.new("Word", "FONT")
    data.body = "one"
    data.align_x, data.align_y = "CENTER", "CENTER"
    data.size = 2.0
    data.resolution_u = 8
    word = bpy.data.objects.new("Word", data)
    word.location.z = 0.05
    bpy.context.scene.collection.objects.link(word)
    line = fill(word, 0.06, bevel_share=0.3, bridge_parts=True)
    dress(line, TEAL, 0.35)
    word.hide_render = True
    studio.add_lights()
    studio.add_floor(0.0, (0.62, 0.58, 0.50))
    studio.add_camera((0.0, -4.6, 5.0), (0.0, -0.02, 0.0), 66.0)
