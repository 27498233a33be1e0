"""Laws and sizes of dampers in words, as the project file gives them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from edesign.damper.laws import LAWS
from edesign.damper.parameter_sets import PARAMETER_SETS
from edesign.damper.parameters import DASHPOTS, coefficient_in_words, read_parameters
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import (
    AnyChosenBrace,
    BraceSection,
    BraceStiffness,
    DamperBetween,
    DamperLaw,
    DamperRun,
)
from edesign.project.dampers.isolation import AnyBaseDevice
from edesign.project.frame.sections import (
    BoxSection,
    ElasticSection,
    PlateSection,
    RivetedSection,
    Section,
    SpaceElasticSection,
    SpaceSection,
)
from edesign.project.notation.selections import LineSelection, NumberSelection
from edesign.project.reading.problems import listed
from edesign.report.drawing.style import VARIANTS
from edesign.report.drawing.symbols import power_of_ten, with_indices_of_laws

SCIENTIFIC = 1e9  # such as the area of a member that stands for a rigid one
MOST = 170  # letters of parameters


def short(value: float, digits: int = 4) -> str:
    """Return a number with at most so many digits, without zeros at its end, and all that stand before the point.

    Numbers from 10⁹ are written with a power of ten.
    """
    if abs(value) >= SCIENTIFIC:
        return power_of_ten(f"{value:.{digits}g}")
    return f"{value:.{digits}g}" if abs(value) < 10.0**digits else f"{value:.0f}"


def law_colors(project: AnalysisFile) -> dict[str, str]:
    """Return a colour for each law that stands in a project, by its name."""
    dampers = project.dampers
    used = [name for name in dampers.laws if name in dampers.used_laws] if dampers is not None else []
    order = (VARIANTS[2], VARIANTS[0], *VARIANTS[3:], VARIANTS[1])
    return {name: order[i % len(order)] for i, name in enumerate(used)}


def law_words(name: str, law: DamperLaw) -> str:
    """Return a law in words: its type with its parameters, the size of its prototype, temperature and factor."""
    if law.file is not None:
        parts = [f"law of {Path(law.file).name}"]
    else:
        parts = [LAWS[str(law.type)].title.partition(":")[0]]
        if isinstance(law.parameters, str):
            parts.append(f"parameters of {PARAMETER_SETS[law.parameters].source}")
        elif law.parameters:
            parts.append(_parameters(law.parameters))
    if law.prototype is not None:
        size = law.prototype
        parts.append(f"prototype {_layers(size.layers, size.layer_area, size.layer_thickness)}")
    parts += [f"effect {effect.name}" for effect in law.effects]
    parts += [f"at {law.temperature:g} °C"] if law.temperature is not None else []
    parts += [f"forces × {law.property_factor:g}"] if law.property_factor != 1.0 else []
    return f"{name}: {', '.join(parts)}"


def _parameters(values: Mapping[str, object]) -> str:
    found = ""
    for key, value in values.items():
        text = f"{with_indices_of_laws(key)} = {_value(value)}"
        if len(found) + len(text) > MOST:
            return f"{found}, …"
        found = f"{found}, {text}" if found else text
    return found


def _value(value: object) -> str:
    if isinstance(value, (list, tuple)):
        return " / ".join(map(_value, value))
    return str(value).replace("*", "·").replace("^2", "²").replace("^3", "³")


def device_size(project: AnalysisFile, device: DamperRun | DamperBetween | AnyBaseDevice, index: int = 0) -> str:
    """Return the size of a damper in words: number, layers or factor on the forces; "" if it is that of its law.

    Args:
        device: whose law is in the project.
        index: of the storey among those of a run.
    """
    parts = [f"{device.number} dampers"] if device.number > 1 else []
    assert project.dampers is not None
    law = project.dampers.laws.get(device.law)
    prototype = law.prototype if law is not None else None
    area, scale = _of_storey(device.layer_area, index), _of_storey(device.scale, index)
    if prototype is not None:
        layers = device.layers or prototype.layers
        area = prototype.layer_area if area is None else area
        parts.append(_layers(layers, area, device.layer_thickness or prototype.layer_thickness))
    elif device.layers is not None or area is not None or device.layer_thickness is not None:  # of a law file
        parts += [f"{device.layers} layers"] if device.layers is not None else []
        parts += [f"layer {_area(area)}"] if area is not None else []
        parts += [f"{_millimetres(device.layer_thickness)} thick"] if device.layer_thickness is not None else []
    if scale is not None:
        parts.append(_scaled(law, scale))
    return ", ".join(parts)


def _scaled(law: DamperLaw | None, scale: float) -> str:
    """The coefficient of a dashpot with a factor on its forces; of other laws the factor."""
    if law is None or law.parameters is None or law.effects or law.type not in (*DASHPOTS, "buckling_restrained"):
        return f"forces × {short(scale)}"
    values = read_parameters(LAWS[law.type], law.parameters)
    if law.type == "buckling_restrained":
        return f"core of {short(1e6 * scale * values['A_sc'])} mm²"
    return f"c = {coefficient_in_words(scale * values['c'], values.get('alpha', 1.0))}"


def brace_words(device: DamperRun | DamperBetween, index: int = 0) -> str:
    """Return the brace of a damper in words; "" for a rigid one.

    Args:
        index: of the storey in the run, from 0.
    """
    brace = device.brace
    if isinstance(brace, BraceSection):
        return f"brace {brace.of(index)} {brace.material}"
    if isinstance(brace, AnyChosenBrace):
        return f"brace chosen from {listed(brace.choose)} {brace.material}"
    if isinstance(brace, BraceStiffness):
        stiffness = _of_storey(brace.stiffness, index)
        assert stiffness is not None
        play = f", play {_millimetres(brace.play)}" if brace.play else ""
        return f"brace {short(stiffness / 1e6)} kN/mm{play}"
    return ""


def _of_storey(values: float | tuple[float, ...] | None, index: int) -> float | None:
    return values[index] if isinstance(values, tuple) else values


def _layers(count: int, area: float, thickness: float) -> str:
    return f"{count} layer{'s' * (count > 1)} of {_area(area)} × {_millimetres(thickness)}"


def _area(area: float | None) -> str:
    assert area is not None
    return f"{short(area)} m²" if area >= 0.01 else f"{short(area * 1e4)} cm²"


def _millimetres(length: float | None) -> str:
    assert length is not None
    return f"{short(1e3 * length)} mm"


def steels_of(members: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Return the kinds of members that each material is of, in words.

    Args:
        members: kind (`column`, `beam`, `brace`) and material of each.
    """
    found: dict[str, dict[str, None]] = {}
    for kind, material in members:
        found.setdefault(material, {})[f"{kind}s"] = None
    return {name: "all members" if len(found) == 1 else ", ".join(kinds) for name, kinds in found.items()}


def several_steels(members: Iterable[tuple[str, str]]) -> set[str]:
    """Return the kinds of members of which there are several materials, so that each member has to name its own."""
    found: dict[str, set[str]] = {}
    for kind, material in members:
        found.setdefault(kind, set()).add(material)
    return {kind for kind, materials in found.items() if len(materials) > 1}


def chosen(what: str, selection: NumberSelection | LineSelection) -> str:
    """Return a selection in words: `all bays`, `bay 1`, `bays 1, 3`.

    Args:
        what: the word for one of them, such as `bay`.
    """
    text = str(selection)
    if text == "all":
        return f"all {what}s"
    return f"{what} {text}" if text.isalnum() else f"{what}s {text.strip('[]')}"


def in_two_lines(words: str, blank: str = " (") -> list[str]:
    """Return a text in one line, and if it has that blank in two: ways to write it, see `Sheet.place`."""
    return list(dict.fromkeys((words, words.replace(blank, f"{blank.rstrip(' (')}\n{blank.lstrip(' ,')}", 1))))


def section_words(name: str, section: Section | SpaceSection) -> str:
    """Return the dimensions of a section that the project or building defines, in words."""
    if isinstance(section, PlateSection):
        sizes = " × ".join(f"{1e3 * value:g}" for value in (section.height, section.width))
        return f"{name}: welded I {sizes} mm, flanges {1e3 * section.flange:g} mm, web {1e3 * section.web:g} mm"
    if isinstance(section, BoxSection):
        sizes = " × ".join(f"{1e3 * value:g}" for value in (section.height, section.width))
        return f"{name}: welded box {sizes} mm, flanges {1e3 * section.flange:g} mm, webs {1e3 * section.web:g} mm"
    if isinstance(section, RivetedSection):
        web, covers = f"{1e3 * section.height:g} × {1e3 * section.web:g} mm", ""
        if section.covers is not None:
            covers = f", covers {1e3 * section.covers.width:g} × {1e3 * section.covers.thickness:g} mm"
        return f"{name}: riveted I, web {web}, 4 {section.angles}{covers}"
    if isinstance(section, SpaceElasticSection):
        given = {"I_y": section.inertia, "I_z": section.weak_inertia, "I_t": section.torsion_constant}
        inertias = "".join(f", {key} = {short(of * 1e8)} cm⁴" for key, of in given.items() if of is not None)
        return f"{name}: elastic, not checked, A = {short(section.area * 1e4)} cm²{inertias}"
    if isinstance(section, ElasticSection):
        inertia = f", I = {short(section.inertia * 1e8)} cm⁴" if section.inertia is not None else ""
        return f"{name}: elastic, A = {short(section.area * 1e4)} cm²{inertia}"
    parts = [f"{1e3 * one.width:g} × {1e3 * one.depth:g} mm at {1e3 * one.centre:g} mm" for one in section.rectangles]
    return f"{name}: rectangles {', '.join(parts[:4])}{' …' if len(parts) > 4 else ''}"
