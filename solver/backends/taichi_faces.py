# SPDX-License-Identifier: GPL-3.0-or-later
"""The local problem of one vertex on the faces of a polytope, in Taichi, as `Polytopes` in NumPy.

To import this imports the engine. These functions are compiled into the kernels
that call them. `tables` are `FaceTables`, those of all faces.
"""

from ..algebra import axial, cross, dot, outer, product, times, trace, transposed_times, turn
from ..styles.active_set import MAX_STEPS
from ..styles.polytope_step import NEAREST_FACET
from .engine import ti
from .face_tables import NUMBERS
from .taichi_active_set import newton_step, turn_about_axis

MANY = 32
"""vertices of a body; as many are looked at one by one"""


@ti.func
def rotation_on_faces(
    kind: ti.template(), S, normal, Q, cubeness, last, last_state, tables: ti.template()
):
    """Return as `rotation_near`, with the state (4,) in place of s."""
    R, s = last, kind.vec3(last_state[0], last_state[1], last_state[2])
    last_face = ti.cast(last_state[3], ti.i32)
    face = last_face
    G = kind.mat3(ti.static(product(*R, *S)))
    y = kind.vec3(ti.static(times(*R, *normal)))
    x = kind.vec3(ti.static(times(*Q, *y)))
    last_fit = ti.static([trace(*G)])[0]
    last_cost, _ = costliest(kind, x, last_face, tables)
    is_done, is_good = False, True
    step = 0
    while step < MAX_STEPS and is_good and not is_done:
        step += 1
        axis = row(kind, tables.frames[face], 1)
        number = ti.cast(face >= tables.edge_start, ti.i32)
        number += ti.cast(face >= tables.facet_start, ti.i32)
        q, v, is_done, is_good = turn_on_face(kind, G, x, y, s, axis, number, Q, cubeness)
        if is_good:
            scale = 2 / (q * q + ti.static([dot(*v, *v)])[0])
            W = kind.mat3(ti.static(turn(scale, q, *v)))
            R = kind.mat3(ti.static(product(*W, *R)))
            G = kind.mat3(ti.static(product(*W, *G)))
            y = kind.vec3(ti.static(times(*R, *normal)))
            x = kind.vec3(ti.static(times(*Q, *y)))
            if cubeness > 0:
                is_kept = True
                if number == 0:
                    s, face, is_kept = from_vertex(kind, x, s, face, tables)
                else:
                    moment = kind.vec3(ti.static(axial(*G)))
                    aside, along = forces(kind, moment, y, tables.frames[face], Q, cubeness)
                    if number == 1:
                        s, face, is_kept = from_edge(kind, x, along, face, tables)
                    else:
                        s, face, is_kept = from_facet(kind, aside, face, tables)
                is_done = is_done and is_kept
    is_done = is_done and is_good
    fit = ti.static([trace(*G)])[0]
    cost, _ = costliest(kind, x, face, tables)
    if not is_done or cubeness * cost - fit > cubeness * last_cost - last_fit:
        R, fit, cost, face = last, last_fit, last_cost, last_face
        s = kind.vec3(last_state[0], last_state[1], last_state[2])
    return R, kind.vec4(s[0], s[1], s[2], ti.cast(face, kind.real)), fit, cost, is_done


@ti.func
def turn_on_face(kind: ti.template(), G, x, y, s, axis, number, Q, cubeness):
    """Return as `next_turn` a quaternion, whether it may be the last, and whether it is sound."""
    q, v = kind.real(1.0), kind.vec3(0.0)
    is_last, is_good = False, True
    if number == 2:
        t = kind.vec3(ti.static(transposed_times(*Q, *axis)))
        q, v, is_last, is_good = turn_about_axis(kind, G, y, t)
    else:
        pull = kind.vec3(ti.static(transposed_times(*Q, *(s * cubeness))))
        L = G - kind.mat3(ti.static(outer(*y, *pull)))
        p = kind.vec3(ti.static(cross(*y, *transposed_times(*Q, *axis))))
        kappa = number * (ti.abs(ti.static([trace(*L)])[0]) + cubeness)
        w, is_sound = newton_step(kind, L, p, ti.static([dot(*x, *axis)])[0], kappa)
        v = w / 2
        is_small = ti.static([dot(*w, *w)])[0] <= kind.real(kind.tolerances.angle**2)
        is_last, is_good = is_sound and is_small, is_sound or not is_small
    return q, v, is_last, is_good


@ti.func
def forces(kind: ti.template(), moment, y, frame, Q, cubeness):
    """Return how far s lies from the point of its face, in space and along its axis."""
    pull = kind.vec3(ti.static(transposed_times(*Q, *row(kind, frame, 0)))) * cubeness
    force = moment - kind.vec3(ti.static(cross(*y, *pull)))
    p = kind.vec3(ti.static(cross(*y, *transposed_times(*Q, *row(kind, frame, 1)))))
    size = ti.max(ti.static([dot(*p, *p)])[0], kind.real(1e-6))
    along = ti.static([dot(*force, *p)])[0] / (cubeness * size)
    return kind.vec3(ti.static(times(*Q, *cross(*force, *y)))) / cubeness, along


@ti.func
def row(kind: ti.template(), matrix, k: ti.template()):
    """Return a row of a matrix."""
    return kind.vec3(matrix[k, 0], matrix[k, 1], matrix[k, 2])


@ti.func
def costliest(kind: ti.template(), x, face, tables: ti.template()):
    """Return the cost at x, and the vertex of the face's body that has it.

    Of many vertices not all are looked at: from one to a neighbor that costs more leads there.
    """
    frames, numbers = ti.static((tables.frames, tables.numbers))
    best, last = numbers[NUMBERS * face], numbers[NUMBERS * face + 1]
    is_climb = last - best > MANY
    if is_climb:
        best = numbers[NUMBERS * face + 4]
    cost = row(kind, frames[best], 0).dot(x)
    if is_climb:
        present = -1
        while present != best:
            present = best
            for link in range(numbers[NUMBERS * present + 2], numbers[NUMBERS * present + 3]):
                edge = NUMBERS * tables.targets[link]
                vertex = numbers[edge + 4] + numbers[edge + 5] - present
                other = row(kind, frames[vertex], 0).dot(x)
                if other > cost:
                    best, cost = vertex, other
    else:
        for vertex in range(best + 1, last):
            other = row(kind, frames[vertex], 0).dot(x)
            if other > cost:
                best, cost = vertex, other
    return cost, best


@ti.func
def from_vertex(kind: ti.template(), x, s, face, tables: ti.template()):
    """Return s, its face, and whether it may stay: at the vertex that costs most."""
    frames, numbers = ti.static((tables.frames, tables.numbers))
    _, best = costliest(kind, x, face, tables)
    way = row(kind, frames[best], 0) - row(kind, frames[face], 0)
    is_kept = way.dot(x) <= kind.real(kind.tolerances.slack) * way.norm()
    if not is_kept:
        number = NUMBERS * face
        face = tables.between[numbers[number + 6] + best - numbers[number]]
        is_facet = face >= tables.facet_start
        if is_facet and row(kind, frames[face], 1).dot(x) < kind.real(NEAREST_FACET):
            face = best
        if face < tables.edge_start:
            s = row(kind, frames[face], 0)
    return s, face, is_kept


@ti.func
def from_edge(kind: ti.template(), x, along, face, tables: ti.template()):
    """Return as `from_vertex`: on the edge, or at an end of it, or on a facet that x has passed."""
    numbers, ways = ti.static((tables.numbers, tables.ways))
    slack = kind.real(kind.tolerances.slack)
    frame = tables.frames[face]
    length = frame[2, 0]
    is_kept = along >= -slack and along <= length + slack
    within = ti.min(ti.max(along, kind.real(0.0)), length)
    s = row(kind, frame, 0) + within * row(kind, frame, 1)
    number = NUMBERS * face
    if along < 0:
        face = numbers[number + 4]
    elif along > length:
        face = numbers[number + 5]
    else:
        link = numbers[number + 2]
        first, second = ways[link].dot(x), ways[link + 1].dot(x)
        if second > first:
            first, link = second, link + 1
        if first > slack:
            face, is_kept = tables.targets[link], False
    return s, face, is_kept


@ti.func
def from_facet(kind: ti.template(), aside, face, tables: ti.template()):
    """Return as `from_vertex`: on the facet, or where it is left, on its boundary."""
    frames, numbers, targets = ti.static((tables.frames, tables.numbers, tables.targets))
    frame = frames[face]
    axis = row(kind, frame, 1)
    s = row(kind, frame, 0) + aside - aside.dot(axis) * axis
    least, edge = kind.real(0.0), -1
    for link in range(numbers[NUMBERS * face + 2], numbers[NUMBERS * face + 3]):
        inside = (s - row(kind, frames[targets[link]], 0)).dot(tables.ways[link])
        if inside < least:
            least, edge = inside, targets[link]
    if edge >= 0:
        frame = frames[edge]
        axis, length = row(kind, frame, 1), frame[2, 0]
        along = (s - row(kind, frame, 0)).dot(axis)
        face = edge
        if along <= 0:
            face = numbers[NUMBERS * edge + 4]
        elif along >= length:
            face = numbers[NUMBERS * edge + 5]
        s = row(kind, frame, 0) + ti.min(ti.max(along, kind.real(0.0)), length) * axis
    return s, face, least >= -kind.real(kind.tolerances.slack)
