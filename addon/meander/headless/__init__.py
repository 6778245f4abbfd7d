# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command in Blender: what `cli` asks of it, and how Blender starts the command."""
