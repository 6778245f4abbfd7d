# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of a result by a UV map of its surface, as files and as the textures of a material."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import bpy

from ..model import image_files, maps
from ..scene import image_material, look
from ..scene.drawn_line import digest_of_curve
from ..scene.errors import DataError
from ..scene.layouts import map_of
from .cut import cut_result
from .lasting import Activity, Memory
from .plan import Plan
from .window import Window


@dataclass(frozen=True)
class Images:
    """Files by their paths, the largest overlap of a square, what the run would be, and the name of
    the result."""

    files: dict[Path, bytes]
    overlap: float
    plan: Plan
    name: str


Drawn = Generator[float, None, Images]


@dataclass(frozen=True)
class Going:
    """Images that are being drawn in a window."""

    images: Drawn
    window: Window

    def end(self) -> None:
        """Gives back what it has borrowed."""
        self.images.close()
        self.window.give_back()


# How the material of each result was made, by the result's name, before an undo or a redo.
_before: Memory[str, str] = Memory()

going: Activity[Going] = Activity(Going.end, busy="Images are being written already")


def images_of(
    result: bpy.types.Object,
    context: bpy.types.Context,
    path: Path,
    kinds: Sequence[str],
    style: maps.Style,
    uv_map: str = "",
    progress: Callable[[float], None] = lambda share: None,
) -> Images:
    """Computes images of a result, and writes nothing.

    path     NAME.png or NAME.exr; the files are beside it
    kinds    some of maps.KINDS
    style    what the images are like, but for the colours, which are those of the look
    uv_map   its name; empty: the active one

    Raises DataError and core.MeanderError.
    """
    work = drawn_images(result, context, path, kinds, style, uv_map)
    return image_files.finished(work, progress)


def drawn_images(
    result: bpy.types.Object,
    context: bpy.types.Context,
    path: Path,
    kinds: Sequence[str],
    style: maps.Style,
    uv_map: str = "",
) -> Drawn:
    """The same piece by piece: gives the share that is done, and returns the images.

    All that it needs of the scene is read at once, so that this may be changed meanwhile.
    """
    surface, depsgraph = result.meander.surface, context.evaluated_depsgraph_get()
    corners = map_of(surface, depsgraph, uv_map)
    # Details of a cut are in half spacings.
    cut = cut_result(result, context.scene, depsgraph, 2.0 * maps.DETAIL, True)
    style = replace(style, ramp=look.ramp_colours(result))
    mapped = maps.Mapped.of(cut.cut, corners, cut.plan.spacing)
    files = image_files.drawn(mapped, path, kinds, style)
    return _drawn(files, cut.plan, result.name, surface.name)


def _drawn(
    files: Generator[float, None, tuple[dict[Path, bytes], float]],
    plan: Plan,
    name: str,
    surface: str,
) -> Drawn:
    try:
        found, overlap = yield from files
    except maps.NoPlace as problem:
        raise DataError(f"The UV map of '{surface}' {problem}") from problem
    return Images(found, overlap, plan, name)


# ------------------------------------------------------------------------------------------------
# A material of images


def make_material(
    result: bpy.types.Object,
    context: bpy.types.Context,
    kind: str,
    size: int,
    follows: bool = True,
    progress: Callable[[float], None] = lambda share: None,
) -> tuple[bpy.types.Material, float]:
    """Gives the surface of a result a material whose images show the line, packed into the file.

    kind      one of image_material.KINDS
    size      of the images, in pixels
    follows   the images are made again when the curve is another

    Returns it and the overlap of the UV map. Raises DataError and core.MeanderError.
    """
    surface, settings = result.meander.surface, result.meander
    uv_map = image_material.map_name(surface)
    data, found = _data_of(result, context, kind, size, uv_map, progress)
    material = image_material.new_material(
        f"{result.name} {kind.capitalize()}", kind, data, uv_map, found.plan.spacing
    )
    image_material.give(surface, material)
    record = {"kind": kind, "size": size, "uv_map": uv_map, "follows": follows}
    settings.made_material = material
    _note(result, record, data)
    return material, found.overlap


def is_due(result: bpy.types.Object) -> bool:
    """Whether the material of a result follows it and shows another curve."""
    record = _record(result)
    follows = record is not None and record["follows"]
    return follows and record["curve"] != digest_of_curve(result.data)


def make_again(result: bpy.types.Object, context: bpy.types.Context) -> list[str]:
    """Makes the images of a result's material again, in their places.

    Returns the names of those that were left alone since somebody has painted on them. Raises
    DataError and core.MeanderError.
    """
    record, material = _record(result), result.meander.made_material
    images = image_material.images_in(material)
    painted = [
        image.name
        for kind, image in images.items()
        if image.is_dirty or _digest(image_material.packed(image)) != record["images"].get(kind)
    ]
    if painted:
        return painted
    data, found = _data_of(result, context, record["kind"], record["size"], record["uv_map"])
    for kind, image in images.items():
        image_material.pack(image, data[kind])
    image_material.tell_spacing(material, found.plan.spacing)
    _note(result, record, data)
    return []


def on_undo_begin() -> None:
    """Before an undo or a redo."""
    _before.clear()
    _before.update((thing.name, thing.meander.made_material_by) for thing in bpy.data.objects)


def on_undo_end() -> None:
    """After it, which brings back the files that images hold, and not what is shown of them."""
    for thing in bpy.data.objects:
        settings = thing.meander
        if settings.made_material_by == _before.get(thing.name, "") or not settings.made_material:
            continue
        for image in image_material.images_in(settings.made_material).values():
            if not image.is_dirty:  # as it was painted
                image_material.read_again(image)


def _data_of(
    result: bpy.types.Object,
    context: bpy.types.Context,
    kind: str,
    size: int,
    uv_map: str,
    progress: Callable[[float], None] = lambda share: None,
) -> tuple[dict[str, bytes], Images]:
    recipe = image_material.KINDS[kind]
    style = maps.Style(size=size, line_width=recipe.line_width, depth=recipe.depth)
    path = Path("line.png")
    found = images_of(result, context, path, recipe.images, style, uv_map, progress)
    if len(found.files) > len(recipe.images):
        raise DataError(
            f"The UV map of '{result.meander.surface.name}' lies in several squares, and a "
            "material has one image of each kind; move it into one square, or use Write Images"
        )
    return dict(zip(recipe.images, found.files.values(), strict=True)), found


def _note(result: bpy.types.Object, record: dict, data: dict[str, bytes]) -> None:
    record |= {"curve": digest_of_curve(result.data)}
    record["images"] = {kind: _digest(file) for kind, file in data.items()}
    result.meander.made_material_by = json.dumps(record)


def _record(result: bpy.types.Object) -> dict | None:
    """How the material of a result was made; None where it has none that anything shows."""
    settings = result.meander
    material = settings.made_material
    if material is None or material.library is not None or not settings.made_material_by:
        return None
    if material.users - int(material.use_fake_user) < 2:  # its name here is one of them
        return None
    return json.loads(settings.made_material_by)


def _digest(data: bytes) -> str:
    return hashlib.blake2b(data, digest_size=8).hexdigest()
