# SPDX-License-Identifier: GPL-3.0-or-later
"""The command that draws what a camera sees on a page, without a window; see camera.py."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import bpy

from ..cli.exit_code import exit_code_of, while_heard
from ..cli.flags import add_flags
from ..cli.limits import add_options as add_limits
from ..cli.limits import refuse_large
from ..cli.places import asked, target_of
from ..cli.values import BadInput, Parser, file_name, index, paper, reader
from ..model.camera import PAPERS, SPACING, Page
from ..model.estimate import described
from ..model.files.whole import are_one, why_no_file
from ..model.options.export import LINE_WIDTH
from ..model.options.page import line_width, margin
from ..model.options.tone import COMMON
from ..model.picture.tone import Tone
from ..run.camera import CameraDrawing
from ..run.stepper import Stepper
from ..scene.camera import camera_page
from ..scene.errors import DataError
from .saved_settings import saved_settings

# The time between two looks at a run, in seconds; an interruption waits for the next one.
_PAUSE = 0.05
_PAGE, _TONE = "page", "tone"
_TONE_TEXT = (
    "With --tone the lamps of the scene say how dark it is where, and the spacing is the width of "
    "the line over that, in place of --spacing."
)


def parser() -> Parser:
    """What the command understands."""
    made = Parser(
        prog="camera.py",
        description="Fills everything that a camera sees at one spacing on paper, and writes the "
        "page as an SVG file with a layer for each object, without what is hidden.",
    )
    add = made.add_argument
    add("--input", type=file_name, metavar="SCENE.blend", help="default: the file that is open")
    add("--output", type=file_name, required=True, metavar="OUT.svg", help="the page")
    add("--report", type=file_name, metavar="OUT.json", help="what has become of each object")
    add("--sheet", type=_one_page, help=argparse.SUPPRESS)  # of other drawings
    add(
        "--spacing",
        type=reader(float, least=0.05, greatest=1000.0),
        metavar="MM",
        help=f"between neighbouring strands on paper, in millimetres; default: {SPACING:g}, as in "
        "the panel",
    )
    add(
        "--paper",
        type=paper,
        default=PAPERS["a4"],
        metavar="NAME|WxH",
        help=f"{', '.join(PAPERS)}, or its sides in millimetres; default: a4",
    )
    add_flags(made, _PAGE, [margin(15.0, _PAGE), line_width(LINE_WIDTH, _PAGE)])
    add(
        "--outlines",
        action="store_true",
        help="draw where surfaces turn out of sight, their creases and edges as well, in layers of "
        "their own",
    )
    add("--camera", metavar="NAME", help="default: the one of the scene")
    add("--frame", type=index, metavar="N", help="of the animation; default: as saved")
    add_flags(made.add_argument_group(_TONE, _TONE_TEXT), _TONE, COMMON)
    add_limits(made)
    add("--quiet", action="store_true", help="print errors and warnings only")
    return made


def main(argv: Sequence[str]) -> int:
    """Runs the command and returns its exit code; see camera.py."""
    return exit_code_of(lambda: _draw(parser().parse_args(argv)), DataError)


def _draw(arguments: argparse.Namespace) -> None:
    page = Page(*arguments.paper, arguments.margin)
    if not page.has_room:
        raise BadInput("the margins leave nothing of the page; choose a smaller --margin")
    if arguments.output.suffix.lower() != ".svg":
        raise BadInput(f"--output {arguments.output} is no .svg file")
    _check_files(arguments)
    tone = _tone(arguments)
    if arguments.input is not None:
        _open(arguments.input)
    scene = bpy.context.scene
    if arguments.frame is not None:
        scene.frame_set(arguments.frame)
    camera = scene.camera
    if arguments.camera is not None:
        camera = scene.objects.get(arguments.camera)
        if camera is None:
            raise BadInput(
                f"the scene has no object {arguments.camera!r}; give the name of a camera to "
                "--camera"
            )

    def say(line: str) -> None:
        if not arguments.quiet:
            while_heard(print, f"meander: {line}", flush=True)

    if tone is not None:
        arguments.spacing = 2.0 * arguments.line_width
    elif arguments.spacing is None:
        arguments.spacing = SPACING
        say(f"the spacing on paper is {SPACING:g} mm, as in the panel; --spacing MM sets another")
    with saved_settings():
        depsgraph = bpy.context.evaluated_depsgraph_get()
        frame = camera_page(scene, depsgraph, camera, page)
        pen = arguments.line_width
        drawing = CameraDrawing(
            frame, arguments.spacing, depsgraph, None, tone, pen, arguments.outlines
        )
    size = drawing.estimate()
    expected = size.at(drawing.spacing, float(frame.sides[0]))
    if expected is not None:
        say(f"about {described(expected)}")
        refuse_large(size.cost(), arguments)
    _fill(drawing, say)
    told = drawing.write(arguments.output, arguments.line_width, camera.name, arguments.report)
    for remark in drawing.remarks():
        while_heard(print, f"meander: warning: {remark}", file=sys.stderr, flush=True)
    say(told)
    for written in filter(None, (arguments.output, arguments.report)):
        say(f"wrote {written}")


def _check_files(arguments: argparse.Namespace) -> None:
    """Refuses a scene that is not there, and outputs that cannot be, before anything is drawn."""
    read = arguments.input
    if read is not None:
        fault = asked(why_no_file, "--input", read)
        if fault:
            raise BadInput(f"--input {read} {fault}")
    elif bpy.data.filepath:
        read = Path(bpy.data.filepath)
    taken = {} if read is None else {"the scene": read}
    for option, path in (("--output", arguments.output), ("--report", arguments.report)):
        if path is None:
            continue
        target = target_of(option, path)
        for other, other_path in taken.items():
            if are_one(target, other_path):
                raise BadInput(f"{option} would overwrite {other} {path}; choose another name")
        taken[option] = path


def _one_page(_text: str) -> None:
    raise argparse.ArgumentTypeError(
        "what a camera sees is one page; give a larger --paper in its place"
    )


def _tone(arguments: argparse.Namespace) -> Tone | None:
    """What the options say of tone; None: the spacing is the same everywhere. Raises BadInput."""
    if arguments.tone is None:
        for name in ("darkest", "lightest"):
            if getattr(arguments, name) is not None:
                raise BadInput(f"--{name} is for --tone; give both or none")
        return None
    if arguments.spacing is not None:
        raise BadInput("--tone and --spacing are both given; choose one")
    given = {name: getattr(arguments, name) for name in ("darkest", "lightest")}
    made = Tone(arguments.tone, **{name: v for name, v in given.items() if v is not None})
    if made.lightest >= made.darkest:
        raise BadInput("--lightest is not less than --darkest; choose a smaller one")
    return made


def _open(path: Path) -> None:
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path.absolute()), load_ui=False)
    except RuntimeError as problem:
        raise BadInput(
            f"{path} is no .blend file that Blender {bpy.app.version_string} can open; save it "
            "again with this version or an older one"
        ) from problem


def _fill(drawing: CameraDrawing, say: Callable[[str], None]) -> None:
    while (stepper := drawing.next()) is not None:
        _run(stepper)
        drawing.take(stepper)
        figures = drawing.layers[-1].figures
        if "paths" in figures:
            say(
                f"{drawing.place}, {drawing.name}: {figures['paths']:,} paths, "
                f"{figures['length'] / 1000.0:.3g} m"
            )


def _run(stepper: Stepper) -> None:
    """To its end, with an ear for interruptions."""
    stepper.start()
    try:
        while not stepper.finished:
            time.sleep(_PAUSE)
            stepper.prepare()
    except BaseException:
        stepper.cancel()
        stepper.join()
        raise
