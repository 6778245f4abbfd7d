# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays in one file, as numpy.load reads them; no bpy."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from .whole import whole_file


def write_npz(path: Path, arrays: Iterable[tuple[str, np.ndarray]]) -> None:
    """Writes named arrays, one after the other, so that a generator need never hold two.

    The same arrays give the same bytes: files in the archive have no date. Raises FileError when
    the file cannot be written; it is then as it was.
    """
    with whole_file(path) as temporary, zipfile.ZipFile(temporary, "w") as archive:
        for name, array in arrays:
            with archive.open(zipfile.ZipInfo(f"{name}.npy"), "w", force_zip64=True) as file:
                np.lib.format.write_array(file, np.asarray(array, order="C"), allow_pickle=False)
