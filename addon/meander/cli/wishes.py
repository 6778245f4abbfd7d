# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the command that draws a picture, and what they ask for; no bpy."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import Any

from .. import core
from ..model import export
from ..model.files.whole import are_one, why_no_file
from ..model.options.export import GROUP, ROWS
from ..model.options.page import margin
from ..model.options.table import BY_SETTING
from ..model.picture import line
from ..model.picture.image import is_there, missing_text
from ..model.picture.inks import INKS
from ..model.picture.page import of_ink
from ..model.picture.tone import RANGES
from ..model.toolpaths import embroidery
from . import flags, limits, sheets, standard, tone
from .place import Place
from .places import target_of
from .values import BadInput, Parser, file_name, one_of_several, positive, reader

PREVIEWS = (".png",)
OUTPUTS = (".obj", *export.SUFFIXES, *PREVIEWS)
# The options of files that a picture decides itself.
_DECIDED = ("layout_as", "visible_only", "unit", "scale", "size", "line_width", "force")
FILE_ROWS = tuple(row for row in ROWS if row.setting not in _DECIDED)
# They count for the time that is told, whatever is written.
_OF_TIME = ("feed", "travel_feed")
_DEFAULT = line.Wishes()
_SHEET, _TONE, _LINE = "sheet", "tone", "line"


def parser(place: Place) -> Parser:
    """What the command understands."""
    made = Parser(
        prog=place.program,
        description="Draw a picture in one line that never crosses itself and has its tones. All "
        "lengths are in millimetres.",
        allow_abbrev=False,
    )
    _add_files(made)
    _add_sheet(made.add_argument_group(_SHEET))
    _add_tone(made.add_argument_group(_TONE))
    _add_line(made.add_argument_group(_LINE))
    group = made.add_argument_group(GROUP, "For the kind of the --output that takes it.")
    flags.add_flags(group, GROUP, FILE_ROWS)
    limits.add_options(made)
    made.add_argument("--quiet", action="store_true", help="print nothing but errors")
    made.add_argument("--version", action="version", version=f"Meander {core.VERSION}")
    return made


def _add_files(made: Parser) -> None:
    add = made.add_argument
    add(
        "--picture",
        type=file_name,
        metavar="FILE",
        help="PNG, JPEG or TIFF, of 8 or 16 bits; where it is transparent there is no line; -: the "
        "standard input",
    )
    add(
        "--test-strip",
        action="store_true",
        help="draw patches of rising darkness in place of a picture, to be measured; see --paper",
    )
    add(
        "--output",
        type=file_name,
        required=True,
        metavar="OUT",
        help=f"one of {', '.join(OUTPUTS)}; several inks are layers of an .svg, and else files of "
        "their own, OUT_cyan and so on; -: the standard output",
    )
    standard.add_options(made, tuple(suffix[1:] for suffix in OUTPUTS))
    add("--preview", type=file_name, metavar="OUT.png", help="also draw it as an image")
    add("--report", type=file_name, metavar="JSON", help="write figures of the drawing")


def _add_sheet(sheet: argparse._ArgumentGroup) -> None:
    add = sheet.add_argument
    add(
        "--width",
        type=reader(float, least=1.0, greatest=1e5),
        default=_DEFAULT.width,
        metavar="MM",
        help="of the drawing; default: 200",
    )
    add(
        "--pen",
        type=positive,
        default=_DEFAULT.pen,
        metavar="MM",
        help="width of its line; default: 0.4",
    )
    flags.add_flags(sheet, _SHEET, [margin(0.0, _SHEET)])
    sheets.add_options(sheet)
    add(
        "--crop",
        type=reader(int, least=0),
        nargs=4,
        metavar=("LEFT", "TOP", "WIDTH", "HEIGHT"),
        help="the part of the picture, in its pixels",
    )
    add(
        "--mask",
        type=file_name,
        metavar="FILE",
        help="an image laid over the picture: no line where it is dark or transparent",
    )
    add(
        "--leave-white",
        type=reader(float, *RANGES["leave_white"]),
        default=_DEFAULT.leave_white,
        metavar="D",
        help="no line where the drawing would be less dark, from 0 to 1; default: 0, a line "
        "everywhere, and of several inks one where they are needed",
    )
    add(
        "--no-bridges",
        action="store_true",
        help="a line for each part that is left apart, in place of corridors between them",
    )


def _add_tone(group: argparse._ArgumentGroup) -> None:
    add = group.add_argument
    tone.add_common(group)
    add(
        "--local-contrast",
        type=reader(float, *RANGES["local_contrast"]),
        default=_DEFAULT.tone.local_contrast,
        metavar="A",
        help="more contrast with what is around, such as 0.5; default: 0",
    )
    add(
        "--sharpen",
        type=reader(float, *RANGES["sharpen"]),
        default=_DEFAULT.tone.sharpen,
        metavar="A",
        help="the same at edges, as fine as the pen can show, such as 0.5; default: 0",
    )
    add(
        "--spread",
        type=reader(float, *RANGES["spread"]),
        default=_DEFAULT.spread,
        metavar="MM",
        help="by which ink makes the line wider on paper than the pen; default: 0",
    )


def _add_line(style: argparse._ArgumentGroup) -> None:
    add = style.add_argument
    add(
        "--picture-style",
        choices=line.STYLES,
        default=_DEFAULT.style,
        help="portrait: long rows; engraving: rows along edges and forms; scribble: grown; "
        "default: portrait",
    )
    add(
        "--inks",
        type=one_of_several(tuple(INKS)),
        metavar="LIST",
        help=f"some of {','.join(INKS)}: a line in each, in rows at angles without moire",
    )
    flags.add_flags(style, options=[BY_SETTING["variation"], BY_SETTING["threads"]])


def check(arguments: argparse.Namespace, place: Place) -> None:
    """Refuses what can be refused before a picture is read. Raises BadInput."""
    if (arguments.picture is None) == (not arguments.test_strip):
        raise BadInput("give either --picture or --test-strip")
    for option in ("picture", "mask"):
        path = getattr(arguments, option)
        fault = "" if path is None else why_no_file(path)
        if fault:
            raise BadInput(f"--{option} {path} {fault}")
    if arguments.test_strip:
        for option in ("crop", "mask", "inks"):
            if getattr(arguments, option) is not None:
                raise BadInput(f"--{option} is for a --picture; leave it out")
    _check_kinds(arguments)
    wrong = tone.problem_of(arguments)
    if wrong is not None:
        raise BadInput(wrong)
    _check_outputs(arguments)


def _check_kinds(arguments: argparse.Namespace) -> None:
    suffix = export.suffix_of(arguments.output)
    if suffix not in OUTPUTS:
        raise BadInput(
            f"--output {arguments.output} is no {', '.join(OUTPUTS[:-1])} or {OUTPUTS[-1]} file"
        )
    if arguments.preview is not None and arguments.preview.suffix.lower() not in PREVIEWS:
        raise BadInput(f"--preview {arguments.preview} is no .png file")
    if (suffix in PREVIEWS or arguments.preview is not None) and not is_there():
        raise BadInput(missing_text("an image of the drawing"))
    kind = export.format_of(arguments.output)
    for row in FILE_ROWS:
        given = getattr(arguments, row.flag.destination) not in (None, False)
        needed = row.setting not in _OF_TIME
        if given and needed and (kind is None or row.setting not in kind.options):
            raise BadInput(
                f"{row.flag.name} does nothing for an --output of kind {suffix}; leave it out"
            )
    wrong = sheets.problem_of(arguments, kind, file_values(arguments))
    if wrong is not None:
        raise BadInput(wrong)
    if kind is not None and embroidery.is_wanted(arguments.output) and not embroidery.is_there():
        raise BadInput(embroidery.missing_text(None))
    if "output" in standard.echo(arguments) and arguments.inks and len(arguments.inks) > 1:
        if not in_one_file(arguments):
            raise BadInput(
                "several inks are files of their own; name a file, or give --output-format svg"
            )


def in_one_file(arguments: argparse.Namespace) -> bool:
    """Whether all inks are in one file."""
    return arguments.output.suffix.lower() in (".svg", *PREVIEWS)


def _named_files(arguments: argparse.Namespace) -> list[Path]:
    """The names of the drawings, before there are any."""
    inks = arguments.inks or ()
    if len(inks) < 2 or in_one_file(arguments):
        return [arguments.output]
    return [of_ink(arguments.output, name) for name in inks]


def _check_outputs(arguments: argparse.Namespace) -> None:
    named = {f"--{option}": getattr(arguments, option) for option in ("picture", "mask")}
    taken = [(option, path) for option, path in named.items() if path is not None]
    written = [("output", path) for path in _named_files(arguments)]
    written += [(option, getattr(arguments, option)) for option in ("preview", "report")]
    for option, path in written:
        if path is None:
            continue
        target_of(f"--{option}", path)
        for other, other_path in taken:
            if option == "output" and sheets.may_write(arguments, path, other_path):
                raise BadInput(f"--sheet would overwrite {other} {other_path}; choose another name")
            if are_one(path, other_path):
                raise BadInput(f"--{option} would overwrite {other} {path}; choose another name")
        taken.append((f"--{option}", path))


def wishes_of(arguments: argparse.Namespace) -> line.Wishes:
    """How the picture is to be drawn. Raises FileError for measurements of paper that are none."""
    made = tone.tone_of(arguments)
    return line.Wishes(
        width=arguments.width,
        pen=arguments.pen,
        spread=arguments.spread,
        style=arguments.picture_style,
        tone=replace(made, local_contrast=arguments.local_contrast, sharpen=arguments.sharpen),
        inks=arguments.inks or (),
        leave_white=arguments.leave_white,
        bridges=not arguments.no_bridges,
        variation=arguments.variation,
        threads=arguments.threads,
    )


def file_values(arguments: argparse.Namespace) -> dict[str, Any]:
    """What model.options.export has for the file, by setting."""
    given = {row.setting: getattr(arguments, row.flag.destination) for row in FILE_ROWS}
    chosen = {name: value for name, value in given.items() if value is not None}
    decided = {"layout_as": "top", "line_width": arguments.pen, "thickness": None}
    return export.DEFAULTS | decided | chosen
