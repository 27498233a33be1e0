"""The wheel is built, installed into an environment of its own, and runs there without the libraries of the system.

The bare environment gets what it needs by pip: without a package index the tests that install are skipped.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
from pathlib import Path

import pytest

from tools.wheel import SYSTEM, Contents, contents, packaged, tracked

pytestmark = [pytest.mark.slow, pytest.mark.skipif(sys.platform != "linux", reason="reads ELF files of Linux")]
ROOT = Path(__file__).parents[3]
MAPPED = """
import edesign.core
edesign.core.version()
with open("/proc/self/maps") as maps:
    print("\\n".join(sorted({line.split()[-1] for line in maps if ".so" in line})))
"""


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the source distribution and the wheel that `make wheel` makes."""
    for module in ("build", "auditwheel", "elftools"):
        pytest.importorskip(module, reason="needs the extra wheel")
    folder = tmp_path_factory.mktemp("dist")
    script = ROOT / "tools" / "wheel.py"
    made = subprocess.run([sys.executable, script, "--folder", folder], capture_output=True, text=True)
    assert made.returncode == 0, f"{made.stdout}\n{made.stderr}"
    return folder


@pytest.fixture(scope="module")
def wheel(built: Path) -> Path:
    (found,) = built.glob("*.whl")
    return found


@pytest.fixture(scope="module")
def found(wheel: Path) -> Contents:
    return contents(wheel)


@pytest.fixture(scope="module")
def bare(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An environment that holds edesign and what pip brought for it, without the packages of this one."""
    folder = tmp_path_factory.mktemp("bare") / "venv"
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    clean = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "LD_LIBRARY_PATH")}
    pip = [folder / "bin" / "python", "-m", "pip", "install", "-q", "--no-input", wheel]
    done = subprocess.run(pip, env=clean, capture_output=True, text=True)
    if "Could not find a version" in done.stderr or "onnection" in done.stderr:
        pytest.skip("no package index can be reached")
    assert done.returncode == 0, done.stderr
    return folder


def in_bare(bare: Path, folder: Path, *words: str | Path) -> str:
    """Output of a program of the bare environment, with next to nothing in its environment variables."""
    settings = {"PATH": f"{bare / 'bin'}:/usr/bin:/bin", "HOME": str(folder)}
    done = subprocess.run(
        [bare / "bin" / words[0], *words[1:]], cwd=folder, env=settings, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_source_distribution_holds_what_git_tracks(built: Path) -> None:
    (sdist,) = built.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        members = [item for item in archive.getmembers() if item.isfile()]
    names = {item.name.split("/", 1)[1] for item in members}
    made = {"PKG-INFO", "setup.cfg"}
    assert set(tracked()) - names == set()
    assert {name for name in names - set(tracked()) if "egg-info" not in name} == made
    assert {(item.uid, item.uname) for item in members} == {(0, "")}  # nothing of who packed it


def test_the_wheel_is_for_every_python_and_complete(wheel: Path) -> None:
    assert contents(wheel, packaged(), (str(ROOT), str(Path.home()), "/tmp/")).faults == []
    assert wheel.name.startswith("edesign-") and "-cp311-abi3-manylinux_" in wheel.name


def test_libraries_outside_the_wheel_are_those_of_every_linux(found: Contents) -> None:
    names = {Path(name).name for name in found.libraries}
    outside = {linked for library in found.libraries.values() for linked in library} - names
    assert [name for name in outside if not name.startswith(SYSTEM)] == []
    assert {name.split("-")[0] for name in names} >= {"libklu", "libamd", "libbtf", "libcolamd", "libsundials_arkode"}


def test_libraries_are_looked_for_beside_the_core_alone(found: Contents) -> None:
    assert found.search["edesign/core/_edcore.abi3.so"] == ["$ORIGIN/../../edesign.libs"]


def test_the_installed_core_uses_the_libraries_of_the_wheel(bare: Path, tmp_path: Path) -> None:
    mapped = in_bare(bare, tmp_path, "python", "-c", MAPPED).splitlines()
    ours = [
        Path(name) for name in mapped if any(word in name for word in ("libklu", "libsundials", "libbtf", "libamd"))
    ]
    assert len(ours) >= 4 and {path.parent.name for path in ours} == {"edesign.libs"}
    assert all(path.is_relative_to(bare.resolve()) for path in ours)


@pytest.mark.parametrize("template", ["frame", "damped"])
def test_the_installed_program_makes_a_project_runs_and_reports_it(bare: Path, tmp_path: Path, template: str) -> None:
    in_bare(bare, tmp_path, "edesign", "new", "demo", "--template", template)
    assert "ok" in in_bare(bare, tmp_path, "edesign", "check", "demo/project.yaml")
    assert "thesis_table_5_6" in in_bare(bare, tmp_path, "edesign", "records")
    in_bare(bare, tmp_path, "edesign", "run", "demo/project.yaml")
    in_bare(bare, tmp_path, "edesign", "report", "demo/project.h5")
    assert (tmp_path / "demo" / "project.html").stat().st_size > 0
