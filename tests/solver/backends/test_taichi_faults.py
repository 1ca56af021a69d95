# SPDX-License-Identifier: GPL-3.0-or-later
"""An engine that is missing, broken or used by others, and a cache folder that cannot be used.

Each test runs in a process of its own, as in `in_a_process`; that it ends well counts too,
because the engine writes its cache only then.
"""

import os
import shutil
import subprocess
import sys

import pytest
from engine_marks import PACKAGE, needs_engine
from in_a_process import passes
from optional_marks import needs

WITH_CACHE = """
    from solver import set_cache_folder
    set_cache_folder({folder!r})
    result = stylize(V, F, max_iterations=2)
    print(result.device, result.positions.tobytes().hex())
"""
BROKEN = {
    "missing": None,
    "empty": "",
    "wants to exit": "raise SystemExit(3)",
    "no library": "raise OSError('lib.so: cannot open shared object file')",
    "half installed": "from . import _lib_that_is_not_there",
    "written badly": "def broken(:",
    "odd": "class Odd(BaseException): pass\nraise Odd",
    "never starts": "class lang: impl = None",
}
IMPORTED = {"empty", "never starts"}


@pytest.mark.thorough(2)
@pytest.mark.parametrize("how", BROKEN)
def test_a_broken_engine_means_numpy_for_good(tmp_path, how):
    if BROKEN[how] is not None:
        (tmp_path / PACKAGE).mkdir()
        (tmp_path / PACKAGE / "__init__.py").write_text(BROKEN[how])
    output = passes(
        f"""
        if {BROKEN[how] is None}:
            sys.modules["taichi"] = sys.modules["quadrants"] = None
        sys.path.insert(0, {str(tmp_path)!r})
        from solver import CubicCraftError, engine_name, problem_with_engine
        from solver.backends import devices
        tries = []
        real = devices.import_engine
        devices.import_engine = lambda: tries.append(1) or real()
        assert problem_with_engine() == ""
        for _ in range(5):
            assert stylize(V, F, max_iterations=2).device == "numpy"
        assert len(tries) == {3 if how in IMPORTED else 1}, "it is tried in each run"
        assert problem_with_engine() and "\\n" not in problem_with_engine()
        try:
            stylize(V, F, max_iterations=2, device="cpu")
        except CubicCraftError as error:
            assert f"needs {{engine_name()}}" in str(error) and "\\n" not in str(error)
        else:
            raise AssertionError("not refused")
        """
    )
    assert output == ""


@pytest.mark.parametrize("passes_at", [3, 4])
def test_a_failure_that_may_pass_is_tried_again(passes_at):
    """In three runs in a row; one that never starts is then given up."""
    passes(
        f"""
        from solver import problem_with_engine
        from solver.backends import devices
        tries = []
        def local_step(*arguments, **_):
            tries.append(1)
            if len(tries) < {passes_at}:
                raise OSError("the disk is full")
            return devices.NumpyLocalStep(*arguments)
        devices.import_engine, devices.TaichiLocalStep = lambda: None, local_step
        for _ in range(2):
            stylize(V, F, max_iterations=2)
            assert problem_with_engine() == "the disk is full"
        for _ in range(3):
            stylize(V, F, max_iterations=2)
            assert problem_with_engine() == ("" if {passes_at} == 3 else "the disk is full")
        assert len(tries) == (5 if {passes_at} == 3 else 3)
        """
    )


@needs_engine
def test_too_little_memory_is_no_reason_to_do_without_the_engine():
    passes(
        """
        from solver import problem_with_engine
        from solver.backends import taichi_local_step
        def fail(*_):
            raise MemoryError
        real, taichi_local_step.warm_up = taichi_local_step.warm_up, fail
        try:
            stylize(V, F, max_iterations=2)
        except MemoryError:
            pass
        taichi_local_step.warm_up = real
        assert problem_with_engine() == ""
        assert stylize(V, F, max_iterations=2).device == CPU
        """
    )


@pytest.fixture(scope="module")
def cached(tmp_path_factory):
    """Return a folder that the engine has filled, and what was computed meanwhile."""
    folder = tmp_path_factory.mktemp("cache")
    return folder, passes(WITH_CACHE.format(folder=str(folder)))


def _cut(data):
    return data[: len(data) // 2]


SPOILED = {
    "kernels garbage": ("*.[tq][id]c", lambda data: bytes(range(256)) * 20),
    "kernels cut off": ("*.[tq][id]c", _cut),
    "kernels empty": ("*.[tq][id]c", lambda data: b""),
    "index garbage": ("*.[tq][cd]b", lambda data: bytes(range(256)) * 20),
    "index cut off": ("*.[tq][cd]b", _cut),
    "all empty": ("*", lambda data: b""),
}


def check_folders(folders, expected):
    """Compute the same with each of the folders for the cache, one after the other."""
    output = passes(
        f"""
        from solver import set_cache_folder
        from solver.backends.engine import import_engine
        for folder in {list(map(str, folders))!r}:
            print(folder, flush=True)  # for whoever reads of a crash
            import_engine().reset()
            set_cache_folder(folder)
            result = stylize(V, F, max_iterations=2)
            assert f"{{result.device}} {{result.positions.tobytes().hex()}}" == {expected.strip()!r}
        """
    )
    assert output.split() == list(map(str, folders))


@pytest.mark.thorough
@needs_engine
def test_a_corrupt_cache_does_not_matter(cached, tmp_path):
    filled, expected = cached
    for how, (pattern, spoil) in SPOILED.items():
        shutil.copytree(filled, tmp_path / how.replace(" ", "_"))
        found = (tmp_path / how.replace(" ", "_")).rglob(pattern)
        files = [path for path in found if path.is_file()]
        assert files
        for file in files:
            file.write_bytes(spoil(file.read_bytes()))
    check_folders(sorted(tmp_path.iterdir()), expected)


@pytest.mark.thorough
@needs_engine
def test_a_cache_folder_that_cannot_be_used_does_not_matter(cached, tmp_path):
    file = tmp_path / "file"
    file.write_text("of the artist")
    read_only = ["/proc/engine"] if sys.platform == "linux" else []  # for root as well
    check_folders([file, file / "below", *read_only], cached[1])
    assert file.read_text() == "of the artist"


@needs_engine
def test_a_full_disk_does_not_matter(cached, tmp_path):
    if sys.platform != "linux" or os.geteuid() != 0:
        pytest.skip("only root can make a small disk")
    mounting = ["mount", "-t", "tmpfs", "-o", "size=8k", "tmpfs", tmp_path]
    if subprocess.run(mounting, capture_output=True, check=False).returncode:
        pytest.skip("no disk can be mounted here")
    try:
        assert passes(WITH_CACHE.format(folder=str(tmp_path))) == cached[1]
    finally:
        subprocess.run(["umount", tmp_path], check=True)


@pytest.mark.thorough(1)
@needs_engine
@pytest.mark.parametrize(
    "options",
    [
        "default_fp=ti.f32",
        "default_fp=ti.f64, default_ip=ti.i64",
        "default_fp=ti.f16, fast_math=True",
        "debug=True, offline_cache=False",
        "advanced_optimization=False, cpu_max_num_threads=1",
        "kernel_profiler=True",
    ],
)
def test_the_options_of_others_do_not_matter(options):
    """Each comes before and during our runs, with a field of the others that must stay."""
    passes(
        f"""
        from solver.backends.engine import import_engine
        ti = import_engine()
        expected = stylize(V, F, device="cpu", max_iterations=6).positions
        def foreign():
            ti.reset()
            ti.init(arch=ti.cpu, log_level=ti.ERROR, {options})
            field = ti.field(ti.i32, shape=4)
            field.fill(7)
            return field
        fields = [foreign()]
        def disturb(stylization):
            if stylization.iterations == 3:
                fields[:] = [foreign()]
        def lose(stylization):
            if stylization.iterations == 3:
                ti.reset()
        for on_iteration in (None, disturb, None, lose):
            V2 = stylize(V, F, device="cpu", max_iterations=6, on_iteration=on_iteration).positions
            np.testing.assert_allclose(V2, expected, rtol=0, atol=1e-9)
            assert on_iteration is lose or (fields[0].to_numpy() == 7).all()
        """
    )


@needs_engine
@needs("pyamg")
def test_no_kernel_reads_beyond_its_arrays():
    """Which another add-on's program may be set to check. Nor is there anything to warn of."""
    passes(
        """
        import warnings
        from solver.global_step import multigrid, step as global_step
        from solver.backends.engine import import_engine
        global_step.FACTORIZED_VERTICES, multigrid._COARSEST = 0, 20
        ti = import_engine()
        ti.init(arch=ti.cpu, log_level=ti.ERROR, debug=True, offline_cache=False)
        warnings.simplefilter("error")
        stylize(V, F, device="cpu", max_iterations=3)
        """
    )
