# SPDX-License-Identifier: GPL-3.0-or-later
"""The import of the engine, the only one, without harm to Blender.

A file of kernels begins with ``from .engine import ti``. This imports the engine, which takes most
of a second, so such a file is imported when its kernels are needed.
"""

import contextlib
import os
import sys
from functools import cache
from typing import Any

from .engine_choice import TAICHI, engine
from .engine_lock import alone

_RTLD_DEEPBIND = 8  # on Linux; the value means something else on macOS


@alone
@cache
def import_engine() -> Any:
    """Import and return Taichi or Quadrants; an ImportError is raised where there is neither.

    Both load their core with RTLD_DEEPBIND. In a program that replaces malloc, such as the Linux
    builds of Blender, it then allocates with one allocator and frees with the other, and crashes.
    So the flag is filtered out for the time of the import.
    """
    with (
        environment(engine().greeting, "False"),
        environment(engine().log_level, "error"),
        _without_deepbind(),
    ):
        if engine() is TAICHI:
            import taichi as imported
        else:
            import quadrants as imported  # pyright: ignore[reportMissingImports]
    return imported


def __getattr__(name):
    if name != "ti":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return import_engine()


def kernel_types(real):
    """Return vec3, mat3, and the types of arrays of reals, integers, vec3 and mat3."""
    ti = import_engine()
    vec3, mat3 = ti.types.vector(3, real), ti.types.matrix(3, 3, real)
    return vec3, mat3, *(ti.types.ndarray(dtype=t, ndim=1) for t in (real, ti.i32, vec3, mat3))


def state_types(real, width):
    """Return the types of a vertex's state, a vector of that width, and of an array of them."""
    ti = import_engine()
    state = ti.types.vector(width, real)
    return state, ti.types.ndarray(dtype=state, ndim=1)


@contextlib.contextmanager
def environment(name, value):
    """Set an environment variable for a time."""
    before = os.environ.get(name)
    os.environ[name] = value
    try:
        yield
    finally:
        if before is None:
            del os.environ[name]
        else:
            os.environ[name] = before


@contextlib.contextmanager
def _without_deepbind():
    if sys.platform != "linux":
        yield
        return
    original = sys.setdlopenflags
    sys.setdlopenflags = lambda flags: original(flags & ~_RTLD_DEEPBIND)
    try:
        yield
    finally:
        sys.setdlopenflags = original
