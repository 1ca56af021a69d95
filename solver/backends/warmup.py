# SPDX-License-Identifier: GPL-3.0-or-later
"""Compile Taichi kernels, or load them from its cache, before the clock of a run starts."""

import time

from .arrays import one_row
from .taichi_runtime import quick_compilation

_rehearsed = set()


def warm_up(calls):
    """Run kernels on next to nothing, those that have been before excepted; return the seconds.

    Parameters
    ----------
    calls : iterable of (kernel, arguments)
        The arrays among the arguments are replaced by one row of zeros, with another one behind it:
        where rows begin and end, nothing begins.
    """
    begin = time.perf_counter()
    with quick_compilation():
        for kernel, arguments in calls:
            if kernel not in _rehearsed:
                kernel(*(one_row(a) if hasattr(a, "shape") else a for a in arguments))
                _rehearsed.add(kernel)
    return time.perf_counter() - begin
