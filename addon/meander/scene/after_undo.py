# SPDX-License-Identifier: GPL-3.0-or-later
"""Subdivided meshes that can be read after an undo or a redo.

Where the graphics card subdivides, the evaluated mesh of an object is its cage, which refers to
data of the Subdivision Surface modifier: by them the rest is made for whoever reads the mesh. An
undo reads an object back whose settings it changes, and with it modifiers under new numbers.
Blender then frees the data of the old ones, but keeps the evaluated mesh where the shape is the
same. Who reads that mesh gets the cage, or a crash. Hence such an object is evaluated anew before
anything can read it. Later versions give modifiers numbers that last (`persistent_uid`), by which
they keep their data; 4.5 has them.
"""

from __future__ import annotations

import bpy

from .changes import uncounted

# Names of the objects of which all but the shape was evaluated since an undo began; None while
# nothing is undone.
_restored: set[str] | None = None


def _is_subdivided(object: bpy.types.Object) -> bool:
    return any(modifier.type == "SUBSURF" for modifier in object.modifiers)


def _needed() -> bool:
    """Whether modifiers have no lasting numbers, and something is drawn."""
    lasting = "persistent_uid" in bpy.types.Modifier.bl_rna.properties
    return not lasting and not bpy.app.background


def begin() -> None:
    """An undo or redo begins."""
    global _restored
    _restored = set() if _needed() else None


def on_update(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph | None = None) -> None:
    if _restored is None or depsgraph is None:
        return
    for update in depsgraph.updates:
        if isinstance(update.id, bpy.types.Object) and not update.is_updated_geometry:
            _restored.add(update.id.original.name)


def end() -> None:
    """Evaluates what the undo has changed, and then the meshes that it has damaged."""
    global _restored
    if _restored is None:
        return
    layers = [window.view_layer for window in bpy.context.window_manager.windows]
    for layer in layers:
        layer.update()
    names, _restored = _restored, None
    # Linked ones, which have a library, are not read back.
    restored = [bpy.data.objects.get((name, None)) for name in names]
    damaged = [thing for thing in restored if thing is not None and _is_subdivided(thing)]
    if not damaged:
        return
    for thing in damaged:
        thing.update_tag(refresh={"DATA"})
    with uncounted():
        for layer in layers:
            layer.update()
