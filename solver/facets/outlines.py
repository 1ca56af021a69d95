# SPDX-License-Identifier: GPL-3.0-or-later
"""The borders of the parts of a surface, with few vertices.

Borders of two parts are chains of edges between vertices where they meet others. A chain keeps its
ends, and of its inner vertices those without which it would leave its course (Douglas and Peucker,
"Algorithms for the Reduction of the Number of Points", 1973). Both parts keep the same ones, so no
gap opens.
"""

from collections import Counter
from itertools import pairwise

import numpy as np

from ..mesh.edges import Edges

MOST_LEFT = 3.0
_FEWEST = 3  # corners of a loop


class Outlines:
    """The borders of parts.

    `P`: (n,3), where the vertices go that are kept. `F`: (m,3) int. `part`: (m,) int. `facing`:
    (k,3), the unit normal of the plane of each part. `course`: (k,), how far a chain may leave its
    course, where planes meet at a right angle; the flatter they meet, the farther, up to
    `MOST_LEFT` times, since the shape changes the less.

    `loops`: dict of int to list of lists of int, of each part the vertices around it and around its
    holes, counterclockwise and clockwise.
    """

    def __init__(self, P, F, part, facing, course):
        self._P, self._F, self._part = P, F, part
        self._find_border(Edges(F, len(P)))
        dense = self._dense_loops()
        self._chains = self._find_chains()
        courses = self._courses(facing, course)
        self._kept = [
            self._simplified(chain, one) for chain, one in zip(self._chains, courses, strict=True)
        ]
        self._keep_distinct()
        self._keep_open(dense)
        self.loops = {}
        anchors = self._anchors()
        for number, loop in dense:
            self.loops.setdefault(number, []).append([v for v in loop if v in anchors])

    def _find_border(self, edges):
        F, m = self._F, len(self._F)
        number = edges.number[[2, 0, 1]].T.ravel()  # of the half-edge from each corner to the next
        backward = edges.is_backward[[2, 0, 1]].T.ravel()
        order = np.argsort(number, kind="stable")
        count = np.bincount(number)
        is_pair = count[number[order[:-1]]] == 2
        is_pair &= number[order[:-1]] == number[order[1:]]
        one, other = order[:-1][is_pair], order[1:][is_pair]
        is_inner = self._part[one // 3] == self._part[other // 3]
        is_inner &= backward[one] != backward[other]
        one, other = one[is_inner], other[is_inner]
        self._opposite = np.full(3 * m, -1)
        self._opposite[one], self._opposite[other] = other, one
        self._border = np.flatnonzero(self._opposite < 0)
        used = np.unique(number[self._border])
        self._edges = np.stack([edges.lower[used], edges.upper[used]], axis=1)
        self._start = F.ravel()

    def _dense_loops(self):
        """Return pairs of a part and the vertices of a loop around it."""
        follows, opposite = {}, self._opposite
        for h in self._border.tolist():
            n = h - 2 if h % 3 == 2 else h + 1
            while opposite[n] >= 0:
                n = opposite[n]
                n = n - 2 if n % 3 == 2 else n + 1
            follows[h] = int(n)
        found = []
        while follows:
            first, h = next(iter(follows.items()))
            loop = [first]
            del follows[first]
            while h != first:
                loop.append(h)
                h = follows.pop(h)
            found.append((int(self._part[first // 3]), self._start[loop].tolist()))
        return found

    def _find_chains(self):
        near = {}
        for a, b in self._edges.tolist():
            near.setdefault(a, []).append(b)
            near.setdefault(b, []).append(a)
        ends = [v for v, others in near.items() if len(others) != 2]
        done, chains = set(), []
        for start in [*ends, *near]:
            for step in near[start]:
                if (start, step) in done:
                    continue
                chain = [start, step]
                while len(near[chain[-1]]) == 2 and chain[-1] != start:
                    a, b = near[chain[-1]]
                    chain.append(b if a == chain[-2] else a)
                done.update(pairwise(chain))
                done.update(pairwise(chain[::-1]))
                chains.append(chain)
        return chains

    def _courses(self, facing, course):
        parts = {}
        ends = self._F[:, [1, 2, 0]].ravel()
        for h in self._border.tolist():
            pair = frozenset((int(self._start[h]), int(ends[h])))
            parts.setdefault(pair, []).append(int(self._part[h // 3]))
        found = []
        for chain in self._chains:
            beside = parts[frozenset(chain[:2])]
            cosine = facing[beside[0]] @ facing[beside[-1]] if len(beside) == 2 else 0.0
            sine = np.sqrt(max(0.0, 1.0 - cosine**2)) if cosine > 0.0 else 1.0
            found.append(min(course[p] for p in beside) / max(sine, 1.0 / MOST_LEFT))
        return found

    def _simplified(self, chain, course):
        kept, open_spans = [0, len(chain) - 1], [(0, len(chain) - 1)]
        while open_spans:
            a, b = open_spans.pop()
            at, off = self._farthest(chain, a, b)
            if at is not None and off > course:
                kept.append(at)
                open_spans += [(a, at), (at, b)]
        return sorted(kept)

    def _farthest(self, chain, a, b):
        """Return the entry between two that is farthest from the line through them, and how far."""
        if b - a < 2:
            return None, -1.0
        P = self._P[chain[a : b + 1]]
        along, away = P[-1] - P[0], P[1:-1] - P[0]
        squared = along @ along
        if squared > 0.0:
            t = np.clip(away @ along / squared, 0.0, 1.0)
            away = away - t[:, None] * along
        off = np.linalg.norm(away, axis=1)
        middle = (len(off) - 1) / 2  # of several, the one in the middle
        at = np.lexsort((np.abs(np.arange(len(off)) - middle), -off))[0]
        return a + 1 + int(at), float(off[at])

    def _keep_distinct(self):
        """Keep more vertices where two chains would be the same segment, or one a point."""
        while True:
            spans = [
                (number, a, b) for number, kept in enumerate(self._kept) for a, b in pairwise(kept)
            ]
            ends = [tuple(sorted((self._chains[n][a], self._chains[n][b]))) for n, a, b in spans]
            times = Counter(ends)
            more = [
                span
                for span, pair in zip(spans, ends, strict=True)
                if times[pair] > 1 or pair[0] == pair[1]
            ]
            if not self._kept_more(more):
                return

    def _kept_more(self, spans):
        found = False
        for number, a, b in spans:
            at, _ = self._farthest(self._chains[number], a, b)
            if at is not None:
                self._kept[number] = sorted({*self._kept[number], at})
                found = True
        return found

    def _keep_open(self, dense):
        anchors = self._anchors()
        at = {v: (n, i) for n, chain in enumerate(self._chains) for i, v in enumerate(chain)}
        for _, loop in dense:
            while len({v for v in loop if v in anchors}) < min(_FEWEST, len(set(loop))):
                n, i = at[next(v for v in loop if v not in anchors)]
                self._kept[n] = sorted({*self._kept[n], i})
                anchors.add(self._chains[n][i])

    def _anchors(self):
        pairs = zip(self._chains, self._kept, strict=True)
        return {chain[i] for chain, kept in pairs for i in kept}
