# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: stories of a user at a window with real keys and clicks, by their files' names.

    LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 960x600x24 -nolisten tcp" \\
      blender --factory-startup --enable-event-simulate --window-geometry 0 0 960 600 \\
      --python-exit-code 1 --python tests/ui/tell.py -- run undo
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Another add-on folder can be tried with the same stories.
ADDONS = os.environ.get("MEANDER_ADDON_PARENT", str(HERE.parents[1] / "addon"))
sys.path[:0] = [str(HERE), str(HERE.parent), ADDONS]

import stage  # noqa: E402

stage.tell(sys.argv[sys.argv.index("--") + 1 :])
