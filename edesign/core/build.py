"""Builds the extension module edesign.core._edcore from the C sources in core_c; run by setup.py, at the root.

The public headers that core_c/include/edcore.h includes are the only declaration of the interface: the C preprocessor
expands them, with ED_CFFI defined and without system headers, into what cffi reads. Integer macros ED_NAME become
constants.

Environment: CC (compiler), EDESIGN_CFLAGS (appended to the compiler flags, e.g. "-O0 -g"), SUITESPARSE_ROOT and
SUNDIALS_ROOT (prefixes).
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sysconfig
from pathlib import Path

import cffi

CORE = Path("core_c")
HEADER = CORE / "include" / "edcore.h"
# What the core may call in Python.
CALLBACKS = 'extern "Python" int edesign_stop_asked(void *);\n'
# No contraction: results must not depend on whether a machine has fused multiply-add. No wrapping of integers, which
# Python's own flags ask for: with it gcc cannot count the turns of a loop whose bound is a sum, and leaves it scalar.
# Hidden symbols: calls inside the library may be inlined. gnu11 for M_PI and clock_gettime. No -march=native: a built
# package moves between machines.
FLAGS = [
    "-std=gnu11",
    "-O3",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-fno-wrapv",
    "-fvisibility=hidden",
    "-Wall",
    "-Wextra",
]


def compiler() -> list[str]:
    """Return the command of the C compiler: CC, or the one that built Python."""
    return shlex.split(os.environ.get("CC") or sysconfig.get_config_var("CC") or "cc")


def declarations(header: Path = HEADER) -> str:
    """Return the declarations of a C header as cffi reads them.

    Returns:
        The preprocessed text without directives and attributes, preceded by the integer macros ED_* as constants: those
        of this header and of all beside it, which it includes.

    Raises:
        SystemExit: the preprocessor failed.
    """
    text = header.read_text(encoding="utf-8")
    text = re.sub(r"^[ \t]*#[ \t]*include[ \t]*<.*$", "", text, flags=re.MULTILINE)
    command = [*compiler(), "-E", "-P", "-DED_CFFI", f"-I{header.parent}", "-x", "c", "-"]
    result = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    if result.returncode:
        raise SystemExit(f"{' '.join(command)} failed on {header}:\n{result.stderr}")
    expanded = re.sub(r"__attribute__\s*\(\(.*?\)\)(?=\s)", "", result.stdout)
    expanded = re.sub(r"\bED_API\b", "", expanded)
    integers = re.findall(
        r"^[ \t]*#[ \t]*define[ \t]+(ED_\w+)[ \t]+\(?-?(?:0[xX][0-9a-fA-F]+|\d+)[uUlL]*\)?[ \t]*(?:/[*/].*)?$",
        "".join(path.read_text(encoding="utf-8") for path in sorted(header.parent.glob("*.h"))),
        flags=re.MULTILINE,
    )
    return "".join(f"#define {name} ...\n" for name in integers) + expanded


def library_flags() -> list[str]:
    """Return the compiler and linker flags of SuiteSparse and SUNDIALS; see core_c/libraries.sh.

    Raises:
        SystemExit: a library was not found.
    """
    result = subprocess.run(["sh", str(CORE / "libraries.sh")], capture_output=True, text=True, check=False)
    if result.returncode:
        missing = " and ".join(result.stderr.splitlines())
        raise SystemExit(
            f"edesign needs libraries with headers that were found in none of the usual places: {missing}. Install "
            "libsuitesparse-dev and libsundials-dev (apt), suitesparse-devel and sundials-devel (dnf), "
            "suite-sparse and sundials (brew) or suitesparse and sundials (conda), "
            "or set SUITESPARSE_ROOT and SUNDIALS_ROOT to their prefixes."
        )
    return result.stdout.split()


def ffibuilder() -> cffi.FFI:
    """Return the cffi builder of edesign.core._edcore, as setuptools asks for it.

    Raises:
        SystemExit: the sources of the core are not there.
    """
    sources = sorted(path.as_posix() for path in CORE.glob("src/*/*.c"))
    if not sources or not HEADER.exists():
        raise SystemExit(f"no C sources under {CORE.resolve()}: build from the root of the source tree")
    found = library_flags()
    builder = cffi.FFI()
    builder.cdef(declarations() + CALLBACKS)
    builder.set_source(
        "edesign.core._edcore",
        '#include "edcore.h"\n',
        sources=sources,
        depends=sorted(
            path.as_posix()
            for path in [*CORE.glob("include/*.h"), *CORE.glob("src/**/*.h"), Path("edesign/core/build.py")]
        ),
        include_dirs=[(CORE / "include").as_posix(), (CORE / "src").as_posix()],
        extra_compile_args=[
            *FLAGS,
            *(flag for flag in found if flag.startswith("-I")),
            *shlex.split(os.environ.get("EDESIGN_CFLAGS", "")),
        ],
        extra_link_args=[flag for flag in found if not flag.startswith("-I")],
    )
    return builder
