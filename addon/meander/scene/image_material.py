# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials that show a line by images alone: an inlay, a glaze, an engraving.

Their images are packed into the file, under the names of their kinds in a custom property.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import bpy

from .errors import DataError

_KIND = "meander_map"
# The node whose Distance is a share of the spacing, and that share.
_GROOVE, _GROOVE_DEPTH = "Groove", 0.08

BRASS, WOOD = (0.85, 0.52, 0.16, 1.0), (0.035, 0.012, 0.006, 1.0)
STEEL, NIELLO = (0.52, 0.53, 0.55, 1.0), (0.012, 0.012, 0.014, 1.0)


@dataclass(frozen=True)
class Recipe:
    """The images of a material, and how they are wired.

    images       of maps.KINDS
    line_width   of the mask, in spacings
    depth        of the normals, in spacings
    wire         given the tree, the shader and a texture for each image
    colour       that solid views show
    """

    images: tuple[str, ...]
    wire: Callable
    line_width: float = 0.25
    depth: float = 0.25
    colour: tuple[float, float, float, float] = (0.8, 0.8, 0.8, 1.0)


def map_name(surface: bpy.types.Object) -> str:
    """The active UV map of a surface; empty where it has none. Raises DataError for no mesh."""
    if surface.type != "MESH":
        raise DataError(f"'{surface.name}' is no mesh and has no UV map; convert it first")
    active = surface.data.uv_layers.active
    return "" if active is None else active.name


def new_material(
    name: str, kind: str, data: dict[str, bytes], uv_map: str, spacing: float
) -> bpy.types.Material:
    """Makes a material of image files, by their kinds; spacing in world units."""
    recipe = KINDS[kind]
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.diffuse_color = recipe.colour
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.bl_idname == "ShaderNodeBsdfPrincipled")
    place = nodes.new("ShaderNodeUVMap")
    place.uv_map, place.location = uv_map, (shader.location.x - 1100.0, shader.location.y - 200.0)
    textures = {}
    for row, image_kind in enumerate(recipe.images):
        texture = nodes.new("ShaderNodeTexImage")
        texture.label = image_kind.capitalize()
        texture.location = (shader.location.x - 850.0, shader.location.y - 320.0 * row)
        texture.image = _new_image(f"{name} {texture.label}", image_kind, data[image_kind])
        links.new(place.outputs["UV"], texture.inputs["Vector"])
        textures[image_kind] = texture
    recipe.wire(material.node_tree, shader, textures)
    nodes.active = textures[recipe.images[0]]
    tell_spacing(material, spacing)
    return material


def tell_spacing(material: bpy.types.Material, spacing: float) -> None:
    """Has a groove be as deep as before in spacings, unless somebody took it away."""
    groove = material.node_tree.nodes.get(_GROOVE)
    if groove is not None and "Distance" in groove.inputs:
        groove.inputs["Distance"].default_value = _GROOVE_DEPTH * spacing


def give(surface: bpy.types.Object, material: bpy.types.Material) -> None:
    """Has a surface shown with one material; its mesh keeps those that it has.

    Raises DataError for a surface from another file.
    """
    if surface.library is not None or surface.data.library is not None:
        raise DataError(f"'{surface.name}' is linked from another file, and cannot be changed")
    if not surface.material_slots:
        surface.data.materials.append(None)
    for slot in surface.material_slots:
        slot.link = "OBJECT"
        slot.material = material


def images_in(material: bpy.types.Material) -> dict[str, bpy.types.Image]:
    """The images of a material that were made by new_material(), by their kinds."""
    images = [getattr(node, "image", None) for node in material.node_tree.nodes]
    return {image[_KIND]: image for image in images if image is not None and _KIND in image}


def packed(image: bpy.types.Image) -> bytes:
    """The file that an image holds; empty where it holds none."""
    return image.packed_file.data if image.packed_file is not None else b""


def pack(image: bpy.types.Image, data: bytes) -> None:
    """Has an image hold another file."""
    image.pack(data=data, data_len=len(data))
    read_again(image)


def read_again(image: bpy.types.Image) -> None:
    """Has an image shown as the file that it holds."""
    image.buffers_free()  # reload() would prefer a file on the disk
    image.update_tag()


def _new_image(name: str, kind: str, data: bytes) -> bpy.types.Image:
    image = bpy.data.images.new(name, 1, 1)
    image.source = "FILE"
    image[_KIND] = kind
    image.filepath_raw = f"//{bpy.path.clean_name(name)}.png"  # where Unpack would put it
    pack(image, data)
    image.colorspace_settings.name = "sRGB" if kind == "color" else "Non-Color"
    return image


def _node(
    tree: bpy.types.NodeTree, kind: str, shader: bpy.types.Node, across: float, down: float
) -> bpy.types.Node:
    node = tree.nodes.new(kind)
    node.location = (shader.location.x + across, shader.location.y + down)
    return node


def _mix(
    tree: bpy.types.NodeTree,
    shader: bpy.types.Node,
    mask: bpy.types.Node,
    colours: tuple[tuple[float, ...], tuple[float, ...]],
) -> None:
    """The base colour: the first, and the second where the line is."""
    mix = _node(tree, "ShaderNodeMixRGB", shader, -300.0, 0.0)
    mix.inputs["Color1"].default_value, mix.inputs["Color2"].default_value = colours
    tree.links.new(mask.outputs["Color"], mix.inputs["Fac"])
    tree.links.new(mix.outputs["Color"], shader.inputs["Base Color"])


def _normals(
    tree: bpy.types.NodeTree, shader: bpy.types.Node, texture: bpy.types.Node, uv_map: str
) -> None:
    normal = _node(tree, "ShaderNodeNormalMap", shader, -300.0, -420.0)
    normal.uv_map = uv_map
    tree.links.new(texture.outputs["Color"], normal.inputs["Color"])
    tree.links.new(normal.outputs["Normal"], shader.inputs["Normal"])


def _uv_map(texture: bpy.types.Node) -> str:
    return texture.inputs["Vector"].links[0].from_node.uv_map


def _inlay(tree: bpy.types.NodeTree, shader: bpy.types.Node, textures: dict) -> None:
    shader.inputs["Roughness"].default_value = 0.35
    _mix(tree, shader, textures["mask"], (WOOD, BRASS))
    tree.links.new(textures["mask"].outputs["Color"], shader.inputs["Metallic"])
    _normals(tree, shader, textures["normal"], _uv_map(textures["normal"]))


def _glaze(tree: bpy.types.NodeTree, shader: bpy.types.Node, textures: dict) -> None:
    shader.inputs["Roughness"].default_value = 0.12
    tree.links.new(textures["color"].outputs["Color"], shader.inputs["Base Color"])
    _normals(tree, shader, textures["normal"], _uv_map(textures["normal"]))


def _engraving(tree: bpy.types.NodeTree, shader: bpy.types.Node, textures: dict) -> None:
    """A groove in metal, as deep as the distance from the line says, and dark where the line is."""
    shader.inputs["Metallic"].default_value = 1.0
    shader.inputs["Roughness"].default_value = 0.28
    _mix(tree, shader, textures["mask"], (STEEL, NIELLO))
    flank = _node(tree, "ShaderNodeValToRGB", shader, -600.0, -420.0)
    flank.color_ramp.elements[1].position = 0.2
    groove = _node(tree, "ShaderNodeBump", shader, -300.0, -420.0)
    groove.name = groove.label = _GROOVE
    tree.links.new(textures["distance"].outputs["Color"], flank.inputs["Fac"])
    tree.links.new(flank.outputs["Color"], groove.inputs["Height"])
    tree.links.new(groove.outputs["Normal"], shader.inputs["Normal"])


KINDS = {
    "INLAY": Recipe(("mask", "normal"), _inlay, 0.32, 0.12, WOOD),
    "GLAZE": Recipe(("color", "normal"), _glaze, depth=0.2),
    "ENGRAVING": Recipe(("mask", "distance"), _engraving, 0.2, colour=STEEL),
}
