# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the arrays of a run lie: with NumPy, or on a GPU for as long as the run lasts."""

import numpy as np

from ..global_step.multigrid import has_multigrid


class HostArrays:
    """Arrays of NumPy; `DeviceArrays` has the same for those on a device."""

    is_resident = False
    """whether they lie on a device and do not come back as a whole in an iteration"""

    def check(self):
        """Make sure that the arrays still exist."""

    def keep(self, values, of_numbers=False):
        """Return an array with these values, to be given to kernels.

        `values`: array, numbers, vectors (n,k) or matrices (n,k,l) of a type that the kernel takes.
        `of_numbers`: bool, of two dimensions without being vectors.
        """
        return values

    def fetch(self, array):
        """Return the values in NumPy, which may be the array itself."""
        return array

    def put(self, array, values):
        """Set all values."""
        array[:] = values

    def copy(self, source, target):
        """Set all values to those of another array."""
        target[:] = source


def arrays_for(device):
    """Return the arrays for a device such as "taichi-cpu".

    A factorization needs the right-hand side in NumPy in each iteration; so without multigrid
    nothing stays on a device.
    """
    if is_on_its_own_memory(device) and has_multigrid():
        from .device_arrays import DeviceArrays

        return DeviceArrays()
    return HostArrays()


def is_on_its_own_memory(device):
    """Return whether a device has to be sent what it is to read."""
    return not device.endswith("-cpu")


def a_few_zeros(array):
    """Return a row of zeros in place of an array, of NumPy or not, and two if it is of integers.

    So where it says where rows begin and end, there is one row, and nothing in it.
    """
    if isinstance(array, np.ndarray):
        shape, dtype = array.shape, array.dtype
    else:
        from .device_arrays import numpy_form

        shape, dtype = numpy_form(array)
    return np.zeros((2 if np.issubdtype(dtype, np.integer) else 1, *shape[1:]), dtype)
