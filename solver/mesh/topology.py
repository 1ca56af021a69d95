# SPDX-License-Identifier: GPL-3.0-or-later
"""How the vertices of a mesh are connected, regardless of their positions."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from ..aliases import IntArray
from ..values import Value
from .components import components

_CHUNK = 256
_GROUP = 32


@dataclass(frozen=True, eq=False, repr=False)
class Topology(Value):
    """Vertices that share triangles or links, by components.

    It is the same for a deformed mesh, and for all frames of an animation.
    """

    F: IntArray
    """(m,3) int32 triangles"""
    part: IntArray
    """(n,) int connected part of each vertex, without links"""
    component_count: int
    component: IntArray
    """(n,) int component of each vertex: linked parts are one component"""

    def linked(self, pairs):
        """Return the Topology with further pairs (p,2) of vertices connected."""
        if not len(pairs):
            return self
        count, of_part = components(self.part[pairs], int(self.part.max()) + 1)
        return Topology(self.F, self.part, count, of_part[self.part])

    @cached_property
    def chunks(self):
        """Up to 256 consecutive vertices of one component each, for parallel sums.

        (k+1,) int32 start of each, and (k,) int32 component of each.
        """
        return _runs(self.component, _CHUNK)

    @cached_property
    def groups(self):
        """Up to 32 consecutive `chunks` of one component each, so that there are few sums.

        (k+1,) int32 start of each, and (k,) int32 component of each.
        """
        return _runs(self.chunks[1], _GROUP)

    @cached_property
    def largest_component(self):
        """Number of vertices of the largest component, which determines the difficulty."""
        return int(np.bincount(self.component).max())

    def sum_parts(self, values):
        """Sum values (n,) or (n,k) over each component, to (component_count,) or with k columns."""
        if self.component_count == 1:
            return values.sum(axis=0, keepdims=True)
        if values.ndim == 2:
            return np.stack([self._sums(column) for column in values.T], axis=1)
        return self._sums(values)

    def means(self, vectors, weights):
        """Return the mean (n,3) of vectors (n,3), by weights (n,), of each vertex's component."""
        weights = weights + 1e-300  # a component without any has a mean as well
        total = self._sums(weights)
        means = [self._sums(weights * column) / total for column in vectors.T]
        return np.stack(means, axis=1)[self.component]

    def shares(self, weights):
        """Return the share (n,) of each vertex in its component, by positive weights (n,)."""
        return weights / self.sum_parts(weights)[self.component]

    def by_component(self, values):
        """Return values (n,k) as a csr_matrix (n, k component_count), for products by component.

        The row of a vertex has its values in the columns of its component: times
        (k component_count, q) it is what each vertex gets of the small matrix (k,q) of its
        component, and its transpose times (n,q) is the sum over each component.
        """
        n, k = values.shape
        column = (k * self.component[:, None] + np.arange(k)).astype(np.int32).ravel()
        start = np.arange(0, n * k + 1, k, dtype=np.int32)
        shape = n, k * self.component_count
        return sp.csr_matrix((np.ascontiguousarray(values).ravel(), column, start), shape=shape)

    def _sums(self, values):
        return np.bincount(self.component, values, self.component_count)


def _runs(labels, length):
    """Return where up to `length` equal labels begin, where the last end, and the labels."""
    is_start = np.zeros(len(labels), dtype=bool)
    is_start[::length] = True
    is_start[1:] |= labels[1:] != labels[:-1]
    start = np.flatnonzero(is_start)
    return np.append(start, len(labels)).astype(np.int32), labels[start].astype(np.int32)


def topology(F, count):
    """Return the Topology of triangles F (m,3) of `count` vertices, without links."""
    part_count, part = components(F, count)
    return Topology(F, part, part_count, part)
