# SPDX-License-Identifier: GPL-3.0-or-later
"""What the extensions platform asks for, as far as a zip shows it: see docs/platform.md."""

import ast
import re
from pathlib import PurePosixPath

LONGEST_TEXT = 64
"""letters of the tagline and of the reason for a permission"""

_PUBLIC = re.compile(r"https://(?!localhost|example\.|[\d.:\[])[^/\s]+\.[a-z]+(/\S*)?")
"""A website. The manifest may do without, and ours does: it has no address that is public."""

_COMPILED = (".pyc", ".pyo", ".so", ".pyd", ".dll", ".dylib", ".exe")
_NETWORK = {"ftplib", "http", "httpx", "requests", "smtplib", "socket", "ssl", "urllib", "urllib3"}
_INSTALLERS = {"ensurepip", "pip"}
_OF_PYTHON = ("sys.modules", "sys.path")
_EXPLAINED = {
    "engine.py": {"sys.setdlopenflags"},
    "elsewhere.py": {"sys.modules"},
}
"""what is replaced in a module of others for a time, by the file that says why"""


def rule_problems(archive, manifest):
    """Return what a reviewer of the platform would object to, as a list of str.

    Parameters
    ----------
    archive : zipfile.ZipFile
    manifest : dict
        That of the archive.
    """
    problems = _text_problems(manifest)
    for name in archive.namelist():
        suffix = PurePosixPath(name).suffix.lower()
        if suffix in _COMPILED:
            problems.append(f"{name} is compiled, so nobody can review it")
        elif suffix == ".py":
            problems += _code_problems(name, ast.parse(archive.read(name)))
    return problems


def _text_problems(manifest):
    problems = []
    if "blender" in manifest.get("name", "").lower():
        problems.append("its name has the word Blender in it")
    website = manifest.get("website")
    if website is not None and not _PUBLIC.fullmatch(website):
        problems.append(f"its website {website} is no public address that begins with https")
    reasons = manifest.get("permissions", {})
    if "network" in reasons:
        problems.append("it asks for the network, which it does not use")
    for text in (manifest.get("tagline", ""), *reasons.values()):
        if len(text) > LONGEST_TEXT or text.endswith((".", "!")):
            problems.append(f'"{text}" has over {LONGEST_TEXT} letters or ends like a sentence')
    return problems


def _code_problems(name, tree):
    problems, modules = [], set()
    for node in ast.walk(tree):
        imported = _imported(node)
        modules |= imported | _looked_up(node)
        if imported & _NETWORK:
            problems.append(f"{name} imports {', '.join(sorted(imported & _NETWORK))}")
        if imported & _INSTALLERS:
            problems.append(f"{name} may install something")
        if isinstance(node, ast.Call) and ast.unparse(node.func) in ("eval", "exec"):
            problems.append(f"{name}, line {node.lineno}, runs what it makes up")
    for node in ast.walk(tree):
        changed = _changed(node, modules)
        if changed and changed not in _EXPLAINED.get(PurePosixPath(name).name, ()):
            problems.append(f"{name}, line {node.lineno}, changes {changed}")
    return problems


def _imported(node):
    """Return the first parts of the names of the modules that a statement imports."""
    if isinstance(node, ast.Import):
        return {each.name.partition(".")[0] for each in node.names}
    if isinstance(node, ast.ImportFrom) and not node.level:
        return {node.module.partition(".")[0]}
    return set()


def _looked_up(node):
    """Return the names that a statement gives to what it takes from the loaded modules."""
    if not isinstance(node, ast.Assign | ast.AnnAssign | ast.NamedExpr) or node.value is None:
        return set()
    if not ast.unparse(node.value).startswith(("sys.modules", "import_module", "importlib.")):
        return set()
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    return {target.id for target in targets if isinstance(target, ast.Name)}


def _changed(node, modules):
    """Return what of one of these modules of others a statement changes, such as "sys.path"."""
    if isinstance(node, ast.Call) and ast.unparse(node.func) in ("setattr", "delattr"):
        module = _name_of(node.args[0]).partition(".")[0]
        return ast.unparse(node.args[0]) if module in modules - {"bpy"} else ""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        adds = node.func.attr in ("append", "extend", "insert", "update", "setdefault")
        return _name_of(node.func.value) if adds and _name_of(node.func.value) in _OF_PYTHON else ""
    targets = getattr(node, "targets", [getattr(node, "target", None)])
    for target in targets if isinstance(node, (ast.Assign, ast.AugAssign, ast.Delete)) else []:
        is_item = isinstance(target, ast.Subscript)
        name = _name_of(target.value if is_item else target)
        module, _, attribute = name.partition(".")
        if name in _OF_PYTHON or (attribute and not is_item and module in modules - {"bpy"}):
            return name
    return ""


def _name_of(node):
    """Return the name that an expression is, such as "sys.path", or an empty text."""
    if isinstance(node, ast.Attribute):
        before = _name_of(node.value)
        return f"{before}.{node.attr}" if before else ""
    return node.id if isinstance(node, ast.Name) else ""
