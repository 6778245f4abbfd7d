# SPDX-License-Identifier: GPL-3.0-or-later
"""Vectors of length 1."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def unit(
    vectors: NDArray[np.floating],
    otherwise: NDArray[np.floating] | None = None,
    least: float = 0.0,
) -> NDArray[np.floating]:
    """Vectors along the last axis, made of length 1.

    otherwise   what stands for those that are no longer than `least`; None: 0
    """
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    instead = np.zeros_like(vectors) if otherwise is None else np.array(otherwise)
    return np.divide(vectors, lengths, out=instead, where=lengths > least)
