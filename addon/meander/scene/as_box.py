# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that the views draw as mere boxes for a while, without a trace in the data.

Only the evaluated copy that the dependency graph draws is told so. The object itself stays as it
is, so that no undo step, file, autosave or crash can keep it from being seen; and the worst that
can happen is that it is drawn in full, when the graph makes a new copy. Of what the views obey,
the kind of display alone is never taken over from the copy: hiding it would deselect the object.
"""

from __future__ import annotations

import bpy


def draw_as_box(object: bpy.types.Object, box: bool, scene: bpy.types.Scene) -> None:
    """Lets the views of a scene draw an object as a box of its size, or as it is."""
    wanted = "BOUNDS" if box else object.display_type
    for layer in scene.view_layers:
        if layer.depsgraph is None:  # no window shows it
            continue
        evaluated = object.evaluated_get(layer.depsgraph)
        # An object that the graph does not have is its own copy.
        if evaluated.is_evaluated and evaluated.display_type != wanted:
            evaluated.display_type = wanted
