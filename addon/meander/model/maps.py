# SPDX-License-Identifier: GPL-3.0-or-later
"""A curve as images by a UV map of its surface, made of the surface cut along it; numpy only.

The cut has the curve among its edges, and every corner of it has its place in the UV map, so that
each pixel is asked of the triangle that it lies in, by the library: nothing is rendered, and
nothing is sampled.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .. import core
from .files.exr import exr
from .files.png import png
from .geometry.unit_vectors import unit

# What an image can show; docs/making.md says what its values mean.
KINDS = ("mask", "distance", "height", "normal", "side", "along", "color")
# PNG has 16 bits a channel, EXR 32-bit floats.
SUFFIXES = (".png", ".exr")
# The colours along a line that the add-on's material begins with, linear: share, and colour.
RAMP = (
    (0.0, (0.010, 0.030, 0.180)),
    (0.5, (0.160, 0.008, 0.150)),
    (1.0, (0.420, 0.045, 0.010)),
)
SIZES = (16, 16384)
MOST_TILES = 100
# How long the edges of a cut are to be between the lines, in spacings.
DETAIL = 0.125
# Pixels whose values are computed at a time: their arrays are kept by the allocator, and not asked
# of the system anew for each part.
_AT_ONCE = 1 << 21
# The shares of the work at a tile that are done when its pixels are known, and when their middles
# have been looked at and all that is left are means.
_PIXELS_FOUND, _MIDDLES_LOOKED_AT = 0.1, 0.3
# Places along each side of a pixel of which it is the mean, where turns meet in it: no fewer than
# the first and no more than the second, and no farther apart than this share of the spacing.
_SAMPLES, _APART = (4, 8), 0.04
# Pixels wider than this share of the spacing are all means: heights bend within them.
_COARSE = 0.08
# Neighbouring pixels farther apart than this along the line, in spacings, belong to two turns.
_JUMP = 0.7
# Kinds of three values a pixel.
_VECTORS = ("normal", "color")


class NoPlace(Exception):
    """A UV map that cannot be drawn on; ``str(error)`` ends a sentence that begins with it."""


@dataclass(frozen=True)
class Style:
    """What images look like.

    size         of a side, in pixels, within SIZES
    margin       how far islands go on beyond their edges, in pixels, so that no seam shows
    line_width   of the mask's line, in spacings
    depth        from the line up to the ridges, in spacings: how steep the normals are
    ramp         the colours along the line, (k, 3), linear, at equal steps from its beginning to
                 its end, or halfway round a closed one; None: those of RAMP
    """

    size: int = 2048
    margin: int = 16
    line_width: float = 0.25
    depth: float = 0.25
    ramp: NDArray[np.float64] | None = None

    def colours(self, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        """Of the ramp at shares (n,) in [0, 1], (n, 3)."""
        if self.ramp is None:
            places, ramp = zip(*RAMP, strict=True)
        else:
            places, ramp = np.linspace(0.0, 1.0, len(self.ramp)), self.ramp
        columns = np.asarray(ramp, float).T
        return np.stack([np.interp(shares, places, column) for column in columns], axis=1)


@dataclass(frozen=True)
class Mapped:
    """A cut, and where it lies in a UV map.

    uv        (m, 3, 2), of the corners of the cut's faces
    spacing   of the curve, in the units of the cut
    """

    cut: core.CutSurface
    uv: NDArray[np.float64]
    spacing: float

    @classmethod
    def of(cls, cut: core.CutSurface, corners: NDArray[np.float64], spacing: float) -> Mapped:
        """A cut laid into a UV map.

        corners   (f, 3, 2), the map at the corners of the surface's faces
        """
        uv = np.einsum("mkw,mwx->mkx", cut.corner_weights, corners[cut.origins])
        return cls(cut, uv, spacing)

    def tiles(self) -> list[tuple[int, int]]:
        """The unit squares of the map that faces lie in, by columns and rows, as UDIM counts."""
        sides = self.uv[:, 1:] - self.uv[:, :1]
        flat = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
        # One without area is on no pixel; what is not a number is none either.
        middles = self.uv.mean(axis=1)[flat > 0.0]
        squares = np.floor(np.clip(middles, -1e6, 1e6)).astype(np.int64)
        across = 1 << 32
        found = np.unique(squares[:, 0] * across + squares[:, 1] + across // 2)
        return [(int(code // across), int(code % across) - across // 2) for code in found]


@dataclass(frozen=True)
class _Looked:
    """What is known of places: their faces, and the nearest places of the line."""

    face: NDArray[np.int32]
    places: core.CutPlaces


def _parts(count: int) -> Iterator[tuple[float, slice]]:
    """Parts of so many pixels, each with the share that is done with it."""
    for begin in range(0, count, _AT_ONCE):
        end = min(begin + _AT_ONCE, count)
        yield end / count, slice(begin, end)


def _chosen(part: slice, known: NDArray[np.bool_]) -> slice | NDArray[np.int64]:
    """The known pixels of a part; where all are, which needs no copies, the part itself."""
    return part if known.all() else part.start + np.flatnonzero(known)


class Tile:
    """One unit square of a map, as pixels: the mean over the area of each.

    Most pixels lie within one turn and are what their middle is. Those at the border between two
    turns, on the line, or at the edge of an island are the mean of many places, as far as these lie
    on the surface. Those of the margin beyond show what the nearest ones within an island do.

    overlap   the share of its pixels that lie in two places of the surface
    """

    def __init__(
        self,
        mapped: Mapped,
        tile: tuple[int, int],
        style: Style,
        context: core.Context | None = None,
        kinds: Sequence[str] = KINDS,
    ) -> None:
        """kinds     those of KINDS that will be asked for
        context   where it is cancelled, whatever takes long raises a core.MeanderError soon
        """
        self._mapped, self._style, self._kinds = mapped, style, tuple(kinds)
        size = style.size
        # In pixels, whose centres are whole numbers; rows count from the top, as in image files.
        places = (mapped.uv - np.array(tile)) * size - 0.5
        places[:, :, 1] = size - 1 - places[:, :, 1]
        self._places = places
        pixels = core.map_pixels(places, size, style.margin, context=context)
        self.face, self._weights = pixels.faces, pixels.weights
        self._context = context
        self._beyond, self._shown = self._margin()
        self.overlap = pixels.twice / pixels.covered if pixels.covered else 0.0
        self._images: dict[str, NDArray[np.float32]] | None = None

    def _margin(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """The pixels of the margin, and those within an island whose places they have."""
        bare = core.map_pixels(self._places, self._style.size, context=self._context).faces
        beyond = np.flatnonzero((self.face >= 0) & (bare < 0))
        shown = np.empty_like(beyond)
        for _done, part in _parts(len(beyond)):
            here = beyond[part]
            corners = self._places[self.face[here]]
            column, row = np.rint(np.einsum("nk,nkx->xn", self._weights[here], corners))
            shown[part] = row * self._style.size + column
        return beyond, shown

    def values(self, kind: str) -> NDArray[np.float32]:
        """One of the kinds, (size, size) or, of normals and colours, (size, size, 3), all from 0 to
        1; 0 where no face is near. Colours are linear."""
        if kind not in self._kinds:
            raise KeyError(f"{kind} is none of the kinds of this tile")
        if self._images is None:
            for _share in self.draw():
                pass
        return self._images[kind]

    def image(self, kind: str) -> NDArray[np.uint16]:
        """The same with 16 bits a channel; colours are as screens have them (sRGB)."""
        values = self.values(kind)
        scaled = (_encoded(values) if kind == "color" else values) * 65535.0
        return np.rint(scaled, out=scaled).astype(np.uint16)

    def file(self, kind: str, suffix: str) -> bytes:
        """The same as a file, of one of SUFFIXES."""
        return exr(self.values(kind)) if suffix == ".exr" else png(self.image(kind))

    def draw(self) -> Iterator[float]:
        """Computes the values piece by piece, for who wants to do something else meanwhile; gives
        the share that is done after each."""
        size = self._style.size
        yield _PIXELS_FOUND
        images = {
            kind: np.zeros((size * size, 3) if kind in _VECTORS else size * size, dtype=np.float32)
            for kind in self._kinds
        }
        within = self.face >= 0
        within[self._beyond] = False
        averaged = [kind for kind in self._kinds if kind != "mask"]  # which is one already
        looked = _MIDDLES_LOOKED_AT if averaged else 1.0
        if averaged:
            turn, along = np.full(size * size, -1, dtype=np.int64), np.zeros(size * size)
            bent = np.zeros(size * size, dtype=bool)
        for done, whole in _parts(size * size):
            part = _chosen(whole, within[whole])
            at = self._look(self.face[part], self._weights[part])
            for kind, image in images.items():
                image[part] = self._values(kind, at)
            if averaged:
                turn[part], along[part] = self._turns(at), at.places.along / self._mapped.spacing
                width = self._pixel_widths[at.face]
                coarse = width > _COARSE * self._mapped.spacing
                bent[part] = coarse | (at.places.distances < width)  # the line may be in it
            yield _PIXELS_FOUND + (looked - _PIXELS_FOUND) * done
        if averaged:
            pixels = np.flatnonzero(bent | self._at_borders(turn, along))
            for done in self._average(images, averaged, pixels, within):
                yield _MIDDLES_LOOKED_AT + (1.0 - _MIDDLES_LOOKED_AT) * done
        rest = ~within[self._beyond]
        for image in images.values():
            image[self._beyond[rest]] = image[self._shown[rest]]
        if "normal" in images:
            known = self.face >= 0
            images["normal"][known] = 0.5 + 0.5 * unit(images["normal"][known] - 0.5)
        self._images = {
            kind: image.reshape(size, size, *image.shape[1:]) for kind, image in images.items()
        }

    def _at_borders(self, turn: NDArray[np.int64], along: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which pixels have a neighbour that belongs to another turn or side, or to none."""
        size = self._style.size
        turn, along = turn.reshape(size, size), along.reshape(size, size)
        border = np.zeros((size, size), dtype=bool)
        for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
            rows = slice(0, size - down), slice(down, size)
            if right >= 0:
                columns = slice(0, size - right), slice(right, size)
            else:
                columns = slice(1, size), slice(0, size - 1)
            here, there = (rows[0], columns[0]), (rows[1], columns[1])
            differs = turn[here] != turn[there]
            differs |= np.abs(along[here] - along[there]) > _JUMP
            border[here] |= differs
            border[there] |= differs
        return border.ravel() & (self.face >= 0)

    def _average(
        self,
        images: dict[str, NDArray[np.float32]],
        kinds: Sequence[str],
        pixels: NDArray[np.int64],
        within: NDArray[np.bool_],
    ) -> Iterator[float]:
        """Puts the mean over so many places of each of these pixels, as far as they lie on the
        surface, in the place of its middle, and gives the share that is done.

        within   pixels whose values are known; those of which some place does are among them then
        """
        sums = {kind: np.zeros((len(pixels), *images[kind].shape[1:])) for kind in kinds}
        counts = np.zeros(len(pixels), dtype=np.int64)
        samples = self._samples(pixels)
        steps = (np.arange(samples) + 0.5) / samples - 0.5
        offsets = np.stack(np.meshgrid(steps, steps), axis=2).reshape(-1, 2)
        for passed, offset in enumerate(offsets):
            found = core.map_pixels(self._places - offset, self._style.size, context=self._context)
            for done, part in _parts(len(pixels)):
                on = part.start + np.flatnonzero(found.faces[pixels[part]] >= 0)
                at = self._look(found.faces[pixels[on]], found.weights[pixels[on]])
                counts[on] += 1
                for kind in kinds:
                    sums[kind][on] += self._values(kind, at)
                yield (passed + done) / len(offsets)
        met = counts > 0
        within[pixels[met]] = True
        for kind in kinds:
            images[kind][pixels[met]] = (sums[kind][met].T / counts[met]).T

    def _samples(self, pixels: NDArray[np.int64]) -> int:
        """Along each side of these pixels: the more, the wider they are on the surface."""
        if not len(pixels):
            return _SAMPLES[0]
        width = float(np.median(self._pixel_widths[self.face[pixels]])) / self._mapped.spacing
        return int(np.clip(np.ceil(width / _APART), *_SAMPLES))

    def _look(self, face: NDArray[np.int32], weights: NDArray[np.float32]) -> _Looked:
        cut = self._mapped.cut
        places = core.cut_places(
            cut, self._mapped.spacing, face, weights, "normal" in self._kinds, context=self._context
        )
        return _Looked(face, places)

    def _turns(self, at: _Looked) -> NDArray[np.int64]:
        """A number for the strand and side that places belong to."""
        strands = at.places.strands
        numbers = np.where(strands == core.NO_STRAND, 0, strands.astype(np.int64) + 1)
        return 2 * numbers + (self._mapped.cut.sides[at.face] > 0)

    def _values(self, kind: str, at: _Looked) -> NDArray[np.float64]:
        spacing, face = self._mapped.spacing, at.face
        distance = at.places.distances / spacing
        if kind == "side":
            values = (self._mapped.cut.sides[face] > 0).astype(np.float64)
        elif kind == "along":
            values = self._shares(at.places)[0]
        elif kind == "color":
            along, closed = self._shares(at.places)
            # Of a closed strand from 0 to 1 and back, so that nothing shows where it meets itself.
            back = 1.0 - np.abs(2.0 * (along % 1.0) - 1.0)
            values = self._style.colours(np.where(closed, back, along))
        elif kind == "mask":
            edge = 0.5 * self._style.line_width - distance
            values = 0.5 + edge * spacing / self._pixel_widths[face]
        elif kind == "normal":
            values = self._normals(face, distance, at.places.away)
        else:
            values = distance if kind == "distance" else _height(distance)
        return np.clip(values, 0.0, 1.0)

    def _shares(self, places: core.CutPlaces) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """How far along their strands places are, from 0 to 1, and whether these are closed."""
        cut = self._mapped.cut
        count = int(cut.line_strands.max()) + 2 if len(cut.line_strands) else 1
        lengths, closed = np.ones(count), np.zeros(count, dtype=bool)
        lengths[cut.line_strands], closed[cut.line_strands] = cut.lengths, cut.closed != 0
        strands = np.minimum(places.strands, count - 1)
        return places.along / lengths[strands], closed[strands]

    @cached_property
    def _pixel_widths(self) -> NDArray[np.float64]:
        """How wide a pixel is on the surface, for each face of the cut."""
        corners = self._mapped.cut.positions[self._mapped.cut.faces]
        sides = corners[:, 1:] - corners[:, :1]
        area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
        flat = self._places[:, 1:] - self._places[:, :1]
        pixels = np.abs(flat[:, 0, 0] * flat[:, 1, 1] - flat[:, 0, 1] * flat[:, 1, 0])
        return np.sqrt(area / np.maximum(pixels, 1e-300)).clip(1e-12 * self._mapped.spacing)

    def _normals(
        self, face: NDArray[np.int32], distance: NDArray[np.float64], away: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Normals of the relief in the tangent space of the map, x along U and y along V.

        away   from the nearest place on the curve: the way on which the distance grows
        """
        cut = self._mapped.cut
        corners = cut.positions[cut.faces]
        sides = corners[:, 1:] - corners[:, :1]
        uv = self._mapped.uv[:, 1:] - self._mapped.uv[:, :1]
        determinant = uv[:, 0, 0] * uv[:, 1, 1] - uv[:, 0, 1] * uv[:, 1, 0]
        turned = np.sign(determinant)[:, None]
        along_u = unit(turned * (uv[:, 1, 1:] * sides[:, 0] - uv[:, 0, 1:] * sides[:, 1]))
        along_v = turned * np.cross(unit(np.cross(sides[:, 0], sides[:, 1])), along_u)
        rise = np.stack(((away * along_u[face]).sum(1), (away * along_v[face]).sum(1)), axis=1)
        slope = -self._style.depth * _steepness(distance)[:, None] * unit(rise)
        return 0.5 + 0.5 * unit(np.concatenate((slope, np.ones_like(slope[:, :1])), axis=1))


def _encoded(linear: NDArray[np.float32]) -> NDArray[np.float32]:
    """Colours as sRGB has them (IEC 61966-2-1)."""
    curved = 1.055 * np.maximum(linear, 0.0031308) ** (1.0 / 2.4) - 0.055
    return np.where(linear <= 0.0031308, 12.92 * linear, curved)


def _height(distance: NDArray[np.float64]) -> NDArray[np.float64]:
    """A round ridge halfway between the turns: 0 on the line, 1 half a spacing from it."""
    return 1.0 - np.clip(1.0 - 2.0 * distance, 0.0, 1.0) ** 2


def _steepness(distance: NDArray[np.float64]) -> NDArray[np.float64]:
    """The derivative of _height()."""
    return 4.0 * np.clip(1.0 - 2.0 * distance, 0.0, 1.0)
