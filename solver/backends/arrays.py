# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the arrays of a run lie: with NumPy, or on a GPU for as long as the run lasts."""

import weakref

import numpy as np

from ..errors import CubicCraftError
from ..global_step.multigrid import has_multigrid
from .engine import import_engine
from .engine_choice import engine, started_program
from .engine_lock import alone, check_not_forked, is_forked


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


class DeviceArrays:
    """As `HostArrays`, with arrays of the engine. They are freed when this object is.

    All but `keep` raise a CubicCraftError once the engine has been reset: then what lay on the
    device is gone, and even to read it would crash the process. `keep` raises one where it is full.
    """

    is_resident = True

    def __init__(self):
        self._program = started_program()
        self._arrays = []
        free = weakref.finalize(self, _free, self._arrays, self._program)
        free.atexit = False  # the engine ends its program itself

    def check(self):
        """Make sure that the arrays still exist."""
        check_not_forked()
        if started_program() is not self._program:
            raise CubicCraftError(
                "what lay on the GPU is lost, because another add-on or another device has reset"
                f" {engine().name} meanwhile; run it again, or choose the device cpu"
            )

    @alone
    def keep(self, values, of_numbers=False):
        """Return an array with these values; see `HostArrays`."""
        if not len(values):  # of which the engine makes none, and which no kernel reads
            values = np.zeros((1, *values.shape[1:]), values.dtype)
        try:
            array = _empty_like(values, of_numbers)
            self._arrays.append(array)
            array.from_numpy(values)
        except RuntimeError as error:  # of which the engine makes no kinds
            raise CubicCraftError(
                f"the GPU takes no more arrays ({str(error).strip().partition(chr(10))[0]});"
                " choose the device cpu, or take a smaller mesh"
            ) from error
        return array

    @alone
    def fetch(self, array):
        """Return the values in NumPy."""
        self.check()
        return array.to_numpy()

    @alone
    def put(self, array, values):
        """Set all values."""
        self.check()
        array.from_numpy(np.ascontiguousarray(values, _numpy_form(array)[1]))

    @alone
    def copy(self, source, target):
        """Set all values to those of another array."""
        self.check()
        target.copy_from(source)


def arrays_for(device):
    """Return the arrays for a device such as "taichi-cpu".

    A factorization needs the right-hand side in NumPy in each iteration; so without multigrid
    nothing stays on a device.
    """
    if is_on_its_own_memory(device) and has_multigrid():
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
        shape, dtype = _numpy_form(array)
    return np.zeros((2 if np.issubdtype(dtype, np.integer) else 1, *shape[1:]), dtype)


def _numpy_form(array):
    """Return the shape and the type that an array of the engine has in NumPy."""
    ti = import_engine()
    return (*array.shape, *array.element_shape), ti.lang.util.to_numpy_type(array.dtype)


def _empty_like(values, of_numbers):
    ti = import_engine()
    dtype = getattr(ti, f"{values.dtype.kind}{8 * values.dtype.itemsize}")  # such as ti.f64
    element = () if of_numbers else values.shape[1:]
    shape = values.shape[: values.ndim - len(element)]
    if len(element) == 2:
        return ti.Matrix.ndarray(*element, dtype, shape=shape)
    if len(element) == 1:
        return ti.Vector.ndarray(*element, dtype, shape=shape)
    return ti.ndarray(dtype, shape=shape)


@alone
def _free(arrays, program):
    """Free arrays of a program that may have ended.

    Taichi 1.7 frees arrays of numbers only, and those even where the program is another one by now,
    which may have something else at the same address. So each is freed here, and then forgotten.
    """
    if not is_forked() and started_program() is program:
        program.synchronize()  # what waits for a kernel would not be freed
        for array in arrays:
            program.delete_ndarray(array.arr)
    for array in arrays:
        array.arr = None
