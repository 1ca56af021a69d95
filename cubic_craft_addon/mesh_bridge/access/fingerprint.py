# SPDX-License-Identifier: GPL-3.0-or-later
"""Recognize a shape that we wrote."""

import hashlib

import numpy as np


def fingerprint(positions: np.ndarray) -> str:
    """Hash the bits of a shape.

    `positions`: (n,3) float32. Returns a str of 32 hexadecimal digits; equal only for the same
    number of vertices and the same bits.
    """
    bits = np.ascontiguousarray(positions, np.float32)
    return hashlib.blake2b(bits.data, digest_size=16).hexdigest()


def fingerprint_of_values(positions: np.ndarray) -> str:
    """Hash the values of a shape: `fingerprint`, but -0 is 0.

    Edit Mode turns -0 into 0 in many shape keys, which is not an edit by the artist.
    """
    return fingerprint(positions + np.float32(0))
