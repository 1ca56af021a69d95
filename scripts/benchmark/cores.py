# SPDX-License-Identifier: GPL-3.0-or-later
"""What of an iteration runs on one core only, from its times on one core and on all of them."""

import os

from .machine import isolated
from .phases import phases


def on_one_and_all(path, cubeness):
    """Return {phase: milliseconds of an iteration} on ``one`` core and ``all``, and the ``cores``.

    None where a process cannot choose its cores, or has only one.
    """
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_setaffinity") else 1
    if cores == 1:
        return None
    case = {"path": path, "cubeness": cubeness}
    one, every = (isolated(_iteration, **case, cores=count) for count in (1, cores))
    return {"one": one, "all": every, "cores": cores}


def serial_share(one, every, cores):
    """Return Amdahl's share s that is not parallel: every / one = s + (1 - s) / cores."""
    return min(max((cores * every / one - 1.0) / (cores - 1.0), 0.0), 1.0)


def _iteration(path, cubeness, cores):
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:cores])
    return phases(path, cubeness)["iteration"]
