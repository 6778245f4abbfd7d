# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of files that a command is given, and what can be refused of them; no bpy."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from .values import BadInput

_Answer = TypeVar("_Answer")


def asked(question: Callable[[Path], _Answer], option: str, path: Path) -> _Answer:
    """Asks about a path; a name that no file can have is refused, and so is one in a current folder
    that has been deleted."""
    try:
        return question(path)
    except OSError as problem:
        raise BadInput(
            f"{option} {path} cannot be used ({problem.strerror}); choose another name"
        ) from problem


def target_of(option: str, path: Path) -> Path:
    """What is written where `path` is: through a symbolic link, what it points to. Raises BadInput
    where no file can be written there."""
    if asked(Path.is_dir, option, path) or not path.name:
        raise BadInput(f"{option} {path} is a folder; give a file name")
    target = asked(lambda named: Path(os.path.realpath(named)), option, path)
    # A pipe or a device is written into, wherever its name leads.
    if path.exists() and not path.is_file():
        if not os.access(path, os.W_OK):
            raise BadInput(f"{option} {path} is protected against writing; choose another name")
        return target
    if not target.parent.is_dir():
        raise BadInput(f"the folder of {option} {path} does not exist; make it first")
    if not os.access(target.parent, os.W_OK):
        raise BadInput(f"the folder of {option} {path} cannot be written to; choose another")
    if path.exists() and not os.access(target, os.W_OK):
        raise BadInput(f"{option} {path} is protected against writing; choose another name")
    return target
