"""Import and start Taichi without harm to Blender or to other add-ons that use it."""

import contextlib
import os
import sys
from dataclasses import dataclass
from functools import cache
from typing import Any

_RTLD_DEEPBIND = 8  # on Linux; the value means something else on macOS

_ARCHES_WITH_F64 = ("x64", "arm64", "cuda")

_cache_folder = None
_our_program = None  # the Taichi program that we started, to tell it from a foreign one


@dataclass(frozen=True)
class Runtime:
    """A started Taichi."""

    taichi: Any
    device: str
    """such as "taichi-cpu" or "taichi-cuda" """
    has_f64: bool


def set_cache_folder(path):
    """Keep compiled kernels in this folder (str) from the next start on, not in Taichi's own."""
    global _cache_folder
    _cache_folder = path


@cache
def import_taichi() -> Any:
    """Import and return Taichi; an ImportError is raised where it is not installed.

    Taichi loads its core with RTLD_DEEPBIND. In a program that replaces malloc, such as the Linux
    builds of Blender, it then allocates with one allocator and frees with the other, and crashes.
    So the flag is filtered out for the time of the import.
    """
    os.environ.setdefault("ENABLE_TAICHI_HEADER_PRINT", "False")
    if sys.platform != "linux":
        import taichi

        return taichi
    original = sys.setdlopenflags
    sys.setdlopenflags = lambda flags: original(flags & ~_RTLD_DEEPBIND)
    try:
        import taichi
    finally:
        sys.setdlopenflags = original
    return taichi


def start(device):
    """Start Taichi on "cpu" or "gpu", unless it runs already, and return the Runtime.

    A program that another add-on has started is used as it is: a second ``ti.init`` would destroy
    that add-on's fields.
    """
    global _our_program
    ti = import_taichi()
    program = ti.lang.impl.get_runtime().prog
    is_foreign = program is not None and program is not _our_program
    is_right = program is not None and (_is_cpu(ti) == (device == "cpu"))
    if not (is_foreign or is_right):
        options = {"offline_cache_file_path": _cache_folder} if _cache_folder else {}
        with contextlib.redirect_stdout(None):  # it announces itself whatever the log level
            ti.init(
                arch=ti.cpu if device == "cpu" else ti.gpu,
                log_level=ti.ERROR,
                offline_cache=True,
                **options,
            )
        _our_program = ti.lang.impl.get_runtime().prog
    arch = ti.lang.impl.current_cfg().arch
    name = ti._lib.core.arch_name(arch)
    return Runtime(ti, f"taichi-{'cpu' if _is_cpu(ti) else name}", name in _ARCHES_WITH_F64)


def _is_cpu(ti):
    name = ti._lib.core.arch_name(ti.lang.impl.current_cfg().arch)
    return name in ("x64", "arm64")
