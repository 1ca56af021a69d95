# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose the machinery of the local step by the name of a device."""

import logging
from functools import partial
from typing import Any, get_args

from ..aliases import Device, Precision
from ..errors import CubicCraftError
from .engine import import_engine
from .engine_choice import engine
from .engine_lock import ForkedError, alone
from .numpy_local_step import NumpyLocalStep
from .taichi_local_step import TaichiLocalStep

_log = logging.getLogger(__name__)

DEVICES: tuple[Device, ...] = get_args(Device)
PRECISIONS: tuple[Precision, ...] = get_args(Precision)

_TRIES = 3
"""runs in a row in which an installed engine may fail: what hinders it, such as a disk, may pass"""


def local_step_class(device: Device = "auto", precision: Precision | None = None) -> Any:
    """Return a function that makes the local step, with the arguments of `NumpyLocalStep`.

    `device`: {"auto", "cpu", "gpu", "numpy"}, "cpu" and "gpu" are those of Taichi or Quadrants;
    "auto" is "cpu" where that works, else "numpy": see `problem_with_engine`. `precision`: "f64" or
    "f32", optional, of their kernels; by default the best that the device has. NumPy is always f64.
    Raises CubicCraftError: an unknown device or precision. The function raises it if the engine is
    asked for and does not work.
    """
    if device not in DEVICES:
        raise CubicCraftError(f'the device "{device}" is none of {", ".join(DEVICES)}')
    if precision is not None and precision not in PRECISIONS:
        raise CubicCraftError(f'the precision must be f64 or f32, not "{precision}"')
    if device == "numpy" or (device == "auto" and _tries_left == 0):
        return NumpyLocalStep
    return partial(_taichi_local_step, device, precision)


def problem_with_engine() -> str:
    """Return why the device "auto" means "numpy" at present, or "" if it does not."""
    return _problem


_problem = ""
_tries_left = _TRIES


@alone
def _taichi_local_step(device, precision, *arguments):
    global _problem, _tries_left
    is_imported = False
    try:
        import_engine()
        is_imported = True
        wanted = "gpu" if device == "gpu" else "cpu"
        step = TaichiLocalStep(*arguments, device=wanted, precision=precision)
    except (MemoryError, KeyboardInterrupt):
        raise
    except BaseException as error:  # a broken installation can raise anything, or want to exit
        is_for_the_user = isinstance(error, CubicCraftError)
        if is_for_the_user and not (device == "auto" and isinstance(error, ForkedError)):
            raise
        reason = str(error).strip().partition("\n")[0] or type(error).__name__
        if device != "auto":
            raise CubicCraftError(
                f'the device "{device}" needs {engine().name}, which cannot be used ({reason});'
                " choose the device auto or numpy"
            ) from error
        _problem, _tries_left = reason, _tries_left - 1 if is_imported else 0
        level = logging.WARNING if is_imported else logging.INFO  # most who have none know it
        _log.log(level, "%s cannot be used (%s); NumPy computes", engine().name, reason)
        return NumpyLocalStep(*arguments)
    if device == "auto":
        _problem, _tries_left = "", _TRIES
    return step
