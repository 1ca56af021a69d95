# SPDX-License-Identifier: GPL-3.0-or-later
"""What must hold for the method as a whole, on every shape and with both backends."""

from functools import partial

import numpy as np
import pytest
import shapes
from devices import by_device
from procrustes import best_rotation

from solver import (
    PAPER,
    CubicCraftError,
    ProxyOptions,
    Setup,
    SolverOptions,
    Style,
    Stylization,
    join_pieces,
    piece_of,
    rest_mesh,
    stylize,
)
from solver.console import method_options
from solver.method import IN_LIBRARY
from solver.styles import forms

FIXED = {"proxy": PAPER, "max_iterations": 40, "tolerance": 1e-12}
Q = shapes.rotation(30, 20, 40)


def face_alignment(V, F):
    """Return the area-weighted mean of the largest component of the unit face normals."""
    normals = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    return np.abs(normals).max(axis=1).sum() / np.linalg.norm(normals, axis=1).sum()


@pytest.mark.parametrize("name", shapes.ALL)
def test_cubeness_0_leaves_the_mesh_where_it_is(name, device):
    V, F = shapes.ALL[name]()
    result = stylize(V, F, 0.0, device=device, max_iterations=30, tolerance=1e-15, proxy=PAPER)
    assert np.abs(result.positions - V).max() < by_device(device, 1e-9, 1e-5) * shapes.extent(V)


@pytest.mark.thorough(12)
@pytest.mark.parametrize("name", shapes.ALL)
@pytest.mark.parametrize("cubeness", [0.0, 0.2, 1.0])
def test_the_energy_of_the_plain_iteration_never_rises(name, cubeness, device):
    V, F = shapes.ALL[name]()
    energies = []
    stylize(
        V,
        F,
        cubeness,
        device=device,
        is_accelerated=False,
        on_iteration=lambda s: energies.append(s.energy.total),
        **FIXED,
    )
    # in 32 bit it comes to rest before
    least = by_device(device, FIXED["max_iterations"], 3)
    assert len(energies) >= least or energies[-1] < 1e-12
    assert np.diff(energies).max() < by_device(device, 1e-11, 1e-6)


def test_a_sphere_becomes_a_cube(device):
    V, F = shapes.sphere(3)
    result = stylize(V, F, 0.8, device=device, proxy=PAPER)
    assert result.converged
    assert face_alignment(V, F) < 0.85
    assert face_alignment(result.positions, F) > 0.94


def test_turning_the_mesh_equals_turning_the_cube(device):
    V, F = shapes.blob()
    a = stylize(V @ Q.T, F, 0.4, device=device, **FIXED).positions @ Q
    b = stylize(V, F, 0.4, orientation=Q, device=device, **FIXED).positions
    assert np.abs(a - b).max() < by_device(device, 1e-6, 1e-4) * shapes.extent(V)


@pytest.mark.parametrize("scale", [1e-4, 1e4])
def test_scale_and_place_do_not_matter(scale, device):
    V, F = shapes.blob()
    offset = 1e3 * shapes.extent(V) * np.array([1.0, -1.0, 0.5])
    a = stylize(V, F, 0.4, device=device, **FIXED).positions
    b = stylize(scale * (V + offset), F, 0.4, device=device, **FIXED).positions / scale - offset
    assert np.abs(a - b).max() < by_device(device, 1e-7, 1e-5) * shapes.extent(V)


def test_components_behave_as_each_alone(device):
    V, F = shapes.two_blobs()
    together = stylize(V, F, 0.4, device=device, **FIXED).positions
    first = len(shapes.blob(2)[0])
    for part in (slice(0, first), slice(first + 1, None)):
        numbers = np.arange(len(V))[part]
        G = F[np.isin(F[:, 0], numbers)] - numbers[0]
        alone = stylize(V[part], G, 0.4, device=device, **FIXED).positions
        apart = np.abs(together[part] - alone).max() / shapes.extent(V)
        assert apart < by_device(device, 1e-7, 1e-4)
    np.testing.assert_array_equal(together[first], V[first])  # the loose vertex


@pytest.mark.parametrize("scale", [1e-2, 1e-4])
def test_a_tiny_part_is_solved_like_a_large_one(scale, device):
    V, F = shapes.blob(2)
    both = np.concatenate([V, scale * V + [3.0, 0.0, 0.0]])
    result = stylize(both, np.concatenate([F, F + len(V)]), 0.4, device=device, **FIXED)
    large, tiny = result.positions[: len(V)], result.positions[len(V) :]
    # the places of both in the same 32 bit: the smaller the part, the fewer are left for its shape
    tolerance = by_device(device, 1e-6, 2e-5 / scale)
    assert np.abs((tiny - [3.0, 0.0, 0.0]) / scale - large).max() < tolerance


def test_the_same_input_gives_the_same_bits(device):
    V, F = shapes.skewed_blob()
    a, b = (stylize(V, F, 0.4, device=device, proxy=PAPER) for _ in range(2))
    np.testing.assert_array_equal(a.positions, b.positions)
    np.testing.assert_array_equal(a.rotations, b.rotations)
    assert a.energy == b.energy


def test_pins_follow_their_targets(device):
    V, F = shapes.blob()
    pins = np.concatenate([np.flatnonzero(V[:, 2] > 1.0), np.flatnonzero(V[:, 2] < -0.5)])
    targets = V.copy()
    targets[V[:, 2] > 1.0] += [0.3, 0.0, 0.4]
    result = stylize(V, F, 0.0, pins, targets=targets, device=device, proxy=PAPER)
    np.testing.assert_array_equal(result.positions[pins], targets[pins])
    free = np.setdiff1d(np.arange(len(V)), pins)
    assert np.abs(result.positions[free] - V[free]).max() > 0.1


def test_a_pinned_loose_vertex_goes_to_its_target(device):
    V, F = shapes.two_blobs()
    loose = len(shapes.blob(2)[0])
    targets = np.full(V.shape, np.nan)
    targets[[0, loose]] = [V[0], [1.0, 2.0, 3.0]]
    result = stylize(
        V, F, 0.2, [0, loose], targets=targets, device=device, max_iterations=3, proxy=PAPER
    )
    np.testing.assert_array_equal(result.positions[[0, loose]], targets[[0, loose]])


def test_a_cubeness_map_acts_where_it_is(device):
    V, F = shapes.sphere(3)
    cubeness = np.where(V[:, 0] > 0.0, 1.0, 0.0)
    U = stylize(V, F, cubeness, device=device, proxy=PAPER).positions
    right = (V[F][:, :, 0] > 0.3).all(axis=1)
    left = (V[F][:, :, 0] < -0.3).all(axis=1)
    assert face_alignment(U, F[right]) > 0.93
    assert abs(face_alignment(U, F[left]) - face_alignment(V, F[left])) < 0.05


def test_keep_rotation_holds_the_shape_and_the_cube(device):
    V, F = shapes.blob()
    V = V @ shapes.rotation(0, 8, 4).T
    rest = rest_mesh(V, F, PAPER)
    free = stylize(V, F, 0.5, device=device, proxy=PAPER)
    kept = stylize(V, F, 0.5, device=device, keep_rotation=True, proxy=PAPER)
    turns = np.array([best_rotation(X.positions, V, rest.areas) for X in (free, kept)])
    angles = np.degrees(np.linalg.norm(turns - np.eye(3), axis=(1, 2)) / 2**0.5)
    assert angles[0] > 1.0
    assert angles[1] < by_device(device, 1e-5, 1e-3)
    assert kept.converged
    # Not the free shape turned back, whose sides are no longer those of the cube.
    energy = Stylization(Setup(rest), 0.5, options=SolverOptions(device=device)).energy_of(
        free.positions @ turns[0]
    )
    assert kept.energy.total < energy.total


def test_the_reported_energy_is_that_of_the_result(device):
    V, F = shapes.blob()
    result = stylize(V, F, 0.3, device=device, proxy=PAPER)
    again = Stylization(Setup(rest_mesh(V, F, PAPER)), 0.3, options=SolverOptions(device=device))
    energy = again.energy_of(result.positions)  # ends nearer to the limit of the ADMM
    assert energy.total == pytest.approx(result.energy.total, rel=2e-4)


def test_a_run_can_be_cancelled_and_says_so(device):
    V, F = shapes.blob(2)
    result = stylize(
        V, F, 0.3, device=device, on_iteration=lambda s: s.iterations == 3, proxy=PAPER
    )
    assert (result.iterations, result.reason, result.converged) == (3, "cancelled", False)


def test_a_run_that_has_come_to_its_end_is_not_cancelled(device):
    V, F = shapes.blob(2)
    of = {"device": device, "proxy": PAPER}
    last = stylize(V, F, 0.3, **of).iterations
    result = stylize(V, F, 0.3, on_iteration=lambda s: s.iterations == last, **of)
    assert (result.iterations, result.reason) == (last, "converged")


def test_by_default_all_is_as_in_the_extension():
    V, F = shapes.blob(2)
    few = {"device": "numpy", "max_iterations": 20}
    plain = stylize(V, F, **few)
    defaults = method_options.defaults(*IN_LIBRARY)
    given = {name: values[0] for name, values in defaults.items()}
    proxy = {name: given[name] for name in ("solidity", "detail")}
    proxy |= {name: given[name] in ("on", "auto") for name in ("keep_pose", "keep_apart", "refine")}
    style = {name: given[name] for name in ("crispness", "detail_strength")}
    told = {"proxy": ProxyOptions(**proxy), "keep_rotation": given["rotation"] == "keep"}
    assert plain == stylize(V, F, 0.4, **few, **style, **told)
    paper = stylize(V, F, **few, proxy=PAPER)
    told = {"proxy": PAPER, "crispness": 0.0, "keep_rotation": False}
    assert paper == stylize(V, F, 0.4, **few, **told) != plain
    rest = rest_mesh(V, F)
    assert rest.options == ProxyOptions() == join_pieces([piece_of(V, F)]).setup.rest.options
    assert piece_of(V, F).placement.style.crispness == given["crispness"]


def test_a_form_may_be_a_name():
    V, F = shapes.blob(1)
    upper = (V[:, 2] > 0).astype(int)
    for name, form in (
        ("octahedron", forms.octahedron()),
        ("cube", None),
        ("prism", forms.prism(6)),
        (["cube", "cone"], [forms.cube(), forms.cone()]),
    ):
        which = upper if isinstance(name, list) else None
        of = {"device": "numpy", "form_of": which, "proxy": PAPER, "max_iterations": 3}
        assert stylize(V, F, form=name, **of) == stylize(V, F, form=form, **of)


def test_triangles_that_face_both_ways_are_refused_if_they_are_many():
    V, F = shapes.blob(2)
    stylize(V, F[:, ::-1], device="numpy", proxy=PAPER)
    F[0] = F[0, ::-1]
    stylize(V, F, device="numpy", proxy=PAPER)
    F[::3] = F[::3, ::-1]
    for entry in (stylize, piece_of):
        with pytest.raises(CubicCraftError, match="one of two triangles faces the other way; make"):
            entry(V, F)
    masked = np.ma.masked_less(F, 3)
    with pytest.raises(CubicCraftError, match="triangles must have no masked values"):
        stylize(V, masked)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"cubeness": -0.1}, "cubeness must be finite and not negative"),
        ({"cubeness": np.nan}, "cubeness must be finite"),
        ({"cubeness": np.ones(3)}, "cubeness must be one number or 42"),
        ({"orientation": np.diag([1.0, 2.0, 1.0])}, "must be a rotation"),
        ({"orientation": np.diag([1.0, 1.0, -1.0])}, "must be a rotation"),
        ({"orientation": np.eye(2)}, r"shape \(3, 3\)"),
        ({"pinned": [42]}, "between 0 and 41"),
        ({"pinned": np.ones(41, bool)}, "one truth value for each of the 42 vertices"),
        ({"pinned": [0.7]}, "by number, or be a mask of 42 truth values, not be float64"),
        ({"pinned": ["0"]}, "not be text"),
        ({"cubeness": "0.4"}, "cubeness must be real numbers, not text"),
        ({"cubeness": None}, "cubeness must be real numbers, not None"),
        ({"orientation": 1j * np.eye(3)}, "orientation must be real numbers, not complex128"),
        ({"keep_rotation": "no"}, "keep_rotation must be True or False, not 'no'"),
        ({"is_accelerated": 0}, "is_accelerated must be True or False, not 0"),
        ({"form": "ball"}, "there is no form 'ball'; give one of cube, box, rounded,"),
        ({"form": 3}, "form must be of the type Polytope, not int"),
        ({"form": ["cube", "cone"]}, "2 values of form are given, .* give form_of, or only one"),
        ({"form_of": np.zeros(42, int)}, "form_of needs values of form"),
        ({"form": forms.octahedron(), "form_of": np.ones(42, int)}, "form_of must lie between"),
        ({"form": forms.octahedron(), "form_of": [0]}, r"form_of must have the shape \(42,\)"),
        ({"proxy": {"solidity": 1}}, "proxy must be of the type ProxyOptions, not dict"),
        ({"limbs": 3}, "limbs must be of the type KnownLimbs, not int"),
        ({"precision": "f16"}, "precision must be f64 or f32"),
        ({"tolerance": "small"}, "tolerance must be real numbers, not text"),
        ({"max_iterations": [3]}, "max_iterations must be a whole number of at least 1, not int64"),
        ({"max_iterations": True}, "max_iterations must be a whole number .*, not True"),
        ({"max_iterations": 1.5}, "max_iterations must be a whole number .*, not 1.5"),
        ({"max_iterations": np.inf}, "max_iterations must be a whole number .*, not inf"),
        ({"cubeness": np.ma.masked_less(np.arange(42), 3)}, "cubeness must have no masked values"),
        ({"pinned": [0], "targets": np.ones((2, 3))}, r"targets must have the shape \(42, 3\)"),
        ({"max_iterations": np.nan}, "max_iterations must"),
        ({"pinned": range(42)}, "all vertices are pinned"),
        ({"pinned": [0], "targets": np.full((42, 3), np.inf)}, "must be finite"),
        ({"device": "abacus"}, 'device "abacus" is none of'),
        ({"tolerance": 0.0}, "tolerance must"),
        ({"max_iterations": 0}, "max_iterations must"),
    ],
)
def test_bad_options_are_refused(options, message):
    V, F = shapes.blob(1)
    with pytest.raises(CubicCraftError, match=message) as caught:
        stylize(V, F, **{"cubeness": 0.3, "device": "numpy", "proxy": PAPER, **options})
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ((0.4, np.eye(3)), "pose must be of the type Pose, not float64"),
        ((0.4, None, {"device": "numpy"}), "options must be of the type SolverOptions, not dict"),
        ((Style("0.4"),), "cubeness must be real numbers, not text"),
    ],
)
def test_what_is_no_style_pose_or_options_is_refused(given, message):
    setup = Setup(rest_mesh(*shapes.blob(1), proxy=PAPER))
    with pytest.raises(CubicCraftError, match=message):
        Stylization(setup, *given)


def test_options_that_are_not_there_are_named():
    V, F = shapes.blob(1)
    for function in (stylize, partial(Stylization, Setup(rest_mesh(V, F, PAPER)), 0.3)):
        with pytest.raises(TypeError, match="unexpected keyword argument 'orientaton'"):
            function(V, F, orientaton=np.eye(3))


def test_pins_may_be_a_mask():
    V, F = shapes.blob(1)
    numbers = np.flatnonzero(V[:, 2] > 0.3)
    one, other = (
        stylize(V, F, 0.3, pinned, device="numpy", proxy=PAPER).positions
        for pinned in (numbers, (V[:, 2] > 0.3).tolist())
    )
    assert len(numbers) and np.array_equal(one, other)
