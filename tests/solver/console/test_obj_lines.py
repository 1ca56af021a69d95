# SPDX-License-Identifier: GPL-3.0-or-later
"""Which lines of an .obj file belong together, and which vertices its corners name."""

import pytest

from solver.console.obj_lines import logical_lines, vertex_of


@pytest.mark.parametrize(
    ("lines", "joined"),
    [
        ([b"v 1 2 \\", b"  3", b"f 1"], [b"v 1 2    3", b"f 1"]),
        ([b"f 1 \\", b"2 \\", b"3"], [b"f 1  2  3"]),
        ([b"f 1 2 3 \\"], [b"f 1 2 3  "]),
        ([b"v 1 2 3 # C:\\", b"f 1"], [b"v 1 2 3 # C:\\", b"f 1"]),
        ([b"# C:\\", b"v 1"], [b"# C:\\", b"v 1"]),
        ([b"usemtl parts\\", b"f 1"], [b"usemtl parts\\", b"f 1"]),
        (["o 表".encode("shift_jis"), b"v 1"], ["o 表".encode("shift_jis"), b"v 1"]),
        ([b"", b"\\", b"v 1"], [b"", b" v 1"]),
    ],
)
def test_numbers_are_continued_names_and_comments_are_not(lines, joined):
    assert list(logical_lines(lines)) == joined


def test_vertices_of_corners():
    corners = [b"1", b"4/2/3", b"4//3", b"-1/2", b"-4"]
    assert [vertex_of(corner, 4) for corner in corners] == [0, 3, 3, 3, 0]
    for corner in (b"0", b"-5", b"-9/1"):
        assert vertex_of(corner, 4) < 0
    assert vertex_of(b"5", 4) >= 4
    for corner in (b"", b"x", b"/1", b"1.5"):
        with pytest.raises(ValueError):
            vertex_of(corner, 4)
