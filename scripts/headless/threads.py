# SPDX-License-Identifier: GPL-3.0-or-later
"""Leave a part of the processor to others."""

import os

__all__ = ("limit_threads", "thread_variables")

_VARIABLES = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
    "TI_CPU_MAX_NUM_THREADS",
)


def thread_variables(count: int) -> dict[str, str]:
    """Return what in a process's environment keeps its numerical libraries to so many threads."""
    return dict.fromkeys(_VARIABLES, str(count))


def limit_threads(count: int) -> None:
    """Keep libraries that are loaded later to so many threads. Cycles has a setting of its own."""
    os.environ.update(thread_variables(count))
