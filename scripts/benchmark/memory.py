# SPDX-License-Identifier: GPL-3.0-or-later
"""Memory of this process.

Linux counts the peak since the last reset, so that a measurement can leave out what came before.
The peak of getrusage, used elsewhere, cannot be reset.
"""

import resource
import sys
from pathlib import Path

_STATUS = Path("/proc/self/status")
_RESET = Path("/proc/self/clear_refs")


def reset_peak():
    """Forget the peak so far, where the system can."""
    if _RESET.exists():
        _RESET.write_text("5")


def peak_bytes():
    """Return the most memory that was resident since the last reset."""
    if _STATUS.exists():
        return _status("VmHWM")
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def resident_bytes():
    """Return the memory that is resident now; where the system does not tell, the peak."""
    return _status("VmRSS") if _STATUS.exists() else peak_bytes()


def _status(name):
    for line in _STATUS.read_text().splitlines():
        key, _, value = line.partition(":")
        if key == name:
            return int(value.split()[0]) * 1024
    raise KeyError(name)
