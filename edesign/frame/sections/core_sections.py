"""Materials and sections of a project in the core's model."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from edesign.errors import InputError
from edesign.frame.sections.named_section import cross_section
from edesign.frame.sections.residual_stress import pattern_of, stressed_layers
from edesign.frame.sections.section import CrossSection
from edesign.project.frame.braces import BraceBuckling, Fracture
from edesign.project.frame.materials import BilinearMaterial, ElasticMaterial, Material
from edesign.project.frame.members import BeamRun, BraceRun, ColumnRun
from edesign.project.frame.sections import ElasticSection, SectionAxis
from edesign.project.project import Project

if TYPE_CHECKING:
    from edesign.core import Model, Steel

Run = ColumnRun | BeamRun | BraceRun

ONE_OF_A_PAIR = 0.5
"""Share of its area that a brace has that does not count in compression.

Source: EN 1998-1:2004, 6.7.2(2)P: of a pair the one in tension acts. With half its area each, the pair is as stiff and
as strong as that one.
"""


class CoreSections:
    """Materials and sections of the core's model, each made once; the core wants all materials before any section.

    Args:
        model: of the core, to which they are added.
    """

    def __init__(self, project: Project, model: Model) -> None:
        self._project = project
        self._model = model
        self._shapes: dict[tuple[str, SectionAxis], CrossSection | ElasticSection] = {}
        self._materials: dict[tuple[str, bool], int] = {}
        self._breaking: dict[tuple[str, Fracture], int] = {}
        self._sections: dict[tuple[str, str, SectionAxis, bool], tuple[int, np.ndarray | None]] = {}
        self._buckling: dict[tuple[str, int, SectionAxis], int] = {}
        for run in project.frame.members.values():
            if isinstance(run, BraceRun) or not self._stays_elastic(run):
                self._material(run)
            if isinstance(run, BraceRun) and run.buckling is not None:
                self._fibre_material(run, run.buckling)

    def section(self, run: Run, elastic: bool = False) -> tuple[int, np.ndarray | None]:
        """Return the id of the section of a column or beam, and the depths of its layers.

        An elastic section has no layers: its depths are None.

        Args:
            elastic: whether it is to be elastic whatever its steel.

        Returns:
            Id in the core; depths of the layers, m, or None.
        """
        key = (run.section, run.material, _axis(run), elastic)
        if key not in self._sections:
            self._sections[key] = self._make(run, elastic)
        return self._sections[key]

    def bending_stiffness(self, run: Run) -> float:
        """Return E I of a column or beam, N m2."""
        return self._project.materials[run.material].E * (self._shape(run).inertia or 0.0)

    def brace(self, run: BraceRun) -> tuple[int, float]:
        """Return the material id and the area of a brace; on an elastic section the material is its elastic part.

        Returns:
            Id in the core; area, m2.
        """
        return self._material(run), self._shape(run).area * (1.0 if run.compression else ONE_OF_A_PAIR)

    def buckling_brace(self, run: BraceRun, buckling: BraceBuckling) -> tuple[int, int, float]:
        """Return the ids of the section and of the material of a brace that buckles, and its area.

        Args:
            buckling: how the brace buckles.

        Returns:
            Ids in the core; area, m2.

        Raises:
            InputError: the section has no fibres.
        """
        shape = cross_section(self._project, run.section, buckling.axis)
        if not isinstance(shape, CrossSection):
            where = self._project.where("sections", run.section)
            raise InputError(
                f"{where}: section {run.section}: a brace that buckles needs a section of fibres [E-SECT-01]"
            )
        material = self._fibre_material(run, buckling)
        key = (run.section, material, buckling.axis)
        if key not in self._buckling:
            self._buckling[key] = self._model.fibre_section(*shape.fibres, material)
        return self._buckling[key], self._material(run), shape.area

    def _make(self, run: Run, elastic: bool) -> tuple[int, np.ndarray | None]:
        shape = self._shape(run)
        if isinstance(shape, CrossSection) and not (elastic or self._stays_elastic(run)):
            return self._of_fibres(run, shape)
        if shape.inertia is None:
            where = self._project.where("sections", run.section)
            raise InputError(f"{where}: section {run.section}: a column or beam needs `inertia` [E-SECT-01]")
        modulus = self._project.materials[run.material].E  # the integral over the section in closed form
        return self._model.elastic_section(modulus * shape.area, modulus * shape.inertia), None

    def _of_fibres(self, run: Run, shape: CrossSection) -> tuple[int, np.ndarray]:
        project, weak = self._project, _axis(run) == "weak"
        where, law = project.where("fibres", "residual_stress"), project.materials[run.material]
        rolled = pattern_of(project.fibres, run.section, run.section in project.sections, run.material, law, where)
        if rolled is None:
            depths, areas = shape.fibres
            return self._model.fibre_section(depths, areas, self._material(run)), shape.layers[0]
        depths, areas, stresses = stressed_layers(rolled, shape, weak)
        section = self._model.fibre_section(depths, areas, self._material(run), stress=stresses)
        return section, np.unique(np.stack([depths, stresses], axis=1), axis=0)[:, 0]

    def _stays_elastic(self, run: Run) -> bool:
        law = self._project.materials[run.material]
        return isinstance(law, ElasticMaterial) or isinstance(self._shape(run), ElasticSection)

    def _shape(self, run: Run) -> CrossSection | ElasticSection:
        key = (run.section, _axis(run))
        if key not in self._shapes:
            self._shapes[key] = cross_section(self._project, *key)
        return self._shapes[key]

    def _material(self, run: Run) -> int:
        key = (run.material, self._stays_elastic(run))
        if key not in self._materials:
            self._materials[key] = self._model.material(core_law(self._project.materials[run.material], key[1]))
        return self._materials[key]

    def _fibre_material(self, run: BraceRun, buckling: BraceBuckling) -> int:
        """The material of the fibres of a brace that buckles."""
        if buckling.fracture is None:
            return self._material(run)
        key = (run.material, buckling.fracture)
        if key not in self._breaking:
            from edesign import core

            fatigue = core.Fatigue(buckling.fracture.strain, buckling.fracture.exponent)
            self._breaking[key] = self._model.material(core_law(self._project.materials[run.material], False), fatigue)
        return self._breaking[key]


def _axis(run: Run) -> SectionAxis:
    return "strong" if isinstance(run, BraceRun) else run.axis


def core_law(material: Material, elastic: bool = False) -> Steel:
    """Return the core's description of a material, or of its elastic part."""
    from edesign import core

    if elastic or isinstance(material, ElasticMaterial):
        return core.Elastic(E=material.E)
    if isinstance(material, BilinearMaterial):
        return core.Bilinear(E=material.E, fy=material.fy, b=material.hardening)
    return core.MenegottoPinto(
        E=material.E, fy=material.fy, b=material.hardening, R0=material.R0, cR1=material.cR1, cR2=material.cR2
    )
