# SPDX-License-Identifier: GPL-3.0-or-later
"""The command that draws a picture in one line: its options, files and report; no bpy.

It is the batch command with --picture in place of --input; see docs/make/picture.md.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from .. import core
from ..model import export
from ..model.files.obj import write_obj_curve
from ..model.files.rows import write_pieces
from ..model.files.whole import are_one, naming, whole_files, why_no_file
from ..model.options.export import ROWS
from ..model.picture import line, strip
from ..model.picture.drawn import preview
from ..model.picture.image import Image, is_there, missing_text, read_image
from ..model.picture.inks import INKS
from ..model.picture.page import curve_of, pieces_of_page
from ..model.picture.tone import TONES, Tone
from ..model.report import write_report
from ..model.toolpaths import embroidery
from . import flags, limits, watching
from .place import Place
from .values import BadInput, Parser, file_name, one_of_several, reader

# What names the command among those of the batch command.
OPTIONS = ("--picture", "--test-strip")
PREVIEWS = (".png",)
OUTPUTS = (".obj", *export.SUFFIXES, *PREVIEWS)
# Kinds of files with all inks in one.
_ALL_INKS = (".svg", *PREVIEWS)
# The options of files that a picture decides itself.
_DECIDED = ("layout_as", "visible_only", "unit", "scale", "size", "line_width", "force")
_ROWS = tuple(row for row in ROWS if row.setting not in _DECIDED)
_GROUP = ROWS[0].flag.group
_PREVIEW_SIZE = 2000


def is_asked(argv: Sequence[str]) -> bool:
    """Whether options of the batch command ask for a picture."""
    return any(word.split("=", 1)[0] in OPTIONS for word in argv)


def parser(place: Place) -> Parser:
    """What the command understands."""
    made = Parser(
        prog=place.program,
        description="Draw a picture in one line that never crosses itself and has its tones. All "
        "lengths are in millimetres.",
        allow_abbrev=False,
    )
    add = made.add_argument
    add(
        "--picture",
        type=file_name,
        metavar="FILE",
        help="PNG, JPEG or TIFF, of 8 or 16 bits; where it is transparent there is no line",
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
        "their own, OUT_cyan and so on",
    )
    add("--preview", type=file_name, metavar="OUT.png", help="also draw it as an image")
    add("--report", type=file_name, metavar="JSON", help="write figures of the drawing")
    sheet = made.add_argument_group("sheet")
    add = sheet.add_argument
    positive = reader(float, above=0.0)
    default = line.Wishes()
    add(
        "--width",
        type=reader(float, least=1.0, greatest=1e5),
        default=default.width,
        metavar="MM",
        help="of the drawing; default: 200",
    )
    add(
        "--pen",
        type=positive,
        default=default.pen,
        metavar="MM",
        help="width of its line; default: 0.4",
    )
    add(
        "--margin",
        type=reader(float, least=0.0),
        default=0.0,
        metavar="MM",
        help="of white on all sides; default: 0",
    )
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
    share = reader(float, 0.0, 1.0)
    add(
        "--leave-white",
        type=share,
        default=default.leave_white,
        metavar="D",
        help="no line where the drawing would be less dark, from 0 to 1; default: 0, a line "
        "everywhere, and of several inks one where they are needed",
    )
    add(
        "--no-bridges",
        action="store_true",
        help="a line for each part that is left apart, in place of corridors between them",
    )
    tone = made.add_argument_group("tone")
    add = tone.add_argument
    of_tone = Tone()
    add(
        "--tone",
        choices=TONES,
        default=of_tone.kind,
        help="how dark it is: eye fits the picture's lightness into what the pen can have; light "
        "reflects as much light, and value goes by the numbers of the file, both clipped to that; "
        "default: eye",
    )
    add(
        "--darkest",
        type=reader(float, 0.1, 1.0),
        default=of_tone.darkest,
        metavar="D",
        help="width of the line over the least spacing; default: 0.9",
    )
    add(
        "--lightest",
        type=reader(float, 0.01, 0.5),
        default=of_tone.lightest,
        metavar="D",
        help="width of the line over the greatest spacing; default: 0.06",
    )
    add(
        "--levels",
        type=reader(float, 0.0, 100.0),
        nargs=2,
        metavar=("BLACK", "WHITE"),
        help="the lightness, from 0 to 100, that becomes darkest and lightest; default: of eye and "
        "one ink, what half a per cent of the picture are beyond; else 0 and 100",
    )
    add(
        "--local-contrast",
        type=reader(float, 0.0, 5.0),
        default=of_tone.local_contrast,
        metavar="A",
        help="more contrast with what is around, such as 0.5; default: 0",
    )
    add(
        "--sharpen",
        type=reader(float, 0.0, 5.0),
        default=of_tone.sharpen,
        metavar="A",
        help="the same at edges, as fine as the pen can show, such as 0.5; default: 0",
    )
    add(
        "--spread",
        type=reader(float, 0.0),
        default=default.spread,
        metavar="MM",
        help="by which ink makes the line wider on paper than the pen; default: 0",
    )
    add(
        "--paper",
        metavar="STOPS",
        help="how dark shares of ink were measured on paper, such as 0.2:0.27,0.5:0.61,0.8:0.85",
    )
    style = made.add_argument_group("line")
    add = style.add_argument
    add(
        "--picture-style",
        choices=line.STYLES,
        default=default.style,
        help="portrait: long rows; engraving: rows along edges and forms; scribble: grown; "
        "default: portrait",
    )
    add(
        "--inks",
        type=one_of_several(tuple(INKS)),
        metavar="LIST",
        help=f"some of {','.join(INKS)}: a line in each, in rows at angles without moire",
    )
    add(
        "--variation",
        type=reader(int, 0, 2**32 - 1),
        default=0,
        metavar="N",
        help="another line of the same tones; default: 0",
    )
    add(
        "--threads",
        type=reader(int, 0, 1024),
        default=0,
        metavar="T",
        help="default: one for each processor",
    )
    group = made.add_argument_group(_GROUP, "For the kind of the --output that takes it.")
    flags.add_flags(group, _GROUP, _ROWS)
    limits.add_options(made)
    made.add_argument("--quiet", action="store_true", help="print nothing but errors")
    made.add_argument("--version", action="version", version=f"Meander {core.VERSION}")
    return made


def process(argv: Sequence[str], place: Place) -> None:
    """Draws what the options ask for. Raises BadInput, FileError and core.MeanderError."""
    arguments = parser(place).parse_args(argv)

    def say(text: str) -> None:
        if not arguments.quiet:
            place.say(f"meander: {text}")

    _check(arguments, place)
    wishes, mask = _wishes(arguments), None
    if arguments.test_strip:
        image, wishes = strip.test_strip(), replace(wishes, tone=strip.TONE)
    else:
        image = _cropped(_read(arguments.picture, place), arguments)
        if arguments.mask is not None:
            mask = _read(arguments.mask, place)

    def run(flow: core.Flow) -> str:
        return watching.run(flow, say if arguments.quiet else place.say)

    def accept(cost: core.Cost) -> None:
        limits.refuse_large(cost, arguments)

    layers = line.draw(image, wishes, mask, run, accept)
    record = _record(arguments, image, wishes, layers)
    for path in _write(arguments, layers, record, say):
        say(f"wrote {path}")


# ------------------------------------------------------------------------------------------------
# What is asked for


def _check(arguments: argparse.Namespace, place: Place) -> None:
    """Refuses what can be refused before a picture is read. Raises BadInput."""
    if arguments.picture is not None and arguments.test_strip:
        raise BadInput("--picture and --test-strip are both given; choose one")
    for option in ("picture", "mask"):
        path = getattr(arguments, option)
        fault = "" if path is None else why_no_file(path)
        if fault:
            raise BadInput(f"--{option} {path} {fault}")
    if arguments.test_strip:
        for option in ("crop", "mask", "inks"):
            if getattr(arguments, option) is not None:
                raise BadInput(f"--{option} is for a --picture; leave it out")
    suffix = arguments.output.suffix.lower()
    if suffix not in OUTPUTS:
        raise BadInput(
            f"--output {arguments.output} is no {', '.join(OUTPUTS[:-1])} or {OUTPUTS[-1]} file"
        )
    if arguments.preview is not None and arguments.preview.suffix.lower() not in PREVIEWS:
        raise BadInput(f"--preview {arguments.preview} is no .png file")
    if (suffix in PREVIEWS or arguments.preview is not None) and not is_there():
        raise BadInput(missing_text("an image of the drawing"))
    kind = export.format_of(arguments.output)
    for row in _ROWS:
        given = getattr(arguments, row.flag.destination) not in (None, False)
        of_time = row.setting in ("feed", "travel_feed")
        if given and not of_time and (kind is None or row.setting not in kind.options):
            raise BadInput(
                f"{row.flag.name} does nothing for an --output of kind {suffix}; leave it out"
            )
    if kind is not None and embroidery.is_wanted(arguments.output) and not embroidery.is_there():
        raise BadInput(embroidery.missing_text(None))
    if arguments.lightest >= arguments.darkest:
        raise BadInput("--lightest is not less than --darkest; choose a smaller one")
    if arguments.levels is not None and not arguments.levels[0] < arguments.levels[1]:
        raise BadInput("--levels are not in order; give the darker one first")
    _check_outputs(arguments)


def _check_outputs(arguments: argparse.Namespace) -> None:
    named = {f"--{option}": getattr(arguments, option) for option in ("picture", "mask")}
    taken = [(option, path) for option, path in named.items() if path is not None]
    written = [("output", path) for path in _named_files(arguments)]
    written += [(option, getattr(arguments, option)) for option in ("preview", "report")]
    for option, path in written:
        if path is None:
            continue
        if path.is_dir() or not path.name:
            raise BadInput(f"--{option} {path} is a folder; give a file name")
        if not path.resolve().parent.is_dir():
            raise BadInput(f"the folder of --{option} {path} does not exist; make it first")
        for other, other_path in taken:
            if are_one(path, other_path):
                raise BadInput(f"--{option} would overwrite {other} {path}; choose another name")
        taken.append((f"--{option}", path))


def _wishes(arguments: argparse.Namespace) -> line.Wishes:
    return line.Wishes(
        arguments.width,
        arguments.pen,
        arguments.spread,
        arguments.picture_style,
        Tone(
            arguments.tone,
            arguments.darkest,
            arguments.lightest,
            None if arguments.levels is None else tuple(arguments.levels),
            arguments.local_contrast,
            arguments.sharpen,
            () if arguments.paper is None else strip.read_paper(arguments.paper),
        ),
        arguments.inks or (),
        arguments.leave_white,
        not arguments.no_bridges,
        arguments.variation,
        arguments.threads,
    )


def _read(path: Path, place: Place) -> Image:
    if place.host is not None and not is_there():
        return place.host.read_picture(path)
    return read_image(path)


def _cropped(image: Image, arguments: argparse.Namespace) -> Image:
    if arguments.crop is None:
        return image
    left, top, width, height = arguments.crop
    columns, rows = image.sides
    if not (width and height and left + width <= columns and top + height <= rows):
        raise BadInput(
            f"--crop {left} {top} {width} {height} is not within the picture, which has {columns} "
            f"x {rows} pixels"
        )
    return image.cropped(left, top, width, height)


# ------------------------------------------------------------------------------------------------
# What is written


def _sides(arguments: argparse.Namespace, layers: Sequence[line.Layer]) -> tuple[float, float]:
    """Of the page, in millimetres."""
    width, height = layers[0].plan.grid.sides
    return width + 2.0 * arguments.margin, height + 2.0 * arguments.margin


def _values(arguments: argparse.Namespace) -> dict[str, Any]:
    given = {row.setting: getattr(arguments, row.flag.destination) for row in _ROWS}
    chosen = {name: value for name, value in given.items() if value is not None}
    return export.DEFAULTS | chosen | {"layout_as": "top", "line_width": arguments.pen}


def _files(arguments: argparse.Namespace, layers: list[line.Layer]) -> dict[Path, list[line.Layer]]:
    """The drawings that are written, and what is in them."""
    if len(layers) == 1 or arguments.output.suffix.lower() in _ALL_INKS:
        return {arguments.output: layers}
    return {_of_ink(arguments.output, layer.plan.name): [layer] for layer in layers}


def _named_files(arguments: argparse.Namespace) -> list[Path]:
    """The names of the drawings, before there are any."""
    inks = arguments.inks or ()
    if len(inks) < 2 or arguments.output.suffix.lower() in _ALL_INKS:
        return [arguments.output]
    return [_of_ink(arguments.output, ink) for ink in inks]


def _of_ink(path: Path, ink: str) -> Path:
    return path.with_stem(f"{path.stem}_{ink}")


def _write(
    arguments: argparse.Namespace,
    layers: list[line.Layer],
    record: dict[str, Any],
    say: Any,
) -> list[Path]:
    """Writes all files, or none; returns their paths."""
    files = _files(arguments, layers)
    others = [path for path in (arguments.preview, arguments.report) if path is not None]
    with whole_files([*files, *others]) as temporary:
        paths = dict(zip([*files, *others], temporary, strict=True))
        for path, of_file in files.items():
            with naming(path):
                _write_drawing(paths[path], path, of_file, arguments)
        if arguments.preview is not None:
            with naming(arguments.preview):
                _write_preview(paths[arguments.preview], layers, arguments)
        for text in _told(record):
            say(text)
        if arguments.report is not None:
            with naming(arguments.report):
                write_report(paths[arguments.report], record)
    return list(paths)


def _write_drawing(
    temporary: Path, path: Path, layers: list[line.Layer], arguments: argparse.Namespace
) -> None:
    suffix = path.suffix.lower()
    if suffix in PREVIEWS:
        _write_preview(temporary, layers, arguments)
    elif suffix == ".obj":
        write_obj_curve(temporary, curve_of(line.drawing_of(layers, arguments.margin)))
    else:
        sides, values = _sides(arguments, layers), _values(arguments)
        write_pieces(temporary, pieces_of_page(path, layers, sides, arguments.margin, values))


def _write_preview(
    temporary: Path, layers: list[line.Layer], arguments: argparse.Namespace
) -> None:
    shown = [
        (layer.plan.colour, [line.moved(strand, arguments.margin) for strand in layer.strands])
        for layer in layers
    ]
    width = arguments.pen + arguments.spread
    preview(shown, _sides(arguments, layers), width, _PREVIEW_SIZE).save(temporary, format="PNG")


def _record(
    arguments: argparse.Namespace, image: Image, wishes: line.Wishes, layers: list[line.Layer]
) -> dict[str, Any]:
    """The report: a JSON object."""
    values = _values(arguments)
    length = sum(layer.length for layer in layers)
    return {
        "version": core.library_version(),
        "picture": None if arguments.picture is None else str(arguments.picture),
        "pixels": list(image.sides),
        "sides": list(layers[0].plan.grid.sides),
        "page": list(_sides(arguments, layers)),
        "places": [count + 1 for count in layers[0].plan.grid.cells],
        "options": asdict(wishes) | {"margin": arguments.margin, "feed": values["feed"]},
        "length": length,
        "minutes": length / values["feed"],
        "inks": [layer.entry() for layer in layers],
    }


def _told(record: dict[str, Any]) -> list[str]:
    """What there is to say of a drawing, a sentence each."""
    width, height = record["sides"]
    told = [
        f"{width:g} x {height:.4g} mm, {record['length'] / 1000.0:.3g} m of line, "
        f"{record['minutes']:.3g} minutes at {record['options']['feed']:g} mm a minute"
    ]
    for ink in record["inks"]:
        lines = "one line" if ink["lines"] == 1 else f"{ink['lines']} lines"
        tone = ink["tone"]
        told.append(
            f"{ink['ink']}: {lines}, spacing {ink['spacing']:.3g} mm in the mean, tone right to "
            f"{tone['error_1']:.3f} of the range at one spacing and {tone['error_2']:.3f} at two"
        )
        for name, what in (("too_dark", "darker"), ("too_light", "lighter")):
            lost = ink["out_of_reach"][name]
            if lost >= 0.005:
                told.append(f"{100.0 * lost:.3g} % of the picture is {what} than the pen can be")
        if ink["stop_reason"] != "converged":
            told.append(f"the run has ended early: {ink['stop_reason'].replace('_', ' ')}")
    return told
