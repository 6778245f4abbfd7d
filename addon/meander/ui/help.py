# SPDX-License-Identifier: GPL-3.0-or-later
"""The way from the panel to the pages: a button, and Blender's own Online Manual on every setting.

The pages are those of the website that the manifest names. As long as it names none they are the
ones that come with the add-on, in its folder `docs`, and from the sources those of the site that
scripts/build_site.sh makes.
"""

from __future__ import annotations

import webbrowser
from pathlib import Path

import bpy
from bpy.props import EnumProperty

_HOME = Path(__file__).resolve().parents[1]
# Beside the sources, where the add-on is used without being installed.
_OF_THE_SOURCES = _HOME.parents[1] / "build" / "site"

PAGES = (
    ("index", "Start", "The first curve"),
    ("settings", "Settings", "Every setting, from low to high"),
    ("look", "Look", "Thickness, profile and colors"),
    ("live", "Live", "A curve that follows its settings"),
    ("making", "Make", "Two colors, reliefs and ribbons"),
    ("density", "Density", "Where strands are closer"),
    ("strands", "Strands", "Seeds, strokes and guides"),
    ("terms", "Direction and Shape", "What strands run along, and how they bend"),
    ("surfaces", "Surfaces", "Parts of a mesh, boundaries and faults"),
    ("motion", "Motion", "Surfaces that move"),
    ("export", "Export", "Files for machines and drawings"),
    ("options", "Options", "Every setting and flag, with its range and default"),
    ("messages", "Messages", "What messages mean"),
)
# What a setting or an operator begins with, and its page: Blender takes the first that fits, and
# knows all names in lower case.
_OF_SETTINGS = (
    ("density_*", "density"),
    ("factor_*", "density"),
    ("use_density*", "density"),
    ("tone_*", "density"),
    ("alignment_*", "terms"),
    ("align_across", "terms"),
    ("*_weight", "terms"),
    ("*_power", "terms"),
    ("reach*", "terms"),
    ("segment_share*", "terms"),
    ("start_spacing_factor", "terms"),
    ("seed*", "strands"),
    ("stroke_*", "strands"),
    ("*guide*", "strands"),
    ("fixed_ends", "strands"),
    ("mirror", "surfaces"),
    ("hide_seam", "surfaces"),
    ("mask_*", "surfaces"),
    ("border_distance", "surfaces"),
    ("use_outline", "surfaces"),
    ("motion*", "motion"),
    ("follow", "motion"),
    ("*light*", "export"),
    ("points_as", "export"),
    ("live", "live"),
    ("use_bevel", "look"),
    ("bevel_*", "look"),
    ("profile", "look"),
    ("radius_follows", "look"),
    ("*", "settings"),
)
_OF_OPERATORS = (
    ("*seed*", "strands"),
    ("*stroke*", "strands"),
    ("*bake*", "motion"),
    ("*export*", "export"),
    ("points_to_*", "export"),
    ("make_light", "export"),
    ("two_tone", "making"),
    ("maps", "making"),
    ("maze", "making"),
    ("draw_camera", "export"),
    ("relief", "making"),
    ("ribbon", "making"),
    ("cut_along_curve", "making"),
    ("add_look", "look"),
    ("live", "live"),
    ("*", "index"),
)


def website() -> str:
    """The address of the website that the manifest names, with a slash at its end; empty: none."""
    for line in (_HOME / "blender_manifest.toml").read_text(encoding="utf-8").splitlines():
        name, equals, value = line.partition("=")
        if equals and name.strip() == "website":
            return value.strip().strip('"').rstrip("/") + "/"
    return ""


def address_of(page: str) -> str:
    """Where a page of PAGES is."""
    site = website()
    return f"{site}{page}.html" if site else _file_of(page).as_uri()


def _file_of(page: str) -> Path:
    folder = _HOME / "docs"
    return (folder if folder.is_dir() else _OF_THE_SOURCES) / f"{page}.html"


def manual_map() -> tuple[str, tuple[tuple[str, str], ...]]:
    """For bpy.utils.register_manual_map: a prefix, and a page for each pattern of names."""
    settings = ((f"bpy.types.meandersettings.{name}", page) for name, page in _OF_SETTINGS)
    operators = ((f"bpy.ops.meander.{name}", page) for name, page in _OF_OPERATORS)
    return "", tuple((pattern, address_of(page)) for pattern, page in (*settings, *operators))


class MEANDER_OT_open_help(bpy.types.Operator):
    """Open the pages about this add-on"""

    bl_idname = "meander.open_help"
    bl_label = "Meander Help"

    page: EnumProperty(
        name="Page", description="Which page to open", items=PAGES, options={"SKIP_SAVE"}
    )

    def execute(self, _context: bpy.types.Context) -> set[str]:
        address = address_of(self.page)
        if not website() and not _file_of(self.page).is_file():
            self.report({"ERROR"}, "The pages are not built; run scripts/build_site.sh")
            return {"CANCELLED"}
        if not webbrowser.open(address):
            self.report({"WARNING"}, f"No browser opens; the page is {address}")
        return {"FINISHED"}


def register() -> None:
    bpy.utils.register_class(MEANDER_OT_open_help)
    bpy.utils.register_manual_map(manual_map)


def unregister() -> None:
    bpy.utils.unregister_manual_map(manual_map)
    bpy.utils.unregister_class(MEANDER_OT_open_help)
