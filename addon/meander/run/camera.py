# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what a camera sees on a page: every surface is filled, and what is hidden is left out.

The strands have one spacing on the paper. On the surface it is as much more as things are smaller
on paper where they are, so it grows with the distance from the camera, within one surface too.
Where a surface turns away from the camera its strands close up on paper: that is what shows its
shape. Nothing in the scene is changed, and nothing is left in it.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from .. import core
from ..model.camera import CameraPage
from ..model.empty import Empty, empty_of, percent
from ..model.files.rows import write_pieces
from ..model.files.whole import naming, whole_files
from ..model.picture.tone import Tone
from ..model.problem import Problem
from ..model.report import write_report
from ..model.toolpaths.drawing import Drawing
from ..model.toolpaths.svg import page_pieces
from ..model.toolpaths.toolpath import Strand, strands_of
from ..scene.camera import Sight, seen_by
from ..scene.errors import DataError
from ..scene.rendered import whatever_it_costs
from .lasting import Activity
from .outlines import on_page, outlines_of
from .paper import DrawingEstimate, PaperSpacing, beyond
from .shading import Shading
from .stepper import Stepper
from .window import Window

# So far a point is moved towards the eye before it is asked what hides it.
_LIFT = 0.01


@dataclass
class Layer:
    """What has become of a surface.

    strands   on paper, in millimetres
    figures   its entry in the report
    unfilled  a sentence where it is not filled
    """

    name: str
    strands: list[Strand]
    figures: dict[str, Any]
    unfilled: str = ""


@dataclass
class Going:
    """A drawing that is being made in a window, and the run that it is at."""

    drawing: CameraDrawing
    stepper: Stepper | None
    window: Window

    def end(self) -> None:
        """Gives back what it has borrowed; a run that is going on ends."""
        if self.stepper is not None:
            self.stepper.cancel()
            self.stepper.join()
        self.window.give_back()


going: Activity[Going] = Activity(Going.end, busy="A drawing is being made already")


class CameraDrawing:
    """A drawing that is made surface by surface: next(), the run, take(), and write() at the end.

    All that it needs of the scene is read at once, so that this may be changed meanwhile.
    """

    def __init__(
        self,
        page: CameraPage,
        spacing: float,
        depsgraph: bpy.types.Depsgraph,
        fallback: bpy.types.PropertyGroup | None = None,
        tone: Tone | None = None,
        pen: float = 0.0,
        outlines: bool = False,
    ) -> None:
        """spacing    on paper, in millimetres; with a tone it is twice the pen
        fallback   the settings of what nobody has set up; None: those that it has
        tone       of the light of the scene, which the drawing has then; None: one spacing
        pen        width of the line, in millimetres, for a tone
        outlines   draw where surfaces turn out of sight, creases and edges as well

        Surfaces are drawn as a render shows them. Raises DataError where the camera sees nothing,
        and where there is no light for a tone.
        """
        self._tone, self._pen = tone, pen
        self.page, self.spacing = page, spacing if tone is None else 2.0 * pen
        self.layers: list[Layer] = []
        self._began = time.perf_counter()
        self.name = ""  # of the surface that next() has given
        self._outlines: dict[str, list[Strand]] = {}
        with whatever_it_costs():
            self._read(depsgraph, fallback, outlines)
        self._count = len(self._waiting)

    def _read(
        self,
        depsgraph: bpy.types.Depsgraph,
        fallback: bpy.types.PropertyGroup | None,
        outlines: bool,
    ) -> None:
        page, spacing = self.page, self.spacing
        margin = beyond(spacing, self._tone is not None)
        seen = seen_by(page, margin, depsgraph.view_layer, depsgraph)
        drawn = [each for each in seen if each.is_drawn]
        if not drawn:
            raise DataError(
                "The camera sees no surface; turn it to what is to be drawn, which has to be shown "
                "in the view and in renders"
            )
        self._sight = Sight(page, [each.mesh for each in seen], _LIFT * spacing)
        shading = None
        if self._tone is not None:
            shading = Shading(page, self._tone, self._pen, depsgraph, self._sight)
        paper = PaperSpacing(page, spacing, depsgraph, fallback, shading=shading)
        self._waiting = [(each.name, paper.problem_of(each)) for each in drawn]
        if shading is not None:
            shading.finish(spacing)
        self._closer = paper.closer
        for each in drawn if outlines else ():
            self._outlines[each.name] = outlines_of(each, page, self._sight, spacing)

    def estimate(self) -> DrawingEstimate:
        """What all that has not begun comes to; to be asked for before the first next()."""
        problems = [problem for _name, problem in self._waiting if isinstance(problem, Problem)]
        return DrawingEstimate(problems, self.spacing, float(self.page.sides[0]))

    @property
    def place(self) -> str:
        """Which one it is that next() has given, such as "2 of 5"."""
        return f"{self._count - len(self._waiting)} of {self._count}"

    def next(self) -> Stepper | None:
        """The run of the next surface; None after the last."""
        while self._waiting:
            self.name, problem = self._waiting.pop(0)
            if isinstance(problem, Problem):
                return Stepper(problem)
            self._leave_out(problem)
        return None

    def take(self, stepper: Stepper) -> None:
        """Takes what has grown in a run that has ended as the layer of its surface."""
        try:
            snapshot, statistics, reason = stepper.result()
        except core.MeanderError as error:
            self._leave_out(str(error))
            return
        options = stepper.problem.options
        drawn = on_page(strands_of(snapshot.polylines), self.page, self._sight, self.spacing)
        gaps = stepper.gaps
        empty = Empty(0.0, 0.0) if gaps is None else empty_of(gaps)
        density = stepper.density if stepper.density is not None else np.ones(1)
        figures = {
            "faces": len(stepper.problem.faces),
            "spacing": {
                "least": float(2.0 * options.radius / np.sqrt(density.max())),
                "greatest": float(2.0 * options.radius / np.sqrt(density.min())),
            },
            "nodes": int(statistics["nodes"]),
            "stop_reason": reason,
            "evenness": float(statistics["evenness"]),
            "empty": empty.entry(),
            "crossings": int(statistics["crossings"]),
            "paths": len(drawn),
            "length": Drawing(drawn, "mm", True).length,
            "seconds": float(statistics["seconds_total"]),
        }
        unfilled = ""
        if empty.matters:
            unfilled = f"'{self.name}' is not filled: {percent(empty.share)} of it is empty"
        self.layers.append(Layer(self.name, drawn, {"name": self.name} | figures, unfilled))

    def write(self, path: Path, line_width: float, title: str, report: Path | None) -> str:
        """Writes the page as an SVG with a layer for each surface, and the report of it; both or
        none. Returns what it has come to, in words.

        Raises DataError where nothing can be drawn, and FileError.
        """
        drawn = [each for each in self._drawn() if each[1]]
        if not drawn:
            raise DataError(
                f"Nothing is drawn: {self._why_nothing()}; choose a smaller spacing, or go nearer "
                "with the camera"
            )
        version, page = core.library_version(), self.page.page
        pieces = page_pieces(
            drawn,
            (page.width, page.height),
            line_width,
            title,
            version,
        )
        record = self._record(version, line_width)
        with whole_files([each for each in (path, report) if each is not None]) as temporary:
            with naming(path):
                write_pieces(temporary[0], pieces)
            if report is not None:
                with naming(report):
                    write_report(temporary[1], record)
        layers = "1 layer" if len(drawn) == 1 else f"{len(drawn)} layers"
        return (
            f"{page.width:g} x {page.height:g} mm, {layers}, {record['paths']:,} paths, "
            f"{record['length'] / 1000.0:.3g} m"
        )

    def _drawn(self) -> list[tuple[str, list[Strand]]]:
        """Name and strands of each layer of the page."""
        found = []
        for layer in self.layers:
            found.append((layer.name, layer.strands))
            if layer.name in self._outlines:
                found.append((f"{layer.name} Outline", self._outlines[layer.name]))
        return found

    def remarks(self) -> list[str]:
        """What is left out and why, what is not filled, and what is closer, a sentence each."""
        unfilled = [layer.unfilled for layer in self.layers if layer.unfilled]
        return [*self._left_out(), *unfilled, *self._closer]

    def _left_out(self) -> list[str]:
        return [
            f"'{layer.name}' is left out: {layer.figures['left_out']}"
            for layer in self.layers
            if "left_out" in layer.figures
        ]

    def _record(self, version: str, line_width: float) -> dict[str, Any]:
        page = self.page
        strands = [strand for layer in self.layers for strand in layer.strands]
        whole = Drawing(strands, "mm", True, self.spacing)
        outlines = [strand for lines in self._outlines.values() for strand in lines]
        return {
            "version": version,
            "page": {
                "width": page.page.width,
                "height": page.page.height,
                "margin": page.page.margin,
            },
            "frame": [*page.corner.tolist(), *page.sides.tolist()],
            "spacing": self.spacing,
            "line_width": line_width,
            "objects": [layer.figures for layer in self.layers],
            "paths": len(strands) + len(outlines),
            "outlines": len(outlines),
            "length": whole.length + sum(strand.length for strand in outlines),
            "crossings": len(whole.crossings()),
            "seconds": time.perf_counter() - self._began,
        }

    def _why_nothing(self) -> str:
        left = self._left_out()
        return left[0] if left else "all that has grown is hidden, or shorter than half a spacing"

    def _leave_out(self, sentence: str) -> None:
        figures = {"name": self.name, "left_out": sentence}
        self.layers.append(Layer(self.name, [], figures))
