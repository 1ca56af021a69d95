# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles: vertex groups that are held in place or follow an object, and the rest follows.

``handle`` holds the plain values that the solver needs, ``pose`` reads them from the objects, and
``properties`` is saved with the objects.
"""

from .handle import THRESHOLD, Handle, handle_of
