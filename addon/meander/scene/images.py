# SPDX-License-Identifier: GPL-3.0-or-later
"""Images as pixels, and how bright these are."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import numpy as np
from numpy.typing import NDArray

from ..model.density import Values, luminance, srgb_luminance
from .errors import DataError


def pixels_of(name: str) -> tuple[NDArray[np.float32], Callable[[NDArray], Values]]:
    """An image's pixels (height, width, channels), first row at the bottom, and their brightness.

    The brightness is what an Image Texture and RGB to BW give: 8-bit pixels of an sRGB image are
    made linear; data and linear images are taken as they are, and so are float images, which
    Blender makes linear when it opens them.
    """
    image = bpy.data.images.get(name)
    if image is None:
        raise DataError(f"There is no image '{name}' in this file; open it, or choose another")
    if image.source not in {"FILE", "GENERATED"}:
        kind = {"TILED": "tiled (UDIM)", "VIEWER": "a render result"}.get(image.source, "a movie")
        raise DataError(f"The image '{name}' is {kind}; only a single still image serves")
    width, height = image.size
    if not width or not height or not len(image.pixels):
        raise DataError(
            f"The image '{name}' has no pixels, as its file cannot be found; find it by File > "
            "External Data, or open it again"
        )
    pixels = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    is_srgb = not image.is_float and "sRGB" in image.colorspace_settings.name
    return pixels.reshape(height, width, image.channels), srgb_luminance if is_srgb else luminance
