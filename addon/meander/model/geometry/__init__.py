# SPDX-License-Identifier: GPL-3.0-or-later
"""Points, lines and triangle meshes, in numpy: what is near, where it crosses, what is left out."""
