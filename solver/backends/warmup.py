# SPDX-License-Identifier: GPL-3.0-or-later
"""Compile kernels, or load them from the cache, before the clock of a run starts."""

import time

from .arrays import a_few_zeros
from .engine_lock import LOCK

_warm = set()


def warm_up(calls):
    """Run kernels on next to nothing, those that have been before excepted; return the seconds.

    `calls`: iterable of (kernel, arguments), the arrays among the arguments are replaced by
    `a_few_zeros`.
    """
    cold = [(kernel, arguments) for kernel, arguments in calls if kernel not in _warm]
    if not cold:
        return 0.0
    begin = time.perf_counter()
    with LOCK:
        for kernel, arguments in cold:
            kernel(*(a_few_zeros(a) if hasattr(a, "shape") else a for a in arguments))
            _warm.add(kernel)
    return time.perf_counter() - begin
