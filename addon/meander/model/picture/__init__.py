# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture in one line: its tones as spacings on a sheet, and what the drawing has become."""
