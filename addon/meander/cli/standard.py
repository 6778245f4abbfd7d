# SPDX-License-Identifier: GPL-3.0-or-later
"""The standard input and output in place of files, by the name `-`; no bpy.

What comes in is put into a file of a temporary folder, and what goes out is taken from one, so that
everything else knows files only.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from .. import core
from ..model.export import SUFFIXES as EXPORTED
from ..model.files.stl import is_stl
from ..model.files.whole import FileError
from ..model.toolpaths.toolpath import SUFFIXES
from .exit_code import sent, while_heard
from .place import Place
from .values import BadInput

NAME = Path("-")
FORMATS = tuple(suffix[1:] for suffix in (".obj", *SUFFIXES, *EXPORTED))

# Options whose file may be one of the two streams.
_READ = ("input", "seed", "guides", "picture", "mask")
_WRITTEN = ("output", "report")
# And those whose file may not.
_NAMED = ("cut", "maps", "preview")
# What systems call the streams.
_SYSTEM_NAMES = {
    name: [Path(f"/dev/{word}"), Path(f"/dev/fd/{number}"), Path(f"/proc/self/fd/{number}")]
    for names, word, number in ((_READ, "stdin", 0), (_WRITTEN, "stdout", 1))
    for name in names
}


def add_options(parser: argparse.ArgumentParser, formats: Sequence[str] = FORMATS) -> None:
    parser.add_argument(
        "--output-format",
        choices=formats,
        help="what goes to the standard output with --output -, where no name says it",
    )


@contextmanager
def streams(arguments: argparse.Namespace, place: Place) -> Iterator[Place]:
    """Files in place of `-` in the arguments while the block runs, and the place to run it in.

    At its end what was written goes to the standard output. Raises BadInput where several options
    ask for one stream, or one for a stream that it cannot have.
    """
    read, written = _asked(arguments, place)
    arguments.streams = (*read, *written)
    if not arguments.streams:
        yield place
        return
    with tempfile.TemporaryDirectory(prefix="meander-") as folder:
        for name in read:
            data = b"" if sys.stdin is None else sys.stdin.buffer.read()
            path = Path(folder) / f"the standard input{_kind_of(data, name)}"
            path.write_bytes(data)
            setattr(arguments, name, path)
        for name in written:
            kind = "json" if name == "report" else arguments.output_format
            setattr(arguments, name, Path(folder) / f"the standard output.{kind}")
        # What is said does not go between the bytes of a file.
        aside = written and not arguments.quiet
        say = partial(print, file=sys.stderr, flush=True) if aside else place.say
        try:
            yield replace(place, say=lambda line: while_heard(say, _without(folder, line)))
        except (BadInput, FileError) as problem:
            raise BadInput(_without(folder, str(problem))) from problem
        except core.MeanderError as problem:
            problem.args = (_without(folder, str(problem)),)
            raise
        for name in written:
            _send(getattr(arguments, name))


def echo(arguments: argparse.Namespace) -> dict[str, Any]:
    """What the report names in place of the files."""
    return {name: str(NAME) for name in getattr(arguments, "streams", ())}


def beside_output(arguments: argparse.Namespace) -> Path:
    """The path of the output, or of a file of its name in the current folder."""
    return Path("meander") if "output" in echo(arguments) else arguments.output


def _without(folder: str, text: str) -> str:
    # "the standard output.svg" is the name of a file for what is written into it only.
    within = re.escape(f"{folder}{os.sep}")
    return re.sub(rf"{within}(?:(the standard output)(?:\.\w+)+)?", r"\1", text)


def _kind_of(data: bytes, option: str) -> str:
    """The suffix of a mesh by its bytes. Curves are OBJ, and images need none."""
    if option in ("picture", "mask"):
        return ""
    if option != "input":
        return ".obj"
    if data.startswith(b"ply"):
        return ".ply"
    return ".stl" if is_stl(data) else ".obj"


def _send(path: Path) -> None:
    """Sends a file to the standard output, if it was written and somebody reads it."""
    if path.exists():
        sent(lambda: sys.stdout.buffer.write(path.read_bytes()), "name a file")


def _asked(arguments: argparse.Namespace, place: Place) -> tuple[list[str], list[str]]:
    """The options that name the standard input, and those that name the standard output."""
    for name, names in _SYSTEM_NAMES.items():
        if getattr(arguments, name, None) in names:
            setattr(arguments, name, NAME)
    read, written, named = (
        [name for name in names if getattr(arguments, name, None) == NAME]
        for names in (_READ, _WRITTEN, _NAMED)
    )
    for names, stream in ((read, "input"), (written, "output")):
        if len(names) > 1:
            raise BadInput(
                f"--{names[0]} and --{names[1]} are both the standard {stream}; name a file for one"
            )
    for name in named:
        raise BadInput(f"--{name} cannot go to the standard output; name a file")
    if arguments.output == NAME and arguments.output_format is None:
        raise BadInput("--output - says no format; give --output-format, such as svg")
    if arguments.output != NAME and arguments.output_format is not None:
        raise BadInput("--output-format is for --output -; a file's name says its format")
    if written and place.host is not None:
        raise BadInput(
            f"--{written[0]} - cannot be used in Blender, which prints to the standard output too; "
            "name a file"
        )
    return read, written
