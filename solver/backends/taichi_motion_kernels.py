# SPDX-License-Identifier: GPL-3.0-or-later
"""What an iteration on a large mesh does beside the local step and the V-cycle, as Taichi kernels.

To import this imports the engine. Sums and maxima are those of the chunks of
`Topology` and then of its groups, each in a fixed order; the few of the groups go to NumPy.
"""

from types import SimpleNamespace

from .engine import kernel_types, ti


def make_motion_kernels(real):
    """Return the kernels for the type ti.f64 or ti.f32."""
    vec3, _, scalars, integers, vectors, matrices = kernel_types(real)
    vec4 = ti.types.vector(4, ti.f32)
    singles = ti.types.ndarray(dtype=ti.f32, ndim=1)
    vectors4 = ti.types.ndarray(dtype=vec4, ndim=1)
    vec6, vec8 = ti.types.vector(6, real), ti.types.vector(8, real)
    vectors6, vectors8 = (ti.types.ndarray(dtype=vec, ndim=1) for vec in (vec6, vec8))

    @ti.func
    def moved(point, correction, scale):
        return point + ti.cast(scale, real) * vec3(correction[0], correction[1], correction[2])

    @ti.kernel
    def residual(
        indptr: integers,
        indices: integers,
        scatter: vectors,
        weights: scalars,
        R: matrices,
        point: vectors,
        scale: singles,
        B: vectors4,
    ):
        """Set B = scale (rhs - L point), with the right-hand side of the rotations."""
        for i in range(point.shape[0]):
            here = point[i]
            turned, pull = vec3(0.0), vec3(0.0)
            for entry in range(indptr[i], indptr[i + 1]):
                j = indices[entry]
                turned += R[j] @ scatter[entry]
                pull += weights[entry] * (point[j] - here)
            total = ti.cast(turned / 3 + pull, ti.f32) * scale[i]
            B[i] = vec4(total[0], total[1], total[2], 0.0)

    @ti.kernel
    def moments(
        bounds: integers,
        share: scalars,
        pull: vectors,
        point: vectors,
        scale: singles,
        X: vectors4,
        groups: integers,
        parts: vectors6,
        sums: vectors6,
    ):
        """Sum what each group adds to the centroid of a component and to its torque."""
        for c in range(parts.shape[0]):
            mean, torque = vec3(0.0), vec3(0.0)
            for i in range(bounds[c], bounds[c + 1]):
                u = moved(point[i], X[i], scale[i])
                mean += share[i] * u
                torque += pull[i].cross(u)
            parts[c] = vec6(mean[0], mean[1], mean[2], torque[0], torque[1], torque[2])
        for g in range(sums.shape[0]):
            total = vec6(0.0)
            for c in range(groups[g], groups[g + 1]):
                total += parts[c]
            sums[g] = total

    @ti.kernel
    def move(
        bounds: integers,
        component: integers,
        V: vectors,
        scale: singles,
        X: vectors4,
        P: vectors,
        motion: vectors8,
        point: vectors,
        U: vectors,
        groups: integers,
        parts: vectors,
        largest: vectors,
    ):
        """Find new positions U by the correction X, and the point that the next step starts from.

        The motion of a component is its twist, shift, momentum and overshoot. It is shifted, and
        kept from turning by twist x P, see `no_turning.py`. Of each group: largest displacement and
        largest distance from rest, by coordinate.
        """
        for c in range(parts.shape[0]):
            of = motion[component[c]]
            mu, by = vec3(of[0], of[1], of[2]), vec3(of[3], of[4], of[5])
            displacement, distance = real(0.0), real(0.0)
            for i in range(bounds[c], bounds[c + 1]):
                u = moved(point[i], X[i], scale[i]) + mu.cross(P[i]) + by
                step = u - U[i]
                displacement = ti.max(displacement, ti.abs(step).max())
                distance = ti.max(distance, ti.abs(u - V[i]).max())
                U[i] = u
                point[i] = u + of[6] * step + of[7] * (u - point[i])
            parts[c] = vec3(displacement, distance, 0.0)
        for g in range(largest.shape[0]):
            most = vec3(0.0)
            for c in range(groups[g], groups[g + 1]):
                most = ti.max(most, parts[c])
            largest[g] = most

    @ti.kernel
    def sum_energies(
        bounds: integers,
        energies: vectors,
        at_rest: scalars,
        cubic_weight: scalars,
        certified: integers,
        groups: integers,
        parts: vectors,
        sums: vectors,
    ):
        """Sum the ARAP energy, the cubic energy, and what is not certified, of each group."""
        for c in range(parts.shape[0]):
            total = vec3(0.0)
            for i in range(bounds[c], bounds[c + 1]):
                quadratic, fit, cost = energies[i]
                total += vec3(
                    real(0.75) * quadratic - fit - at_rest[i],
                    cubic_weight[i] * cost,
                    ti.cast(certified[i] == 0, real),
                )
            parts[c] = total
        for g in range(sums.shape[0]):
            total = vec3(0.0)
            for c in range(groups[g], groups[g + 1]):
                total += parts[c]
            sums[g] = total

    return SimpleNamespace(residual=residual, moments=moments, move=move, sum_energies=sum_energies)
