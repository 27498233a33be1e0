"""Build of the C core (edesign.core._edcore) with cffi; everything else is declared in pyproject.toml.

cffi uses Python's stable interface, so that one wheel serves every version from 3.11 on: it says so in its tag,
cp311-abi3. A Python without global lock has no stable interface; its wheel is for its version alone.
"""

from __future__ import annotations

import os
import sysconfig
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from setuptools import setup
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py

SUITES = Path("records", "suites")
INSTALLED_SUITES = Path("edesign", "project", "records", "suites")
"""Where `edesign/project/records/suite_names.py` looks for the suites."""


class ParallelBuild(build_ext):
    """Compile the C files side by side, and only those older than their source, a header or the build files."""

    def build_extensions(self) -> None:
        compile_files = self.compiler.compile
        shared = [*Path("core_c").glob("include/*.h"), *Path("core_c").glob("src/**/*.h")]
        shared += [Path("setup.py"), Path("edesign/core/build.py")]
        newest = max(path.stat().st_mtime for path in shared)

        def compile_one(source: str, output_dir: str, options: dict[str, Any]) -> list[str]:
            objects: list[str] = self.compiler.object_filenames([source], output_dir=output_dir)
            built = Path(objects[0])
            if not self.force and built.exists() and built.stat().st_mtime > max(newest, Path(source).stat().st_mtime):
                return objects
            return list(compile_files([source], output_dir=output_dir, **options))

        def compile_all(sources: list[str], output_dir: str = "", **options: Any) -> list[str]:
            with ThreadPoolExecutor(os.cpu_count()) as pool:
                results = pool.map(lambda source: compile_one(source, output_dir, options), sources)
                return [name for objects in results for name in objects]

        self.compiler.compile = compile_all
        super().build_extensions()


class BuildWithSuites(build_py):
    """Put the suites of recordings into the package; an editable one finds them where they are."""

    def run(self) -> None:
        super().run()
        if not self.editable_mode:
            for path, built in self.suites().items():
                self.mkpath(str(Path(built).parent))
                self.copy_file(path, built)

    def suites(self) -> dict[str, str]:
        """Return where each suite goes, by its path."""
        return {str(path): str(Path(self.build_lib, INSTALLED_SUITES, path.name)) for path in SUITES.glob("*.yaml")}

    def get_outputs(self, include_bytecode: bool = True) -> list[str]:
        return [*super().get_outputs(include_bytecode), *self.suites().values()]

    def get_output_mapping(self) -> dict[str, str]:
        return super().get_output_mapping() | {built: path for path, built in self.suites().items()}


FREE_THREADED = bool(sysconfig.get_config_var("Py_GIL_DISABLED"))

setup(
    cffi_modules=["edesign/core/build.py:ffibuilder"],
    cmdclass={"build_ext": ParallelBuild, "build_py": BuildWithSuites},
    options={} if FREE_THREADED else {"bdist_wheel": {"py_limited_api": "cp311"}},
)
