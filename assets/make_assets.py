# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: makes the asset file of the add-on, its node groups and materials.

    blender -b --factory-startup --python-exit-code 1 --python assets/make_assets.py -- [FOLDER]

FOLDER is addon/meander/assets by default. Run it in Blender 3.4, whose files every later Blender
reads. The file is kept with the sources, since not every machine that packs the add-on has a
Blender; tests/blender/test_assets.py compares it with what this script makes.
"""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "assets"), str(ROOT / "addon")]

from asset_groups import nodes  # noqa: E402  (the path comes first)
from meander.scene.assets import MARK, VERSION  # noqa: E402

# In the order in which one needs another.
MODULES = ("materials", "look", "making", "growth")
_CATALOGS = """\
# This is an Asset Catalog Definition file for Blender.
VERSION 1

"""


def build() -> list[bpy.types.ID]:
    """Makes all of them in the open file, which has none of their names."""
    blocks: list[bpy.types.ID] = []
    for name in MODULES:
        blocks += importlib.import_module(f"asset_groups.{name}").build()
    for block in blocks:
        block[MARK] = VERSION
    return blocks


def main() -> None:
    if not (3, 4) <= bpy.app.version[:2] < (3, 5):
        raise SystemExit("The asset file is made in Blender 3.4; later ones read it")
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    folder = Path(arguments[0]) if arguments else ROOT / "addon" / "meander" / "assets"
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    blocks = build()
    path = folder / "meander.blend"
    bpy.data.libraries.write(str(path), set(blocks), fake_user=True, compress=True)
    lines = (f"{number}:Meander/{name}:Meander-{name}\n" for name, number in nodes.CATALOGS.items())
    (folder / "blender_assets.cats.txt").write_text(_CATALOGS + "".join(lines), encoding="utf-8")
    print(f"{path}: {len(blocks)} assets, {path.stat().st_size / 1024:.0f} KiB")


if __name__ == "__main__":
    main()
