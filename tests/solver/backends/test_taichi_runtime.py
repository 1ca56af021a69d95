# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine is imported late, without RTLD_DEEPBIND, and shared with other users of it.

Each test runs in a process of its own, because its program is global, and does much in it,
because that takes seconds to begin.
"""

import os

import pytest
from engine_marks import CPU, PACKAGE, needs_engine
from in_a_process import passes

from solver import engine_name


def test_numpy_needs_no_engine():
    passes(
        """
        stylize(V, F, device="numpy", max_iterations=2)
        assert not {"taichi", "quadrants"} & set(sys.modules)
        """
    )


@needs_engine
def test_the_first_result_takes_nothing_that_it_does_not_need():
    """Neither a word on the screen, nor the network, nor time for what is not used."""
    output = passes(
        """
        import os, types
        from urllib import request

        calls = {"flags": [], "version": [], "compiled": [], "replaced": []}
        def spied(name, original, argument=lambda value: value):
            def spy(*args, **named):
                calls[name].append(argument(args[0]))
                return original(*args, **named)
            return spy
        def refuse(*args, **kwargs):
            raise AssertionError("went online")

        request.urlopen = refuse
        sys.setdlopenflags = set_flags = spied("flags", sys.setdlopenflags)
        from solver.backends.engine import ti
        if ti.__name__ == "taichi":
            from taichi.lang import kernel_impl as compiler
            name = "_get_tree_and_ctx"
            from taichi import _version_check
            _version_check.try_check_version = spied("version", lambda _=None: None)
        else:
            from quadrants.lang._func_base import FuncBase as compiler
            name = "get_tree_and_ctx"
        of_function = lambda function, *_: function.func.__module__
        setattr(compiler, name, spied("compiled", getattr(compiler, name), of_function))
        class Watched(types.ModuleType):
            def __setattr__(self, name, value):
                calls["replaced"].append(name)
                super().__setattr__(name, value)
        sys.modules[f"{ti.__name__}.lang.misc"].__class__ = Watched  # the module of ti.init
        stylize(V, F, max_iterations=2)

        if sys.platform == "linux":  # whose flag it is
            assert calls["flags"] and not any(value & 8 for value in calls["flags"]), calls
        assert sys.setdlopenflags is set_flags
        assert not calls["replaced"], "the engine's own module was changed for a time"
        assert not calls["version"] and "TI_SKIP_VERSION_CHECK" not in os.environ
        # a function for the engine costs as much at every start as a tenth of a whole kernel
        ours = {"kernels", "active_set"}
        assert set(calls["compiled"]) == {f"solver.backends.taichi_{name}" for name in ours}, calls
        for large in ("taichi_motion_kernels", "taichi_cycle_kernels"):
            assert f"solver.backends.{large}" not in sys.modules
        """
    )
    assert output == ""


@needs_engine
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
    assert output.startswith((f"no GPU that {engine_name()} can use was found", f"{PACKAGE}-"))
    assert CPU not in output


@needs_engine
def test_threads_may_be_the_first_to_use_it():
    """Whatever is replaced for a time is put back, and each gets what it would get alone."""
    output = passes(
        """
        import os
        from concurrent.futures import ThreadPoolExecutor
        from solver import problem_with_engine
        before = sys.stdout, sys.setdlopenflags, dict(os.environ)
        def one(scale):
            return stylize(scale * V * (1, 1, scale), F, max_iterations=3)
        scales = (1.0, 1.1, 1.2, 1.3)
        with ThreadPoolExecutor(4) as threads:
            together = list(threads.map(one, scales))
        assert (sys.stdout, sys.setdlopenflags, dict(os.environ)) == before
        assert problem_with_engine() == ""
        for scale, result in zip(scales, together):
            assert result.device == CPU
            np.testing.assert_array_equal(result.positions, one(scale).positions)
        """
    )
    assert output == ""


@needs_engine
@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
def test_a_forked_process_has_numpy_instead_of_waiting_for_threads():
    """Also one whose parent is in the middle of a run, and it ends as any other."""
    output = passes(
        """
        import os, signal, threading, warnings
        from solver import Setup, SolverOptions, Stylization, problem_with_engine, rest_mesh
        warnings.simplefilter("ignore")  # newer versions of Python warn of forks beside threads
        def in_child(work):
            child = os.fork()
            if child:
                assert os.waitpid(child, 0)[1] == 0
                return
            signal.alarm(60)  # ends it if it waits
            work()
            sys.exit(0)
        def new_run(device):
            assert stylize(V, F, max_iterations=2).device == device
        def go_on():
            for step in (stylization.step, lambda: stylize(V, F, device="cpu")):
                try:
                    step()
                except ValueError as error:
                    assert "forked" in str(error) and "\\n" not in str(error)
                else:
                    raise AssertionError("not refused")
        def all_of_it():
            new_run("numpy")
            assert "forked" in problem_with_engine()
            go_on()

        in_child(lambda: new_run(CPU))  # it has not started yet
        options = SolverOptions(device="cpu")
        stylization = Stylization(Setup(rest_mesh(V, F, PAPER)), 0.4, options=options)
        stylization.step()
        in_child(all_of_it)
        in_child(lambda: None)
        stylization.step()
        new_run(CPU)

        # a fork waits for what another thread does
        from solver.backends.engine_lock import LOCK
        inside, leave = threading.Event(), threading.Event()
        def hold():
            with LOCK:
                inside.set()
                leave.wait(0.2)
        thread = threading.Thread(target=hold)
        thread.start()
        inside.wait()
        in_child(all_of_it)
        thread.join()
        """
    )
    assert output == ""
