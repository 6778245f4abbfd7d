# SPDX-License-Identifier: GPL-3.0-or-later
"""Inputs that fuzzing the readers has found worth keeping: each is a mesh or a sentence."""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "fuzz"))

import fuzz_readers  # noqa: E402


def test_every_input_that_was_kept(tmp_path: Path) -> None:
    inputs = sorted((ROOT / "tests" / "fuzz" / "readers").iterdir())
    refused = sum(bool(fuzz_readers.read_one(path.read_bytes(), tmp_path)) for path in inputs)
    assert len(inputs) > 20
    assert 0 < refused < len(inputs)
