# SPDX-License-Identifier: GPL-3.0-or-later
"""Leave a part of the processor to others."""

_VARIABLES = (
    *("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"),
    *("VECLIB_MAXIMUM_THREADS", "TI_CPU_MAX_NUM_THREADS", "QD_CPU_MAX_NUM_THREADS"),
)


def thread_variables(count: int | None) -> dict[str, str]:
    """Return what in a process's environment keeps its numerical libraries to so many threads.

    Nothing for None. Cycles has a setting of its own.
    """
    return dict.fromkeys(_VARIABLES, str(count)) if count else {}
