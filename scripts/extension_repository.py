# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a folder that Blender can install Meander from: the zips, index.json, and a page.

    python3 scripts/extension_repository.py FOLDER ZIP...

Served by any web server, or by its path as file:///FOLDER/index.json, the folder is an extension
repository for Blender 4.2 and later: Preferences, Get Extensions, Repositories, Add Remote
Repository. Blender then offers updates from it.

index.json is written by Blender's own command, which needs no Blender to run: that of the newest
build/bpy-*. Zips that are in the folder already stay, so that a repository keeps old versions.
Exit code 2 and one sentence where something is missing; then nothing is written.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
COMMAND = "scripts/addons_core/bl_pkg/cli/blender_ext.py"


def blenders_command() -> Path | None:
    """Blender's command for extensions, of the newest version in build/."""
    found = ROOT.glob(f"build/bpy-*/lib/python3.*/site-packages/bpy/*/{COMMAND}")
    numbered = {tuple(map(int, path.parents[4].name.split("."))): path for path in found}
    return numbered[max(numbered)] if numbered else None


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("zips", type=Path, nargs="+", metavar="ZIP")
    arguments = parser.parse_args()
    command = blenders_command()
    if command is None:
        print(
            "No Blender in build/ makes the index: run scripts/install_dependencies.sh --bpy 4.5",
            file=sys.stderr,
        )
        return 2
    for path in arguments.zips:
        if not path.is_file():
            print(f"{path} is not a file; give the zips of a release", file=sys.stderr)
            return 2
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for path in arguments.zips:
        if path.resolve().parent != arguments.folder.resolve():
            shutil.copy(path, arguments.folder)
    done = subprocess.run(
        [sys.executable, command, "server-generate", "--repo-dir", arguments.folder, "--html"],
        stdout=subprocess.DEVNULL,
    )
    if done.returncode != 0:
        print(f"Blender's command cannot index {arguments.folder}; see above", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
