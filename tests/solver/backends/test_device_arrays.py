# SPDX-License-Identifier: GPL-3.0-or-later
"""The iteration whose arrays stay on a device: on a GPU, or with the CPU in its place.

The kernels are those of large meshes on the CPU, and so is what they are compared with.
"""

import sys
from importlib import import_module
from types import SimpleNamespace

import numpy as np
import pytest
import shapes
from devices import DEVICES, by_device
from engine_marks import PACKAGE, needs_engine
from in_a_process import passes
from optional_marks import needs

from solver import (
    PAPER,
    CubicCraftError,
    Pose,
    Run,
    Setup,
    SolverOptions,
    Stylization,
    rest_mesh,
    stylize,
)
from solver.backends import arrays
from solver.backends.engine import import_engine
from solver.backends.taichi_cycle import ON_DEVICE

pytestmark = [needs("pyamg"), needs_engine]

DEVICE = "gpu" if "gpu" in DEVICES else "cpu"
ON_A_DEVICE = f"""
        from solver.backends import arrays
        from solver.backends.engine import import_engine
        from solver.backends.engine_choice import engine_name, started_program
        from solver.backends.taichi_runtime import start
        if {DEVICE!r} == "cpu":
            arrays.is_on_its_own_memory = lambda device: True
        ti = import_engine()
"""
PRECISIONS = by_device(DEVICE, ["f64", "f32"], ["f32"])  # Vulkan and Metal have no other
here = SimpleNamespace(device="cpu")


@pytest.fixture(autouse=True)
def some_levels(monkeypatch):
    monkeypatch.setattr("solver.global_step.multigrid._COARSEST", 20)


@pytest.fixture
def on_a_device(monkeypatch):
    """Return a function that lets the runs that are begun after it stay on a device."""

    def go():
        monkeypatch.setattr(here, "device", DEVICE)
        if DEVICE == "cpu":
            monkeypatch.setattr(arrays, "is_on_its_own_memory", lambda device: True)

    return go


def on_the_host(monkeypatch, make):
    """Return what `make` makes with the same kernels and arrays of NumPy."""
    with monkeypatch.context() as context:
        context.setattr("solver.global_step.step.FACTORIZED_VERTICES", 0)
        context.setattr("solver.backends.taichi_cycle.ON_PROCESSOR", ON_DEVICE)
        return make()


def stylization(name="blob", pins=0, **options):
    V, F = shapes.ALL[name]()
    pinned = np.argsort(V[:, 2])[:pins]
    pose = Pose(targets=V + [0.0, 0.1, 0.2])
    options = SolverOptions(**{"device": here.device} | options)
    return Stylization(Setup(rest_mesh(V, F, PAPER), pinned), 0.5, pose, options)


@pytest.mark.thorough(3)
@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("pins", [0, 12])
@pytest.mark.parametrize("name", shapes.ALL)
def test_a_run_is_that_of_the_host(name, pins, precision, monkeypatch, on_a_device):
    options = {"precision": precision, "keep_rotation": pins == 0}

    def make():
        state = stylization(name, pins, **options)
        energies = []
        for _ in range(6):
            state.step()
            energies.append(state.energy.total)
        return state, [*energies, state.finish().total]

    host, expected = on_the_host(monkeypatch, make)
    on_a_device()
    state, energies = make()
    assert state._local.arrays.is_resident and not host._local.arrays.is_resident
    tight = 1e-9 if precision == "f64" else 2e-5
    np.testing.assert_allclose(energies, expected, rtol=tight)
    np.testing.assert_allclose(state.positions, host.positions, atol=tight)
    if name != "broken":  # where a vertex without area can be turned at will
        np.testing.assert_allclose(state.rotations, host.rotations, atol=100 * tight)
    np.testing.assert_array_equal(state.placed()[0], make()[0].placed()[0])
    held = state.setup.pinned_input
    np.testing.assert_array_equal(state.placed_positions()[held], state._targets[held])


@pytest.mark.parametrize("coarsest", [20, 10_000])
def test_it_ends_where_the_factorisation_does(coarsest, monkeypatch, on_a_device):
    monkeypatch.setattr("solver.global_step.multigrid._COARSEST", coarsest)
    V, F = shapes.two_blobs()
    exact = stylize(V, F, 0.4, device=here.device, tolerance=1e-4, proxy=PAPER)
    on_a_device()
    near = stylize(V, F, 0.4, device=here.device, tolerance=1e-4, proxy=PAPER)
    assert near.converged
    assert near.energy.total == pytest.approx(exact.energy.total, rel=1e-4)


def _kernel_class():
    """Return the class of kernels."""
    import_engine()
    name = {"taichi": "taichi.lang.kernel_impl", "quadrants": "quadrants.lang.kernel"}[PACKAGE]
    return import_module(name).Kernel


def test_an_iteration_runs_nine_kernels_and_exchanges_few_bytes(monkeypatch, on_a_device):
    on_a_device()
    V, F = shapes.sphere(5)
    state = Stylization(
        Setup(rest_mesh(V, F, PAPER)), 0.5, options=SolverOptions(device=here.device)
    )
    state.step()
    launched, exchanged = [], []
    Kernel = _kernel_class()
    launch = Kernel.__call__

    def spy(self, *arguments):
        launched.append(self.func.__name__)
        exchanged.extend(a.nbytes for a in arguments if isinstance(a, np.ndarray))
        return launch(self, *arguments)

    monkeypatch.setattr(Kernel, "__call__", spy)
    monkeypatch.setattr(type(state._local.arrays), "fetch", None)
    monkeypatch.setattr(type(state._local.arrays), "put", None)
    state.step()
    cycles = ["cycle", "add", "cycle", "together"]
    assert launched == ["local_step", "sum_energies", "residual", *cycles, "moments", "move"]
    assert 0 < sum(exchanged) < 1000


@pytest.mark.parametrize("precision", PRECISIONS)
def test_rotations_that_the_kernel_does_not_certify_are_found_too(
    precision, monkeypatch, on_a_device
):
    def make():
        state = stylization(precision=precision)
        # nothing that starts there is certified
        energy = state.energy_of(state.rest.box.from_unit(state.rest.V * [-1, -1, 1]), steps=1)
        return energy.total, state.rotations

    energy, R = on_the_host(monkeypatch, make)
    on_a_device()
    again, S = make()
    assert np.abs(R - np.eye(3)).max() > 1.0
    assert again == pytest.approx(energy, rel=1e-9 if precision == "f64" else 1e-4)
    np.testing.assert_allclose(S, R, atol=1e-6 if precision == "f64" else 5e-2)


def test_it_starts_from_a_coarser_mesh_and_can_be_looked_at(monkeypatch, on_a_device):
    pytest.importorskip("pyamg")
    monkeypatch.setattr("solver.coarse_to_fine.start.LEAST_VERTICES", 300)
    monkeypatch.setattr("solver.coarse_to_fine.start.COARSEST_VERTICES", 150)

    def make():
        V, F = shapes.blob(3)
        run = Run(
            Stylization(
                Setup(rest_mesh(V, F, PAPER), [3, 4]),
                0.4,
                options=SolverOptions(device=here.device),
            )
        )
        assert run.is_on_coarser_mesh
        looks = []
        while run.reason is None:
            run.advance()
            looks.append(run.placed()[0] if len(looks) % 2 else run.positions())
        return looks, run.result()

    looks, expected = on_the_host(monkeypatch, make)
    on_a_device()
    again, result = make()
    assert len(looks) == pytest.approx(len(again), rel=by_device(DEVICE, 0.0, 0.2))
    np.testing.assert_allclose(again[5], looks[5], atol=by_device(DEVICE, 1e-7, 1e-4))
    near = by_device(DEVICE, 1e-6, 1e-3)
    assert result.energy.total == pytest.approx(expected.energy.total, rel=near)


def test_without_pyamg_only_the_local_step_is_on_the_device(monkeypatch, on_a_device):
    def make():
        state = stylization()
        for _ in range(3):
            state.step()
        return state

    expected = make().positions
    on_a_device()
    monkeypatch.setattr("solver.global_step.multigrid.optional_package", lambda name: None)
    state = make()
    assert not state._local.arrays.is_resident
    assert np.abs(state.positions - expected).max() <= by_device(DEVICE, 0.0, 1e-5)


def test_a_full_device_is_told(monkeypatch, on_a_device):
    def fail(*_):
        raise RuntimeError("out of memory\nin a long story")

    on_a_device()
    monkeypatch.setattr(arrays, "_empty_like", fail)
    with pytest.raises(CubicCraftError, match=r"takes no more arrays \(out of memory\);"):
        stylization()


# on a GPU only one: the kernels are compiled anew each time
THEN = by_device(DEVICE, ["step", "rotations"], ["step"])


@pytest.mark.thorough(1)
@pytest.mark.parametrize(
    ("how", "thens"),
    [("ti.reset()", THEN), *(("ti.reset(); ti.init(arch=arch)", [then]) for then in THEN)],
)
def test_a_reset_is_told_and_the_next_run_works(how, thens):
    passes(
        ON_A_DEVICE
        + f"""
        import gc
        from solver import CubicCraftError, Setup, SolverOptions, Stylization, rest_mesh
        options = SolverOptions(device={DEVICE!r})
        expected = stylize(V, F, device={DEVICE!r}, max_iterations=4)
        for then in {thens}:
            state = Stylization(Setup(rest_mesh(V, F, PAPER)), 0.4, options=options)
            state.step()
            arch = ti.lang.impl.current_cfg().arch
            {how}
            program = started_program()
            foreign = [ti.ndarray(ti.i32, shape=8) for _ in range(300 if program else 0)]
            try:
                value = getattr(state, then)
                if callable(value):
                    value()
            except CubicCraftError as error:
                assert f"reset {{engine_name()}}" in str(error)
            else:
                raise AssertionError(f"{{then}}: not told")
            del state
            gc.collect()
            for array in foreign:  # may lie where ours have been
                array.fill(7)
            again = stylize(V, F, device={DEVICE!r}, max_iterations=4)
            np.testing.assert_array_equal(again.positions, expected.positions)
            assert all((array.to_numpy() == 7).all() for array in foreign)
        """
    )


@pytest.mark.skipif(sys.platform == "win32", reason="it does not tell the peak of its memory")
def test_memory_on_the_device_is_given_back():
    passes(
        ON_A_DEVICE
        + f"""
        import resource
        device, _ = start({DEVICE!r})
        values = np.ones((300_000, 3))
        def keep():
            of_a_run = arrays.arrays_for(device)
            of_a_run.keep(values)
            np.testing.assert_array_equal(of_a_run.fetch(of_a_run.keep(values[:, 0])), 1.0)
        keep()
        unit = 1 if sys.platform == "darwin" else 1024
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit
        for _ in range(40):
            keep()
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit - before
        assert grown < 10 * values.nbytes, grown
        """
    )
