# SPDX-License-Identifier: GPL-3.0-or-later
"""Which libraries of others are inside a wheel, to see that each of them is credited.

Wheels often link libraries that their own licence files do not name. A library gives itself away by
the name of a file or by words in the machine code.
"""

import re
import zipfile

from packaging.utils import canonicalize_name

_FILES = {
    "libdevice": r"libdevice",
    "ROCm": r"/ockl\.bc$",
    "MoltenVK": r"MoltenVK",
    "Go Regular": r"Go-Regular\.ttf$",
    "OpenBLAS": r"openblas[^/]*\.(so|dylib|dll)",
    "LAPACK": r"lapack[^/]*\.(so|dylib|dll)",
    "libgfortran": r"libgfortran",
    "libquadmath": r"libquadmath",
    "METIS": r"(lib)?metis\.(a|lib)$",
}
"""name of the library: part of the path of a file, a regular expression"""
_WORDS = {
    "LLVM": b"LLVM ERROR",
    "SPIRV-Tools": b"spvtools",
    "SPIRV-Cross": b"spirv_cross",
    "Eigen": b"5Eigen",
    "pybind11": b"pybind11",
    "nanobind": b"nanobind",
    "GLFW": b"glfwInit",
    "Dear ImGui": b"ImGui",
    "spdlog": b"spdlog",
    "Vulkan Memory Allocator": b"VmaAllocat",
    "volk": b"volkInitialize",
    "PicoSHA2": b"picosha2",
    "stb": b"stb_image",
    "CHOLMOD": b"cholmod_",
    "HiGHS": b"HiGHS",
    "SuperLU": b"SuperLU",
    "ARPACK": b"ARPACK",
    "Qhull": b"qhull",
    "Boost": b"5boost",
    "libffi": b"ffi_call",
    "PyO3": b"pyo3",
}
"""name of the library: what stands in machine code, such as a part of mangled names"""
_MACHINE_CODE = re.compile(r"\.(so|pyd|dll|dylib)(\.[\d.]+)?$")


def check_inside(path, credits):
    """Raise a ValueError if a known library in a wheel (Path) is credited nowhere.

    Parameters
    ----------
    path : Path
        The wheel.
    credits : list of Credit
        Of all wheels; a library is named in the texts of its own.
    """
    (credit,) = (c for c in credits if c.name == canonicalize_name(path.name.partition("-")[0]))
    texts = "\n".join([*credit.inside, *credit.texts.values()]).lower()
    with path.open("rb") as file:
        missing = libraries_inside(file, lambda library: library.lower() not in texts)
    if missing:
        raise ValueError(
            f"{path.name} has {', '.join(sorted(missing))} inside, which neither its licence "
            "texts nor licences/additions.toml name"
        )


def libraries_inside(file, is_wanted=lambda library: True):
    """Return the names of known libraries in a wheel, a set of str.

    Parameters
    ----------
    file
        An open, seekable file.
    is_wanted
        Says of a name whether to look for it; each takes time, as machine code is large.
    """
    files = {library: part for library, part in _FILES.items() if is_wanted(library)}
    words = {library: part for library, part in _WORDS.items() if is_wanted(library)}
    found = set()
    with zipfile.ZipFile(file) as wheel:
        for name in wheel.namelist():
            found |= {library for library, part in files.items() if re.search(part, name)}
            if _MACHINE_CODE.search(name):
                code = wheel.read(name)
                found |= {library for library, part in words.items() if part in code}
    return found
