# SPDX-License-Identifier: GPL-3.0-or-later
"""A layout that stands in for Blender's, notes what a panel draws, and measures whether it fits.

What Blender does with a text that is too wide is to cut its middle out. The widths are those of the
sidebar as it is when it is first opened, 220 pixels with its tabs at a resolution scale of 1; they
were read off pictures of Blender 3.4.1. Texts are measured by Blender itself.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import blf
import bpy

# Between the left and the right end of what stands in a panel, in pixels.
PANEL = 173.0
# Blender's share of the labels where a property is split.
LABELS = 0.4
# What a text has around it: at one side in labels, with a check box, an icon, an arrow.
MARGIN, BOX, ICON, ARROW = 9.0, 21.0, 20.0, 16.0
# What stands beside a name in a field.
NUMBER = "0.000"


def width_of(text: str) -> float:
    """Pixels of a text in the sidebar."""
    size = bpy.context.preferences.ui_styles[0].widget.points
    try:
        blf.size(0, size)
    except TypeError:  # before Blender 4.0
        blf.size(0, round(size), 72)
    return blf.dimensions(0, text)[0]


@dataclass
class Text:
    """A text and what it has to fit into."""

    text: str
    room: float

    @property
    def excess(self) -> float:
        return width_of(self.text) - self.room


@dataclass
class Item:
    """A property, a button or a text."""

    kind: str
    label: str = ""
    icon: bool = False
    values: tuple[str, ...] = ()
    expanded: bool = False
    split: bool = False
    buttons: int = 0  # behind the value

    @property
    def small(self) -> bool:
        """An icon, which takes no share of its row."""
        return self.kind in {"operator", "label", "BOOLEAN"} and not self.label

    def texts(self, width: float) -> list[Text]:
        if self.kind == "label":
            return [Text(self.label, width - MARGIN - (ICON if self.icon else 0.0))]
        if self.kind == "operator":
            return [Text(self.label, width - MARGIN - (ICON if self.icon else 0.0))]
        if self.kind == "BOOLEAN":
            room = width * (1.0 - LABELS) if self.split else width
            return [Text(self.label, room - BOX)]
        found = []
        if self.split and self.label:
            found.append(Text(self.label, width * LABELS - MARGIN))
            width *= 1.0 - LABELS
        elif self.label:
            number = MARGIN + width_of(NUMBER) if self.kind in {"FLOAT", "INT"} else 0.0
            found.append(Text(self.label, width - 2.0 * MARGIN - number))
        if self.expanded:
            found += [Text(value, width / len(self.values) - 6.0) for value in self.values]
        else:
            icon = ICON if self.icon else 0.0
            icon += self.buttons * ICON
            found += [Text(value, width - MARGIN - ARROW - icon) for value in self.values]
        return found


@dataclass
class Layout:
    """Takes every call of a UILayout that panels make."""

    direction: str = "column"
    use_property_split: bool = False
    heading: str = ""
    factor: float = 0.0
    children: list[Any] = field(default_factory=list)

    def _add(self, child: Any) -> Any:
        self.children.append(child)
        return child

    def _inside(self, direction: str, **given: Any) -> Layout:
        return self._add(Layout(direction, self.use_property_split, **given))

    def column(self, align: bool = False, heading: str = "") -> Layout:
        return self._inside("column", heading=heading)

    def row(self, align: bool = False, heading: str = "") -> Layout:
        return self._inside("row", heading=heading)

    def box(self) -> Layout:
        return self._inside("column")

    def split(self, factor: float = 0.0, align: bool = False) -> Layout:
        return self._inside("split", factor=factor)

    def separator(self, **_options: Any) -> None:
        pass

    def prop(
        self, data: Any, name: str, text: str | None = None, icon: str = "NONE",
        expand: bool = False, icon_only: bool = False, **_options: Any,
    ) -> None:
        if name.startswith("["):  # an input of a modifier's group
            data.path_resolve(name)
            self._add(Item("FLOAT", text, icon != "NONE", split=self.use_property_split))
            return
        known = data.bl_rna.properties[name]
        label = known.name if text is None else text
        values: tuple[str, ...] = ()
        if known.type == "ENUM" and expand:
            values = tuple(item.name for item in known.enum_items)
        elif known.type == "ENUM":
            values = (known.enum_items[getattr(data, name)].name,)
        elif known.type == "POINTER" and isinstance(getattr(data, name), bpy.types.ID):
            values = (getattr(data, name).name,)
        kind = known.type
        has_icon = icon != "NONE"
        if kind == "BOOLEAN" and (self.heading or icon_only):
            kind, self.heading = "BOOLEAN", ""
        self._add(Item(kind, label, has_icon, values, expand, self.use_property_split))

    def prop_search(
        self, data: Any, name: str, source: Any, items: str, text: str | None = None,
        **_options: Any,
    ) -> None:
        assert hasattr(source, items)
        self.prop(data, name, text)

    def template_ID(
        self, data: Any, name: str, text: str | None = None, **_options: Any
    ) -> None:
        """A name between an icon and five buttons where there is something, as in pictures."""
        self.prop(data, name, text)
        item = self.children[-1]
        item.split = item.split and text != ""
        item.buttons = 5 if item.values else 0

    def operator(
        self, idname: str, text: str | None = None, icon: str = "NONE", **_options: Any
    ) -> SimpleNamespace:
        kind, name = idname.split(".")
        label = getattr(getattr(bpy.ops, kind), name).get_rna_type().name
        self._add(Item("operator", label if text is None else text, icon != "NONE"))
        return SimpleNamespace()

    def operator_menu_enum(
        self, idname: str, name: str, text: str = "", icon: str = "NONE", **_options: Any
    ) -> None:
        kind, operator = idname.split(".")
        options = getattr(getattr(bpy.ops, kind), operator).get_rna_type().properties
        assert options[name].type == "ENUM"
        self._add(Item("operator", text, icon != "NONE"))

    def menu(self, _idname: str, text: str = "", icon: str = "NONE", **_options: Any) -> None:
        self._add(Item("operator", text, icon != "NONE"))

    def popover(self, panel: str, text: str = "", icon: str = "NONE", **_options: Any) -> None:
        assert hasattr(bpy.types, panel)
        self._add(Item("operator", text, icon != "NONE"))

    def label(self, text: str = "", icon: str = "NONE", **_options: Any) -> None:
        self._add(Item("label", text, icon != "NONE"))

    def progress(self, text: str = "", **_options: Any) -> None:
        self._add(Item("operator", text))

    def template_curve_mapping(self, *_arguments: Any, **_options: Any) -> None:
        pass

    def template_color_ramp(self, *_arguments: Any, **_options: Any) -> None:
        pass

    def texts(self, width: float = PANEL) -> list[Text]:
        """Everything in it, with the room that it has in a layout of this width."""
        found = []
        if self.heading:
            found.append(Text(self.heading, LABELS * width - MARGIN))
        small = sum(isinstance(child, Item) and child.small for child in self.children)
        large = len(self.children) - small
        for place, child in enumerate(self.children):
            if isinstance(child, Item) and child.small:
                continue
            if self.direction == "column":
                room = width
            elif self.direction == "split" and self.factor:
                room = width * (self.factor if place == 0 else 1.0 - self.factor)
            elif self.use_property_split and isinstance(child, Item) and child.split and large == 1:
                # The label has its share of the whole row; what is small is beside the value.
                found += child.texts(width)[: 1 if child.label else 0]
                found += [
                    Text(text.text, text.room - small * ICON)
                    for text in child.texts(width)[1 if child.label else 0 :]
                ]
                continue
            else:
                room = (width - small * ICON) / large
            found += child.texts(room)
        return found


def drawn(panel: type[bpy.types.Panel], context: bpy.types.Context) -> Layout | None:
    """What a panel draws now; None if it is hidden."""
    if hasattr(panel, "poll") and not panel.poll(context):
        return None
    layout = Layout()

    class Drawn:
        def __getattr__(self, name: str) -> Any:
            return getattr(panel, name).__get__(self)

    panel_of_layout = Drawn()
    panel_of_layout.layout = layout
    panel.draw(panel_of_layout, context)
    return layout


def texts_of(panel: type[bpy.types.Panel]) -> list[str]:
    """All that a panel says now, from top to bottom; nothing if it is hidden."""
    layout = drawn(panel, bpy.context)
    return [] if layout is None else [text.text for text in layout.texts()]


def panels() -> list[type[bpy.types.Panel]]:
    """All panels of the tab."""
    found, open_ones = [], [bpy.types.Panel]
    while open_ones:
        cls = open_ones.pop()
        open_ones += cls.__subclasses__()
        if getattr(cls, "bl_category", "") == "Meander" and getattr(cls, "is_registered", False):
            found.append(cls)
    return sorted(found, key=lambda cls: cls.__name__)
