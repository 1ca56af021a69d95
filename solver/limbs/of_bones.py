# SPDX-License-Identifier: GPL-3.0-or-later
"""Take limbs from the bones that move them, and from the weights with which they do.

Not every bone is in a limb: those of a spine lie in a trunk that is about as wide as they are long.
Bones that go on from each other are measured together, as a tail may have many short ones, beside
the width of the vertices that they move.
"""

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike

from ..algebra import smoothstep
from ..aliases import FloatArray, IntArray
from ..inputs import vectors
from .limbs import KnownLimbs
from .turns import smallest_turns

NONE, FULL = 1.4, 2.1
"""lengths, in widths: below is no limb, above is one in full"""
STRAIGHT = np.cos(np.radians(25.0))
"""between bones that are measured together"""
ALIKE = 1.7
"""largest ratio of their widths, from the one nearer to the trunk to the next,..."""
WIDER = 1.1
"""...and the other way, as a head on a neck is not measured with it"""
THICKER = 1.6
"""largest ratio of the width of a hand to that of its arm; thicker is a head on its neck"""
BENT = np.cos(np.radians(45.0))
"""between a shin and its foot, which stands on the ground and keeps the frame of the object,..."""
SHORT = 0.6
"""...and of their lengths"""
GOES_ON = np.cos(np.radians(60.0))
"""between bones of which the next has the frame of the one before, carried along,..."""
LEVEL = np.cos(np.radians(15.0))
"""...or as it is, as a hand has that of its arm: bones of hands are rarely straight"""
ACROSS, MUCH = 1.3, 1.2
"""ratios of widths: from the first on, the last bone lies across what it moves; up to the second, a
way to the next bone is as good as another"""
NEAR = 0.25
"""of the length of a bone: where the next one begins if it goes on from there"""
_MAIN = 0.5  # weight of the vertices that a bone is measured by...
_FEWEST = 4  # ...unless there are fewer of them
_LEAST = 1e-6  # sum of weights


class _Measured(NamedTuple):
    """Of b bones; those that move nothing, or have no length, have the length and width 0."""

    directions: FloatArray
    """(b,3)"""
    lengths: FloatArray
    """(b,)"""
    widths: FloatArray
    """(b,) of a round limb, its diameter"""
    parents: IntArray
    """(b,) the nearest one that is measured, or -1"""


def limbs_of_bones(
    V: ArrayLike, weights: sp.csr_matrix, heads: ArrayLike, tails: ArrayLike, parents: ArrayLike
) -> KnownLimbs:
    """Return the KnownLimbs of a mesh, one piece for each bone.

    `V`: (n,3), rest positions. `weights`: (n,b) scipy csr_matrix, how much each bone moves each
    vertex, not normalized. `heads`, `tails`: (b,3), ends of the bones in the same coordinates and
    in the rest pose. `parents`: (b,) int, -1 for none. Limbs are known where a bone moves a vertex;
    bones outside limbs have no shares.

    Examples
    --------
    >>> import numpy as np
    >>> from scipy.sparse import csr_matrix
    >>> from solver.limbs import limbs_of_bones
    >>> angles, heights = np.meshgrid(np.arange(8) * np.pi / 4, [0.0, 1.0, 2.0, 3.0])
    >>> V = 0.3 * np.stack([np.cos(angles), np.sin(angles), heights / 0.3], axis=2).reshape(-1, 3)
    >>> weights = csr_matrix(np.ones((len(V), 1)))
    >>> limbs = limbs_of_bones(V, weights, np.zeros((1, 3)), np.array([[0.0, 0, 3]]), [-1])
    >>> limbs.directions, int(limbs.shares.sum()), len(V)
    (array([[0., 0., 1.]]), 32, 32)
    """
    weights = _usable(weights)
    total = np.asarray(weights.sum(axis=1)).ravel()
    known = total > _LEAST
    shares = sp.diags(np.where(known, 1.0, 0.0) / np.where(known, total, 1.0)) @ weights
    bones = _measured(vectors(V, "positions"), weights, heads, tails, parents)
    confidence, end_of, is_foot = _confidence(bones)
    shares = sp.csr_matrix(shares @ sp.diags(confidence))
    # a limb ends where most of a vertex belongs to the trunk, or its weights would skew that
    total = np.asarray(shares.sum(axis=1)).ravel()
    shares = sp.csr_matrix(sp.diags(total * (3.0 - 2.0 * total)) @ shares)
    shares.eliminate_zeros()
    directions, carried = _frames(bones, confidence, end_of)
    directions[is_foot] = 0.0
    carried[is_foot] = np.eye(3)
    return KnownLimbs(directions, shares, known, carried=carried)


def _usable(weights):
    weights = sp.csr_matrix(weights, dtype=np.float64, copy=True)
    is_good = np.isfinite(weights.data) & (weights.data > 0.0)
    weights.data[~is_good] = 0.0
    weights.eliminate_zeros()
    return weights


def _measured(V, weights, heads, tails, parents):
    count, means, spread = _spreads(V, weights)
    heads, tails = (vectors(ends, "the ends of bones") for ends in (heads, tails))
    along = tails - heads
    is_there = (count > 0) & np.isfinite(along).all(axis=1)
    parents = _nearest_there(np.asarray(parents), is_there)
    is_there &= (along != 0.0).any(axis=1)
    along = _onward(along, heads, parents, means, spread, is_there)
    lengths = np.where(is_there, np.linalg.norm(along, axis=1), 0.0)
    is_there &= lengths > 0.0
    parents = np.where(is_there, _nearest_there(parents, is_there), -1)
    directions = np.where(is_there[:, None], along, [0.0, 0.0, 1.0])
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    widths = np.where(is_there, _widths(spread, directions), 0.0)
    return _Measured(directions, lengths, widths, parents)


def _spreads(V, weights):
    """Return how many vertices each bone moves (b,), their means (b,3) and covariances (b,3,3)."""
    main = weights.copy()
    main.data[main.data <= _MAIN] = 0.0
    is_few = np.asarray((main > 0).sum(axis=0)).ravel() < _FEWEST
    main = sp.csr_matrix(main @ sp.diags(np.where(is_few, 0.0, 1.0)))
    main = main + weights @ sp.diags(np.where(is_few, 1.0, 0.0))
    count = np.asarray((main > 0).sum(axis=0)).ravel()
    total = np.asarray(main.sum(axis=0)).ravel()
    total = np.where(count > 0, total, 1.0)[:, None]
    middle = V.mean(axis=0)
    V = V - middle
    mean = main.T @ V / total
    products = main.T @ (V[:, :, None] * V[:, None, :]).reshape(-1, 9) / total
    spread = products.reshape(-1, 3, 3) - mean[:, :, None] * mean[:, None, :]
    return count, mean + middle, spread


def _nearest_there(parents, is_there):
    """Return the nearest ancestor (b,) of each bone that is there, or -1."""
    found = np.full(len(parents), -1)
    for bone in range(len(parents)):
        ancestor, steps = parents[bone], 0
        while ancestor >= 0 and not is_there[ancestor] and steps < len(parents):
            ancestor, steps = parents[ancestor], steps + 1
        found[bone] = ancestor if steps < len(parents) else -1
    return found


def _onward(along, heads, parents, means, spread, is_there):
    """Return the vectors (b,3) along the bones, or along what they move.

    Of rigs from other programs, all bones may point up, or across what they move. Then one goes to
    the head of the next, the farthest of several, as a twist bone begins in between. The last goes
    through the middle of its vertices, or on, as the one before it.
    """
    given, along = along, along.copy()
    for bone in _from_the_root(parents):
        if not is_there[bone]:
            continue
        length, ways = np.linalg.norm(given[bone]), heads[(parents == bone) & is_there]
        ways, is_last = ways - heads[bone], not len(ways)
        worst = MUCH
        if is_last:
            parent = parents[bone]
            is_doubted = parent >= 0 and (along[parent] != given[parent]).any()
            ways = _ways_of_last(bone, along, heads, parent, means, spread)
            worst = 1.0 if is_doubted else 1.0 / ACROSS
        elif np.linalg.norm(ways - given[bone], axis=1).min() < NEAR * length:
            continue  # the next one begins where it ends
        sizes = np.linalg.norm(ways, axis=1)
        ways, sizes = ways[sizes > NEAR * length], sizes[sizes > NEAR * length]
        if not len(ways):
            continue
        widths = _widths(np.repeat(spread[[bone]], len(ways), axis=0), ways)
        if widths.min() > worst * _widths(spread[[bone]], given[[bone]])[0]:
            continue
        if is_last:
            along[bone] = ways[widths.argmin()]
            continue
        sizes = np.where(widths < MUCH * widths.min(), sizes, 0.0)
        is_along = np.abs(ways @ given[bone]) > STRAIGHT * sizes * length
        sizes[~is_along] *= not is_along[sizes > 0.0].any()
        along[bone] = ways[sizes.argmax()]
    return along


def _ways_of_last(bone, along, heads, parent, means, spread):
    """Return the ways (k,3) that a bone may go which none follows."""
    ways = [2.0 * (means[bone] - heads[bone])]
    if parent >= 0:
        before = along[parent] / np.linalg.norm(along[parent])
        ways.append(before * np.sqrt(12.0 * max(before @ spread[bone] @ before, 0.0)))
    return np.array(ways)


def _widths(spread, along):
    """Return the diameters (k,) of round limbs along vectors, of vertices with covariances."""
    directions = along / np.linalg.norm(along, axis=1, keepdims=True)
    across = np.eye(3) - directions[:, :, None] * directions[:, None, :]
    return np.sqrt(8.0 * np.maximum(np.linalg.eigvalsh(across @ spread @ across)[:, 2], 0.0))


def _confidence(bones):
    """Return how much of a limb each bone is in (b,), and which are at the end of one.

    The latter as the bone (b,) at whose end each is, or -1, and as which are in a foot (b,).
    """
    following = _following(bones)
    total = _total_lengths(bones, following)
    ratio = total / np.where(bones.widths > 0.0, bones.widths, np.inf)
    own = smoothstep(ratio, NONE, FULL)
    confidence, end_of = own.copy(), np.full(len(own), -1)
    is_foot = np.zeros(len(own), dtype=bool)
    for bone in _from_the_root(bones.parents):
        parent = bones.parents[bone]
        if parent < 0:
            continue
        is_foot[bone] = _is_foot(bone, bones, own, total)
        is_part = is_foot[bone] or (
            confidence[parent] > own[bone]
            and bones.widths[bone] <= THICKER * bones.widths[parent]
            and bones.directions[bone] @ bones.directions[parent] > GOES_ON
            and _is_end(bone, bones)
        )
        if is_part:
            confidence[bone], end_of[bone] = confidence[parent], parent
    return confidence, end_of, is_foot


def _frames(bones, confidence, end_of):
    """Return the directions (b,3) that frames are found from, and what carries them (b,3,3).

    Along a limb, they are those of its first bone, carried by the smallest turns from each bone to
    the next: found one by one, they would twist a limb where its nearest axis changes. A hand that
    goes straight on has the frame of its arm.
    """
    directions, carried = bones.directions.copy(), np.tile(np.eye(3), (len(confidence), 1, 1))
    for bone in _from_the_root(bones.parents):
        parent = bones.parents[bone]
        if parent < 0 or min(confidence[bone], confidence[parent]) <= 0.0:
            continue
        one, other = bones.directions[[parent]], bones.directions[[bone]]
        cosine = (one * other).sum()
        if cosine > GOES_ON:
            is_straight = end_of[bone] >= 0 and cosine > LEVEL
            turn = np.eye(3) if is_straight else smallest_turns(one, other)[0]
            directions[bone], carried[bone] = directions[parent], turn @ carried[parent]
    return directions, carried


def _following(bones):
    """Return the child (b,) that each bone is measured with, or -1."""
    found = np.full(len(bones.parents), -1)
    best = np.full(len(found), STRAIGHT)
    is_fork = np.zeros(len(found), dtype=bool)
    for bone, parent in enumerate(bones.parents):
        if parent < 0 or bones.widths[bone] == 0.0:
            continue
        ratio = bones.widths[parent] / bones.widths[bone]
        cosine = bones.directions[bone] @ bones.directions[parent]
        if not (1.0 / WIDER <= ratio <= ALIKE and cosine > STRAIGHT):
            continue
        is_fork[parent] = found[parent] >= 0 and abs(cosine - best[parent]) < 1e-3
        if cosine > best[parent]:
            best[parent], found[parent] = cosine, bone
    found[is_fork] = -1  # neither of two that are mirror images
    return found


def _total_lengths(bones, following):
    """Return the length (b,) of the bones that each is measured with."""
    total = np.zeros(len(following))
    is_first = np.ones(len(following), dtype=bool)
    is_first[following[following >= 0]] = False
    for bone in np.flatnonzero(is_first):
        chain = [bone]
        while following[chain[-1]] >= 0:
            chain.append(following[chain[-1]])
        total[chain] = bones.lengths[chain].sum()
    return total


def _from_the_root(parents):
    """Return the bones (b,), parents before children."""
    depth = np.zeros(len(parents), dtype=int)
    for bone in range(len(parents)):
        ancestor = parents[bone]
        while ancestor >= 0 and depth[bone] <= len(parents):
            ancestor, depth[bone] = parents[ancestor], depth[bone] + 1
    return np.argsort(depth, kind="stable")


def _is_end(bone, bones):
    children = np.flatnonzero(bones.parents == bone)
    return (bones.widths[children] < bones.widths[bone]).all()


def _is_foot(bone, bones, own, total):
    """Return whether a bone is the first of a foot, or follows such a one."""
    while bones.parents[bone] >= 0:
        parent = bones.parents[bone]
        siblings = np.flatnonzero(bones.parents == parent)
        if len(siblings) > 1:
            return False
        if bones.directions[bone] @ bones.directions[parent] < BENT:
            return bool(own[parent] > 0.0 and total[bone] < SHORT * total[parent])
        bone = parent
    return False
