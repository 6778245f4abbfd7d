# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures in files, as Blender reads them."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np

from ..model.files.whole import FileError
from ..model.picture.image import Image, image_of


def read_picture(path: Path) -> Image:
    """The picture in a file; nothing of it stays in the scene. Blender does not turn photographs
    as their cameras say.

    Raises FileError where Blender cannot read it.
    """
    try:
        image = bpy.data.images.load(str(path.absolute()), check_existing=False)
    except RuntimeError as problem:
        raise FileError(
            f"{path} cannot be read as a picture; save it as PNG, JPEG or TIFF"
        ) from problem
    try:
        # The numbers of the file, whatever Blender would take them for.
        image.colorspace_settings.name = "Non-Color"
        image.alpha_mode = "CHANNEL_PACKED"
        width, height = image.size
        if not width or not height:
            raise FileError(f"{path} cannot be read as a picture; save it as PNG, JPEG or TIFF")
        pixels = np.empty(width * height * image.channels, dtype=np.float32)
        image.pixels.foreach_get(pixels)
        return image_of(pixels.reshape(height, width, image.channels)[::-1])
    finally:
        bpy.data.images.remove(image)
