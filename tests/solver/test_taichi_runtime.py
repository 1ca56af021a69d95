# SPDX-License-Identifier: GPL-3.0-or-later
"""Taichi is imported late, without RTLD_DEEPBIND, and shared with other users of it.

Each test runs in a process of its own, because Taichi's program is global.
"""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from taichi_marks import needs_taichi

ROOT = Path(__file__).parents[2]
SET_UP = """
import sys
sys.path.insert(0, {root!r})
sys.path.insert(0, {here!r})
import numpy as np
import shapes
from solver import stylize
V, F = shapes.blob(2)
"""


def python(code, **environment):
    code = SET_UP.format(root=str(ROOT), here=str(Path(__file__).parent)) + textwrap.dedent(code)
    return subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
        timeout=300,
    )


def passes(code, **environment):
    run = python(code, **environment)
    assert run.returncode == 0, run.stderr
    return run.stdout


def test_importing_the_solver_does_not_import_taichi():
    assert passes("print('taichi' in sys.modules)") == "False\n"


def test_numpy_needs_no_taichi():
    passes("stylize(V, F, device='numpy', max_iterations=2); assert 'taichi' not in sys.modules")


def test_without_taichi_auto_means_numpy_and_cpu_is_refused():
    output = passes(
        """
        sys.modules["taichi"] = None  # makes every import of it fail
        print(stylize(V, F, max_iterations=2).device)
        try:
            stylize(V, F, device="cpu")
        except ValueError as error:
            print(error)
        """
    )
    assert output.startswith("numpy\nthe device 'cpu' needs Taichi")


@needs_taichi
def test_nothing_is_printed():
    assert passes("stylize(V, F, max_iterations=2)") == ""


@needs_taichi
@pytest.mark.skipif(sys.platform != "linux", reason="the flag is Linux's")
def test_taichi_is_loaded_without_deepbind_and_the_function_is_put_back():
    passes(
        """
        flags = []
        original = sys.setdlopenflags
        def spy(value):
            flags.append(value)
            original(value)
        sys.setdlopenflags = spy
        stylize(V, F, max_iterations=2)
        assert sys.setdlopenflags is spy
        assert flags and not any(value & 8 for value in flags), flags
        """
    )


@needs_taichi
@pytest.mark.parametrize("moment", ["before", "between"])
def test_a_foreign_init_does_not_matter_and_is_left_alone(moment):
    passes(
        f"""
        from solver.backends.taichi_runtime import import_taichi
        expected = stylize(V, F, device="cpu", max_iterations=5).positions
        ti = import_taichi()
        if {moment!r} == "before":
            ti.reset()
        ti.init(arch=ti.cpu, log_level=ti.ERROR, default_fp=ti.f32)
        field = ti.field(ti.f32, shape=4)
        field.fill(7)
        again = stylize(V, F, device="cpu", max_iterations=5).positions
        np.testing.assert_array_equal(again, expected)
        assert (field.to_numpy() == 7).all()  # our second init would have destroyed it
        """
    )


@needs_taichi
def test_a_foreign_init_during_a_run_does_not_matter():
    passes(
        """
        from solver.backends.taichi_runtime import import_taichi
        expected = stylize(V, F, device="cpu", max_iterations=6).positions
        def disturb(stylization):
            if stylization.iteration == 3:
                ti = import_taichi()
                ti.reset()
                ti.init(arch=ti.cpu, log_level=ti.ERROR)
        again = stylize(V, F, device="cpu", max_iterations=6, on_iteration=disturb).positions
        np.testing.assert_array_equal(again, expected)
        """
    )


@needs_taichi
def test_a_foreign_reset_during_a_run_does_not_matter():
    passes(
        """
        from solver.backends.taichi_runtime import import_taichi
        expected = stylize(V, F, device="cpu", max_iterations=6).positions
        def disturb(stylization):
            if stylization.iteration == 3:
                import_taichi().reset()
        again = stylize(V, F, device="cpu", max_iterations=6, on_iteration=disturb).positions
        np.testing.assert_array_equal(again, expected)
        """
    )


@needs_taichi
def test_kernels_are_cached_in_the_folder_given(tmp_path):
    passes(
        f"""
        from solver import set_cache_folder
        set_cache_folder({str(tmp_path)!r})
        stylize(V, F, device="cpu", max_iterations=2)
        """
    )
    assert any(tmp_path.rglob("*"))


@needs_taichi
def test_taichi_asks_no_server_for_its_version():
    passes(
        """
        import threading
        from urllib import request
        def refuse(*args, **kwargs):
            raise AssertionError("went online")
        request.urlopen = refuse
        from solver.backends import taichi_runtime
        ti = taichi_runtime.import_taichi()
        from taichi import _version_check
        asked = []
        _version_check.try_check_version = lambda: asked.append(True)
        stylize(V, F, device="cpu", max_iterations=2)
        assert not asked
        import os
        assert "TI_SKIP_VERSION_CHECK" not in os.environ
        """
    )


@needs_taichi
def test_a_gpu_is_used_or_refused_but_never_crashes():
    output = passes(
        """
        a = stylize(V, F, device="cpu", max_iterations=5)
        try:
            b = stylize(V, F, device="gpu", max_iterations=5)
        except ValueError as error:
            print(error)
        else:
            print(b.device)
            assert np.abs(a.positions - b.positions).max() < 1e-4
        c = stylize(V, F, device="cpu", max_iterations=5)
        np.testing.assert_array_equal(a.positions, c.positions)
        """
    )
    assert output.startswith(("no GPU that Taichi can use was found", "taichi-"))
    assert "taichi-cpu" not in output


@needs_taichi
def test_quick_compilation_changes_no_bit_and_leaves_taichi_as_it_was():
    passes(
        """
        import inspect
        import textwrap
        getmodule = inspect.getmodule
        from solver.backends import devices, taichi_runtime, warmup
        import contextlib
        quick = stylize(V, F, device="cpu", max_iterations=5).positions
        from taichi.lang.ast import ast_transformer_utils
        assert ast_transformer_utils.TextWrapper is textwrap.TextWrapper
        assert inspect.getmodule is getmodule
        taichi_runtime.import_taichi().reset()  # else the kernels would not be compiled again
        devices.quick_compilation = warmup.quick_compilation = contextlib.nullcontext
        slow = stylize(V, F, device="cpu", max_iterations=5).positions
        np.testing.assert_array_equal(quick, slow)
        """
    )


@needs_taichi
def test_errors_in_kernels_keep_their_place_under_quick_compilation(tmp_path):
    (tmp_path / "faulty.py").write_text(
        "import taichi as ti\n@ti.kernel\ndef faulty():\n    x = 1 + unheard_of\n"
    )
    passes(
        f"""
        from solver.backends.taichi_runtime import import_taichi, quick_compilation, start
        from textwrap import TextWrapper
        ti = import_taichi()
        start("cpu")
        sys.path.insert(0, {str(tmp_path)!r})
        from faulty import faulty
        from taichi.lang.ast import ast_transformer_utils
        try:
            with quick_compilation():
                assert ast_transformer_utils.TextWrapper is not TextWrapper
                faulty()
        except ti.TaichiCompilationError as error:
            assert "line 4" in str(error) and "unheard_of" in str(error), error
        else:
            raise AssertionError("compiled")
        assert ast_transformer_utils.TextWrapper is TextWrapper
        """
    )


@needs_taichi
def test_the_first_result_needs_no_graph_search_of_scipy():
    # Its import takes longer than the set-up of a small mesh. SciPy 1.15 imports it itself, so it
    # is forgotten before.
    passes(
        """
        import scipy.sparse
        for name in [name for name in sys.modules if name.startswith("scipy.sparse.csgraph")]:
            del sys.modules[name]
        stylize(V, F, max_iterations=2)
        assert "scipy.sparse.csgraph" not in sys.modules
        """
    )


@needs_taichi
def test_taichi_is_imported_and_its_kernels_compiled_without_searching_all_modules():
    passes(
        """
        import inspect
        searched = []
        getmodule = inspect.getmodule
        def spy(object, _filename=None):
            searched.append(object)
            return getmodule(object, _filename)
        inspect.getmodule = spy
        stylize(V, F, device="cpu", max_iterations=2)
        assert inspect.getmodule is spy
        assert not any(map(inspect.isframe, searched)), searched
        """
    )


def test_the_module_of_a_frame_is_the_one_that_inspect_finds(tmp_path):
    (tmp_path / "elsewhere.py").write_text("import sys\nframe = sys._getframe()\n")
    passes(
        f"""
        import inspect
        from solver.backends.taichi_runtime import _quick_module_search
        sys.path.insert(0, {str(tmp_path)!r})
        import elsewhere
        nowhere = {{"__name__": "elsewhere", "sys": sys}}
        exec("frame = sys._getframe()", nowhere)
        nameless = {{"sys": sys}}
        exec("frame = sys._getframe()", nameless)
        frames = [elsewhere.frame, nowhere["frame"], nameless["frame"]]
        expected = list(map(inspect.getmodule, frames))
        assert expected[0] is elsewhere
        with _quick_module_search():
            assert list(map(inspect.getmodule, frames)) == expected
            assert inspect.getmodule(stylize) is sys.modules["solver.runner"]
        """
    )


@needs_taichi
def test_no_function_of_taichi_is_compiled_into_the_kernels():
    # each costs as much at every start as a tenth of a whole kernel
    passes(
        """
        from solver.backends import taichi_runtime
        taichi_runtime.import_taichi()
        from taichi.lang import kernel_impl
        compiled = []
        original = kernel_impl._get_tree_and_ctx
        def spy(function, *args, **kwargs):
            compiled.append(function.func.__module__)
            return original(function, *args, **kwargs)
        kernel_impl._get_tree_and_ctx = spy
        stylize(V, F, device="cpu", max_iterations=2)
        ours = {"solver.backends.taichi_kernels", "solver.backends.taichi_active_set"}
        assert set(compiled) == ours, compiled
        """
    )


@needs_taichi
def test_small_meshes_do_not_pay_for_the_kernels_of_large_ones():
    passes(
        """
        stylize(V, F, max_iterations=2)
        assert "solver.backends.taichi_kernels" in sys.modules
        assert "solver.backends.taichi_motion_kernels" not in sys.modules
        assert "solver.backends.taichi_cycle_kernels" not in sys.modules
        """
    )
