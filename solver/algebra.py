# SPDX-License-Identifier: GPL-3.0-or-later
"""Algebra of 3-vectors and 3x3 matrices on their entries: one source for NumPy and for Taichi.

These are plain Python functions of scalars, of any type with arithmetic, without branches. Matrices
are given and returned as their nine entries, row by row.

- In NumPy the scalars are columns: `columns` takes matrices (n,3,3) apart, and `from_columns` puts
  them together again.
- In a kernel the functions are called inside ``ti.static`` with unpacked operands, as in
  ``mat3(ti.static(product(*A, *B)))``, and build Taichi's expressions directly, which takes a
  fraction of the time that Taichi needs for a function of its own. An operand that is no variable
  is computed anew for each of its entries, until the compiler finds that these are the same, and
  ``ti.static`` lets no bare expression through: what is no list is put in one, as in
  ``ti.static([dot(*a, *b)])[0]``. Numbers in here are integers, because Taichi would take others
  for those of whatever precision its program was started with.
"""

import math

import numpy as np

BLOCK = 4096
"""vertices; what is computed of so many at once stays in the cache of a core"""


def columns(values):
    """Return the entries (w,n) of vectors (n,w) or matrices (n,3,3), if possible as a view."""
    return values.reshape(len(values), math.prod(values.shape[1:])).T


def from_columns(entries):
    """Return the vectors (n,3) or matrices (n,3,3) that have these entries (n,).

    In memory, all numbers of an entry are side by side, as `columns` wants them back.
    """
    entries = np.asarray(entries)
    return entries.T.reshape(-1, 3, 3) if len(entries) == 9 else entries.T


def smoothstep(x, start, end):
    """Return 0 for numbers x at or before a start, 1 at or beyond an end, and smoothly between.

    For NumPy. The end may be before the start: then it falls.
    """
    t = np.clip((x - start) / (end - start), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def sums_by_group(vectors, group, count=0):
    """Return the sums (count or more,d) of vectors (k,d) by their group (k,) int, for NumPy."""
    return np.stack([np.bincount(group, x, count) for x in vectors.T], axis=1)


def spreads(places, weight, group, count):
    """Return the variances (count,3) of groups of places (k,3) along their main axes, ascending."""
    total = np.bincount(group, weight, count)[:, None] + 1e-300
    away = places - (sums_by_group(weight[:, None] * places, group, count) / total)[group]
    products = (weight[:, None, None] * away[:, :, None] * away[:, None, :]).reshape(-1, 9)
    moments = (sums_by_group(products, group, count) / total).reshape(-1, 3, 3)
    return np.maximum(np.linalg.eigvalsh(moments), 0.0)


def by_blocks(function, *arrays):
    """Return what a function makes of arrays (n,...), row by row, for so many rows at once.

    What it computes on the way stays in the cache, and takes no new pages of memory.
    """
    first, *others = blocks(len(arrays[0])) or [slice(0)]
    result = function(*(values[first] for values in arrays))
    if others:
        result, begin = np.empty((len(arrays[0]), *result.shape[1:]), result.dtype), result
        result[first] = begin
    for part in others:
        result[part] = function(*(values[part] for values in arrays))
    return result


def blocks(count):
    """Return slices of so many rows that stay in the cache."""
    return [slice(begin, begin + BLOCK) for begin in range(0, count, BLOCK)]


def by_columns(values):
    """Return a copy of numbers (n,), vectors (n,w) or matrices that lies as `from_columns` says."""
    return np.array(columns(values), order="C").T.reshape(values.shape)


def take(values, rows):
    """Return some rows, by number (k,), that lie as `from_columns` says."""
    if values.strides[0] != values.itemsize:  # row by row: its columns would be a copy of it all
        return by_columns(values[rows])
    return columns(values).take(rows, 1).T.reshape(len(rows), *values.shape[1:])


def put(values, rows, new):
    """Set some rows, by number (k,), of an array that lies as `from_columns` says."""
    into = columns(values)
    assert np.shares_memory(into, values)
    into[:, rows] = columns(new)


def dot(a, b, c, x, y, z):
    """Return the scalar product of two vectors."""
    return a * x + b * y + c * z


def total(a, b, c):
    """Return the sum of the entries of a vector."""
    return a + b + c


def trace(a, b, c, d, e, f, g, h, i):
    """Return the trace of a matrix."""
    return a + e + i


def axial(a, b, c, d, e, f, g, h, i):
    """Return the axial vector of a matrix: (A23 - A32, A31 - A13, A12 - A21)."""
    return [f - h, g - c, b - d]


AXIAL = np.array([axial(*entries) for entries in np.eye(9)])
"""(9,3): matrices (k,9) times it are their axial vectors; its transpose makes of vectors m the
matrices with the rows m x e_1, m x e_2, m x e_3. For few; of many, columns take less time"""


def cross(a, b, c, x, y, z):
    """Return the vector product of two vectors."""
    return [b * z - c * y, c * x - a * z, a * y - b * x]


def outer(a, b, c, x, y, z):
    """Return the matrix of the products of all entries of two vectors."""
    return [row * column for row in (a, b, c) for column in (x, y, z)]


def times(a, b, c, d, e, f, g, h, i, x, y, z):
    """Return the matrix applied to the vector."""
    return [dot(*row, x, y, z) for row in ((a, b, c), (d, e, f), (g, h, i))]


def transposed(a, b, c, d, e, f, g, h, i):
    """Return the transposed matrix."""
    return [a, d, g, b, e, h, c, f, i]


def transposed_times(a, b, c, d, e, f, g, h, i, x, y, z):
    """Return the transposed matrix applied to the vector."""
    return times(a, d, g, b, e, h, c, f, i, x, y, z)


def product(*entries):
    """Return the product of two matrices."""
    A, B = entries[:9], entries[9:]
    return [dot(*A[3 * i : 3 * i + 3], *B[j::3]) for i in range(3) for j in range(3)]


def gram(*A):
    """Return the scalar products of the columns of a matrix."""
    a, b, c = A[::3], A[1::3], A[2::3]
    ab, ac, bc = dot(*a, *b), dot(*a, *c), dot(*b, *c)
    return [dot(*a, *a), ab, ac, ab, dot(*b, *b), bc, ac, bc, dot(*c, *c)]


def adjugate(a, d, e, _d, b, f, _e, _f, c):
    """Return the adjugate of a symmetric matrix."""
    A, B, C = b * c - f * f, a * c - e * e, a * b - d * d
    D, E, F = e * f - d * c, d * f - b * e, d * e - a * f
    return [A, D, E, D, B, F, E, F, C]


def determinant(*entries):
    """Return the determinant of a symmetric matrix, which is given together with its adjugate."""
    return dot(*entries[:3], *entries[9:12])


def size_squared(a, d, e, _d, b, f, _e, _f, c):
    """Return the sum of the squares of the entries of a symmetric matrix."""
    return a * a + b * b + c * c + 2 * (d * d + e * e + f * f)


def shifted(shift, a, b, c, d, e, f, g, h, i):
    """Return a matrix with more on its diagonal."""
    return [a + shift, b, c, d, e + shift, f, g, h, i + shift]


def turn(s, q, x, y, z):
    """Return the rotation of the quaternion (q, x, y, z), with s = 2 / (its square)."""
    return [
        *(1 - s * (y * y + z * z), s * (x * y - z * q), s * (x * z + y * q)),
        *(s * (x * y + z * q), 1 - s * (x * x + z * z), s * (y * z - x * q)),
        *(s * (x * z - y * q), s * (y * z + x * q), 1 - s * (x * x + y * y)),
    ]


def nearer_to_orthogonal(*R):
    """Return (3 R - R R'R) / 2 for almost a rotation R: a step of Newton and Schulz."""
    return [(3 * x - y) / 2 for x, y in zip(R, product(*R, *gram(*R)), strict=True)]
