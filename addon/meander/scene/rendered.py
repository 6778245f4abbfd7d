# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an object looks otherwise in a render than in the views: it has values for each of them.

Levels of subdivision, switches of modifiers, limits of Simplify, resolutions of curves and
metaballs, and the node Is Viewport. Blender evaluates for a render within one only, so a copy gets
the render's values where those of the views stand: nothing of the scene is changed for it.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any, NamedTuple

import bpy

# So many times the faces that the views show may those of the render be, or the views' are filled.
MOST_FACES = 4.0
# The values of a modifier for the views and for the render, and by which power of them faces grow.
_LEVELS = ("levels", "render_levels")
_STEPS = {
    "SUBSURF": _LEVELS,
    "MULTIRES": _LEVELS,
    "SCREW": ("steps", "render_steps"),
    "OCEAN": ("viewport_resolution", "resolution"),
}
_SUBDIVIDING = frozenset({"SUBSURF", "MULTIRES"})
# What gives no faces of its own.
_NO_SHAPE = frozenset({"COLLISION", "PARTICLE_SYSTEM", "SURFACE"})
_OF_SPLINES = frozenset({"CURVE", "SURFACE", "FONT"})

SUBDIVISIONS, MODIFIERS, RESOLUTION = "SUBDIVISIONS", "MODIFIERS", "RESOLUTION"

_most_faces: ContextVar[float] = ContextVar("_most_faces", default=MOST_FACES)


@contextmanager
def whatever_it_costs() -> Iterator[None]:
    """Has surfaces taken as rendered for the block, however many faces they have there."""
    before = _most_faces.set(float("inf"))
    try:
        yield
    finally:
        _most_faces.reset(before)


@dataclass(frozen=True)
class Rendering:
    """How a render of an object differs from what the views show.

    kind     SUBDIVISIONS, MODIFIERS or RESOLUTION: what is the cause, or the first of several
    cost     how many times the faces it has there, as far as numbers tell
    counted  numbers do not tell; the faces have to be counted
    is_set   values of the object or the scene say so, which make_same() can set
    """

    kind: str
    cost: float = 1.0
    counted: bool = False
    is_set: bool = True

    @property
    def may_be_filled(self) -> bool:
        """Whether a surface is filled as rendered, as far as that can be told without counting."""
        return self.cost <= _most_faces.get()

    def is_worth(self, rendered: int, shown: int) -> bool:
        """may_be_filled, once the corners of the faces of both are counted."""
        return rendered <= _most_faces.get() * shown


def rendering_of(thing: bpy.types.Object, scene: bpy.types.Scene) -> Rendering | None:
    """How the render of an object differs; None: not at all. Cheap, for panels."""
    found = list(_differences(thing, scene, {thing}))
    if not found:
        return None
    cost = 1.0
    for each in found:
        cost *= each.cost
    counted, is_set = (any(getattr(each, name) for each in found) for name in ("counted", "is_set"))
    return Rendering(found[0].kind, cost, counted, is_set)


def _differences(
    thing: bpy.types.Object, scene: bpy.types.Scene, known: set[bpy.types.Object]
) -> Iterator[Rendering]:
    for modifier in thing.modifiers:
        if modifier.type in _NO_SHAPE:
            continue
        shown, rendered = modifier.show_viewport, modifier.show_render
        if modifier.type in _SUBDIVIDING:
            view, render = _levels_of(modifier, scene)
            if view != render:
                yield Rendering(SUBDIVISIONS, 4.0 ** (render - view))
        elif shown != rendered:
            yield Rendering(MODIFIERS, counted=True)
        elif shown and modifier.type in _STEPS:
            view, render = (getattr(modifier, name) for name in _STEPS[modifier.type])
            if view != render:
                yield Rendering(RESOLUTION, counted=True)
        if shown or rendered:
            if modifier.type == "NODES" and _asks_for_viewport(modifier.node_group, set()):
                yield Rendering(MODIFIERS, counted=True, is_set=False)
            for _name, other in _operands(modifier):
                if other not in known and any(_differences(other, scene, known | {other})):
                    yield Rendering(MODIFIERS, counted=True, is_set=False)
    ratio = _resolution_ratio(thing)
    if ratio != 1.0:
        yield Rendering(RESOLUTION, ratio)


def _levels_of(modifier: bpy.types.Modifier, scene: bpy.types.Scene) -> tuple[int, int]:
    """The levels of subdivision in the views, and in a render."""
    view = modifier.levels if modifier.show_viewport else 0
    render = modifier.render_levels if modifier.show_render else 0
    if scene.render.use_simplify:
        view = min(view, scene.render.simplify_subdivision)
        render = min(render, scene.render.simplify_subdivision_render)
    return view, render


def _resolution_ratio(thing: bpy.types.Object) -> float:
    """How many times the faces of curves, texts, surfaces and metaballs there are in a render."""
    data = thing.data
    if thing.type == "META":
        return (data.resolution / data.render_resolution) ** 2
    if thing.type not in _OF_SPLINES:
        return 1.0
    ratio = 1.0
    for axis in _axes(thing):
        render = getattr(data, f"render_resolution_{axis}")
        views = [getattr(each, f"resolution_{axis}") for each in _of_resolution(thing)]
        if render and any(view != render for view in views):
            ratio *= render / max(min(views), 1)
    return ratio


def _axes(thing: bpy.types.Object) -> str:
    return "uv" if thing.type == "SURFACE" else "u"


def _of_resolution(thing: bpy.types.Object) -> list[Any]:
    """What has the resolution for the views: the splines; a text makes its own."""
    if thing.type == "FONT":
        return [thing.data]
    return [spline for spline in thing.data.splines if spline.type != "POLY"]


def _operands(modifier: bpy.types.Modifier) -> Iterator[tuple[str, bpy.types.Object]]:
    """The objects that a modifier has as its properties, with the names of these."""
    for property in modifier.bl_rna.properties:
        if property.type == "POINTER" and property.fixed_type.identifier == "Object":
            value = getattr(modifier, property.identifier)
            if value is not None and not property.is_readonly:
                yield property.identifier, value


def _asks_for_viewport(group: bpy.types.NodeTree | None, known: set[bpy.types.NodeTree]) -> bool:
    """Whether nodes tell views from renders."""
    if group is None or group in known:
        return False
    known.add(group)
    return any(
        node.bl_idname == "GeometryNodeIsViewport"
        or node.type == "GROUP"
        and _asks_for_viewport(node.node_tree, known)
        for node in group.nodes
    )


# ------------------------------------------------------------------------------------------------
# A copy as rendered


class _Values(NamedTuple):
    """What has a value for the views, and one for the render."""

    owner: Any
    view: str
    render: str


def _values_of(thing: bpy.types.Object) -> Iterator[_Values]:
    for modifier in thing.modifiers:
        if modifier.type in _STEPS:
            yield _Values(modifier, *_STEPS[modifier.type])
        yield _Values(modifier, "show_viewport", "show_render")
    if thing.type == "META":
        yield _Values(thing.data, "resolution", "render_resolution")


class RenderedCopies:
    """Copies that have the values of the render where those of the views were, until remove()."""

    def __init__(self) -> None:
        self._objects: list[bpy.types.Object] = []
        self._others: list[bpy.types.ID] = []
        self._copies: dict[bpy.types.Object, bpy.types.Object] = {}
        self._groups: dict[bpy.types.NodeTree, bpy.types.NodeTree] = {}

    def prepare(
        self, copy: bpy.types.Object, original: bpy.types.Object, scene: bpy.types.Scene
    ) -> None:
        """Gives a copy, whose data is the original's, the values of the render.

        scene   the one that shows the original
        """
        self._copies[original] = copy
        if copy.type == "META" or copy.type in _OF_SPLINES:
            data = copy.data.copy()
            self._others.append(data)
            if copy.type == "META":
                # Before an object has it: Blender hands on the resolution to all metaballs that
                # are called alike, the user's too.
                data.resolution = data.render_resolution
            copy.data = data
        for owner, view, render in _values_of(copy):
            owner.driver_remove(view)
            if getattr(owner, view) != getattr(owner, render):
                setattr(owner, view, getattr(owner, render))
        if copy.type in _OF_SPLINES:
            _give_render_resolution(copy)
        for modifier in copy.modifiers:
            if modifier.type == "NODES" and _asks_for_viewport(modifier.node_group, set()):
                modifier.node_group = self._group(modifier.node_group)
            for name, other in list(_operands(modifier)):
                if other in self._copies or any(_differences(other, scene, {other})):
                    setattr(modifier, name, self._copy(other, scene))

    def family(
        self, copy: bpy.types.Object, original: bpy.types.Object, scene: bpy.types.Scene
    ) -> list[bpy.types.Object]:
        """Copies of the metaballs that are one body with an object, its own among them, named so
        that they are one too: the first has the faces. None for any other object.
        """
        if copy.type != "META":
            return []
        stem, _number = _parts(original)
        others = sorted(
            (
                one
                for one in scene.objects
                if one.type == "META" and _parts(one)[0] == stem
                if one == original or not one.hide_render
            ),
            key=_parts,
        )
        members = [copy if one == original else self._copy(one, scene) for one in others]
        for number, member in enumerate(members):
            member.name = f"Meander Ball.{number + 1:03}"
        return members

    def _copy(self, other: bpy.types.Object, scene: bpy.types.Scene) -> bpy.types.Object:
        if other not in self._copies:
            copy = other.copy()
            self._objects.append(copy)
            self.prepare(copy, other, scene)
        return self._copies[other]

    def _group(self, group: bpy.types.NodeTree) -> bpy.types.NodeTree:
        """A copy of nodes in which Is Viewport says no."""
        if group in self._groups:
            return self._groups[group]
        copy = self._groups[group] = group.copy()
        self._others.append(copy)
        for node in list(copy.nodes):
            if node.type == "GROUP" and _asks_for_viewport(node.node_tree, set()):
                node.node_tree = self._group(node.node_tree)
            elif node.bl_idname == "GeometryNodeIsViewport":
                no = copy.nodes.new("FunctionNodeInputBool")
                no.boolean = False
                for link in list(node.outputs[0].links):
                    copy.links.new(no.outputs[0], link.to_socket)
        return copy

    def remove(self) -> None:
        """Removes what was made; the copy itself is the caller's."""
        for thing in self._objects:
            bpy.data.objects.remove(thing)
        if self._others:
            bpy.data.batch_remove(self._others)


def _parts(thing: bpy.types.Object) -> tuple[str, int]:
    """The name without its number, and the number."""
    head, _dot, tail = thing.name.rpartition(".")
    return (head, int(tail)) if head and tail.isdigit() else (thing.name, 0)


def _give_render_resolution(thing: bpy.types.Object) -> None:
    for axis in _axes(thing):
        render = getattr(thing.data, f"render_resolution_{axis}")
        if render:  # 0 is the views'
            for each in (thing.data, *_of_resolution(thing)):
                setattr(each, f"resolution_{axis}", render)


# ------------------------------------------------------------------------------------------------
# The views as the render, and the render as the views


def make_same(thing: bpy.types.Object, scene: bpy.types.Scene, as_rendered: bool) -> None:
    """Sets the values of an object for the views to those for the render, or the other way; the
    limits of Simplify too, where these make the difference."""
    for owner, view, render in _values_of(thing):
        source, target = (render, view) if as_rendered else (view, render)
        setattr(owner, target, getattr(owner, source))
    if thing.type in _OF_SPLINES:
        if as_rendered:
            _give_render_resolution(thing)
        else:  # which is told by 0
            for axis in _axes(thing):
                setattr(thing.data, f"render_resolution_{axis}", 0)
    limits, left = scene.render, rendering_of(thing, scene)
    if left is not None and left.kind == SUBDIVISIONS:
        if as_rendered:
            limits.simplify_subdivision = limits.simplify_subdivision_render
        else:
            limits.simplify_subdivision_render = limits.simplify_subdivision
