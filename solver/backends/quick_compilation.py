# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes Taichi half of its time before the first kernel runs, and is needed by nobody.

All of it is replaced for as long as the engine is imported or compiles, and put back.
"""

import contextlib
import inspect
import sys
from textwrap import TextWrapper
from typing import Any

from .engine_lock import LOCK


@contextlib.contextmanager
def quick_compilation():
    """Compile kernels without wrapping the lines of error messages that never appear.

    For each expression of a kernel Taichi prepares the message of an error in it, and `textwrap`,
    which breaks its lines, takes almost half of the time in which Python goes through a kernel,
    which it does even when the kernel is cached. The messages stay; only their lines are not
    broken. Versions of Taichi that do without are left alone.
    """
    module: Any = sys.modules.get("taichi.lang.ast.ast_transformer_utils")
    with LOCK, quick_module_search():
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
def quick_module_search():
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
