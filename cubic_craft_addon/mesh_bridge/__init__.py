# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that reads or writes mesh data-blocks.

Only positions are ever written, the ``position`` attribute and the points of shape keys, and free
normals, which point somewhere in object space; and sharp edges of a crisp shape, on a mesh that has
none of its own (see `sharp_edges`).
Besides them, the bridge keeps its own attributes and one custom property on the mesh (see `note`),
which Restore and Apply remove without a trace (a first original is removed by Apply and *Restore
First*).
"""

from .access.any_mode import copied, flush, glance, in_no_mode, remove_copy
from .access.arrays import corner_vertices, read_position, read_values
from .access.attributes import carried_attributes
from .access.checks import (
    check_editable,
    check_relative_keys,
    check_usable,
    is_linked,
    mesh_of,
    why_no_mesh,
)
from .access.dress import dress_of
from .access.group_names import set_groups_aside
from .access.note import LastRun, last_run
from .access.sharp_edges import (
    are_wanted,
    only_shades,
    rounds,
)
from .access.triangulation import (
    faces_of_triangles,
    read_evaluated,
    read_evaluated_points,
    read_selected_faces,
    triangles,
)
from .access.vertex_groups import group_weights, vertex_group, weights_of_groups
from .memory.cubic_key import find_cubic_key
from .memory.first_original import has_first
from .memory.original import (
    Start,
    has_original,
    has_strokes,
    is_edited,
    is_lost,
    original_positions,
    read_positions,
    starts_here,
)
from .memory.strokes import moved_as_a_whole, offsets_by_hand
from .preview.preview import Preview
from .preview.store import end_all_previews, end_preview, has_preview
from .result.charts import charts
from .result.cover import Look, cover_problem, covers, distance, is_still
from .result.new_object import (
    KINDS,
    as_seen,
    link_beside,
    make_seen,
    move_vertices,
    plain_copy,
    select_instead,
    show_beside,
    write_new_object,
    write_seen,
)
from .result.ngons import Polygons, rebuild, write_ngons
from .result.restore import discard_original, has_traces, restore, restore_first
from .result.results import (
    keep_preview,
    noted_outcome,
    positions_with_strokes,
    result_positions,
    write_mesh,
    write_reshaped,
    write_shape_key,
)
from .result.rollback import after_errors, carry_result, mesh_untouched
from .result.shading import shade_edges, shade_shape
from .result.transferred_keys import key_offsets, places_on, shares_of, transfer_keys
