# SPDX-License-Identifier: GPL-3.0-or-later
"""Import and start Taichi without harm to Blender or to other add-ons that use it."""

import contextlib
import inspect
import os
import sys
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from textwrap import TextWrapper
from typing import Any

from .engine_lock import LOCK, alone, check_not_forked
from .gpu_arch import gpu_arch

_RTLD_DEEPBIND = 8  # on Linux; the value means something else on macOS

_ARCHES_WITH_F64 = ("x64", "arm64", "cuda")

_cache_folder = None
_our_program = None  # the Taichi program that we started, to tell it from a foreign one
_our_device = None  # "cpu" or "gpu"


@dataclass(frozen=True)
class Runtime:
    """A started Taichi."""

    device: str
    """such as "taichi-cpu" or "taichi-cuda" """
    has_f64: bool


def set_cache_folder(path):
    """Keep compiled kernels in this folder (str) from the next start on, not in Taichi's own."""
    global _cache_folder
    _cache_folder = path


@alone
@cache
def import_taichi() -> Any:
    """Import and return Taichi; an ImportError is raised where it is not installed.

    Taichi loads its core with RTLD_DEEPBIND. In a program that replaces malloc, such as the Linux
    builds of Blender, it then allocates with one allocator and frees with the other, and crashes.
    So the flag is filtered out for the time of the import.
    """
    with (
        _environment("ENABLE_TAICHI_HEADER_PRINT", "False"),
        _without_deepbind(),
        _quick_module_search(),
    ):
        import taichi
    return taichi


@alone
def start(device):
    """Start Taichi on "cpu" or "gpu", unless it runs already, and return the Runtime.

    A program that another add-on has started is used as it is: a second ``ti.init`` would destroy
    that add-on's fields.

    Raises
    ------
    CubicCraftError
        There is no GPU, or the process was forked after Taichi had started.
    """
    global _our_program, _our_device
    check_not_forked()
    ti = import_taichi()
    program = ti.lang.impl.get_runtime().prog
    is_foreign = program is not None and program is not _our_program
    if not is_foreign and (program is None or _our_device != device):
        ti.set_logging_level(ti.ERROR)
        arch = ti.cpu if device == "cpu" else gpu_arch(ti)
        folder = _cache_folder or ti.lang.impl.default_cfg().offline_cache_file_path
        is_cached = _is_writable(folder)
        if not is_cached:
            folder = tempfile.gettempdir()  # nothing is written to it, but it must be there
        options = {"offline_cache": is_cached, "offline_cache_file_path": folder}
        # It would ask a server for its newest version, and it announces itself whatever the level.
        with _environment("TI_SKIP_VERSION_CHECK", "ON"), _silence(ti.lang.misc):
            ti.init(arch=arch, log_level=ti.ERROR, **options)
        _our_program, _our_device = ti.lang.impl.get_runtime().prog, device
    name = ti._lib.core.arch_name(ti.lang.impl.current_cfg().arch)
    shown = "cpu" if name in ("x64", "arm64") else name
    return Runtime(f"taichi-{shown}", name in _ARCHES_WITH_F64)


def _is_writable(folder):
    """Return whether files can be made in a folder, which is made if need be.

    Taichi does not ask: when its program ends, as at the end of Blender, it makes the folder, and
    crashes the process if it cannot.
    """
    try:
        Path(folder).mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


@contextlib.contextmanager
def quick_compilation():
    """Compile kernels without wrapping the lines of error messages that never appear.

    For each expression of a kernel Taichi prepares the message of an error in it, and `textwrap`,
    which breaks its lines, takes almost half of the time in which Python goes through a kernel,
    which it does even when the kernel is cached. The messages stay; only their lines are not
    broken. Versions of Taichi that do without are left alone.
    """
    module: Any = sys.modules.get("taichi.lang.ast.ast_transformer_utils")
    with LOCK, _quick_module_search():
        if getattr(module, "TextWrapper", None) is not TextWrapper:
            yield
            return
        module.TextWrapper = _WholeLines
        try:
            yield
        finally:
            module.TextWrapper = TextWrapper


class _WholeLines(TextWrapper):
    def wrap(self, text):
        return [text]


@contextlib.contextmanager
def _quick_module_search():
    """Let `inspect` take the module in whose namespace a frame runs, instead of searching all.

    Taichi looks at the line of source around each function that is declared for it, hundreds of
    its own ones included, and each time `inspect` compares the files of all modules that are
    loaded: half of the time of Taichi's import, and more the more is loaded. It finds the same
    one, or none where the code lies in no file. Frames outside of modules are searched as before.
    """
    search = inspect.getmodule

    def look_up(object, _filename=None):
        if inspect.isframe(object):
            module = sys.modules.get(object.f_globals.get("__name__", ""))
            if getattr(module, "__dict__", None) is object.f_globals:
                return module
        return search(object, _filename)

    inspect.getmodule = look_up
    try:
        yield
    finally:
        inspect.getmodule = search


@contextlib.contextmanager
def _silence(module: Any):
    """Let a module print nothing for a time; what others print in other threads is shown."""
    module.print = lambda *_, **__: None
    try:
        yield
    finally:
        del module.print


@contextlib.contextmanager
def _environment(name, value):
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
    """Filter RTLD_DEEPBIND out of the flags with which libraries are loaded, on Linux."""
    if sys.platform != "linux":
        yield
        return
    original = sys.setdlopenflags
    sys.setdlopenflags = lambda flags: original(flags & ~_RTLD_DEEPBIND)
    try:
        yield
    finally:
        sys.setdlopenflags = original
