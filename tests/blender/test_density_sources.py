# SPDX-License-Identifier: GPL-3.0-or-later
"""Every source of the density against values read one by one, and a curve that follows one."""

from __future__ import annotations

from dataclasses import asdict

import bpy
import numpy as np
import pytest
from meander.model.density import Choice
from meander.run.plan import plan_run
from meander.scene import attributes
from meander.scene import density as ramp
from meander.scene import density as scene_density
from scenes import activate, fill, grid, mesh_object, poly_curve, refused, sphere, world_splines

KINDS = [
    ("BYTE_COLOR", "POINT"),
    ("BYTE_COLOR", "CORNER"),
    ("FLOAT_COLOR", "POINT"),
    ("FLOAT_COLOR", "CORNER"),
]


def density(thing: bpy.types.Object, choice: Choice) -> list[float]:
    return scene_density.density_of(
        choice, thing, bpy.context.evaluated_depsgraph_get()
    ).tolist()


def factors_of(values: np.ndarray, choice: Choice) -> np.ndarray:
    low, high = choice.value_range or (0.0, 1.0)
    shares = [min(max((value - low) / (high - low), 0.0), 1.0) for value in values]
    return np.array([choice.factors[0] * (1 - t) + choice.factors[1] * t for t in shares])


def expected(values: np.ndarray, choice: Choice) -> list[float]:
    return pytest.approx(list(factors_of(values, choice) ** -2.0), rel=1e-5)


def folded_strip() -> bpy.types.Object:
    """A square, a triangle and a loose vertex: corners, vertices and faces count differently."""
    vertices = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 1), (9, 9, 9)]
    return mesh_object("Strip", vertices, [(0, 1, 2, 3), (1, 4, 2)])


def brightness(color) -> float:
    return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]


# -- one source at a time --------------------------------------------------------------------------


def test_vertex_group():
    thing = folded_strip()
    group = thing.vertex_groups.new(name="Fine")
    weights = np.array([0.0, 0.25, 0.5, 0.75, 1.0, 0.0])
    for index, weight in enumerate(weights[:-1]):
        group.add([index], weight, "REPLACE")
    choice = Choice("GROUP", "Fine", factors=(2.0, 0.5))
    assert density(thing, choice) == expected(weights, choice)
    choice = Choice("GROUP", "Fine", value_range=(0.25, 0.75))
    assert density(thing, choice) == expected(weights, choice)
    nothing = scene_density.density_of(
        Choice("GROUP"), thing, bpy.context.evaluated_depsgraph_get()
    )
    assert nothing is None


def test_attribute():
    thing = folded_strip()
    heights = thing.data.attributes.new("height", "FLOAT", "POINT")
    values = np.array([-3.0, 1.0, 2.0, 7.0, 0.5, 0.0], dtype=np.float32)
    heights.data.foreach_set("value", values)
    choice = Choice("ATTRIBUTE", "height")
    assert density(thing, choice) == expected(values, Choice(value_range=(-3.0, 7.0)))
    choice = Choice("ATTRIBUTE", "height", value_range=(2.0, 0.0), factors=(0.3, 3.0))
    assert density(thing, choice) == expected(values, choice)


@pytest.mark.parametrize(("kind", "domain"), KINDS)
def test_color_attribute(kind, domain):
    thing = folded_strip()
    attribute = thing.data.color_attributes.new("Paint", kind, domain)
    rng = np.random.default_rng(3)
    for element in attribute.data:
        element.color = (*rng.random(3), 0.5)
    colors = [brightness(element.color) for element in attribute.data]
    if domain == "CORNER":
        loops = [loop.vertex_index for loop in thing.data.loops]
        of_vertex = [[c for c, v in zip(colors, loops) if v == vertex] for vertex in range(6)]
        colors = [sum(corners) / len(corners) if corners else 0.0 for corners in of_vertex]
    choice = Choice("COLOR", "Paint", factors=(1.5, 0.25))
    assert density(thing, choice) == expected(np.array(colors), choice)


def painted_image(is_float: bool, color_space: str) -> bpy.types.Image:
    image = bpy.data.images.new("Map", 4, 2, float_buffer=is_float)
    image.colorspace_settings.name = color_space
    rng = np.random.default_rng(5)
    pixels = rng.random((8, 4)).astype(np.float32)
    pixels[:, 3] = 1.0
    image.pixels.foreach_set(pixels.ravel())
    return image


def unwrapped() -> tuple[bpy.types.Object, list[tuple[float, float]]]:
    """The strip with a UV map that sends every corner to the middle of a pixel of its own."""
    thing = folded_strip()
    thing.data.uv_layers.new(name="Other")
    layer = thing.data.uv_layers.new(name="Flat")
    corners = [(0.125 + 0.25 * (i % 4), 0.25 + 0.5 * (i // 4)) for i in range(7)]
    for element, uv in zip(layer.data, corners, strict=True):
        element.uv = uv
    thing.data.uv_layers.active = layer
    return thing, corners


@pytest.mark.parametrize(
    ("is_float", "color_space"), [(False, "sRGB"), (False, "Non-Color"), (True, "Non-Color")]
)
def test_image(is_float, color_space):
    thing, corners = unwrapped()
    image = painted_image(is_float, color_space)
    pixels = np.array(image.pixels[:]).reshape(8, 4)[:, :3]
    if color_space == "sRGB":
        pixels = np.where(pixels > 0.04045, ((pixels + 0.055) / 1.055) ** 2.4, pixels / 12.92)
    values = np.zeros(6)
    counts = np.zeros(6)
    for index, loop in enumerate(thing.data.loops):
        values[loop.vertex_index] += brightness(pixels[index])
        counts[loop.vertex_index] += 1
    choice = Choice("IMAGE", "Map", factors=(1.0, 0.2))
    assert density(thing, choice) == expected(values / np.maximum(counts, 1), choice)
    # Another map of the same mesh puts every corner on one pixel.
    for element in thing.data.uv_layers["Other"].data:
        element.uv = (0.125, 0.25)
    choice = Choice("IMAGE", "Map", uv_map="Other")
    values = [brightness(pixels[0])] * 5 + [0.0]
    assert density(thing, choice) == expected(np.array(values), choice)


def test_an_image_from_a_packed_file_and_from_disk(tmp_path):
    thing, _corners = unwrapped()
    painted = painted_image(False, "sRGB")
    before = density(thing, Choice("IMAGE", "Map"))
    painted.filepath_raw = str(tmp_path / "map.png")
    painted.file_format = "PNG"
    painted.save()
    bpy.data.images.remove(painted)
    opened = bpy.data.images.load(str(tmp_path / "map.png"))
    assert density(thing, Choice("IMAGE", opened.name)) == pytest.approx(before, rel=0.02)
    opened.pack()
    (tmp_path / "map.png").unlink()
    assert density(thing, Choice("IMAGE", opened.name)) == pytest.approx(before, rel=0.02)


def test_a_colour_and_an_image_of_the_same_grey_agree():
    thing, _corners = unwrapped()
    image = bpy.data.images.new("Grey", 2, 2)
    image.generated_color = (0.5, 0.5, 0.5, 1.0)
    attribute = thing.data.color_attributes.new("Grey", "BYTE_COLOR", "CORNER")
    linear = image.pixels[0]
    linear = ((linear + 0.055) / 1.055) ** 2.4
    for element in attribute.data:
        element.color = (linear, linear, linear, 1.0)
    by_color = density(thing, Choice("COLOR", "Grey"))
    assert by_color == pytest.approx(density(thing, Choice("IMAGE", "Grey")), rel=0.01)


# -- in a run --------------------------------------------------------------------------------------


def test_curvature_makes_tips_denser():
    """A long ellipsoid: most of the length of its curve lies near the tips, more than area says."""
    surface = sphere()
    surface.scale = (1.0, 1.0, 3.0)
    plain = fill(surface, 0.3)
    share = [share_near_tips(plain)]
    bpy.data.objects.remove(plain)
    settings = {"density_source": "CURVATURE", "density_curvature": "GAUSSIAN"}
    result = fill(surface, 0.3, factor_0=1.0, factor_1=0.5, **settings)
    share.append(share_near_tips(result))
    assert share[1] > 1.15 * share[0]
    assert result.meander.density_curvature == "GAUSSIAN"
    plan = plan_run(bpy.context)
    assert callable(plan.problem.density)  # Continue computes the same


def share_near_tips(curve: bpy.types.Object) -> float:
    near = total = 0.0
    for points, _cyclic in world_splines(curve):
        following = np.roll(points, -1, axis=0)
        lengths = np.linalg.norm(following - points, axis=1)
        total += lengths.sum()
        near += lengths[np.abs(points[:, 2] + following[:, 2]) / 2.0 > 2.0].sum()
    return near / total


@pytest.mark.parametrize("source", ["GROUP", "ATTRIBUTE", "COLOR", "IMAGE"])
def test_the_spacing_follows(source):
    """A square whose left half is to be twice as dense: twice the length lies there."""
    surface = grid(cells=40)
    left = np.array([vertex.co.x < 0.0 for vertex in surface.data.vertices])
    settings = surface.meander
    settings.density_source = source
    if source == "GROUP":
        surface.vertex_groups.new(name="side").add(np.flatnonzero(left).tolist(), 1.0, "REPLACE")
        settings.density_group = "side"
    elif source == "ATTRIBUTE":
        surface.data.attributes.new("side", "FLOAT", "POINT").data.foreach_set("value", 4.0 * left)
        settings.density_attribute = "side"
    elif source == "COLOR":
        colors = surface.data.color_attributes.new("side", "FLOAT_COLOR", "POINT")
        colors.data.foreach_set("color", np.repeat(left, 4).astype(np.float32))
        settings.density_color = "side"
    else:
        image = bpy.data.images.new("side", 64, 2)
        image.pixels.foreach_set(np.repeat(np.arange(128) % 64 < 32, 4).astype(np.float32))
        settings.density_image = image
    result = fill(surface, 0.16, factor_0=1.0, factor_1=0.5)
    ((points, _cyclic),) = world_splines(result)
    following = np.roll(points, -1, axis=0)
    lengths = np.linalg.norm(following - points, axis=1)
    x = (points + following)[:, 0] / 2.0
    # Away from the border and from the step between the halves.
    fine, coarse = lengths[(x > -0.8) & (x < -0.2)].sum(), lengths[(x > 0.2) & (x < 0.8)].sum()
    assert fine / coarse == pytest.approx(2.0, rel=0.15)
    # The result knows what it was made with, and Continue reads the same.
    for name in ("source", "group", "attribute", "color", "image"):
        name = f"density_{name}"
        assert getattr(result.meander, name) == getattr(settings, name)
    plan = plan_run(bpy.context)
    assert plan.problem.density.min() == 1.0 and plan.problem.density.max() == pytest.approx(4.0)


def test_attributes_of_a_modifier_are_found():
    """Subdivided points get interpolated values, and the names that are offered."""
    thing = grid(cells=2)
    values = thing.data.attributes.new("height", "FLOAT", "POINT")
    values.data.foreach_set("value", np.arange(9.0))
    thing.data.color_attributes.new("Paint", "FLOAT_COLOR", "POINT")
    thing.data.attributes.new("edges", "FLOAT", "EDGE")
    modifier = thing.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = 1
    modifier.subdivision_type = "SIMPLE"
    found = density(thing, Choice("ATTRIBUTE", "height", value_range=(0.0, 8.0)))
    assert len(found) == 25
    assert min(found) == 1.0 and max(found) == pytest.approx(4.0)
    names = attributes.attribute_names(thing.meander, bpy.context, "")
    assert names == ["height"]
    assert attributes.color_names(thing.meander, bpy.context, "") == ["Paint"]
    assert attributes.color_names(poly_curve("C", [], False).meander, bpy.context, "") == []


def test_choices_go_into_settings_and_out_again():
    thing = grid(cells=2)
    bpy.data.images.new("Map", 2, 2)
    for choice in (
        Choice(factors=(0.5, 2.0)),
        Choice("GROUP", "Fine", interpolation="constant"),
        Choice("ATTRIBUTE", "height", value_range=(-2.0, 4.0)),
        Choice("COLOR", "Paint", interpolation="smooth"),
        Choice("IMAGE", "Map", uv_map="Flat"),
        Choice("CURVATURE", "gaussian", smoothing=3.5),
    ):
        scene_density.store_choice(choice, thing.meander)
        assert asdict(scene_density.choice_of(thing.meander)) == asdict(choice)


def test_a_curve_shapes_the_ramp():
    """What the widget shows against factors read off by hand."""
    thing = folded_strip()
    values = np.array([0.0, 0.25, 0.5, 0.75, 1.0, 0.0], dtype=np.float32)
    thing.data.attributes.new("height", "FLOAT", "POINT").data.foreach_set("value", values)
    settings = thing.meander
    settings.density_source, settings.density_attribute = "ATTRIBUTE", "height"
    settings.factor_0, settings.factor_1 = 1.0, 3.0
    settings.density_interpolation = "FREE"
    assert density(thing, scene_density.choice_of(settings)) == pytest.approx(
        (1.0 + 2.0 * values) ** -2.0, rel=1e-4
    )
    mapping = ramp.node_of(settings.density_ramp).mapping
    point = mapping.curves[0].points.new(0.5, 1.0)
    for other in mapping.curves[0].points:
        other.handle_type = "VECTOR"
    mapping.curves[0].points[-1].location = (1.0, 0.5)
    mapping.update()
    heights = np.array([0.0, 0.5, 1.0, 0.75, 0.5, 0.0])
    found = density(thing, scene_density.choice_of(settings))
    assert found == pytest.approx((1.0 + 2.0 * heights) ** -2.0, rel=0.02)
    assert point is not None
    # Without its node, as somebody may have left it, the ramp is straight.
    settings.density_ramp.nodes.clear()
    assert density(thing, scene_density.choice_of(settings)) == pytest.approx(
        (1.0 + 2.0 * values) ** -2.0, rel=1e-5
    )


@pytest.mark.parametrize("kind", ["FLOAT", "INT", "INT8", "BOOLEAN"])
@pytest.mark.parametrize("domain", ["POINT", "FACE", "CORNER"])
def test_an_attribute_of_any_numbers(kind, domain):
    thing = folded_strip()
    numbers = {"FLOAT": 2.5, "INT": -70_000, "INT8": -7, "BOOLEAN": True}
    count = {"POINT": 6, "FACE": 2, "CORNER": 7}[domain]
    values = [numbers[kind] if place % 2 else 0 for place in range(count)]
    attribute = thing.data.attributes.new("number", kind, domain)
    for place, value in enumerate(values):
        attribute.data[place].value = value
    attribute = thing.data.attributes["number"]
    assert attributes.is_number(attribute)
    corners = [0, 1, 2, 3, 1, 4, 2]
    element = {"POINT": corners, "FACE": [0, 0, 0, 0, 1, 1, 1], "CORNER": range(7)}[domain]
    by_corner = [values[each] for each in element]
    wanted = [
        np.mean([float(by_corner[at]) for at, vertex in enumerate(corners) if vertex == each])
        for each in range(5)
    ]
    low, high = sorted([0.0, float(numbers[kind])])
    choice = Choice("ATTRIBUTE", "number", value_range=(low, high))
    assert density(thing, choice)[:5] == expected(np.array(wanted), choice)


def test_a_result_has_a_curve_of_its_own(tmp_path):
    thing = grid(cells=6)
    heights = thing.data.attributes.new("height", "FLOAT", "POINT")
    heights.data.foreach_set("value", [vertex.co.x for vertex in thing.data.vertices])
    stops = ((0.0, 0.0), (0.5, 1.0), (1.0, 0.25))
    choice = Choice("ATTRIBUTE", "height", factors=(1.0, 2.0), interpolation="free", stops=stops)
    scene_density.store_choice(choice, thing.meander)
    earlier = fill(thing, 0.4)
    activate(thing)
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    own, source = earlier.meander.density_ramp, thing.meander.density_ramp
    assert own != source
    assert ramp.stops_of(own) == ramp.stops_of(source)
    path = tmp_path / "kept.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.open_mainfile(filepath=str(path))
    kept = ramp.stops_of(bpy.data.objects["Grid Meander"].meander.density_ramp)
    shares, shape = np.array(kept).T
    assert shape == pytest.approx(np.interp(shares, *np.array(stops).T), abs=0.01)


# -- refusals --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"density_group": "Nowhere"}, "'Nowhere'"),
        ({"density_source": "ATTRIBUTE"}, "no attribute"),
        ({"density_source": "ATTRIBUTE", "density_attribute": "x"}, "no attribute of numbers"),
        ({"density_source": "ATTRIBUTE", "density_attribute": "edges"}, "per edge"),
        ({"density_source": "ATTRIBUTE", "density_attribute": "bad"}, "finite number at vertex 3"),
        ({"density_source": "COLOR"}, "no color attribute"),
        ({"density_source": "COLOR", "density_color": "bad"}, "choose a color attribute"),
        ({"density_source": "IMAGE"}, "no image"),
    ],
    ids=lambda value: value if isinstance(value, str) else "-".join(value.values()),
)
def test_what_is_missing_or_of_another_kind(settings, words):
    thing = grid(cells=4)
    thing.data.attributes.new("edges", "FLOAT", "EDGE")
    thing.data.attributes.new("bad", "FLOAT", "POINT").data[3].value = float("nan")
    assert words in refused(thing, **settings)


def test_a_map_with_places_that_are_no_numbers_is_named_and_not_the_image():
    thing = grid(cells=4)
    layer = thing.data.uv_layers[0] if thing.data.uv_layers else thing.data.uv_layers.new(name="UV")
    layer.data[5].uv = (float("nan"), 0.0)
    vertex = thing.data.loops[5].vertex_index
    image = bpy.data.images.new("Fine", 4, 4)
    said = refused(thing, density_source="IMAGE", density_image=image)
    assert f"The UV map '{layer.name}' is not a finite number at vertex {vertex}" in said
    assert "'Fine'" not in said


def test_images_that_cannot_be_read(tmp_path):
    thing = grid(cells=4)
    image = bpy.data.images.new("Lost", 4, 4)
    image.filepath = str(tmp_path / "nowhere.png")
    image.source = "FILE"
    settings = {"density_source": "IMAGE", "density_image": image}
    assert "'Lost' has no pixels" in refused(thing, **settings)
    image.source = "TILED"
    assert "tiled (UDIM)" in refused(thing, **settings)
    other = bpy.data.images.new("Whole", 4, 4)
    settings["density_image"] = other
    assert "no UV map 'Nowhere'" in refused(thing, density_uv_map="Nowhere", **settings)
    assert "unwrap it first" in refused(folded_strip(), **settings)
