# SPDX-License-Identifier: GPL-3.0-or-later
"""Licences, copyrights and the bill of materials of what is bundled."""

import io
import json
from dataclasses import replace

import pytest
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
from made_up import PACKAGE, good_wheels, sha256, wheel

from scripts.package.bom import bill_of_materials
from scripts.package.inside import check_inside, libraries_inside
from scripts.package.third_party import copyright_lines, credit, write_third_party
from scripts.package.wheel import Wheel

MANIFEST = {
    "id": "cubic_craft",
    "version": "1.2.3",
    "maintainer": "Somebody",
    "license": ["SPDX:GPL-3.0-or-later"],
}


def read(name, content):
    return Wheel.read(name, io.BytesIO(content))


@pytest.fixture
def wheels():
    return [read(*item) for item in good_wheels().items()]


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("Copyright (c) 2010 Jo Doe", "2010 Jo Doe"),
        ("  Copyright 2001-2003, Doe, Inc.", "2001-2003 Doe, Inc."),
        (" * copyright (C) 2001, 2004 by Doe <doe@example.org>.", "2001-2004 Doe"),
        ("Copyright © 2020 Doe and\n            Son. All rights reserved.", "2020 Doe and Son"),
    ],
)
def test_copyright_in_the_form_of_the_manifest(line, expected):
    assert copyright_lines(f"A licence\n\n{line}\n\nAll copyright is 2000 words.\n") == [expected]


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        (["License-Expression: MIT OR Apache-2.0"], "MIT OR Apache-2.0"),
        (["License: bsd-3-clause"], "BSD-3-Clause"),
        (["License: read it", "Classifier: License :: OSI Approved :: MIT License"], "MIT"),
        (["Classifier: License :: OSI Approved :: BSD License"], "BSD-2-Clause"),
    ],
)
def test_the_licence_as_an_expression(fields, expected):
    assert credit(read(*wheel("deep", "py3-none-any", fields=fields))).licence == expected


def test_an_unknown_licence_is_an_error():
    with pytest.raises(ValueError, match="licence of deep"):
        credit(read(*wheel("deep", "py3-none-any", fields=["License: mine"])))


def test_the_list_and_the_texts(tmp_path, wheels):
    write_third_party(tmp_path, wheels)
    page = (tmp_path / "THIRD_PARTY.md").read_text()
    for name in ("fast", "plain", "deep"):
        assert page.count(f"## {name} 1.0") == 1
        assert "The Makers" in (tmp_path / "licences" / name / "LICENSE").read_text()
    assert page.count("- Copyright 2020-2026 The Makers") == 3


def test_libraries_inside_a_wheel_are_credited(tmp_path):
    """By the name of a file, or by what stands in machine code."""
    code = {"deep/lib/libMoltenVK.dylib": "", "deep/core.pyd": "LLVM ERROR: no N5Eigen here"}
    name, content = wheel("deep", "py3-none-any", files={**code, "deep/a.py": "glfwInit()"})
    (tmp_path / name).write_bytes(content)
    assert libraries_inside(io.BytesIO(content)) == {"MoltenVK", "LLVM", "Eigen"}
    known = credit(read(name, content))
    with pytest.raises(ValueError, match="has Eigen, LLVM, MoltenVK inside"):
        check_inside(tmp_path / name, [known])
    complete = replace(known, inside=["MoltenVK, Eigen (MPL-2.0)", "llvm (Apache-2.0)"])
    check_inside(tmp_path / name, [complete])


def test_what_has_terms_of_its_own_brings_their_text():
    files = ["deep/slim_libdevice.10.bc"]
    with_terms = credit(read(*wheel("deep", "py3-none-any", files=files)))
    assert "libdevice.10.bc" in with_terms.texts["NVIDIA_CUDA_TOOLKIT.txt"]
    assert with_terms.copyrights == ["2020-2026 The Makers"], "not those of the added text"
    assert set(credit(read(*wheel("deep", "py3-none-any"))).texts) == {"LICENSE"}


def test_the_bill_is_valid_and_complete(tmp_path, wheels):
    text = bill_of_materials(PACKAGE, MANIFEST, wheels, write_third_party(tmp_path, wheels))
    assert JsonStrictValidator(SchemaVersion.V1_6).validate_str(text) is None
    bill = json.loads(text)
    hashes = {part["bom-ref"]: part["hashes"][0]["content"] for part in bill["components"]}
    assert hashes == {name: sha256(content) for name, content in good_wheels().items()}
    assert all(part["licenses"] == [{"expression": "MIT"}] for part in bill["components"])
    needs = {entry["ref"]: entry.get("dependsOn", []) for entry in bill["dependencies"]}
    assert needs["plain-1.0-py3-none-any.whl"] == ["deep-1.0-py2.py3-none-any.whl"]
    assert sorted(needs["cubic_craft"]) == sorted(good_wheels())


def test_what_is_no_bill_is_refused():
    """The validator of the other test would notice."""
    assert JsonStrictValidator(SchemaVersion.V1_6).validate_str('{"bomFormat": "x"}') is not None
