# SPDX-License-Identifier: GPL-3.0-or-later
"""Credit what is bundled: licenses, copyrights and the texts, mostly from the wheels themselves."""

import re
import tomllib
import zipfile
from dataclasses import dataclass
from email.message import Message
from email.parser import BytesParser
from pathlib import Path, PurePosixPath

from packaging.licenses import InvalidLicenseExpression, canonicalize_license_expression
from packaging.utils import parse_wheel_filename

ADDITIONS = Path(__file__).with_name("licences")

# Names of classifiers and what else projects write, where it is not an SPDX expression.
_SPDX = {"MIT License": "MIT", "Apache Software License": "Apache-2.0"}
# The holder may go on in lines that are indented deeper.
_COPYRIGHT = re.compile(
    r"^[\s*#/]{0,4}Copyright\s*(?:\(c\)|©)?\s*(\d{4}(?:\s*[-,]\s*\d{4})*),?\s+(?:by\s+)?"
    r"(\S.*(?:\n {12,}\S.*)*)$",
    re.IGNORECASE | re.MULTILINE,
)
_NOT_A_NAME = re.compile(r"<[^>]*>|\bAll\s+rights(\s+reserved)?\.?", re.IGNORECASE)
_TEXT = re.compile(r"\.dist-info/.*(licen[cs]e|copying|notice|authors)[^/]*$", re.IGNORECASE)

_HEAD = """\
# Third-party software in this package

The folder `wheels` holds these packages as their authors published them on the Python package
index, unchanged. Their licence texts are in the folder `licences`. CubicCraft itself is under
GPL-3.0-or-later, see `LICENSE`.
"""


@dataclass(frozen=True)
class Credit:
    """What is to be said of a bundled package; `texts` by the name of the file."""

    name: str
    version: str
    licence: str
    copyrights: list[str]
    inside: list[str]
    texts: dict[str, str]


def credit(path):
    """Collect what is known of the license of a wheel (Path).

    Raises ValueError: its license, its text or its copyright is not known; see
    ``licences/additions.toml``.
    """
    name, version, *_ = parse_wheel_filename(path.name)
    additions = tomllib.loads((ADDITIONS / "additions.toml").read_text())
    with zipfile.ZipFile(path) as wheel:
        files = wheel.namelist()
        own = {
            PurePosixPath(f).name: wheel.read(f).decode("utf-8", "replace")
            for f in files
            if _TEXT.search(f)
        }
        (information,) = (f for f in files if re.fullmatch(r"[^/]+\.dist-info/METADATA", f))
        metadata = BytesParser().parsebytes(wheel.read(information))
    if not own and (ADDITIONS / f"{name}.txt").exists():
        own = {"LICENSE.txt": (ADDITIONS / f"{name}.txt").read_text()}
    added = additions.get(name, {})
    whole = "\n".join(own.values())
    copyrights = [*added.get("copyright", []), *copyright_lines(whole)]
    if not copyrights:
        raise ValueError(f"{path.name} has no licence text that says whose copyright it is")
    theirs = {
        file_name: (ADDITIONS / file_name).read_text()
        for part, file_name in additions["texts"].items()
        if any(part in file for file in files)
    }
    licence = _licence(metadata, whole)
    return Credit(name, str(version), licence, copyrights, added.get("inside", []), own | theirs)


def copyright_lines(text):
    """Return the copyrights of a text as the manifest wants them: "YEAR Name", "YEAR-YEAR Name"."""
    found = []
    for years, holder in _COPYRIGHT.findall(text):
        numbers = re.findall(r"\d{4}", years)
        span = numbers[0] if len(numbers) == 1 else f"{numbers[0]}-{numbers[-1]}"
        name = " ".join(_NOT_A_NAME.sub("", holder).split())
        entry = f"{span} {re.sub(r'(?<!Inc)[ .,]+$', '', name)}"
        if entry not in found:
            found.append(entry)
    return found


def write_third_party(folder, wheels):
    """Write THIRD_PARTY.md and the texts of wheels (Paths) into a folder; return the credits."""
    credits = [credit(path) for path in wheels]
    lines = [_HEAD]
    for entry in credits:
        for name, text in entry.texts.items():
            target = folder / "licences" / entry.name / name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text)
        lines += [f"\n## {entry.name} {entry.version}\n", f"- Licence: {entry.licence}"]
        lines += [f"- Copyright {line}" for line in entry.copyrights]
        lines += [f"- Inside it: {line}" for line in entry.inside]
    (folder / "THIRD_PARTY.md").write_text("\n".join(lines) + "\n")
    return credits


def _licence(metadata: Message, text):
    """Return the license as an SPDX expression."""
    classifiers = metadata.get_all("Classifier", [])
    named = [c.rpartition(" :: ")[2] for c in classifiers if c.startswith("License ::")]
    stated = [metadata[field] for field in ("License-Expression", "License")]
    for candidate in [*stated, *(_SPDX.get(name) for name in named)]:
        try:
            return canonicalize_license_expression(candidate or "")
        except InvalidLicenseExpression:
            continue
    if "BSD License" in named:  # the classifier does not say which; the third clause does
        third = re.search(r"endorse\s+or\s+promote", text)
        return "BSD-3-Clause" if third else "BSD-2-Clause"
    raise ValueError(f"the licence of {metadata['Name']} is not known")
