# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys of an item as flags of the batch command, checked by the command's own parser."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from ..cli import blender_flags, density
from ..cli.arguments import check_options, parsed, parser, read_options
from ..cli.flags import current_name
from ..cli.place import Place
from ..cli.values import BadInput
from .job_file import JobError, unknown_key

# Keys of an item that are no flags, or more than a flag.
OWN_KEYS = ("name", "input", "object", "frames", "output", "timeout", "memory")
# What the job itself says to the command.
_REFUSED = {
    "report": "every item has a report beside its output",
    "quiet": "what an item prints is in its log",
    "output-format": "an output is a file, whose name says it",
    "help": "see --help of batch.py",
    "version": "every report has it",
}
# Paths of files that are written.
WRITTEN_KEYS = ("output", "cut", "maps")


def read_keys(input_file: Path) -> tuple[str, ...]:
    """Paths of files that are read beside the input."""
    images = () if input_file.suffix.lower() == ".blend" else density.IMAGES
    names = (*(name for name in read_options() if name != "input"), *images)
    return tuple(name.replace("_", "-") for name in names)



# Where a command line is only looked at.
_NOWHERE = Place("the batch command", lambda _line: None)


@cache
def _actions() -> dict[str, argparse.Action]:
    """What the batch command takes, by the name of the flag without its dashes."""
    return {
        name.lstrip("-"): action
        for action in parser(_NOWHERE)._actions
        for name in action.option_strings
        if name.startswith("--") and action.help != argparse.SUPPRESS
    }


def check_keys(where: str, table: Mapping[str, Any]) -> dict[str, Any]:
    """A table of the file with its keys as the flags are spelt. Raises JobError."""
    known = [*OWN_KEYS, *(name for name in _actions() if name not in _REFUSED)]
    found: dict[str, Any] = {}
    for key, value in table.items():
        name = current_name(key.replace("_", "-"))
        if name in _REFUSED:
            raise JobError(f"{where}: {key} is not for job files: {_REFUSED[name]}; leave it out")
        if name not in known:
            raise JobError(f"{where} {unknown_key(key, known)}")
        if name in found:
            other = next(each for each in table if current_name(each.replace("_", "-")) == name)
            raise JobError(f"{where}: {key} stands there twice, as {other} too; leave one out")
        found[name] = value
    return found


def flags_of(where: str, options: Mapping[str, Any]) -> list[str]:
    """Options as arguments of the batch command, sorted by name. Raises JobError."""
    arguments: list[str] = []
    for name, value in sorted(options.items()):
        if isinstance(_actions()[name], argparse._StoreTrueAction):
            if not isinstance(value, bool):
                raise JobError(f"{where}: {name} is true or false, not {value!r}")
            arguments += [f"--{name}"] if value else []
        elif isinstance(value, list):
            arguments += [f"--{name}", *(_text(where, name, one) for one in value)]
        else:
            arguments.append(f"--{name}={_text(where, name, value)}")
    return arguments


def _text(where: str, name: str, value: Any) -> str:
    if isinstance(value, bool) or not isinstance(value, (str, int, float)):
        raise JobError(f"{where}: {name} is a number or a text in quotes, not {value!r}")
    return value if isinstance(value, str) else repr(value)


def check(where: str, arguments: list[str]) -> argparse.Namespace:
    """What the arguments say. Raises JobError where the batch command would refuse them."""
    try:
        found = parsed(arguments, _NOWHERE)
        check_options(found)
    except BadInput as refusal:
        raise JobError(f"{where}: {str(refusal).removesuffix('; see --help')}") from refusal
    return found


def needs_blender(item: argparse.Namespace) -> bool:
    """Whether the batch command needs Blender for that."""
    files = [item.input, item.output, item.cut]
    if any(path is not None and path.suffix.lower() == ".blend" for path in files):
        return True
    try:
        blender_flags.refuse(item, _NOWHERE)
    except BadInput:
        return True
    return False
