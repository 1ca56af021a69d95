# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever the mesh: a finite result that keeps what was promised, or a refusal that says why."""

import importlib.util
from dataclasses import replace

import numpy as np
import pytest
from budget import examples
from hostile_meshes import SEEDS, broken_meshes
from hostile_options import options_for
from hypothesis import event, given
from hypothesis import strategies as st
from pieces import PIECES

from solver import CubicCraftError, Setup, Stylization, rest_mesh, stylize

ITERATIONS = 10
ROUNDING = 1e-9
"""of the energy at rest: what sums of 64 bit numbers may differ by, with cotangents up to 1e3"""
NOTHING = 1e-10
"""an energy in the unit box that is nothing but rounding, of up to 10,000 vertices of a proxy"""
HAS_TAICHI = importlib.util.find_spec("taichi") is not None
DEVICES = (*4 * ["cpu"], "numpy") if HAS_TAICHI else ("numpy",)  # NumPy is slower


def _not_finite(arguments, rng):
    used = np.unique(arguments["F"])
    arguments["V"][rng.choice(used), rng.integers(3)] = rng.choice([np.nan, np.inf, -np.inf])


def _loose_not_finite(arguments, rng):
    arguments["V"] = np.concatenate([arguments["V"], [[0.0, np.nan, 0.0]]])


def _index_too_large(arguments, rng):
    arguments["F"][rng.integers(len(arguments["F"])), rng.integers(3)] = len(arguments["V"])


def _index_negative(arguments, rng):
    arguments["F"][rng.integers(len(arguments["F"])), rng.integers(3)] = -1


def _given(name, value):
    return lambda arguments, rng: arguments.update({name: value})


def _all_pinned(arguments, rng):
    arguments["pinned"] = np.arange(len(arguments["V"]))


def _pin_out_of_range(arguments, rng):
    arguments["pinned"] = [len(arguments["V"])]


def _target_not_finite(arguments, rng):
    arguments["pinned"], arguments["targets"] = [0], arguments["V"] * np.nan


def _map_too_short(arguments, rng):
    arguments["cubeness"] = np.ones(len(arguments["V"]) - 1)


SPOILT = {
    "not finite": _not_finite,
    "a loose vertex is not finite": _loose_not_finite,
    "index too large": _index_too_large,
    "index negative": _index_negative,
    "no faces": _given("F", np.empty((0, 3), int)),
    "cubeness nan": _given("cubeness", np.nan),
    "cubeness negative": _given("cubeness", -0.1),
    "cubeness infinite": _given("cubeness", np.inf),
    "map too short": _map_too_short,
    "all pinned": _all_pinned,
    "pin out of range": _pin_out_of_range,
    "target not finite": _target_not_finite,
    "mirroring": _given("orientation", -np.eye(3)),
    "orientation not finite": _given("orientation", np.full((3, 3), np.nan)),
    "sheared orientation": _given("orientation", np.triu(np.ones((3, 3)))),
    "no iterations": _given("max_iterations", 0),
    "tolerance nan": _given("tolerance", np.nan),
    "tolerance 0": _given("tolerance", 0.0),
    "unknown device": _given("device", "tpu"),
}
"""what a name stands for: a function that spoils the arguments of `stylize`"""


@st.composite
def cases(draw):
    """Draw a mesh, options for it, and a device."""
    mesh = draw(broken_meshes())
    return mesh, draw(options_for(mesh)), draw(st.sampled_from(DEVICES))


def run(mesh, options, device, **more):
    """Return the Result and the energies of all iterations, the last that of the result."""
    energies = []
    result = stylize(
        mesh.V,
        mesh.triangles,
        options.cubeness,
        options.pinned,
        targets=options.targets,
        orientation=options.orientation,
        keep_rotation=options.keep_rotation,
        proxy=options.proxy,
        device=device,
        max_iterations=ITERATIONS,
        tolerance=1e-6,
        on_iteration=lambda state: energies.append(state.energy.total),
        **more,
    )
    return result, np.array([*energies, result.energy.total])


def check_result(mesh, options, result):
    """Check what holds for every Result."""
    V, n = mesh.V, len(mesh.V)
    assert result.positions.shape == (n, 3)
    assert np.isfinite(result.positions).all()
    assert np.isfinite(result.energy.total)
    R = result.rotations
    assert np.abs(R @ R.swapaxes(1, 2) - np.eye(3)).max() < 1e-6
    assert (np.linalg.det(R) > 0.0).all()
    free = np.setdiff1d(np.flatnonzero(mesh.loose), options.pinned)
    assert result.positions[free].tobytes() == V[free].tobytes()
    held = V if options.targets is None else options.targets
    assert result.positions[options.pinned].tobytes() == held[options.pinned].tobytes()


@examples(475)
@given(case=cases())
def test_a_result_keeps_what_was_promised(case):
    mesh, options, device = case
    V, F = mesh.V.copy(), mesh.triangles
    result, energies = run(mesh, options, device)
    event(f"{device}: {result.reason}")
    check_result(mesh, options, result)
    assert mesh.V.tobytes() == V.tobytes()
    assert mesh.triangles.tobytes() == F.tobytes()
    assert energies[-1] <= energies[0] * (1 + ROUNDING) + NOTHING
    if options.targets is None:
        assert energies[-1] <= energy_at_rest(mesh, options) * (1 + ROUNDING) + NOTHING
    used = np.flatnonzero(~mesh.loose)  # the same numbers, with and without loose vertices
    again, _ = run(*without_loose(mesh, options), device)
    assert again.positions.tobytes() == result.positions[used].tobytes()
    assert again.rotations.tobytes() == result.rotations[used].tobytes()


@examples(400)
@given(case=cases())
def test_the_energy_of_the_plain_iteration_never_rises(case):
    mesh, options, device = case
    result, energies = run(mesh, options, device, is_accelerated=False)
    check_result(mesh, options, result)
    assert np.diff(energies).max() <= ROUNDING * abs(energies[0]) + NOTHING


@examples(50)
@given(mesh=broken_meshes(), data=st.data())
def test_what_cannot_be_used_is_refused(mesh, data):
    spoil = data.draw(st.sampled_from(sorted(SPOILT)), label="spoilt")
    rng = np.random.default_rng(data.draw(SEEDS, label="seed"))
    arguments = {
        "V": mesh.V.copy(),
        "F": mesh.triangles,
        "device": data.draw(st.sampled_from(DEVICES)),
    }
    SPOILT[spoil](arguments, rng)
    with pytest.raises(CubicCraftError) as caught:
        stylize(**arguments)
    message = str(caught.value)
    assert message and "\n" not in message


@pytest.mark.parametrize("device", sorted(set(DEVICES)))
def test_thousands_of_parts(device):
    """Each part does as it would alone, and none moves away."""
    count = 10_000 if device == "cpu" else 2_000  # NumPy is slower
    rng = np.random.default_rng(3)
    part = PIECES["ball"](rng, 1)
    turns = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
    sizes = 10.0 ** rng.uniform(-5, -3, (count, 1, 1))
    V = sizes * (part.V @ turns.swapaxes(1, 2)) + rng.random((count, 1, 3))
    n = len(part.V)
    F = part.triangles + n * np.arange(count)[:, None, None]
    result = stylize(V.reshape(-1, 3), F.reshape(-1, 3), 0.4, device=device, max_iterations=5)
    moved = (result.positions.reshape(V.shape) - V) / sizes
    assert np.isfinite(moved).all()
    assert np.abs(moved).max() < 1.0
    alone = stylize(V[7], part.triangles, 0.4, device=device, max_iterations=5)
    assert np.abs((alone.positions - V[7]) / sizes[7] - moved[7]).max() < 1e-6


def without_loose(mesh, options):
    """Return the mesh without its loose vertices, and the Options of the others."""
    used = np.flatnonzero(~mesh.loose)
    number = np.full(len(mesh.V), -1)
    number[used] = np.arange(len(used))
    faces = [tuple(number[list(face)].tolist()) for face in mesh.faces]
    kept = replace(
        options,
        cubeness=options.cubeness[used] if np.ndim(options.cubeness) else options.cubeness,
        pinned=np.setdiff1d(number[options.pinned], -1),
        targets=None if options.targets is None else options.targets[used],
    )
    return replace(mesh, V=mesh.V[used], faces=faces, edges=[]), kept


def energy_at_rest(mesh, options):
    """Return the energy of the undeformed mesh with all rotations the identity."""
    rest = rest_mesh(mesh.V, mesh.triangles, options.proxy)
    state = Stylization(
        Setup(rest, options.pinned),
        options.cubeness,
        options.orientation,
        device="numpy",
        keep_rotation=options.keep_rotation,
    )
    cube_normals = np.einsum(
        "nij,nj->ni", np.broadcast_to(state._Q, (len(rest.V), 3, 3)), rest.normals
    )
    return (state._lam * rest.areas * np.abs(cube_normals).sum(axis=1)).sum()
