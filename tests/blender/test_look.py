# SPDX-License-Identifier: GPL-3.0-or-later
"""The look of a result: what body it gives, and that no later run touches it."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
import scenes
from mathutils.kdtree import KDTree
from meander.scene import assets, curve_reader, look
from meander.scene.results import last_result
from scenes import (
    activate,
    circle_points,
    cube,
    pieces_of,
    points_of,
    poly_curve,
    sphere,
    world_splines,
)

SPACING = 0.3


def fill(thing: bpy.types.Object, spacing: float, **settings) -> bpy.types.Object:
    return scenes.fill(thing, spacing, **{"use_bevel": True} | settings)


def small(**settings) -> bpy.types.Object:
    return fill(sphere(subdivisions=4), SPACING, iteration_limit=60, **settings)


def body_of(thing: bpy.types.Object) -> bpy.types.Mesh:
    """The evaluated mesh; it lives until the next evaluation."""
    bpy.context.view_layer.update()
    return thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()


def heights(thing: bpy.types.Object) -> np.ndarray:
    """How far the vertices of its body are from the middle of a sphere of radius 1."""
    mesh = body_of(thing)
    points = scenes.column(mesh.vertices, "co", 3)
    return np.linalg.norm(points, axis=1)


def choose(thing: bpy.types.Object, **values) -> bpy.types.Object:
    modifier = look.modifier_of(thing)
    for name, value in values.items():
        look.set_value(modifier, name.replace("_", " "), value)
    return thing


def values_of(thing: bpy.types.Object) -> dict[str, object]:
    modifier = look.modifier_of(thing)
    names = (
        *("Radius", "Profile", "Resolution", "Lift", "Radius Follows Spacing", "Material"),
        *("Plies", "Twist", "Fuzz", "Ends", "Ends Material"),
    )
    return {name: look.value_of(modifier, name) for name in names}


# A line on facets of a sphere lies below it by so much at most, and so does its body.
SAG = 0.012


def test_a_new_result_has_a_live_body_in_a_dark_colour():
    result = small(bevel_share=0.1)
    found = heights(result)
    assert found.max() == pytest.approx(1.0 + 0.1 * SPACING, abs=SAG)
    assert found.min() == pytest.approx(1.0 - 0.1 * SPACING, abs=SAG)
    material = look.material_of(result)
    assert result.data.materials[:] == [material] and assets.is_asset(material, look.LINE)
    assert [slot.name for slot in body_of(result).materials if slot] == [look.LINE]
    assert max(material.diffuse_color[:3]) < 0.2, "surfaces are .8 grey"


@pytest.mark.parametrize(
    "profile, above", [("ROUND", 1.0), ("SQUARE", 1.0), ("RIBBON", 0.3), ("WALL", 1.0)]
)
def test_profiles_stand_on_the_surface(profile: str, above: float):
    result = small(bevel_share=0.1, profile=profile)
    assert result.meander.shown_profile == profile
    result.meander.shown_profile = "ROUND"
    assert values_of(result)["Profile"] == 0
    result.meander.shown_profile = profile
    found = heights(result)
    radius = 0.1 * SPACING
    assert np.percentile(found, 98) == pytest.approx(1.0 + above * radius, abs=SAG)
    assert np.percentile(found, 2) == pytest.approx(1.0 - above * radius, abs=SAG)


def test_lift_is_counted_in_radii():
    result = choose(small(bevel_share=0.1), Lift=3.0)
    found = heights(result)
    assert found.min() == pytest.approx(1.0 + 2.0 * 0.1 * SPACING, abs=SAG)
    assert found.max() == pytest.approx(1.0 + 4.0 * 0.1 * SPACING, abs=SAG)


def test_a_body_knows_where_along_its_strand_it_is():
    surface = sphere()
    seed = poly_curve("Seed", [circle_points(0.45, 0.89), circle_points(0.45, -0.89)], True)
    result = fill(surface, SPACING, seed=seed, iteration_limit=30, round_share=0.0)
    mesh = body_of(result)
    values = {}
    for name in ("along", "arc_length", "strand"):
        values[name] = np.empty(len(mesh.vertices), dtype=np.float32)
        mesh.attributes[name].data.foreach_get("value", values[name])
    for index, (points, _cyclic) in enumerate(world_splines(result)):
        mine = values["strand"] == index
        length = np.linalg.norm(np.diff(points, axis=0, append=points[:1]), axis=1).sum()
        assert values["along"][mine].min() == 0.0 and 0.9 < values["along"][mine].max() < 1.0
        share = values["arc_length"][mine] / length
        assert np.allclose(share, values["along"][mine], atol=1e-3)
    assert set(np.unique(values["strand"])) == {0.0, 1.0}


@pytest.mark.parametrize("closed", [True, False])
def test_colours_jump_nowhere_on_a_line(closed: bool):
    seed = poly_curve("Seed", [circle_points(0.45, 0.89)[: None if closed else 12]], closed)
    mesh = body_of(fill(sphere(), SPACING, seed=seed, iteration_limit=30))
    ramp = scenes.column(mesh.attributes["ramp"].data, "value")
    along = scenes.column(mesh.attributes["along"].data, "value")
    edges = scenes.column(mesh.edges, "vertices", 2, np.int32)
    assert np.abs(np.diff(ramp[edges], axis=1)).max() < 0.05
    assert np.ptp(ramp) > 0.95
    if not closed:
        assert np.allclose(ramp, along)
    material = assets.material(look.LINE)
    place = next(n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeAttribute")
    assert place.attribute_name == "ramp"


def test_thickness_follows_the_spacing():
    surface = sphere()
    group = surface.vertex_groups.new(name="Fine")
    for vertex in surface.data.vertices:
        group.add([vertex.index], 1.0 if vertex.co.z > 0.0 else 0.0, "REPLACE")
    result = fill(surface, SPACING, iteration_limit=60, density_source="NONE")
    assert values_of(result)["Radius Follows Spacing"] == 0.0

    def thickness(above: bool) -> float:
        mesh = body_of(result)
        sides = look.value_of(look.modifier_of(result), "Resolution")
        rings = np.array([vertex.co[:] for vertex in mesh.vertices]).reshape(-1, sides, 3)
        middles = rings.mean(axis=1)
        sizes = np.linalg.norm(rings - middles[:, None], axis=2).mean(axis=1)
        return float(np.median(sizes[middles[:, 2] > 0.4 if above else middles[:, 2] < -0.4]))

    assert thickness(True) == pytest.approx(thickness(False), rel=1e-3)
    # As soon as there is a density: what is dense would be a blob.
    density = {"density_source": "GROUP", "factor_0": 1.0, "factor_1": 0.4, "iteration_limit": 60}
    assert fill(surface, SPACING, **density) == result
    assert thickness(True) / thickness(False) == pytest.approx(0.4, abs=0.15)
    # Whoever has set it by hand keeps that.
    choose(result, Radius_Follows_Spacing=0.5)
    assert fill(surface, SPACING, **density) == result
    assert values_of(result)["Radius Follows Spacing"] == 0.5
    choose(result, Radius_Follows_Spacing=1.0)
    fill(surface, SPACING, density_source="NONE", iteration_limit=60)
    assert values_of(result)["Radius Follows Spacing"] == 0.0
    # And whoever does not want it says so beforehand.
    surface.meander.last_result = None
    bare = fill(surface, SPACING, radius_follows=False, **density)
    assert bare != result and values_of(bare)["Radius Follows Spacing"] == 0.0

def turns_of(points: np.ndarray) -> np.ndarray:
    """By how much a closed line turns at each of its points, in degrees."""
    steps = np.roll(points, -1, axis=0) - points
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    return np.degrees(np.arccos(np.clip((steps * np.roll(steps, 1, axis=0)).sum(axis=1), -1, 1)))


@pytest.mark.parametrize("profile", ["ROUND", "RIBBON"])
def test_a_body_is_bent_round_the_creases_of_its_surface(profile: str):
    result = fill(cube(), 0.25, profile=profile, bevel_share=0.2)
    ((line, closed),) = world_splines(result)
    assert closed
    sides = {"ROUND": 8, "RIBBON": 4}[profile]
    mesh = body_of(result)
    points = scenes.column(mesh.vertices, "co", 3)
    rings = points.reshape(-1, sides, 3).astype(float)
    middles = rings.mean(axis=1)
    # A pipe that is bent by a right angle at one place is .7 of its width there.
    sharp = np.count_nonzero(turns_of(line) > 60.0)
    assert sharp > 20
    assert np.count_nonzero(turns_of(middles) > 60.0) <= 0.05 * sharp
    # It leaves the line at creases only, and there by less than half of its thickness.
    radius = 0.2 * 0.25
    off = np.abs(np.abs(middles).max(axis=1) - 1.0)
    assert off.max() < 0.5 * radius and np.median(off) < 1e-4


def test_the_ends_of_a_body_stay_where_those_of_the_line_are():
    # Both ends are closer to a crease than an arc needs.
    seed = poly_curve("Stroke", [[(0.99, 0.0, 1.0), (1.0, 0.0, 0.5)]], False)
    result = fill(cube(), 0.25, seed=seed, fixed_ends=True)
    ((line, _closed),) = world_splines(result)
    mesh = body_of(result)
    points = np.array([vertex.co for vertex in mesh.vertices])
    for end in (line[0], line[-1]):
        rings = np.linalg.norm(points - end, axis=1)
        assert np.count_nonzero(rings < 1.1 * 0.2 * 0.25) >= 8


@pytest.mark.parametrize(
    ("closed", "plies", "twist"), [(True, 2, 1.0), (True, 3, -1.5), (False, 5, 2.0)]
)
def test_a_rope_is_as_many_plies_that_wind_round_the_line(closed: bool, plies: int, twist: float):
    seed = poly_curve("Seed", [circle_points(0.45, 0.89)[: None if closed else 20]], closed)
    rope = {"profile": "ROPE", "round_share": 0.0}
    result = fill(sphere(), SPACING, seed=seed, iteration_limit=12, **rope)
    choose(result, Radius=0.15, Plies=plies, Twist=twist, Resolution=8)
    mesh = body_of(result)
    assert pieces_of(mesh) == plies
    radius = 0.15 * SPACING
    ((line, _closed),) = world_splines(result)
    ends = np.roll(line, -1, axis=0) if closed else line[1:]
    begins = line if closed else line[:-1]
    share = np.linspace(0.0, 1.0, 8, endpoint=False)[:, None, None]
    samples = (begins + share * (ends - begins)).reshape(-1, 3)
    points = np.array([vertex.co for vertex in mesh.vertices])
    tree = KDTree(len(samples))
    for number, sample in enumerate(samples):
        tree.insert(sample, number)
    tree.balance()
    away = np.array([tree.find(point)[2] for point in points])
    assert away.max() < 1.12 * radius
    assert np.percentile(away, 95) > 0.95 * radius
    # Each ply closes where the line does, and turns as often as it is said to.
    edges = np.array([edge.vertices[:] for edge in mesh.edges])
    steps = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    assert steps.max() < 4.0 * np.median(steps)
    first = points[: len(points) // plies].reshape(-1, 8, 3).mean(axis=1)
    nearest = np.array([tree.find(middle)[1] for middle in first])
    heights = np.linalg.norm(first, axis=1) - np.linalg.norm(samples[nearest], axis=1)
    crossed = np.count_nonzero(np.diff(np.sign(heights)) != 0)
    length = np.linalg.norm(ends - begins, axis=1).sum()
    turns = round(abs(twist) * length / (10.0 * radius))
    assert crossed == pytest.approx(2 * turns, abs=0.1 * turns + 2)


def test_fuzz_is_loose_fibres_that_have_the_colours_of_their_place():
    result = small(profile="ROPE", bevel_share=0.15)
    smooth = len(body_of(result).vertices)
    choose(result, Fuzz=1.0)
    assert np.abs(heights(result) - 1.0).max() < 3.0 * 0.15 * SPACING
    mesh = body_of(result)
    assert pieces_of(mesh) > 500 and len(mesh.vertices) > 1.5 * smooth
    ramp = scenes.column(mesh.attributes["ramp"].data, "value")
    assert np.quantile(ramp[smooth:], 0.1) > 0.01 and np.ptp(ramp[smooth:]) > 0.9
    # Of many lengths, most of them short.
    reach = heights(result) - 1.0
    stand_off = reach[smooth:][reach[smooth:] > 1.1 * 0.15 * SPACING] / (0.15 * SPACING)
    assert np.quantile(stand_off, 0.99) > 1.5 * np.median(stand_off)
    # Other profiles have none.
    result.meander.shown_profile = "ROUND"
    assert len(body_of(result).vertices) < smooth


def test_a_line_knows_its_surface_and_can_fade_behind():
    result = small(bevel_share=0.15)
    mesh = body_of(result)
    normals = scenes.column(mesh.attributes["surface_normal"].data, "vector", 3)
    points = np.array([vertex.co for vertex in mesh.vertices])
    outward = points / np.linalg.norm(points, axis=1, keepdims=True)
    assert ((normals * outward).sum(axis=1) > 0.9).mean() > 0.98
    nodes = {node.label: node for node in look.material_of(result).node_tree.nodes}
    assert nodes["Fade Behind"].outputs[0].default_value == 0.0
    assert nodes["Color Behind"].bl_idname == "ShaderNodeRGB"


def beyond(result: bpy.types.Object) -> tuple[list[float], set[str]]:
    """How far the body reaches beyond each end of an open line, in radii of the line, and the
    materials of its faces."""
    ((line, _closed),) = world_splines(result)
    mesh = body_of(result)
    points = np.array([vertex.co for vertex in mesh.vertices])
    used = {mesh.materials[polygon.material_index].name for polygon in mesh.polygons}
    reach = []
    for end, inner in ((line[0], line[1]), (line[-1], line[-2])):
        outwards = (end - inner) / np.linalg.norm(end - inner)
        near = points[np.linalg.norm(points - end, axis=1) < 0.7 * SPACING]
        reach.append(float(((near - end) @ outwards).max()) / (0.05 * SPACING))
    return reach, used


def test_open_lines_have_ends_and_closed_ones_have_none():
    # Far enough from each other that nothing else is ahead of an end.
    seed = poly_curve("Seed", [[(0.6, -0.8, 0.0), (-0.6, -0.8, 0.0)]], False)
    result = fill(sphere(), SPACING, seed=seed, fixed_ends=True, iteration_limit=1)
    choose(result, Radius=0.05)
    found = {}
    for kind in ("FLAT", "ROUND", "NEON", "PLUG"):
        result.meander.shown_ends = kind
        assert result.meander.shown_ends == kind
        found[kind] = beyond(result)
    assert max(found["FLAT"][0]) < 0.1 and found["FLAT"][1] == {look.LINE}
    assert found["ROUND"][0] == pytest.approx([0.97, 0.97], abs=0.05)
    assert found["ROUND"][1] == {look.LINE}
    assert found["NEON"][0] == pytest.approx([4.0, 4.0], abs=0.1)
    assert found["NEON"][1] == found["PLUG"][1] == {look.LINE, look.ENDS}
    # A plug rises by .8 of what it goes ahead.
    assert found["PLUG"][0] == pytest.approx([10.2, 10.2], abs=0.8)
    # One of one's own stays.
    mine = bpy.data.materials.new("Mine")
    choose(result, Ends_Material=mine)
    result.meander.shown_ends = "NEON"
    assert beyond(result)[1] == {look.LINE, "Mine"}
    closed = small(bevel_share=0.1)
    before = len(body_of(closed).vertices)
    closed.meander.shown_ends = "PLUG"
    assert len(body_of(closed).vertices) == before


def test_no_run_touches_the_look():
    result = small()
    surface = result.meander.surface
    mine = bpy.data.materials.new("Mine")
    choose(result, Radius=0.4, Profile=4, Resolution=5, Lift=0.5, Material=mine)
    choose(result, Plies=4, Twist=0.5, Fuzz=0.1, Ends=2, **{"Ends Material": mine})
    modifier = look.modifier_of(result)
    owner, path = look.place_of(modifier, "Radius")
    if path.startswith("["):
        subtype = owner.id_properties_ui(path.strip('[]"')).as_dict()["subtype"]
    else:
        subtype = owner.bl_rna.properties[path].subtype
    assert subtype == "FACTOR"  # a slider
    chosen, modifiers = values_of(result), result.modifiers.keys()
    surface.meander.bevel_share, surface.meander.use_bevel = 0.05, False
    for thing, options in ((surface, {}), (result, {}), (result, {"restart": True})):
        activate(thing)
        thing.meander.iteration_limit = 20
        assert bpy.ops.meander.run(**options) == {"FINISHED"}
        assert values_of(result) == chosen and result.modifiers.keys() == modifiers
    # The group is the user's as well.
    group = look.modifier_of(result).node_group
    group.nodes.remove(next(n for n in group.nodes if n.bl_idname == "GeometryNodeSetPosition"))
    activate(surface)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert look.modifier_of(result).node_group == group
    assert len(group.nodes) < len(assets.node_group(look.GROUP).nodes)


def test_thickness_is_a_share_of_the_spacing_until_somebody_sets_that():
    result = small(bevel_share=0.1)
    surface = result.meander.surface
    activate(surface)
    surface.meander.spacing = 0.5 * SPACING
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert look.radius_of(result) == pytest.approx(0.05 * SPACING)
    choose(result, Spacing=1.0)
    surface.meander.spacing = SPACING
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert look.radius_of(result) == pytest.approx(0.1)


def test_a_result_goes_on_from_its_line_and_not_from_its_body():
    result = small()
    points = points_of(result)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    read = curve_reader.strands_of_curve(result, depsgraph)
    assert np.abs(read.points - points).max() < 1e-6
    result.modifiers.new("After", "SUBSURF")  # of the body
    first = result.modifiers.new("Before", "HOOK")  # of the line
    with bpy.context.temp_override(object=result):
        bpy.ops.object.modifier_move_to_index(modifier=first.name, index=0)
    read = curve_reader.strands_of_curve(result, bpy.context.evaluated_depsgraph_get())
    assert len(read.points) == len(points)


def test_strands_with_materials_of_their_own_have_a_bevel():
    surface = sphere()
    seed = poly_curve("Seed", [circle_points(0.45, 0.89), circle_points(0.45, -0.89)], True)
    for name in ("Red", "Blue"):
        seed.data.materials.append(bpy.data.materials.new(name))
    seed.data.splines[1].material_index = 1
    result = fill(surface, SPACING, seed=seed, iteration_limit=20)
    assert look.modifier_of(result) is None and result.data.bevel_depth > 0.0
    assert [spline.material_index for spline in result.data.splines] == [0, 1]
    assert [material.name for material in result.data.materials] == ["Red", "Blue"]
    seed.data.splines[1].material_index = 0
    seed.data.materials.pop()
    activate(surface)
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    single = last_result(surface, bpy.context.scene)
    assert look.material_of(single).name == "Red"


def test_a_line_is_kept_when_the_file_of_the_add_on_is_missing(monkeypatch, tmp_path):
    monkeypatch.setattr(assets, "FILE", tmp_path / "meander.blend")
    result = small()
    assert len(result.data.splines) == 1 and look.modifier_of(result) is None
    assert result.data.bevel_depth == pytest.approx(0.2 * SPACING)


def test_a_result_of_an_earlier_version_keeps_its_bevel_and_may_get_a_look():
    result = small(use_bevel=False)
    data = result.data
    data.bevel_depth, data.twist_mode = 0.05, "MINIMUM"
    for spline in data.splines:
        spline.points.foreach_set("tilt", np.zeros(len(spline.points), dtype=np.float32))
    activate(result)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert data.bevel_depth == pytest.approx(0.05) and look.modifier_of(result) is None
    assert bpy.ops.meander.add_look() == {"FINISHED"}
    assert data.bevel_depth == 0.0 and look.radius_of(result) == pytest.approx(0.05)
    assert heights(choose(result, Lift=1.0)).min() == pytest.approx(1.0, abs=SAG)
    assert not bpy.ops.meander.add_look.poll()


def test_the_material_is_the_first_slots_wherever_it_is_chosen():
    result = small()
    first, second = (bpy.data.materials.new(name) for name in ("First", "Second"))
    result.data.materials[0] = first
    bpy.context.view_layer.update()
    assert look.material_of(result) == first
    assert [slot.name for slot in body_of(result).materials if slot] == ["First"]
    result.material_slots[0].link = "OBJECT"
    result.material_slots[0].material = second
    bpy.context.view_layer.update()
    assert look.material_of(result) == second
    # One that was chosen in the modifier stays.
    choose(result, Material=first)
    result.material_slots[0].material = None
    bpy.context.view_layer.update()
    assert look.material_of(result) == first
    assert look.is_chosen_in_modifier(result)
