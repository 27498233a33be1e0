"""Build a wheel that carries its shared libraries, from a source distribution, and print what is in it.

Usage: wheel.py [--folder dist] [WHEEL]

Makes FOLDER/edesign-VERSION.tar.gz of the files that git tracks; outside git, of those that the sdist came with. From
that alone it makes FOLDER/edesign-VERSION-cp311-abi3-PLATFORM.whl, into which auditwheel (Linux) or delocate (macOS)
has copied SuiteSparse and SUNDIALS. With WHEEL nothing is built, and that wheel is looked at.

Exit code 1 if the wheel lacks a file of the package or a licence, links what it does not carry, or says where it was
built. Needs the extra `wheel`. EDESIGN_CFLAGS, SUITESPARSE_ROOT and SUNDIALS_ROOT work as in every build.
"""

from __future__ import annotations

import argparse
import gzip
import io
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[1]
LICENCES = (
    "LICENSE",
    "KLU.txt",
    "BTF.txt",
    "AMD.txt",
    "COLAMD.txt",
    "SuiteSparse_config.txt",
    "SUNDIALS.txt",
    "LGPL-2.1.txt",
)
SYSTEM = ("libc.so.", "libm.so.", "libpthread.so.", "libdl.so.", "librt.so.", "libgcc_s.so.", "ld-linux")
"""Libraries that every Linux with the GNU C library has."""


@dataclass
class Contents:
    """What a wheel holds.

    Attributes:
        files: sizes in bytes by path inside the wheel.
        tag: for which Pythons and systems, as its name says.
        libraries: shared libraries by path, with what each of them links.
        search: where each of them looks for what it links (RPATH and RUNPATH).
        faults: what is wrong with the wheel.
    """

    files: dict[str, int]
    tag: str
    libraries: dict[str, list[str]] = field(default_factory=dict)
    search: dict[str, list[str]] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)


def tracked(root: Path = ROOT) -> list[str]:
    """Files of the project as git tracks them, relative to the root; all of a source distribution outside git."""
    if (root / ".git").exists():
        found = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, text=True, check=True)
        return sorted(name for name in found.stdout.split("\0") if name and (root / name).exists())
    sources = root / "edesign.egg-info" / "SOURCES.txt"
    return sorted(name for name in sources.read_text(encoding="utf-8").split("\n") if name and "egg-info" not in name)


def packaged() -> list[str]:
    """Files that a wheel must hold: those of the package, and the suites, which setup.py puts into it."""
    suites = "records/suites/"
    own = [name for name in tracked() if name.startswith("edesign/")]
    return own + [f"edesign/project/{name}" for name in tracked() if name.startswith(suites)]


def run(command: list[str], **settings: object) -> None:
    """Run a command; what it says is shown when it fails."""
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **settings)  # type: ignore[call-overload]
    if result.returncode:
        sys.exit(f"{result.stdout}\n{' '.join(command)} failed")


def build_sdist(folder: Path) -> Path:
    """Make the source distribution of tracked files, so that no file that lies about comes in."""
    with tempfile.TemporaryDirectory() as scratch:
        source = Path(scratch, "source")
        for name in tracked():
            copy = source / name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, copy, follow_symlinks=False)
        settings, made = environment(), Path(scratch, "made")
        run(
            [sys.executable, "-m", "build", "--sdist", "--no-isolation", "--outdir", str(made), str(source)],
            env=settings,
        )
        (sdist,) = made.glob("*.tar.gz")
        moment = int(settings.get("SOURCE_DATE_EPOCH", sdist.stat().st_mtime))

        # packed again, as the same sources are to give the same bytes
        folder.mkdir(parents=True, exist_ok=True)
        with (
            tarfile.open(sdist) as given,
            (folder / sdist.name).open("wb") as target,
            gzip.GzipFile(filename="", fileobj=target, mode="wb", mtime=moment) as packed,
            tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive,
        ):
            for item in sorted(given.getmembers(), key=lambda item: item.name):
                item.pax_headers = {}  # it has the time to the nanosecond
                item.mtime, item.uid, item.gid, item.uname, item.gname = moment, 0, 0, "", ""
                archive.addfile(item, given.extractfile(item) if item.isfile() else None)
    return folder / sdist.name


def environment() -> dict[str, str]:
    """Environment of a build: no debug information, times of the last commit, libraries that the set-up unpacked."""
    found = dict(os.environ)
    found["EDESIGN_CFLAGS"] = f"-g0 {found.get('EDESIGN_CFLAGS', '')}".strip()
    if (ROOT / ".git").exists() and "SOURCE_DATE_EPOCH" not in found:
        moment = subprocess.run(["git", "-C", str(ROOT), "log", "-1", "--format=%ct"], capture_output=True, text=True)
        found["SOURCE_DATE_EPOCH"] = moment.stdout.strip() or "315532800"
    flags = subprocess.run(["sh", "core_c/libraries.sh"], cwd=ROOT, capture_output=True, text=True).stdout
    unpacked = ROOT / ".libraries"
    if str(unpacked) in flags:  # an unpacked source distribution has none
        for name in ("SUITESPARSE_ROOT", "SUNDIALS_ROOT"):
            found.setdefault(name, str(unpacked))
    return found


def build_wheel(sdist: Path, folder: Path) -> Path:
    """Build the wheel from a source distribution alone, and copy its shared libraries into it."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        with tarfile.open(sdist) as archive:
            archive.extraction_filter = getattr(tarfile, "data_filter", None)  # from Python 3.11.4 on
            archive.extractall(scratch)
        source = Path(scratch, sdist.name.removesuffix(".tar.gz"))
        bare = Path(scratch, "bare")
        settings = environment()
        run(
            [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(bare), str(source)],
            env=settings,
        )
        made = Path(scratch, "made")
        tools = str(Path(sys.executable).parent)  # not resolved: beside the interpreter of the environment
        settings["PATH"] = os.pathsep.join([tools, settings.get("PATH", "")])
        repair = {"linux": ["auditwheel", "repair", "-w"], "darwin": ["delocate-wheel", "-w"]}.get(sys.platform)
        if repair is None:
            sys.exit(f"nothing is known here that copies shared libraries into a wheel on {sys.platform}")
        command = shutil.which(repair[0], path=settings["PATH"])
        if command is None:
            sys.exit(f"{repair[0]} is not installed: pip install 'edesign[wheel]'")
        run([command, *repair[1:], str(made), *map(str, bare.glob("*.whl"))], env=settings)
        (wheel,) = made.glob("*.whl")
        return Path(shutil.move(wheel, folder / wheel.name))


def contents(path: Path, wanted: Iterable[str] = (), places: Iterable[str] = ()) -> Contents:
    """Read a wheel.

    Args:
        path: the wheel.
        wanted: files of the package that it must hold, relative to the root of the project.
        places: folders of the machine that no shared library may name.
    """
    with zipfile.ZipFile(path) as wheel:
        found = Contents(
            {item.filename: item.file_size for item in wheel.infolist() if not item.is_dir()},
            path.stem.split("-", 2)[2],
        )
        binary = {name: wheel.read(name) for name in found.files if ".so" in PurePosixPath(name).suffixes}
    found.faults += [f"the package's {name} is not in the wheel" for name in wanted if name not in found.files]
    licences = {PurePosixPath(name).name for name in found.files if "/licenses/" in name}
    found.faults += [f"the licence {name} is not in the wheel" for name in LICENCES if name not in licences]
    if "-abi3-" not in f"-{found.tag}-":
        found.faults.append(f"the tag {found.tag} is not of the stable interface")
    carried = {PurePosixPath(name).name for name in binary}
    for name, content in binary.items():
        linked, search = elf_links(content)
        found.libraries[name], found.search[name] = linked, search
        found.faults += [
            f"{name} links {library}, which is not in the wheel"
            for library in linked
            if library not in carried and not library.startswith(SYSTEM)
        ]
        found.faults += [
            f"{name} looks for libraries in {place}" for place in search if not place.startswith("$ORIGIN")
        ]
        found.faults += [f"{name} names the folder {place}" for place in places if place.encode() in content]
    return found


def elf_links(content: bytes) -> tuple[list[str], list[str]]:
    """Names of the libraries that an ELF file links, and the folders where it looks for them; none of other files."""
    if not content.startswith(b"\x7fELF"):  # of macOS: delocate-wheel itself refuses what it cannot copy
        return [], []
    from elftools.elf.dynamic import DynamicSection
    from elftools.elf.elffile import ELFFile

    linked: list[str] = []
    search: list[str] = []
    for section in ELFFile(io.BytesIO(content)).iter_sections():
        if isinstance(section, DynamicSection):
            for tag in section.iter_tags():
                if tag.entry.d_tag == "DT_NEEDED":
                    linked.append(tag.needed)
                elif tag.entry.d_tag in ("DT_RPATH", "DT_RUNPATH"):
                    search += getattr(tag, tag.entry.d_tag.removeprefix("DT_").lower()).split(":")
    return linked, search


def describe(path: Path, found: Contents) -> str:
    """What a wheel holds, in lines for people."""
    counts = Counter(PurePosixPath(name).suffix or "other" for name in found.files if name not in found.libraries)
    lines = [f"{path.name}: {path.stat().st_size / 1e6:.1f} MB, {len(found.files)} files, for {found.tag}"]
    lines += [f"  {', '.join(f'{count} {kind}' for kind, count in counts.most_common())}", "  shared libraries:"]
    for name, linked in sorted(found.libraries.items()):
        outside = [library for library in linked if library.startswith(SYSTEM)]
        lines.append(f"    {name}  {found.files[name] / 1e3:.0f} kB; of the system: {', '.join(outside) or 'none'}")
    licences = sorted(PurePosixPath(name).name for name in found.files if "/licenses/" in name)
    return "\n".join([*lines, f"  licences: {', '.join(licences)}"])


def main() -> None:
    """Build the source distribution and the wheel, or look at a wheel."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("wheel", type=Path, nargs="?")
    parser.add_argument("--folder", type=Path, default=ROOT / "dist")
    options = parser.parse_args()
    wheel = options.wheel
    if wheel is None:
        sdist = build_sdist(options.folder)
        print(f"{sdist.name}: {sdist.stat().st_size / 1e6:.1f} MB")
        wheel = build_wheel(sdist, options.folder)
    found = contents(wheel, packaged(), (str(ROOT), tempfile.gettempdir() + "/", str(Path.home())))
    print(describe(wheel, found))
    if found.faults:
        sys.exit("\n".join(f"wrong: {fault}" for fault in found.faults))


if __name__ == "__main__":
    main()
