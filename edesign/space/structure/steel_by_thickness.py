"""The yield strength of thick parts: steels of a building by the thickness of the sections that are made of them."""

from __future__ import annotations

import re
from typing import TypeVar

from edesign.codes.ec3.materials import Standard, thickness_step, yield_stress
from edesign.errors import InputError
from edesign.frame.sections.own_section import section_of
from edesign.frame.sections.restrained_core import core_name
from edesign.project.building.building import Building, Steel
from edesign.project.building.members import BeamRun, BraceRun, ColumnRun
from edesign.project.project import Project

Run = TypeVar("Run", ColumnRun, BeamRun, BraceRun)
_GRADE = re.compile(r"(S235|S275|S355|S450)(?:JR|J0|J2|K2)?H?")
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
    if fy == yield_stress(grade, 1e-3, standard):
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
    nominal = yield_stress(match[1], 1e-3, standard)
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


def _standard(building: Building) -> Standard | None:
    return building.design.members.yield_by_thickness if building.design is not None else None
