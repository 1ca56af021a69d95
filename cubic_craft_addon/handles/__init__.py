# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles: vertex groups that are held in place, or follow an object, and the rest comes along.

``handle`` is what the solver needs to know of one, in plain values; ``pose`` reads it off the
objects, ``properties`` is what is saved with them.
"""

from .handle import IDENTITY, THRESHOLD, Handle, handle_of, targets

__all__ = ("IDENTITY", "THRESHOLD", "Handle", "handle_of", "targets")
