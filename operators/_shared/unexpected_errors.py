# SPDX-License-Identifier: GPL-3.0-or-later
"""Unexpected errors: one line for the artist, the traceback for the console."""

import functools
import logging

from ...cubic_craft_addon.run.failures import UNEXPECTED, in_words
from ...solver import CubicCraftError

_log = logging.getLogger(__name__)


def reporting(execute):
    """Wrap `execute` of an operator, which changes nothing if it raises, to report the exception.

    Otherwise Blender would show the artist a traceback.
    """

    @functools.wraps(execute)
    def reporting_execute(self, context):
        try:
            return execute(self, context)
        except CubicCraftError as error:
            self.report({"ERROR"}, str(error))
        except UNEXPECTED as error:
            _log.exception("%s failed", self.bl_label)
            self.report({"ERROR"}, f"Nothing has changed: {in_words(error)}")
        return {"CANCELLED"}

    return reporting_execute
