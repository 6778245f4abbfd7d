# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of build/web/meander.mjs have the bytes of those of the native library.

MEANDER_CASES=sheet pytest tests/web     only fingerprints whose names contain this
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
sys.path.insert(0, str(Path(__file__).parent))

import fingerprints  # noqa: E402
from node_core import NodeCore  # noqa: E402

WANTED = os.environ.get("MEANDER_CASES", "")
NATIVE = fingerprints.load_core(ROOT / "addon" / "meander")


@pytest.fixture(scope="module")
def node():
    core = NodeCore()
    yield core
    core.close()


NAMES = [
    name for name in (*fingerprints.CASES, *fingerprints.field_rows(NATIVE, 1)) if WANTED in name
]


@pytest.mark.parametrize("name", NAMES)
def test_curves_have_the_same_bytes_as_native_ones(node, name):
    def row(core):
        if name in fingerprints.CASES:
            return fingerprints.run_case(core, name, 1)
        return fingerprints.field_rows(core, 1)[name]()

    assert str(row(node)) == str(row(NATIVE))
