"""The numerical model of a frame in a plane or in space: a thin typed layer over the C core."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, assert_never

import numpy as np
from numpy.typing import ArrayLike

from edesign.core._edcore import ffi, lib
from edesign.core.damper import LawValues, effect_number, law_number, placement_number
from edesign.core.errors import CoreError, status_name
from edesign.core.materials import Bilinear, Elastic, Fatigue, MenegottoPinto, Steel
from edesign.core.springs import SpringLaw

GEOMETRY = {"linear": lib.ED_LINEAR, "p_delta": lib.ED_P_DELTA, "corotational": lib.ED_COROTATIONAL}


PLANE_DEGREES = ("ux", "uy", "rz")
SPACE_DEGREES = ("ux", "uy", "uz", "rx", "ry", "rz")
NO_RELEASE = (False, False, False, False)


class Model:
    """Nodes, elements, masses, supports and load patterns, in SI units.

    In a plane a node has three degrees: ux, uy (upwards), rz (anticlockwise). In space it has six: ux, uy, uz
    (upwards), rx, ry, rz, right-handed. Local x of a member runs from i to j; in space local z is the direction of its
    web, and local y completes a right-handed system. Ids are the integers that the methods return. Materials come
    before sections. Every method raises CoreError with a message for people when the core refuses its arguments.

    Args:
        dimension: 2 or 3.
    """

    def __init__(self, dimension: int = 2) -> None:
        self._frozen = False
        self.dimension = dimension
        self.degrees = SPACE_DEGREES if dimension == 3 else PLANE_DEGREES
        self._handle = ffi.gc(lib.ed_model_new(dimension), lib.ed_model_free)
        if self._handle == ffi.NULL:
            raise MemoryError
        self.node_names: list[str] = []
        self.element_names: list[str] = []
        self.element_sections: list[int] = []
        self.node_places: list[tuple[float, float, float]] = []
        self.masters: dict[int, int] = {}
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

    def elastic_section(self, EA: float, EI: float, EI_y: float = 0.0, GJ: float = 0.0) -> int:
        """Add an elastic section.

        Args:
            EA: N.
            EI: in space about local z, N m2.
            EI_y: in space about local y, N m2.
            GJ: in space, N m2.

        Returns:
            Number of the section.
        """
        return self._checked(lib.ed_model_elastic_section(self._c, [EA, EI, EI_y, GJ]))

    def fibre_section(
        self,
        y: ArrayLike,
        area: ArrayLike,
        material: int | ArrayLike,
        z: ArrayLike | None = None,
        GJ: float = 0.0,
        stress: ArrayLike | None = None,
    ) -> int:
        """Add a section of fibres; those at one place are merged exactly.

        In space the strain is e0 - kappa_z y + kappa_y z, and torsion is elastic beside it, without warping.

        Args:
            y: (n,) depths, in space along local y, m.
            area: (n,) m2.
            material: one number, or (n,).
            z: in space (n,) along local z, m; None for a section in one plane, as buckling braces have.
            GJ: in space, N m2.
            stress: (n,) Pa before any load, in equilibrium and below yield; of bilinear laws alone.

        Returns:
            Number of the section.

        Raises:
            ValueError: there are not as many areas as depths, or the materials or stresses do not fit them.
        """
        depth = np.ascontiguousarray(y, dtype=float).ravel()
        across = None if z is None else np.ascontiguousarray(z, dtype=float).ravel()
        areas = np.ascontiguousarray(area, dtype=float).ravel()
        laws = np.ascontiguousarray(np.broadcast_to(material, depth.shape), dtype=np.int32)
        initial = None if stress is None else np.ascontiguousarray(stress, dtype=float).ravel()
        if areas.shape != depth.shape or any(of is not None and of.shape != depth.shape for of in (across, initial)):
            raise ValueError(f"{depth.size} depths and {areas.size} areas")
        return self._checked(
            lib.ed_model_stressed_section(
                self._c,
                depth.size,
                ffi.from_buffer("double[]", depth),
                ffi.NULL if across is None else ffi.from_buffer("double[]", across),
                ffi.from_buffer("double[]", areas),
                ffi.from_buffer("int[]", laws),
                ffi.NULL if initial is None else ffi.from_buffer("double[]", initial),
                GJ,
            )
        )

    def layers(self, section: int) -> int:
        """Return the number of layers of a fibre section after merging."""
        return self._checked(lib.ed_model_section_layers(self._handle, section))

    def node(self, name: str, x: float, y: float, z: float = 0.0) -> int:
        """Add a node.

        Args:
            x: m.
            y: m.
            z: in space, m.

        Returns:
            Number of the node.
        """
        self._only_in_space(z=z)
        result = self._checked(lib.ed_model_node(self._c, name.encode(), [x, y, z]))
        self.node_names.append(name)
        self.node_places.append((x, y, z))
        return result

    def _only_in_space(self, **values: float) -> None:
        """Refuse what a plane frame would leave out without a word."""
        given = [name for name, value in values.items() if value and self.dimension == 2]
        if given:
            raise ValueError(f"a plane frame has no {', '.join(given)}")

    def _over_degrees(self, values: Mapping[str, float]) -> list[Any]:
        """Return values in the order of the degrees; of a plane frame those of space must be 0."""
        unknown = [name for name, value in values.items() if value and name not in self.degrees]
        if unknown:
            raise ValueError(f"a plane frame has no degree {', '.join(unknown)}")
        return [values[name] for name in self.degrees]

    def fix(
        self,
        node: int,
        ux: bool = False,
        uy: bool = False,
        rz: bool = False,
        *,
        uz: bool = False,
        rx: bool = False,
        ry: bool = False,
    ) -> None:
        """Support degrees of a node.

        Args:
            ux: fix the displacement along x.
            uy: fix the displacement along y.
            rz: fix the rotation about z.
            uz: in space, fix the vertical displacement.
            rx: in space, fix the rotation about x.
            ry: in space, fix the rotation about y.
        """
        fixed = {"ux": ux, "uy": uy, "uz": uz, "rx": rx, "ry": ry, "rz": rz}
        self._checked(lib.ed_model_fix(self._c, node, self._over_degrees(fixed)))

    def tie(
        self,
        node: int,
        master: int,
        ux: bool = False,
        uy: bool = False,
        rz: bool = False,
        *,
        uz: bool = False,
        rx: bool = False,
        ry: bool = False,
    ) -> None:
        """Let degrees of a node be those of another one (rigid floor of a plane frame: ux).

        Args:
            ux: tie the displacement along x.
            uy: tie the displacement along y.
            rz: tie the rotation about z.
            uz: in space, tie the vertical displacement.
            rx: in space, tie the rotation about x.
            ry: in space, tie the rotation about y.
        """
        tied = {"ux": ux, "uy": uy, "uz": uz, "rx": rx, "ry": ry, "rz": rz}
        self._checked(lib.ed_model_tie(self._c, node, master, self._over_degrees(tied)))

    def diaphragm(self, master: int, nodes: Sequence[int]) -> None:
        """Let ux, uy and rz of nodes in space follow a master as a body that is rigid in plan and turns a little.

        Args:
            master: a node at the centre of mass of the diaphragm, so that the masses stay uncoupled. Supports of the
                diaphragm in plan are supports of its master.
            nodes: their numbers, without that of the master.
        """
        self._checked(lib.ed_model_diaphragm(self._c, master, len(nodes), list(nodes)))
        self.masters |= dict.fromkeys(nodes, master)

    def on_masters(self, terms: Sequence[tuple[float, int, int]]) -> tuple[tuple[float, int, int], ...]:
        """Return terms (coefficient, node, degree) with those in plan of nodes of diaphragms put on their masters."""
        found: list[tuple[float, int, int]] = []
        for coefficient, node, degree in terms:
            master = self.masters.get(node)
            if master is None or self.degrees[degree] not in ("ux", "uy", "rz"):
                found.append((coefficient, node, degree))
                continue
            found.append((coefficient, master, degree))
            if degree < 2:
                lever = self.levers(node)[degree]
                found.append((coefficient * lever, master, self.degrees.index("rz")))
        return tuple(found)

    def levers(self, node: int) -> tuple[float, float]:
        """Return what ux and uy of a node of a diaphragm are of the turn of its master, m/rad."""
        (x, y, _), (x0, y0, _) = self.node_places[node], self.node_places[self.masters[node]]
        return y0 - y, x - x0

    def mass(
        self,
        node: int,
        mx: float,
        my: float = 0.0,
        mrz: float = 0.0,
        *,
        mz: float = 0.0,
        mrx: float = 0.0,
        mry: float = 0.0,
    ) -> None:
        """Add lumped mass to a node.

        Args:
            mx: along x, kg.
            my: along y, kg.
            mrz: against rotation about z, kg m2.
            mz: in space, along z, kg.
            mrx: in space, against rotation about x, kg m2.
            mry: in space, against rotation about y, kg m2.
        """
        masses = {"ux": mx, "uy": my, "uz": mz, "rx": mrx, "ry": mry, "rz": mrz}
        self._checked(lib.ed_model_mass(self._c, node, self._over_degrees(masses)))

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
        release: Sequence[bool] = NO_RELEASE,
        breaks: Sequence[float] = (),
        web: Sequence[float] = (0.0, 0.0, 0.0),
    ) -> int:
        """Add a beam-column: force-based for fibre sections, closed form for an elastic one.

        Args:
            name: of the element.
            i: number of the node at its start.
            j: number of the node at its end.
            section: one id, or one id for each Gauss-Lobatto point.
            points: Gauss-Lobatto points, 2 to 10.
            geometry: "linear", "p_delta" or "corotational".
            release: moment-free ends: i, j; in space about y at i, about z at i, about y at j, about z at j.
            breaks: rising positions 0..1 of its length, between which a force-based member of one section is integrated
                piece by piece, by `points` in each: where loads begin, end or stand.
            web: in space the direction of local z, of length 1 and at right angles to the member.

        Returns:
            Number of the element.

        Raises:
            ValueError: there are not as many sections as points, or in space no 4 releases or 3 components of the web.
        """
        if self.dimension == 3 and (len(release) != 4 or len(web) != 3):
            raise ValueError(f"element {name}: {len(release)} releases of 4, {len(web)} components of its web of 3")
        ids = [section] * points if isinstance(section, int) else list(section)
        free = [bool(release[k]) for k in ((1, 3, 0, 2) if self.dimension == 3 else (0, 1))]
        shape = GEOMETRY[geometry]
        if isinstance(section, int) and 0 <= section and lib.ed_model_section_layers(self._c, section) == 0:
            result = lib.ed_model_elastic_beam(self._c, name.encode(), i, j, section, shape, free, list(web))
            return self._element(name, result, section)
        if len(ids) != points:
            raise ValueError(f"element {name}: {len(ids)} sections for {points} points")
        result = lib.ed_model_beam_column(self._c, name.encode(), i, j, points, ids, shape, free, list(web))
        self._element(name, result, ids[0])
        if breaks:
            self._checked(lib.ed_model_breaks(self._c, result, len(breaks), list(breaks)))
        return result

    def rigid_ends(self, element: int, start: float, end: float) -> None:
        """Let the ends of a beam-column not bend; its end forces are those where it begins to.

        Args:
            start: length of the first part, m.
            end: length of the last part, m.
        """
        self._checked(lib.ed_model_rigid_ends(self._c, element, start, end))

    def offset_ends(self, element: int, at_i: Sequence[float], at_j: Sequence[float]) -> None:
        """Let what bends of a beam-column in space begin and end beside its nodes, on rigid arms.

        Its end forces are those where it begins to bend. Local x runs between these ends, and a web that is not at
        right angles to it is turned until it is. Loads are of the length along local x, and where an arm covers some
        of it, they stand on the arm. Linear geometry takes the arms as they stand, P-Delta their turns to the second
        order, corotational geometry exactly.

        Args:
            at_i: from its first node to where it begins to bend, (3,) m in global axes.
            at_j: from its second node to where it ends to bend, (3,) m in global axes.

        Raises:
            ValueError: an offset has no 3 components.
        """
        if len(at_i) != 3 or len(at_j) != 3:
            raise ValueError(f"offsets of {len(at_i)} and {len(at_j)} components, not 3")
        self._checked(lib.ed_model_offset_ends(self._c, element, [float(x) for x in at_i], [float(x) for x in at_j]))

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
        """Add an elastic link in a plane.

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
            terms: coefficients of the degrees at i and of those at j, (6,) or in space (12,), whose sum is its
                deformation; between turns of two nodes at one place in a plane (0, 0, -1, 0, 0, 1), in space the
                components of the axis in the places of the rotations, less those at i.
            law: of its force and deformation.

        Returns:
            Number of the element.

        Raises:
            ValueError: there are not as many coefficients as degrees.
        """
        if len(terms) != 2 * len(self.degrees):
            raise ValueError(f"spring {name}: {len(terms)} coefficients of {2 * len(self.degrees)} degrees")
        kind, values = law.parameters()
        result = lib.ed_model_spring(self._c, name.encode(), i, j, [float(c) for c in terms], kind, len(values), values)
        return self._element(name, result, -1)

    def without_flexibility(self, element: int, at_i: float, at_j: float, about_y: bool = False) -> None:
        """Let the ends of an elastic beam leave out flexibilities that springs beside them have.

        Args:
            at_i: at its start, rad/(N m).
            at_j: at its end, rad/(N m).
            about_y: in space, of bending about local y, else about local z; each has its own.
        """
        self._checked(lib.ed_model_without_flexibility(self._c, element, about_y, at_i, at_j))

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
        across: tuple[str, Sequence[tuple[float, int, int]]] | None = None,
    ) -> int:
        """Add a damper; it carries nothing before `Analysis.install_dampers` unless it carries from the beginning.

        Args:
            terms: (coefficient, node, degree) of each displacement that its deformation is the sum of; degrees are
                places in `degrees`. They should have mass.
            brace: stiffness in series at the size of the device, N/m; 0: rigid.
            force_scale: force of the device over that of the law, F = force_scale * law(deformation_scale * u).
            deformation_scale: deformation of the law over that of the device.
            play: of the pins of the brace, from end to end, m.
            carries: whether it acts from the beginning, gravity included: a bearing that holds what stands on it.
            pressed_by: a spring and a weight (N): in histories the force is multiplied by the compression of the spring
                over the weight, none where it is pulled.
            across: name and terms of a second deformation at right angles to the first: a bearing, whose forces in both
                directions lie within a circle. It is the damper of the next number. The law is one of `CIRCULAR`.

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
        self.damper_terms.append(self.on_masters(terms))
        if across is not None:
            name, terms = across
            nodes, degrees = [node for _, node, _ in terms], [degree for _, _, degree in terms]
            coefficients = [coefficient for coefficient, _, _ in terms]
            arguments = (number, name.encode(), len(terms), nodes, degrees, coefficients)
            self._checked(lib.ed_model_damper_across(self._c, *arguments))
            self.damper_names.append(name)
            self.damper_terms.append(self.on_masters(terms))
        return number

    def pattern(self) -> int:
        """Add a load pattern.

        Returns:
            Number of the pattern.
        """
        return self._checked(lib.ed_model_pattern(self._c))

    def nodal_load(
        self,
        pattern: int,
        node: int,
        fx: float = 0.0,
        fy: float = 0.0,
        mz: float = 0.0,
        *,
        fz: float = 0.0,
        mx: float = 0.0,
        my: float = 0.0,
    ) -> None:
        """Add forces and moments on a node.

        Args:
            fx: N.
            fy: N.
            mz: N m.
            fz: in space, N.
            mx: in space, N m.
            my: in space, N m.
        """
        loads = {"ux": fx, "uy": fy, "uz": fz, "rx": mx, "ry": my, "rz": mz}
        self._checked(lib.ed_model_nodal_load(self._c, pattern, node, self._over_degrees(loads)))

    def uniform_load(
        self, pattern: int, element: int, axial: float = 0.0, transverse: float = 0.0, transverse_z: float = 0.0
    ) -> None:
        """Add a load along a beam-column in its local axes.

        Args:
            axial: N/m.
            transverse: along local y, N/m.
            transverse_z: in space, along local z, N/m.
        """
        self._only_in_space(transverse_z=transverse_z)
        self._checked(lib.ed_model_uniform_load(self._c, pattern, element, axial, [transverse, transverse_z]))

    def point_load(
        self,
        pattern: int,
        element: int,
        position: float,
        axial: float = 0.0,
        transverse: float = 0.0,
        transverse_z: float = 0.0,
    ) -> None:
        """Add a force on a beam-column in its local axes.

        Args:
            position: 0 to 1 of its length.
            axial: N.
            transverse: along local y, N.
            transverse_z: in space, along local z, N.
        """
        self._only_in_space(transverse_z=transverse_z)
        self._checked(lib.ed_model_point_load(self._c, pattern, element, position, axial, [transverse, transverse_z]))

    def partial_load(
        self, pattern: int, element: int, start: float, end: float, at_start: float, at_end: float
    ) -> None:
        """Add a linear load across a beam-column, along local y, between two positions.

        Args:
            start: first position, 0 to 1 of its length.
            end: last position, 0 to 1 of its length.
            at_start: load there, N/m.
            at_end: load there, N/m.
        """
        across = [at_start, 0.0], [at_end, 0.0]
        self._checked(lib.ed_model_partial_load(self._c, pattern, element, start, end, *across))
