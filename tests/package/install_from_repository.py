# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: adds an extension repository, installs the add-on from it, and fills a mesh.

    python install_from_repository.py -- URL REPORT.json    (bpy 4.2 or later)
"""

import json
import os
import sys

import bpy

# isort: split
import addon_utils

NAME = "meander"


def install(url: str) -> str:
    """Installs and enables the add-on from the repository; the name of its module."""
    bpy.context.preferences.system.use_online_access = True  # else Blender installs from no URL
    repositories = bpy.context.preferences.extensions.repos
    repository = repositories.new(name="Studio", module="studio", remote_url=url)
    repository.enabled = True
    index = repositories.find(repository.name)
    bpy.ops.extensions.repo_sync(repo_index=index)
    bpy.ops.extensions.package_install(repo_index=index, pkg_id=NAME, enable_on_install=True)
    return f"bl_ext.studio.{NAME}"


def main(url: str, report: str) -> None:
    module = install(url)
    _at_start, loaded = addon_utils.check(module)
    assert loaded, f"{module} is not enabled"
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2)
    bpy.context.object.meander.spacing = 0.4
    bpy.ops.meander.run("EXEC_DEFAULT")
    curve = bpy.context.object
    with open(report, "w", encoding="utf-8") as file:
        points = [len(spline.points) for spline in curve.data.splines]
        json.dump({"module": sys.modules[module].__file__, "points": points}, file)
    addon_utils.disable(module)
    os._exit(0)  # bpy 4.2 crashes in its clean-up at exit once classes have been registered


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
