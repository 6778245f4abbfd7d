# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings on an object that the table of options declares.

A class either takes its annotations from the table or writes its own: from Python 3.14 on it cannot
do both.
"""

from ..model.options.table import TABLE, in_panel
from ..run import following
from ..scene.linked_settings import owner_of
from .declared import declared


class TableSettings:
    """The part of MeanderSettings that the table declares."""

    __annotations__ = declared(option for option in TABLE if option.panel != "Motion")


class MotionSettings:
    """The settings of a result that follows its surface, which starts again when they change."""

    __annotations__ = declared(
        in_panel("Motion"),
        update=lambda settings, context: following.begin(owner_of(settings), context),
    )
