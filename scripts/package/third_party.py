# SPDX-License-Identifier: GPL-3.0-or-later
"""Credit what is bundled: licences, copyrights and the texts, mostly from the wheels themselves."""

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

from packaging.licenses import InvalidLicenseExpression, canonicalize_license_expression

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

_HEAD = """\
# Third-party software in this package

The folder `wheels` holds these packages as their authors published them on the Python package
index, unchanged. Their licence texts are in the folder `licences`. CubicCraft itself is under
GPL-3.0-or-later, see `LICENSE`. The same list for machines: `sbom.cdx.json`.
"""


@dataclass(frozen=True)
class Credit:
    """What is to be said of a bundled package; `texts` by the name of the file."""

    name: str
    version: str
    licence: str
    copyrights: list[str]
    homepage: str
    inside: list[str]
    texts: dict[str, str]


def credit(wheel):
    """Collect what is known of a wheel's licence.

    Raises
    ------
    ValueError
        Its licence, its text or its copyright is not known; see ``licences/additions.toml``.
    """
    additions = tomllib.loads((ADDITIONS / "additions.toml").read_text())
    added = additions.get(wheel.name, {})
    texts = dict(wheel.licences)
    for part, file_name in additions["texts"].items():
        if any(part in file for file in wheel.files):
            texts[file_name] = (ADDITIONS / file_name).read_text()
    if not wheel.licences and (ADDITIONS / f"{wheel.name}.txt").exists():
        texts["LICENSE.txt"] = (ADDITIONS / f"{wheel.name}.txt").read_text()
    if not texts:
        raise ValueError(f"{wheel.file_name} has no licence text")
    whole = "\n".join(wheel.licences.values() or texts.values())
    copyrights = [*added.get("copyright", []), *copyright_lines(whole)]
    if not copyrights:
        raise ValueError(f"{wheel.file_name} does not say whose copyright it is")
    return Credit(
        name=wheel.name,
        version=wheel.version,
        licence=_licence(wheel, whole),
        copyrights=copyrights,
        homepage=_homepage(wheel.metadata),
        inside=added.get("inside", []),
        texts=texts,
    )


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
    """Write THIRD_PARTY.md and the texts into the folder of the extension; return the credits."""
    credits = [credit(wheel) for wheel in sorted(wheels, key=lambda wheel: wheel.file_name)]
    lines = [_HEAD]
    for entry in credits:
        for name, text in entry.texts.items():
            target = folder / "licences" / entry.name / name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text)
        lines += [f"\n## {entry.name} {entry.version}\n", f"- Licence: {entry.licence}"]
        lines += [f"- Copyright {line}" for line in entry.copyrights]
        lines += [f"- {entry.homepage}"] if entry.homepage else []
        lines += [f"- Inside it: {line}" for line in entry.inside]
    (folder / "THIRD_PARTY.md").write_text("\n".join(lines) + "\n")
    return credits


def _licence(wheel, text):
    """Return the licence as an SPDX expression."""
    classifiers = wheel.metadata.get_all("Classifier", [])
    named = [c.rpartition(" :: ")[2] for c in classifiers if c.startswith("License ::")]
    stated = [wheel.metadata[field] for field in ("License-Expression", "License")]
    for candidate in [*stated, *(_SPDX.get(name) for name in named)]:
        try:
            return canonicalize_license_expression(candidate or "")
        except InvalidLicenseExpression:
            continue
    if "BSD License" in named:  # the classifier does not say which; the third clause does
        third = re.search(r"endorse\s+or\s+promote", text)
        return "BSD-3-Clause" if third else "BSD-2-Clause"
    raise ValueError(f"the licence of {wheel.file_name} is not known")


def _homepage(metadata):
    urls = [url.split(",", 1) for url in metadata.get_all("Project-URL", [])]
    pages = {label.strip().lower(): url.strip() for label, url in urls}
    return metadata["Home-page"] or pages.get("homepage") or pages.get("source") or ""
