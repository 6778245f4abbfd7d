# SPDX-License-Identifier: GPL-3.0-or-later
"""How much memory a computation takes at its peak, in a process of its own."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import geometry
import pytest
from conftest import PACKAGE

linux_tells = pytest.mark.skipif(
    not Path("/proc/self/clear_refs").exists(), reason="Linux tells of peaks"
)

# The library is loaded and the arrays are there before; writing 5 there makes the kernel forget
# older peaks.
_PREPARED = """
import importlib.util, json, math, sys
package, tests, *given = sys.argv[1:]
place = importlib.util.spec_from_file_location("meander", package + "/__init__.py",
                                               submodule_search_locations=[package])
sys.modules["meander"] = importlib.util.module_from_spec(place)
place.loader.exec_module(sys.modules["meander"])
sys.path.append(tests)
import geometry
from meander import core
def kilobytes(name):
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith(name))
"""
_BEGINS = """
with open("/proc/self/clear_refs", "w") as file:
    file.write("5")
before = kilobytes("VmRSS")
"""
_ENDS = """
print(json.dumps([1024 * (kilobytes("VmHWM") - before), told]))
"""


def peak_of(prepare: str, compute: str, *given: object) -> list[float]:
    """The bytes that the second of two pieces of Python takes at its peak, and what it leaves in
    `told`. `given` are the words in their list of that name, beside `core`, `geometry`, `math`."""
    script = _PREPARED + prepare + _BEGINS + compute + _ENDS
    words = [str(word) for word in (PACKAGE, Path(geometry.__file__).parent, *given)]
    done = subprocess.run(
        [sys.executable, "-c", script, *words], capture_output=True, text=True, timeout=300,
        check=True,
    )  # fmt: skip
    return json.loads(done.stdout)
