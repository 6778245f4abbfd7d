# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: takes the pictures of docs/gallery.md, each from an empty scene.

    bash docs/pictures/make.sh gallery

Leaves PICTURE.png for each, all of them if none is named. Those in docs/images/gallery have been
reduced to 128 colours since, by `pngquant 128`.
"""

from __future__ import annotations

import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "docs" / "pictures")]

import gallery_scenes  # noqa: E402
import meander  # noqa: E402
import studio  # noqa: E402
import tone_scenes  # noqa: E402, F401

SIZE = (560, 448)
SAMPLES = 64


def main(folder: str, names: list[str]) -> None:
    scenes = gallery_scenes.SCENES
    unknown = [name for name in names if name not in scenes]
    if unknown:
        raise SystemExit(f"no picture {unknown[0]}; there are {', '.join(scenes)}")
    for name in names or scenes:
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        scenes[name]()
        studio.take_picture(str(Path(folder).resolve() / f"{name}.png"), SIZE, SAMPLES)
        print(f"{name}: done", flush=True)


meander.register()
try:
    main(sys.argv[sys.argv.index("--") + 1], sys.argv[sys.argv.index("--") + 2 :])
finally:
    meander.unregister()
