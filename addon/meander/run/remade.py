# SPDX-License-Identifier: GPL-3.0-or-later
"""What was made of a curve, made again when the curve is another.

Each object that a maker has left keeps how: the maker and its values, which of its objects it is,
of which curve it was made, and what its points were. Only its mesh is replaced: place, modifiers,
materials and name stay as they are. What somebody has edited is left alone, and said.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import bpy
import numpy as np

from .. import core
from ..scene.columns import column
from ..scene.drawn_line import digest_of_curve, digest_of_points
from ..scene.errors import DataError
from ..scene.look import set_value, value_of
from ..scene.made import name_curve
from . import images, makers


def note(
    made: list[bpy.types.Object], result: bpy.types.Object, kind: str, values: makers.Values
) -> None:
    """Notes on objects that a maker has made how to make them again."""
    name_curve(made, result)
    group = 1 + max((record["group"] for _thing, record in _records(result)), default=0)
    for part, thing in enumerate(made):
        _note(thing, result, {"maker": kind, "values": values, "group": group, "part": part})


def _note(thing: bpy.types.Object, result: bpy.types.Object, record: dict[str, Any]) -> None:
    record |= {"curve": digest_of_curve(result.data), "points": _digest(thing.data)}
    record["spacing"] = next((value for _modifier, value in _told_spacing(thing)), 0.0)
    thing.meander.made_by = json.dumps(record)


def is_due(result: bpy.types.Object) -> bool:
    """Whether an object that follows a result was made of another curve than it is."""
    curve = digest_of_curve(result.data)
    return any(record["curve"] != curve for _thing, record in _followers(result))


def make_again(
    result: bpy.types.Object,
    context: bpy.types.Context,
    asked: Iterable[bpy.types.Object] | None = None,
) -> tuple[list[str], list[str]]:
    """Makes again what follows a result and was made of another curve.

    asked   these instead, whether they follow or were edited or not

    Returns the names of what was made, and of what was left alone as somebody has edited it.
    Raises DataError and core.MeanderError; what is there stays then.
    """
    curve, left = digest_of_curve(result.data), []
    groups: dict[int, list[tuple[bpy.types.Object, dict[str, Any]]]] = {}
    wanted = None if asked is None else set(asked)
    for thing, record in _records(result) if wanted is not None else _followers(result):
        if wanted is not None and thing not in wanted:
            continue
        if wanted is None and record["curve"] == curve:
            continue
        if wanted is None and (thing.mode != "OBJECT" or _digest(thing.data) != record["points"]):
            left.append(thing.name)
            continue
        groups.setdefault(record["group"], []).append((thing, record))
    names: list[str] = []
    for things in groups.values():
        record = things[0][1]
        found = makers.make(
            record["maker"],
            record["values"],
            result,
            context.scene,
            context.evaluated_depsgraph_get(),
        )
        names += _exchange(things, found[0], result)
    return names, left


def _exchange(
    things: list[tuple[bpy.types.Object, dict[str, Any]]],
    made: list[bpy.types.Object],
    result: bpy.types.Object,
) -> list[str]:
    """Gives objects the data of those that were made in their place, which go."""
    given: dict[str, bpy.types.ID] = {}
    taken: set[int] = set()
    for thing, record in things:
        if record["part"] >= len(made):
            continue
        new, before = made[record["part"]], thing.data
        if before.name not in given:  # duplicates may share their data
            given[before.name] = new.data if record["part"] not in taken else new.data.copy()
            taken.add(record["part"])
            _keep_looks(before, given[before.name])
        thing.data = given[before.name]
        spacing = next((value for _modifier, value in _told_spacing(new)), 0.0)
        for modifier, value in _told_spacing(thing):
            if math.isclose(value, record["spacing"], rel_tol=1e-5):
                set_value(modifier, makers.SPACING, spacing)
        _note(thing, result, record)
        if record["spacing"] != spacing and spacing:
            thing.update_tag()
    for part, new in enumerate(made):
        data = new.data
        bpy.data.objects.remove(new)
        if part not in taken:
            bpy.data.batch_remove([data])
    for before in [bpy.data.meshes.get(name) or bpy.data.curves.get(name) for name in given]:
        if before is not None and before.users == 0:
            name = before.name
            bpy.data.batch_remove([before])
            given[name].name = name
    return [thing.name for thing, _record in things]


def _keep_looks(before: bpy.types.ID, data: bpy.types.ID) -> None:
    """Gives data the materials of that in whose place it comes, and a curve its thickness."""
    for index, material in enumerate(before.materials):
        if index < len(data.materials):
            data.materials[index] = material
        else:
            data.materials.append(material)
    if isinstance(data, bpy.types.Curve):
        data.bevel_depth = before.bevel_depth


def _told_spacing(thing: bpy.types.Object) -> Iterator[tuple[bpy.types.Modifier, float]]:
    """The modifiers of an object that are told a spacing."""
    for modifier in thing.modifiers:
        if modifier.type == "NODES" and modifier.node_group is not None:
            value = value_of(modifier, makers.SPACING)
            if value is not None:
                yield modifier, float(value)


def _records(result: bpy.types.Object) -> Iterator[tuple[bpy.types.Object, dict[str, Any]]]:
    """The objects that makers have made of a result, each with what it keeps."""
    for thing in bpy.data.objects:
        settings = thing.meander
        if settings.made_from == result and settings.made_by and thing.library is None:
            if thing.users_scene:
                yield thing, json.loads(settings.made_by)


def _followers(result: bpy.types.Object) -> Iterator[tuple[bpy.types.Object, dict[str, Any]]]:
    return (each for each in _records(result) if each[0].meander.keep_up)


def _digest(data: bpy.types.ID) -> str:
    """Another text for other points."""
    if isinstance(data, bpy.types.Curve):
        return digest_of_curve(data)
    corners = column(data.loops, "vertex_index", kind=np.int32)
    return digest_of_points([column(data.vertices, "co", 3), corners])


def follow(result: bpy.types.Object, context: bpy.types.Context) -> str:
    """Makes again the objects that follow a result. Returns what to warn of; empty if nothing."""
    return _told(result, lambda: make_again(result, context)[1])


def follow_with_images(result: bpy.types.Object, context: bpy.types.Context) -> str:
    """The same of the images of its material, which take seconds."""
    if not images.is_due(result):
        return ""
    return _told(result, lambda: images.make_again(result, context))


def _told(result: bpy.types.Object, made: Callable[[], list[str]]) -> str:
    try:
        left = made()
    except (DataError, core.MeanderError) as error:
        return f"What was made of {result.name} is of its curve before: {error}"
    if not left:
        return ""
    are = "was edited and is" if len(left) == 1 else "were edited and are"
    return f"{', '.join(left)} {are} not made again; a button does so"


def on_render() -> None:
    """Makes images that are due before a picture is rendered."""
    for thing in [each for each in bpy.data.objects if each.type == "CURVE"]:
        follow_with_images(thing, bpy.context)
