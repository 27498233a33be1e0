"""The yield strength of thick parts: steels of a building by the thickness of the sections that are made of them."""

from __future__ import annotations

import re
from typing import TypeVar

from edesign.codes.ec3.materials import GRADES, Standard, thickness_step, yield_stress
from edesign.errors import InputError
from edesign.frame.sections.own_section import section_of
from edesign.frame.sections.restrained_core import core_name
from edesign.project.building.building import Building, Steel
from edesign.project.building.members import BeamRun, BraceRun, ColumnRun
from edesign.project.frame.sections import ElasticSection
from edesign.project.project import Project

Run = TypeVar("Run", ColumnRun, BeamRun, BraceRun)
_GRADE = re.compile(r"(S235|S275|S355|S450)(?:JR|J0|J2|K2)?H?")
_THIN, _NAMED = 1e-3, 3
"""A thickness in the first step of all tables, m; sections that a warning names."""
_STIFFER = re.compile(r"_x[0-9.]+$")
"""What `edesign extract` adds to the name of the steel of beams that a slab stiffens."""


def steel_by_thickness(building: Building, section: str, material: str) -> tuple[str, Steel]:
    """Return the steel that a section is made of, and its name: `S275_t40` for parts above 16 and up to 40 mm.

    f_y is that of the thickest part. Without `design.members.yield_by_thickness`, and in the first step of thickness,
    it is the material of the file.

    Args:
        material: one of the file's.

    Returns:
        Name of the steel, and the steel.

    Raises:
        InputError: as `yield_by_thickness`.
    """
    steel = building.materials[material]
    standard = _standard(building)
    if standard is None or core_name(section) is not None:  # that of a core is its manufacturer's
        return material, steel
    fy, grade, thickness = yield_by_thickness(building, section, material, steel.fy, standard)
    if fy == yield_stress(grade, _THIN, standard):
        return material, steel
    name = f"{material}_t{1e3 * thickness_step(grade, thickness, standard):g}"
    if name in building.materials and building.materials[name].fy != fy:
        raise InputError(
            f"{building.where('materials', name)}: materials.{name}: edesign gives this name; take another [E-NAME-02]"
        )
    return name, steel.model_copy(update={"fy": fy})


def yield_by_thickness(
    file: Building | Project, section: str, material: str, given: float, standard: Standard
) -> tuple[float, str, float]:
    """Return the yield strength of a section by its thickest part.

    Args:
        material: its steel in the file, whose name is that of a grade.
        given: f_y of the material, Pa.
        standard: whose table is taken.

    Returns:
        f_y, Pa, the grade, and the thickness of the thickest part, m.

    Raises:
        InputError: the name of the material is no grade, its f_y is not that of the grade, or the section is thicker
            than any part that the standard knows.
    """
    match = _GRADE.fullmatch(_STIFFER.sub("", material))
    where = file.where("materials", material)
    if match is None:
        raise InputError(
            f"{where}: materials.{material}: yield_by_thickness needs the name of a grade, S235, S275, S355 or S450, "
            "with or without JR, J0, J2, K2 and H [E-SPACE-09]"
        )
    nominal = yield_stress(match[1], _THIN, standard)
    if abs(given - nominal) > 1.0:
        raise InputError(
            f"{file.where('materials', material, 'fy')}: materials.{material}.fy: {given / 1e6:g} MPa, but "
            f"{standard} has {nominal / 1e6:g} MPa for thin parts; leave yield_by_thickness out for other steels"
            " [E-SPACE-09]"
        )
    of = section_of(file, section)
    thickness = max(of.tw, of.tf)
    try:
        return yield_stress(match[1], thickness, standard), match[1], thickness
    except InputError as error:
        raise InputError(f"{where}: materials.{material}: {section}: {error}") from error


def with_steel_by_thickness(building: Building) -> Building:
    """Return a building whose members are of steels by their thickness, if its file asks for that.

    Raises:
        InputError: as `steel_by_thickness`.
    """
    if _standard(building) is None:
        return building
    materials = dict(building.materials)

    def made(run: Run) -> Run:
        name, materials[name] = steel_by_thickness(building, run.section, run.material)
        return run.model_copy(update={"material": name})

    return building.model_copy(
        update={
            "columns": tuple(made(run) for run in building.columns),
            "beams": tuple(made(run) for run in building.beams),
            "braces": tuple(made(run) for run in building.braces),
            "materials": materials,
        }
    )


def thick_parts(file: Building | Project) -> str:
    """Return a sentence where f_y of thick parts is that of thin ones and `design` does not say that it is meant.

    Steels are grades by their names, others by f_y of their thin parts. Those with less or more than f_y of thin parts
    have what was measured or expected, and cores of buckling-restrained braces that of their manufacturer.

    Args:
        file: from `load_building` or `load_project`.

    Source: EN 10025-2:2004, Table 7.
    """
    if file.design is None or "yield_by_thickness" in file.design.members.model_fields_set:
        return ""
    found: dict[str, float] = {}
    for section, material in dict.fromkeys(_sections(file)):
        fy = getattr(file.materials[material], "fy", 0.0)
        match = _GRADE.fullmatch(_STIFFER.sub("", material))
        grade = next((name for name in GRADES if abs(yield_stress(name, _THIN) - fy) <= 1.0), None)
        if grade is None or (match and match[1] != grade) or isinstance(file.sections.get(section), ElasticSection):
            continue
        shape = section_of(file, section)
        thickness = max(shape.tw, shape.tf)
        try:
            least = yield_stress(grade, max(thickness, _THIN))
        except InputError:
            least = 0.0  # thicker than any
        if least < fy:
            by = f"{least / 1e6:g} MPa" if least else "which is not made"
            found[f"{section} {fy / 1e6:g} MPa ({1e3 * thickness:.4g} mm: {by})"] = thickness
    if not found:
        return ""
    first = sorted(found, key=lambda text: -found[text])
    more = f" and {len(first) - _NAMED} more" if len(first) > _NAMED else ""
    return (
        f"Thick parts have f_y of thin ones, in brackets that of EN 10025-2: {', '.join(first[:_NAMED])}{more}. With "
        "`yield_by_thickness` they have their own."
    )


def _sections(file: Building | Project) -> list[tuple[str, str]]:
    """Section and material of each run of members, but for cores of buckling-restrained braces."""
    frame = file if isinstance(file, Building) else file.frame
    braces = [run for run in frame.braces if core_name(run.section) is None]
    return [(run.section, run.material) for runs in (frame.columns, frame.beams, braces) for run in runs]


def _standard(building: Building) -> Standard | None:
    return building.design.members.yield_by_thickness if building.design is not None else None
