# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of meshes, images and text, read and written whole."""
