# SPDX-License-Identifier: GPL-3.0-or-later
"""What the asset file of the add-on is made of: a module for each node group or set of materials.

Every module has build(), which makes its data-blocks in the open file, in Blender 3.4, and returns
them; make_assets.py writes them into one file.
"""
