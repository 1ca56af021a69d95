# SPDX-License-Identifier: GPL-3.0-or-later
"""Algebra of 3-vectors and 3x3 matrices, written out on their entries while a kernel is compiled.

These are plain Python functions of scalars, of any type with arithmetic. In a kernel they are
called inside ``ti.static`` with unpacked operands, as in ``mat3(ti.static(product(*A, *B)))``, and
build the expressions directly. Matrices are given and returned as their nine entries, row by row,
and scalars are returned as a list of one, because ``ti.static`` lets no bare expression through.
An operand that is no variable is computed anew for each of its entries, until the compiler finds
that these are the same.
"""


def dot(*entries):
    """Return the scalar product of two vectors, as a list of one."""
    return [_dot(*entries)]


def total(a, b, c):
    """Return the sum of the entries of a vector, as a list of one."""
    return [a + b + c]


def trace(a, b, c, d, e, f, g, h, i):
    """Return the trace of a matrix, as a list of one."""
    return total(a, e, i)


def axial(a, b, c, d, e, f, g, h, i):
    """Return the axial vector of a matrix: (A23 - A32, A31 - A13, A12 - A21)."""
    return [f - h, g - c, b - d]


def cross(a, b, c, x, y, z):
    """Return the vector product of two vectors."""
    return [b * z - c * y, c * x - a * z, a * y - b * x]


def outer(a, b, c, x, y, z):
    """Return the matrix of the products of all entries of two vectors."""
    return [row * column for row in (a, b, c) for column in (x, y, z)]


def times(a, b, c, d, e, f, g, h, i, x, y, z):
    """Return the matrix applied to the vector."""
    return [_dot(*row, x, y, z) for row in ((a, b, c), (d, e, f), (g, h, i))]


def transposed_times(a, b, c, d, e, f, g, h, i, x, y, z):
    """Return the transposed matrix applied to the vector."""
    return times(a, d, g, b, e, h, c, f, i, x, y, z)


def product(*entries):
    """Return the product of two matrices."""
    A, B = entries[:9], entries[9:]
    return [_dot(*A[3 * i : 3 * i + 3], *B[j::3]) for i in range(3) for j in range(3)]


def gram(*A):
    """Return the scalar products of the columns of a matrix."""
    return [_dot(*A[i::3], *A[j::3]) for i in range(3) for j in range(3)]


def turn(s, q, x, y, z):
    """Return the rotation of the quaternion (q, x, y, z), with s = 2 / (its square)."""
    return [
        *(1 - s * (y * y + z * z), s * (x * y - z * q), s * (x * z + y * q)),
        *(s * (x * y + z * q), 1 - s * (x * x + z * z), s * (y * z - x * q)),
        *(s * (x * z - y * q), s * (y * z + x * q), 1 - s * (x * x + y * y)),
    ]


def _dot(a, b, c, x, y, z):
    return a * x + b * y + c * z
