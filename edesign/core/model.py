"""The numerical model of a plane frame: a thin typed layer over the C core."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, assert_never

import numpy as np
from numpy.typing import ArrayLike

from edesign.core._edcore import ffi, lib
from edesign.core.damper import LawValues, effect_number, law_number, placement_number
from edesign.core.errors import CoreError, status_name
from edesign.core.materials import Bilinear, Elastic, Fatigue, MenegottoPinto, Steel
from edesign.core.springs import SpringLaw

GEOMETRY = {"linear": lib.ED_LINEAR, "p_delta": lib.ED_P_DELTA, "corotational": lib.ED_COROTATIONAL}


class Model:
    """Nodes, elements, masses, supports and load patterns, in SI units.

    Three degrees a node: ux, uy (upwards), rz (anticlockwise). Ids are the integers that the methods return. Materials
    come before sections. Every method raises CoreError with a message for people when the core refuses its arguments.
    """

    def __init__(self) -> None:
        self._frozen = False
        self._handle = ffi.gc(lib.ed_model_new(), lib.ed_model_free)
        if self._handle == ffi.NULL:
            raise MemoryError
        self.node_names: list[str] = []
        self.element_names: list[str] = []
        self.element_sections: list[int] = []
        self.node_xy: list[tuple[float, float]] = []
        self.damper_names: list[str] = []
        self.damper_terms: list[tuple[tuple[float, int, int], ...]] = []

    def freeze(self) -> Any:
        """Return the core's handle, for Analysis, and freeze the model.

        Nothing can be added afterwards, because analyses refer to what is here.
        """
        self._frozen = True
        return self._handle

    @property
    def _c(self) -> Any:
        if self._frozen:
            raise RuntimeError("the model cannot change once an analysis has been made of it")
        return self._handle

    def _checked(self, result: int) -> int:
        if result < 0:
            message = ffi.string(lib.ed_model_message(self._handle)).decode(errors="replace")
            raise CoreError(status_name(result), message)
        return result

    def material(self, law: Steel, fatigue: Fatigue | None = None) -> int:
        """Add a uniaxial law, whose fibres break by `fatigue` if it is given.

        Returns:
            Number of the material.
        """
        match law:
            case Elastic(E):
                kind, values = lib.ED_ELASTIC, [E]
            case Bilinear(E, fy, b):
                kind, values = lib.ED_BILINEAR, [E, fy, b]
            case MenegottoPinto(E, fy, b, R0, cR1, cR2):
                kind, values = lib.ED_MENEGOTTO_PINTO, [E, fy, b, R0, cR1, cR2]
            case _:
                assert_never(law)
        number = self._checked(lib.ed_model_material(self._c, kind, len(values), values))
        if fatigue is not None:
            self._checked(lib.ed_model_fatigue(self._c, number, fatigue.strain, -1.0 / fatigue.exponent))
        return number

    def elastic_section(self, EA: float, EI: float) -> int:
        """Add an elastic section.

        Args:
            EA: N.
            EI: N m2.

        Returns:
            Number of the section.
        """
        return self._checked(lib.ed_model_elastic_section(self._c, EA, EI))

    def fibre_section(self, y: ArrayLike, area: ArrayLike, material: int | ArrayLike) -> int:
        """Add a section of fibres; those at one depth are merged exactly.

        Args:
            y: (n,) depths, m.
            area: (n,) m2.
            material: one number, or (n,).

        Returns:
            Number of the section.

        Raises:
            ValueError: there are not as many areas as depths, or the materials do not fit them.
        """
        depth = np.ascontiguousarray(y, dtype=float).ravel()
        areas = np.ascontiguousarray(area, dtype=float).ravel()
        laws = np.ascontiguousarray(np.broadcast_to(material, depth.shape), dtype=np.int32)
        if areas.shape != depth.shape:
            raise ValueError(f"{depth.size} depths and {areas.size} areas")
        return self._checked(
            lib.ed_model_fibre_section(
                self._c,
                depth.size,
                ffi.from_buffer("double[]", depth),
                ffi.from_buffer("double[]", areas),
                ffi.from_buffer("int[]", laws),
            )
        )

    def layers(self, section: int) -> int:
        """Return the number of layers of a fibre section after merging."""
        return self._checked(lib.ed_model_section_layers(self._handle, section))

    def node(self, name: str, x: float, y: float) -> int:
        """Add a node.

        Args:
            x: m.
            y: m.

        Returns:
            Number of the node.
        """
        result = self._checked(lib.ed_model_node(self._c, name.encode(), x, y))
        self.node_names.append(name)
        self.node_xy.append((x, y))
        return result

    def fix(self, node: int, ux: bool = False, uy: bool = False, rz: bool = False) -> None:
        """Support degrees of a node.

        Args:
            ux: fix the horizontal displacement.
            uy: fix the vertical displacement.
            rz: fix the rotation.
        """
        self._checked(lib.ed_model_fix(self._c, node, ux, uy, rz))

    def tie(self, node: int, master: int, ux: bool = False, uy: bool = False, rz: bool = False) -> None:
        """Let degrees of a node be those of another one (rigid diaphragm: ux).

        Args:
            ux: tie the horizontal displacement.
            uy: tie the vertical displacement.
            rz: tie the rotation.
        """
        self._checked(lib.ed_model_tie(self._c, node, master, ux, uy, rz))

    def mass(self, node: int, mx: float, my: float = 0.0, mrz: float = 0.0) -> None:
        """Add lumped mass to a node.

        Args:
            mx: along x, kg.
            my: along y, kg.
            mrz: against rotation, kg m2.
        """
        self._checked(lib.ed_model_mass(self._c, node, mx, my, mrz))

    def _element(self, name: str, result: int, section: int) -> int:
        self._checked(result)
        self.element_names.append(name)
        self.element_sections.append(section)
        return result

    def beam_column(
        self,
        name: str,
        i: int,
        j: int,
        section: int | Sequence[int],
        points: int = 5,
        geometry: str = "p_delta",
        release: tuple[bool, bool] = (False, False),
        breaks: Sequence[float] = (),
    ) -> int:
        """Add a beam-column: force-based for fibre sections, closed form for an elastic one.

        Args:
            name: of the element.
            i: number of the node at its start.
            j: number of the node at its end.
            section: one id, or one id for each Gauss-Lobatto point.
            points: Gauss-Lobatto points, 2 to 10.
            geometry: "linear", "p_delta" or "corotational".
            release: moment-free ends i, j.
            breaks: rising positions 0..1 of its length, between which a force-based member of one section is integrated
                piece by piece, by `points` in each: where loads begin, end or stand.

        Returns:
            Number of the element.

        Raises:
            ValueError: there are not as many sections as points.
        """
        ids = [section] * points if isinstance(section, int) else list(section)
        if isinstance(section, int) and 0 <= section and lib.ed_model_section_layers(self._c, section) == 0:
            result = lib.ed_model_elastic_beam(self._c, name.encode(), i, j, section, GEOMETRY[geometry], *release)
            return self._element(name, result, section)
        if len(ids) != points:
            raise ValueError(f"element {name}: {len(ids)} sections for {points} points")
        result = lib.ed_model_beam_column(self._c, name.encode(), i, j, points, ids, GEOMETRY[geometry], *release)
        self._element(name, result, ids[0])
        if breaks:
            self._checked(lib.ed_model_breaks(self._c, result, len(breaks), list(breaks)))
        return result

    def rigid_ends(self, element: int, start: float, end: float) -> None:
        """Let the first and the last part of a beam-column not bend; its end forces are those where it begins to.

        Args:
            start: length of the first part, m.
            end: length of the last part, m.
        """
        self._checked(lib.ed_model_rigid_ends(self._c, element, start, end))

    def truss(self, name: str, i: int, j: int, material: int, area: float, geometry: str = "linear") -> int:
        """Add a pin-ended bar.

        Args:
            name: of the element.
            i: number of the node at its start.
            j: number of the node at its end.
            area: m2.
            geometry: "linear", "p_delta" or "corotational".

        Returns:
            Number of the element.
        """
        result = lib.ed_model_truss(self._c, name.encode(), i, j, material, area, GEOMETRY[geometry])
        return self._element(name, result, -1)

    def strut(
        self,
        name: str,
        i: int,
        j: int,
        section: int,
        material: int,
        area: float,
        camber: float,
        elements: int = 4,
        points: int = 5,
        buckling_length: float = 1.0,
        end_stiffness: float = 0.0,
        geometry: str = "linear",
    ) -> int:
        """Add a brace that buckles between its ends: fibre beams with camber, condensed to one bar of the frame.

        Args:
            name: of the element.
            i: number of the node at its start.
            j: number of the node at its end.
            section: of fibres, bending as the brace buckles.
            material: of the straight bar that the rest of the brace is.
            area: of that bar, m2.
            camber: of the first mode / buckling length.
            elements: over the buckling length, even, 2 to 16.
            points: Gauss-Lobatto points of each of them, 3 to 10.
            buckling_length: / length between the nodes, above 0, at most 1.
            end_stiffness: rotational, of each end against the chord, N m/rad; 0 pinned, infinite fixed.
            geometry: of the chord.

        Returns:
            Number of the element.

        Source: Uriz, Filippou & Mahin (2008), J. Struct. Eng. 134(4), 619-628.
        """
        result = lib.ed_model_strut(
            self._c,
            name.encode(),
            i,
            j,
            section,
            points,
            elements,
            camber,
            buckling_length,
            end_stiffness,
            material,
            area,
            GEOMETRY[geometry],
        )
        return self._element(name, result, section)

    def link(self, name: str, i: int, j: int, stiffness: tuple[float, float, float], angle: float = 0.0) -> int:
        """Add an elastic link.

        Between two places local x runs along the link and shear acts at mid-length.

        Args:
            name: of the element.
            i: number of the node at its start.
            j: number of the node at its end.
            stiffness: along local x and y, N/m, and in rotation, N m/rad.
            angle: of local x if both nodes are at one place, rad.

        Returns:
            Number of the element.
        """
        return self._element(name, lib.ed_model_link(self._c, name.encode(), i, j, *stiffness, angle), -1)

    def spring(self, name: str, i: int, j: int, terms: Sequence[float], law: SpringLaw) -> int:
        """Add a spring without length.

        Args:
            name: of the element.
            i: number of the first node.
            j: number of the second node.
            terms: coefficients of ux, uy, rz at i and of those at j (6,) whose sum is its deformation; between turns of
                two nodes at one place (0, 0, -1, 0, 0, 1).
            law: of its force and deformation.

        Returns:
            Number of the element.
        """
        kind, values = law.parameters()
        result = lib.ed_model_spring(self._c, name.encode(), i, j, [float(c) for c in terms], kind, len(values), values)
        return self._element(name, result, -1)

    def without_flexibility(self, element: int, at_i: float, at_j: float) -> None:
        """Let the ends of an elastic beam leave out flexibilities that springs beside them have.

        Args:
            at_i: at its start, rad/(N m).
            at_j: at its end, rad/(N m).
        """
        self._checked(lib.ed_model_without_flexibility(self._c, element, at_i, at_j))

    def damping_factor(self, element: int, factor: float) -> None:
        """Multiply the stiffness of an element where damping is proportional to it.

        Args:
            factor: dimensionless.
        """
        self._checked(lib.ed_model_damping_factor(self._c, element, factor))

    def damper(
        self,
        name: str,
        law: LawValues,
        terms: Sequence[tuple[float, int, int]],
        brace: float = 0.0,
        force_scale: float = 1.0,
        deformation_scale: float = 1.0,
        play: float = 0.0,
        carries: bool = False,
        pressed_by: tuple[int, float] | None = None,
    ) -> int:
        """Add a damper; it carries nothing before `Analysis.install_dampers` unless it carries from the beginning.

        Args:
            law: the law with its parameters and effects.
            terms: (coefficient, node, degree) of each displacement that its deformation is the sum of; degrees 0 ux, 1
                uy, 2 rz. They should have mass.
            brace: stiffness in series at the size of the device, N/m; 0: rigid.
            force_scale: force of the device over that of the law, F = force_scale * law(deformation_scale * u).
            deformation_scale: deformation of the law over that of the device.
            play: of the pins of the brace, from end to end, m.
            carries: whether it acts from the beginning, gravity included: a bearing that holds what stands on it.
            pressed_by: a spring and a weight (N): in histories the force is multiplied by the compression of the spring
                over the weight, none where it is pulled.

        Returns:
            Number of the damper.
        """
        number = lib.ed_model_damper(
            self._c,
            name.encode(),
            law_number(law.law),
            len(law.values),
            list(law.values),
            brace,
            play,
            force_scale,
            deformation_scale,
            len(terms),
            [node for _, node, _ in terms],
            [degree for _, _, degree in terms],
            [coefficient for coefficient, _, _ in terms],
        )
        self._checked(number)
        if carries:
            self._checked(lib.ed_model_damper_carries(self._c, number))
        if pressed_by is not None:
            self._checked(lib.ed_model_damper_weighs(self._c, number, *pressed_by))
        for effect in law.effects:
            form, values = effect_number(effect.name), list(effect.values)
            place = placement_number(effect.placement)
            self._checked(lib.ed_model_add_damper_effect(self._c, number, form, place, len(values), values))
        self.damper_names.append(name)
        self.damper_terms.append(tuple(terms))
        return number

    def pattern(self) -> int:
        """Add a load pattern.

        Returns:
            Number of the pattern.
        """
        return self._checked(lib.ed_model_pattern(self._c))

    def nodal_load(self, pattern: int, node: int, fx: float = 0.0, fy: float = 0.0, mz: float = 0.0) -> None:
        """Add a force and a moment on a node.

        Args:
            fx: N.
            fy: N.
            mz: N m.
        """
        self._checked(lib.ed_model_nodal_load(self._c, pattern, node, fx, fy, mz))

    def uniform_load(self, pattern: int, element: int, axial: float = 0.0, transverse: float = 0.0) -> None:
        """Add a load along a beam-column in its local axes.

        Args:
            axial: N/m.
            transverse: N/m.
        """
        self._checked(lib.ed_model_uniform_load(self._c, pattern, element, axial, transverse))

    def point_load(
        self, pattern: int, element: int, position: float, axial: float = 0.0, transverse: float = 0.0
    ) -> None:
        """Add a force on a beam-column in its local axes.

        Args:
            position: 0 to 1 of its length.
            axial: N.
            transverse: N.
        """
        self._checked(lib.ed_model_point_load(self._c, pattern, element, position, axial, transverse))

    def partial_load(
        self, pattern: int, element: int, start: float, end: float, at_start: float, at_end: float
    ) -> None:
        """Add a linear load across a beam-column between two positions.

        Args:
            start: first position, 0 to 1 of its length.
            end: last position, 0 to 1 of its length.
            at_start: load there, N/m.
            at_end: load there, N/m.
        """
        self._checked(lib.ed_model_partial_load(self._c, pattern, element, start, end, at_start, at_end))
