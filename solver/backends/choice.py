# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose the machinery of the local step by the name of a device."""

from functools import partial

from ..errors import CubicCraftError
from .numpy_local_step import NumpyLocalStep
from .taichi_local_step import TaichiLocalStep
from .taichi_runtime import import_taichi, quick_compilation

DEVICES = ("auto", "cpu", "gpu", "numpy")


def local_step_class(device="auto", precision=None):
    """Return a function of (rest, lam, Q, options) that makes the local step for the device.

    Parameters
    ----------
    device : {"auto", "cpu", "gpu", "numpy"}
        "cpu" and "gpu" are Taichi's; "auto" is "cpu" where Taichi can be imported, else "numpy".
    precision : {"f64", "f32"}, optional
        Of Taichi's kernels; by default the best that the device has. NumPy is always f64.

    Raises
    ------
    CubicCraftError
        An unknown device, or Taichi is asked for and is not there.
    """
    if device not in DEVICES:
        raise CubicCraftError(f"the device {device!r} is none of {', '.join(DEVICES)}")
    if device == "numpy":
        return NumpyLocalStep
    try:
        import_taichi()
    except Exception as error:  # a broken installation can raise anything
        if device == "auto":
            return NumpyLocalStep
        raise CubicCraftError(
            f"the device {device!r} needs Taichi, which cannot be imported ({error});"
            " choose the device auto or numpy"
        ) from error
    return partial(_taichi_local_step, "gpu" if device == "gpu" else "cpu", precision)


def _taichi_local_step(device, precision, rest, lam, Q, options):
    with quick_compilation():
        return TaichiLocalStep(rest, lam, Q, options, device, precision)
