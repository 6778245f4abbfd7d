# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command: a mesh file in, a filling curve and a report out, without a window.

    blender --background --python-exit-code 1 --python <this file> -- --input MESH --output OUT ...

It runs from an installed add-on and from a source checkout, inside Blender and under the bpy
module (``python batch.py -- ...``). Only .blend files and what is in them need either. From Blender
4.2 on an installed add-on runs as ``blender --command meander ...`` as well.

Exit codes: 0 done, also when the iteration limit was reached (the report says so); 3 done, with all
files written, but with gaps where --fail-on-gaps asks for none; 2 bad input, with one sentence on
stderr and every output file as it was; 1 a defect, with a traceback; 130 interrupted from the
keyboard, with every output file as it was.
"""

from __future__ import annotations

import importlib.util
import os
import sys
from pathlib import Path
from typing import NoReturn


def _containing_package() -> str:
    """The name of the package that this file lies in, imported if need be.

    Blender runs this file as a script, which has no package. When the add-on is enabled its package
    is there already; else it is loaded under a name of its own, so that neither sys.path changes
    nor an add-on of the same name from another folder gets in the way.
    """
    folder = Path(__file__).resolve().parent
    for name, module in list(sys.modules.items()):
        paths = list(getattr(module, "__path__", None) or [])
        if len(paths) == 1 and Path(paths[0]).resolve() == folder:
            return name
    name = "_meander_batch_package"
    spec = importlib.util.spec_from_file_location(
        name, folder / "__init__.py", submodule_search_locations=[str(folder)]
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return name


if not globals().get("__package__"):
    __package__ = _containing_package()  # what relative imports go by (PEP 366)

try:
    from .headless.command import hear_interruptions, main
except KeyboardInterrupt:  # numpy alone may take a second
    if __name__ != "__main__":
        raise
    print("meander: interrupted", file=sys.stderr, flush=True)
    sys.exit(130)

__all__ = ["main"]


def end(code: int) -> NoReturn:
    """Ends the process.

    Where Blender is a module of Python its own clean-up at exit crashes once classes have been
    registered (bpy 4.2), or hangs: everything is written by then, and it is left out.
    """
    bpy = sys.modules.get("bpy")
    if bpy is None or bpy.app.binary_path:
        sys.exit(code)
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


if __name__ == "__main__":
    hear_interruptions()
    end(main())
