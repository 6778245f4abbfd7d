# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures as arrays: read by Pillow, where it is installed, averaged and blurred; no bpy."""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..files.whole import FileError, why_no_file

PACKAGE = "Pillow"
# What holds light and no coded values, which Blender reads and Pillow does not.
LINEAR = (".exr", ".hdr")

# A picture of more pixels is refused: it would need several gigabytes.
_MOST_PIXELS = 200_000_000
# How a file of 16 bits has its bytes, as Pillow calls it, and the other way round. What is packed
# comes in the order of the machine, whose low byte is first wherever Meander runs.
_OTHER_ORDER = {";16B": "L", ";16L": "B", ";16N": "B"}
# Grey of 16 bits with opacity, of which Pillow knows no other order: as many bytes as four colours.
_DEEP_GREY, _BYTES = "LA;16B", "RGBA"
# Resampling leaves numbers beside edges that are beyond 0 and 1, but not by more.
_BEYOND = 1.0
# Of Exif, and in how many bytes from the beginning of a file it is.
_ORIENTATION, _HEAD = 0x0112, 1 << 18
# How far a blur looks, in standard deviations.
_REACH = 4.0


@dataclass(frozen=True)
class Image:
    """A picture, row by row from the top.

    colours   (h, w, 3) float32 from 0 to 1, as sRGB has them
    opacity   (h, w) float32 from 0 to 1; None: everything is opaque
    """

    colours: NDArray[np.float32]
    opacity: NDArray[np.float32] | None = None

    @property
    def sides(self) -> tuple[int, int]:
        """Width and height, in pixels."""
        return self.colours.shape[1], self.colours.shape[0]

    def cropped(self, left: int, top: int, width: int, height: int) -> Image:
        """A part of it, in pixels, which it has."""
        part = (slice(top, top + height), slice(left, left + width))
        return Image(self.colours[part], None if self.opacity is None else self.opacity[part])


def image_of(pixels: ArrayLike) -> Image:
    """An array as a picture.

    pixels   (h, w), (h, w, 1) grey, (h, w, 2) with opacity, (h, w, 3) or (h, w, 4) of colours,
             from the top; integers of 8 or 16 bits up to their greatest, numbers from 0 to 1

    Raises FileError for another shape, and for what is no number.
    """
    values = np.asarray(pixels)
    values = values[..., None] if values.ndim == 2 else values
    if values.ndim != 3 or values.shape[2] not in (1, 2, 3, 4) or 0 in values.shape:
        raise FileError(
            f"an array of shape {np.shape(pixels)} is no picture; give rows of pixels with 1 to 4 "
            "values each"
        )
    if values.dtype == bool:
        values = values.astype(np.float32)
    elif np.issubdtype(values.dtype, np.integer):
        if values.dtype.itemsize > 2:
            raise FileError(
                f"an array of {values.dtype} does not say what is white; give them as uint8 or "
                "uint16, or numbers from 0 to 1"
            )
        values = values.astype(np.float32) / np.float32(np.iinfo(values.dtype).max)
    elif np.issubdtype(values.dtype, np.floating):
        values = values.astype(np.float32)
    else:
        raise FileError(f"an array of {values.dtype} is no picture; give numbers")
    _check_range(values)
    values = values.clip(0.0, 1.0)
    depth = values.shape[2]
    opacity = values[..., -1] if depth in (2, 4) else None
    if opacity is not None and (opacity == 1.0).all():
        opacity = None
    colours = values[..., :1] if depth < 3 else values[..., :3]
    return Image(np.broadcast_to(colours, (*values.shape[:2], 3)), opacity)


def _check_range(values: NDArray[np.float32]) -> None:
    """Raises FileError for numbers that are not from 0 to 1, or nearly."""
    least, most = float(values.min()), float(values.max())
    if not (np.isfinite(least) and np.isfinite(most)):
        raise FileError("the picture has values that are not finite numbers; correct them")
    if most > 1.0 + _BEYOND:
        raise FileError(
            f"the picture has values up to {most:g}, and numbers have to be from 0 to 1; divide "
            f"them by {most:g}"
        )
    if least < -_BEYOND:
        raise FileError(
            f"the picture has values from {least:g}, and numbers have to be from 0 to 1; correct "
            "them"
        )


def is_there() -> bool:
    """Whether Pillow can be imported."""
    return importlib.util.find_spec("PIL") is not None


def missing_text(what: str) -> str:
    """What to say where it is not."""
    return (
        f"{what} needs the Python package {PACKAGE}; install it by pip install {PACKAGE}, or "
        "Meander as meander[picture]"
    )


def read_image(path: str | Path) -> Image:
    """The picture in a file, as it is meant to be seen: turned as its camera says, with all 16 bits
    where it has them. A profile of colours other than sRGB is not looked at.

    Raises FileError: it cannot be read, or Pillow is not installed.
    """
    if not is_there():
        raise FileError(missing_text(f"{path}"))
    if fault := why_no_file(Path(path)):
        raise FileError(f"{path} {fault}")
    from PIL import Image as pillow

    pillow.MAX_IMAGE_PIXELS = None  # the limit is ours
    try:
        with pillow.open(path) as opened:
            if opened.width * opened.height > _MOST_PIXELS:
                raise FileError(
                    f"{path} has {opened.width * opened.height / 1e6:,.0f} million pixels, and "
                    f"{_MOST_PIXELS / 1e6:,.0f} million is the most; make it smaller"
                )
            pixels = turned(_pixels(opened, path), opened.getexif().get(_ORIENTATION, 1))
    except (OSError, SyntaxError, ValueError) as problem:
        raise FileError(
            f"{path} cannot be read as a picture ({problem}); save it as PNG, JPEG or TIFF"
        ) from problem
    try:
        return image_of(pixels)
    except FileError as problem:
        raise FileError(str(problem).replace("the picture", str(path), 1)) from problem


def _pixels(opened: Any, path: str | Path) -> NDArray[Any]:
    """The pixels of a picture that Pillow has opened, as image_of() takes them."""
    from PIL import Image as pillow

    raw = _raw_mode(opened)
    if opened.mode in ("RGB", "RGBA") and raw[-4:] in _OTHER_ORDER:
        with pillow.open(path) as again:
            if raw == _DEEP_GREY:
                again.tile = [_read_as(tile, _BYTES) for tile in again.tile]
                return np.ascontiguousarray(again).view(">u2").astype(np.uint16)
            return _keyed(_deep(opened, again), opened)
    if opened.mode.startswith("I"):
        values = np.asarray(opened)
        if values.max() > 65535 or values.min() < 0:
            raise ValueError("its integers have 32 bits")
        return _keyed(values.astype(np.uint16), opened)
    if opened.mode == "F":
        return np.asarray(opened)
    transparent = opened.mode in ("RGBA", "LA", "PA") or "transparency" in opened.info
    grey = opened.mode in ("1", "L", "LA")
    mode = ("LA" if grey else "RGBA") if transparent else ("L" if grey else "RGB")
    return np.asarray(opened.convert(mode))


def _raw_mode(opened: Any) -> str:
    """How the file has its pixels; "" where nobody can say."""
    arguments = opened.tile[0][3] if opened.tile else ""
    raw = arguments[0] if isinstance(arguments, tuple) and arguments else arguments
    return raw if isinstance(raw, str) else ""


def _deep(opened: Any, again: Any) -> NDArray[np.uint16]:
    """Colours of 16 bits, of which Pillow keeps the high byte: read as if the bytes stood the other
    way round, the high byte is the low one."""
    again.tile = [_read_as(tile, _in_other_order(_raw_mode(again))) for tile in again.tile]
    high, low = np.asarray(opened), np.asarray(again)
    return (high.astype(np.uint16) << 8) | low


def _read_as(tile: Any, raw_mode: str) -> Any:
    """A part of a file that Pillow is to read as if its pixels were another kind of bytes."""
    *where, arguments = tile
    changed = (raw_mode, *arguments[1:]) if isinstance(arguments, tuple) else raw_mode
    return type(tile)(*where, changed) if hasattr(tile, "_fields") else (*where, changed)


def _in_other_order(raw_mode: str) -> str:
    return raw_mode[:-1] + _OTHER_ORDER[raw_mode[-4:]]


def _keyed(pixels: NDArray[np.uint16], opened: Any) -> NDArray[np.uint16]:
    """Pixels of 16 bits with opacity, where the file names a colour that stands for nothing."""
    key = opened.info.get("transparency")
    if key is None or isinstance(key, bytes):
        return pixels
    pixels = pixels if pixels.ndim == 3 else pixels[..., None]
    opaque = (pixels != np.array(key)).any(axis=-1, keepdims=True)
    return np.concatenate([pixels, np.where(opaque, 65535, 0).astype(np.uint16)], axis=-1)


def turn_of(path: Path) -> int:
    """How a JPEG says that its camera was held, from 1, upright, to 8; 1 where nothing is said.

    For whoever reads pictures without Pillow. Raises OSError where the file cannot be read.
    """
    with path.open("rb") as file:
        data = file.read(_HEAD)
    place = 2
    while data[:2] == b"\xff\xd8" and data[place : place + 1] == b"\xff":
        part = data[place : place + 2 + int.from_bytes(data[place + 2 : place + 4], "big")]
        if part[1:2] == b"\xe1" and part[4:10] == b"Exif\0\0":
            return _turn_in(part[10:])
        place += max(len(part), 2)
    return 1


def _turn_in(tiff: bytes) -> int:
    """The orientation in a head of TIFF, which Exif is."""
    order: Any = "little" if tiff[:2] == b"II" else "big"
    place = int.from_bytes(tiff[4:8], order)
    for _ in range(int.from_bytes(tiff[place : place + 2], order)):
        entry = tiff[place + 2 : place + 14]
        if int.from_bytes(entry[:2], order) == _ORIENTATION:
            return int.from_bytes(entry[8:10], order)
        place += 12
    return 1


def turned(pixels: NDArray[Any], turn: int) -> NDArray[Any]:
    """Pixels as the camera was held, which a photograph says."""
    if turn in (5, 6, 7, 8):
        pixels = np.swapaxes(pixels, 0, 1)
    if turn in (2, 3, 6, 7):
        pixels = pixels[:, ::-1]
    if turn in (3, 4, 7, 8):
        pixels = pixels[::-1]
    return pixels


def averaged(
    values: NDArray[np.floating], places_y: NDArray[np.float64], places_x: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The mean of an array (h, w) around places, (len(places_y), len(places_x)).

    places   equal steps from 0 to 1 of the height and of the width, ends among them; each stands
             for half a step on both sides, and for half a pixel at least
    """
    return _averaged(_averaged(values, places_y).T, places_x).T


def _averaged(values: NDArray[np.floating], places: NDArray[np.float64]) -> NDArray[np.float64]:
    count = len(values)
    half = max(0.5 / count, 0.5 / (len(places) - 1))
    low, high = (places - half).clip(0.0, 1.0) * count, (places + half).clip(0.0, 1.0) * count
    sums = np.zeros((count + 1, values.shape[1]))
    np.cumsum(values, axis=0, out=sums[1:])

    def up_to(place: NDArray[np.float64]) -> NDArray[np.float64]:
        whole = np.minimum(place.astype(np.int64), count - 1)
        share = (place - whole)[:, None]
        return sums[whole] * (1.0 - share) + sums[whole + 1] * share

    return (up_to(high) - up_to(low)) / (high - low)[:, None]


def blurred(values: NDArray[np.float64], sigma: float) -> NDArray[np.float64]:
    """An array (h, w) under a Gaussian of a standard deviation in cells, mirrored at its edges."""
    for axis in (0, 1):
        values = _blurred(values, sigma, axis)
    return values


def _blurred(values: NDArray[np.float64], sigma: float, axis: int) -> NDArray[np.float64]:
    count = values.shape[axis]
    pad = int(np.ceil(_REACH * sigma))
    if pad == 0:
        return values
    widths = [(0, 0), (0, 0)]
    widths[axis] = (pad, pad)
    padded = np.pad(values, widths, mode="symmetric")
    size = padded.shape[axis]
    frequency = np.fft.rfftfreq(size)
    transfer = np.exp(-2.0 * (np.pi * sigma * frequency) ** 2)
    shape = (-1, 1) if axis == 0 else (1, -1)
    spectrum = np.fft.rfft(padded, axis=axis) * transfer.reshape(shape)
    found = np.fft.irfft(spectrum, size, axis=axis)
    return found[pad : pad + count] if axis == 0 else found[:, pad : pad + count]
