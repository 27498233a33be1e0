"""What a file of substructure tests says, in a few lines."""

from __future__ import annotations

from pathlib import Path

from edesign.project.reading.problems import listed
from edesign.project.reading.words import counted
from edesign.project.substructure.checks_structure import frequencies
from edesign.project.substructure.programme import RecordTest
from edesign.project.substructure.rig import RigInFile, RigModel
from edesign.project.substructure.rts_file import RtsFile
from edesign.project.substructure.structure import ProjectStructure, ShearBuilding


def summary(rts: RtsFile) -> dict[str, str]:
    """Return a description of the tests of a checked file, line by line under short labels."""
    found = {
        "title": rts.title or rts.path.stem,
        "structure": _structure(rts),
        "specimen": _specimen(rts),
        "rig": _rig(rts),
        "loop": _loop(rts),
        "compensate": ", ".join(_called(name, one.kind) for name, one in rts.compensators.items()),
        "tests": "\n".join(_test(rts, i) for i in range(len(rts.tests))) or "none",
        "runs": _runs(rts),
    }
    return {label: text for label, text in found.items() if text}


def _structure(rts: RtsFile) -> str:
    if isinstance(rts.structure, ProjectStructure):
        assert rts.project is not None
        kind = ", may yield" if rts.structure.frame == "nonlinear" else ""
        return f"{rts.project.path} without {listed(rts.structure.physical)}{kind}"
    if isinstance(rts.structure, ShearBuilding):
        hertz = ", ".join(f"{frequency:.4g}" for frequency in frequencies(rts.structure)[:3])
        count = len(rts.structure.masses)
        return f"{count} storey{'s' * (count > 1)}, specimen in storey {rts.structure.storey}; without it {hertz} Hz"
    return ""


def _specimen(rts: RtsFile) -> str:
    placed = rts.law
    if placed is None:
        return "none"
    law = placed.law
    said = Path(law.file).name if law.file is not None else law.type or ""
    name = f"{rts.specimen.law}: " if isinstance(rts.specimen.law, str) else ""
    heat = f" at {law.temperature:g} degC" if law.temperature is not None else ""
    effects = f", with {listed(effect.name for effect in rts.specimen.effects)}" if rts.specimen.effects else ""
    return f"{name}{said}{heat}{effects}"


def _rig(rts: RtsFile) -> str:
    return rig_text(rts.plant, f" of {rts.rig.file}" if isinstance(rts.rig, RigInFile) else "")


def rig_text(plant: RigModel, origin: str = "") -> str:
    """Return the kind of a rig and its values in a line.

    Args:
        origin: text that follows the kind.
    """
    parts = [plant.kind + origin]
    for key, factor, unit in (
        ("frequency", 1.0, "Hz"),
        ("damping", 1.0, ""),
        ("time_constant", 1e3, "ms"),
        ("proportional_gain", 1.0, "/s"),
        ("valve_time_constant", 1e3, "ms"),
        ("delay", 1e3, "ms"),
    ):
        if value := getattr(plant, key, None):
            parts.append(f"{key.replace('_', ' ')} {factor * value:.4g} {unit}".rstrip())
    return ", ".join(parts)


def _loop(rts: RtsFile) -> str:
    loop = rts.loop
    unseen = f", {loop.unseen_delay} unseen" if loop.unseen_delay else ""
    steps = f"main step {1e3 * loop.main_step:.4g} ms{unseen}, rig {1e3 * rts.sub_step:.4g} ms"
    return f"{steps}; {_integrated(rts)}, force {loop.force}"


def _integrated(rts: RtsFile) -> str:
    if not rts.may_yield:
        return rts.integration.method
    assert rts.project is not None and rts.project.integration is not None
    return f"frame by {rts.project.integration.method}, {rts.integration.frame_steps} in a main step"


def _test(rts: RtsFile, i: int) -> str:
    test = rts.tests[i]
    if not isinstance(test, RecordTest):
        return _called(test.name, test.kind)
    motion = rts.motion(test)
    size = f"to {motion.pga:.4g} m/s2" if motion.pga is not None else f"x {motion.scale:.4g}"
    return f"{_called(test.name, test.kind)}: {motion.record} {size}"


def _runs(rts: RtsFile) -> str:
    """Tests by other methods have no compensator."""
    looped = sum(test.kind in ("command", "rts") for test in rts.tests)
    others = len(rts.tests) - looped
    found = [f"{counted(looped, 'test')} x {counted(len(rts.compensators), 'compensator')}"] if looped else []
    found += [f"{counted(others, 'test')} by other methods"] if others else []
    return ", ".join(found)


def _called(name: str, kind: str) -> str:
    return name if name == kind else f"{name} ({kind})"
