# SPDX-License-Identifier: GPL-3.0-or-later
"""Start Taichi or Quadrants without harm to Blender or to other add-ons that use it."""

import os
import subprocess
import sys
import tempfile
import time
from functools import cache
from pathlib import Path
from types import FunctionType

from ..errors import CubicCraftError
from .arrays import a_few_zeros
from .engine import environment, import_engine
from .engine_choice import engine, started_program
from .engine_lock import LOCK, alone, check_not_forked

_ARCHES_WITH_F64 = ("x64", "arm64", "cuda")
_PROBE = "import {} as ti; ti.init(arch=ti.vulkan, enable_fallback=False)"
_PROBE_SECONDS = 60

_cache_folder = None
_our_program = None  # the program of the engine that we started, to tell it from a foreign one
_our_device = None  # "cpu" or "gpu"
_warm = set()  # kernels that have run


def set_cache_folder(path: str) -> None:
    """Keep compiled kernels in this folder (str) from the next start on, not in the usual one."""
    global _cache_folder
    _cache_folder = path


@alone
def start(device):
    """Start the engine on "cpu" or "gpu", unless it runs already.

    Returns the name of the device, such as "taichi-cpu", "taichi-cuda" or "quadrants-cpu", and
    whether it has 64 bit.

    A program that another add-on has started is used as it is: a second ``ti.init`` would destroy
    that add-on's fields.

    Raises CubicCraftError: there is no GPU, or the process was forked after the engine had started.
    """
    global _our_program, _our_device
    check_not_forked()
    ti = import_engine()
    program = started_program()
    is_foreign = program is not None and program is not _our_program
    if not is_foreign and (program is None or _our_device != device):
        ti.set_logging_level(ti.ERROR)
        arch = ti.cpu if device == "cpu" else _gpu_arch(ti)
        folder = _cache_folder or ti.lang.impl.default_cfg().offline_cache_file_path
        is_cached = _is_writable(folder)
        if not is_cached:
            folder = tempfile.gettempdir()  # nothing is written to it, but it must be there
        options = {"offline_cache": is_cached, "offline_cache_file_path": folder}
        with environment("TI_SKIP_VERSION_CHECK", "ON"):  # Taichi would ask a server
            _silent(ti.init)(arch=arch, log_level=ti.ERROR, **options)
        _our_program, _our_device = started_program(), device
    name = ti._lib.core.arch_name(ti.lang.impl.current_cfg().arch)
    shown = "cpu" if name in ("x64", "arm64") else name
    return f"{engine().package}-{shown}", name in _ARCHES_WITH_F64


def warm_up(calls):
    """Compile kernels, or load them from the cache, before the clock of a run starts.

    They run on next to nothing, but for those that have been before. Returns the seconds.

    `calls`: iterable of (kernel, arguments), the arrays among the arguments are replaced by
    `a_few_zeros`.
    """
    cold = [(kernel, arguments) for kernel, arguments in calls if kernel not in _warm]
    if not cold:
        return 0.0
    begin = time.perf_counter()
    with LOCK:
        for kernel, arguments in cold:
            kernel(*(a_few_zeros(a) if hasattr(a, "shape") else a for a in arguments))
            _warm.add(kernel)
    return time.perf_counter() - begin


def _gpu_arch(ti):
    """Return CUDA, Metal or Vulkan, the best that there is, or raise a CubicCraftError."""
    core = ti._lib.core
    for arch, is_there in ((ti.cuda, core.with_cuda), (ti.metal, core.with_metal)):
        if is_there():
            return arch
    if _vulkan_starts():
        return ti.vulkan
    raise CubicCraftError(
        f"no GPU that {engine().name} can use was found; choose the device auto, cpu or numpy"
    )


@cache
def _vulkan_starts():
    """Return whether the engine starts on Vulkan, by trying it in another process.

    Where the driver is missing or broken, even asking whether Vulkan is there crashes the process,
    and in Blender the artist's work with it.
    """
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(path for path in sys.path if path),
        "TI_SKIP_VERSION_CHECK": "ON",
    }
    try:
        probe = subprocess.run(
            [sys.executable, "-c", _PROBE.format(engine().package)],
            env=environment,
            capture_output=True,
            timeout=_PROBE_SECONDS,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    return probe.returncode == 0


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


def _silent(function: FunctionType):
    """Return a copy of a function in which `print` does nothing; the function stays as it is.

    Both engines print that they start, whatever the level of their log.
    """
    names = {**function.__globals__, "print": lambda *_, **__: None}
    return FunctionType(
        function.__code__, names, argdefs=function.__defaults__, closure=function.__closure__
    )
