# SPDX-License-Identifier: GPL-3.0-or-later
"""How the batch command is started: by batch.py, and by Blender itself as ``--command meander``."""

from __future__ import annotations

import signal
import sys
from collections.abc import Sequence
from functools import partial
from typing import Any

from ..cli import command
from ..cli.place import Place
from .host import blender_if_there

# What Blender calls it: blender --command NAME ...
NAME = "meander"

_registered: list[Any] = []  # what Blender gave for it, one at most


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command as batch.py does, and returns its exit code; see cli.command.main.

    argv   the options; None takes those of this process
    """
    options = arguments_of_process() if argv is None else argv
    return _run(options, "batch.py")


def execute(argv: Sequence[str]) -> int:
    """Runs the command as Blender's own; what it returns is Blender's exit code."""
    hear_interruptions()
    try:
        return _run(argv, f"blender --command {NAME}")
    except SystemExit as left:  # after --help
        return int(left.code or 0)


def hear_interruptions() -> None:
    """Makes Ctrl-C an interruption: without a window Blender takes it for its renderer, and Python
    never hears of it."""
    if signal.getsignal(signal.SIGINT) != signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def arguments_of_process() -> list[str]:
    """What stands behind ``--``; inside Blender all the rest is Blender's own."""
    if "--" in sys.argv:
        return sys.argv[sys.argv.index("--") + 1 :]
    loaded_bpy = sys.modules.get("bpy")
    if loaded_bpy is not None and loaded_bpy.app.binary_path:
        return []
    return sys.argv[1:]


def register() -> None:
    """Adds the command to Blender, from 4.2 on."""
    import bpy

    if hasattr(bpy.utils, "register_cli_command"):
        _registered.append(bpy.utils.register_cli_command(NAME, execute))


def unregister() -> None:
    import bpy

    while _registered:
        bpy.utils.unregister_cli_command(_registered.pop())


def _run(options: Sequence[str], program: str) -> int:
    host = blender_if_there()
    try:
        return command.main(options, Place(program, partial(print, flush=True), host))
    finally:
        if host is not None:
            host.leave_scene()
