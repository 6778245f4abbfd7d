#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# From a bare Debian 12: packs the sources as pip takes them, build/sources/meander-VERSION.tar.gz, has pip build the
# wheel from that file alone, and fills a surface by what it has installed. Compiles the library, in some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash scripts/install_dependencies.sh --bpy 4.5
python=$PWD/build/bpy-4.5/bin/python
rm -rf build/sources
mkdir -p build/sources
"$python" -c "import scikit_build_core.build as builder; builder.build_sdist('build/sources')"

# Far from the checkout, by a pip of a new environment, which fetches the builder and numpy.
/usr/bin/python3 -m venv build/sources/environment
cd build/sources
environment/bin/python -m pip install --quiet --disable-pip-version-check meander-*.tar.gz
environment/bin/python - <<'PYTHON'
import meander
import numpy as np

corners = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], dtype=float)
faces = np.array([(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])
options = meander.default_options("even")
options.radius = 0.1
with meander.Surface(corners, faces) as surface:
    flow = meander.Flow(surface, options)
print(flow.run(), flow.statistics()["crossings"], "crossings;", meander.__file__)
PYTHON
