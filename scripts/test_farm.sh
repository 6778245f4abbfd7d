#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_farm.sh [pytest's arguments]
#
# Installs Debian's Slurm, starts it on this machine alone, and runs a job of 40 items over 4 of its
# tasks. Needs root, as Slurm's daemons do, and no Slurm that runs already. scripts/test.sh does not
# run it: it takes a minute, and changes what is installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash scripts/install_dependencies.sh --farm
bash scripts/build.sh stage
exec env PYTHONDONTWRITEBYTECODE=1 \
  /usr/bin/python3 -m pytest -q -p no:cacheprovider tests/farm "$@"
