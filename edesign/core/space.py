"""Linear elastic space frames, computed by the core: static cases, natural modes, combination, critical load factor.

Degrees of a node: ux, uy, uz, rx, ry, rz, global, z upwards. Local x of a member runs from its start to its end, local
z along its web, local y completes a right-handed system. End forces are N, V_y, V_z, T, M_y, M_z at the start, then at
the end: local components of what acts on the member. Internal forces are those on the face whose outward normal is +x:
N is positive in tension; at the end they are the end forces, at the start the end forces with the other sign.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from edesign.core._edcore import ffi, lib
from edesign.core.errors import CoreError, status_name
from edesign.core.space_modes import SpaceModes, mass_factor, mass_modes

PROPERTIES = ("E", "G", "A", "A_y", "A_z", "I_t", "I_y", "I_z")
"""Columns of the properties of a member in `SpaceModel.change_sections`."""


@dataclass(frozen=True)
class SpaceMembers:
    """Members as arrays; values in SI.

    Attributes:
        start, end: (m,) numbers of their nodes.
        web: (m, 3) direction of local z, of length 1 and at right angles to the member.
        E, G: (m,) Pa.
        A: (m,) m2.
        A_y, A_z: (m,) shear areas for V_y and V_z, m2; 0: no shear deformation.
        I_t, I_y, I_z: (m,) m4.
        ends: (m, 4) rotational springs y at start, z at start, y at end, z at end, N m/rad; infinite: rigid, 0: pin.
        axial_only: (m,) carries an axial force alone between its ends; of its properties E and A count.
    """

    start: np.ndarray
    end: np.ndarray
    web: np.ndarray
    E: np.ndarray
    G: np.ndarray
    A: np.ndarray
    A_y: np.ndarray
    A_z: np.ndarray
    I_t: np.ndarray
    I_y: np.ndarray
    I_z: np.ndarray
    ends: np.ndarray
    axial_only: np.ndarray

    @property
    def count(self) -> int:
        """Number of members."""
        return len(self.start)


@dataclass(frozen=True)
class Points:
    """Forces on members between their ends.

    Attributes:
        case, member: (p,) of which case and member.
        position: (p,) place as a fraction of the length.
        force: (p, 3) global, N.
    """

    case: np.ndarray
    member: np.ndarray
    position: np.ndarray
    force: np.ndarray


@dataclass(frozen=True)
class Static:
    """Results of c static cases.

    Attributes:
        displacements: (c, n, 6) m and rad.
        end_forces: (c, m, 12) N and N m, local.
        reactions: (c, n, 6) of supports and springs on the frame, N and N m. Those of a restrained diaphragm are at
            the node that restrains it.
    """

    displacements: np.ndarray
    end_forces: np.ndarray
    reactions: np.ndarray


class SpaceModel:
    """A space frame with rigid diaphragms, factored once for many cases. One thread at a time may use a model.

    ux, uy and rz of the nodes of a diaphragm are those of its master, which moves as a rigid body in plan. A node of a
    diaphragm may be restrained in rz, and then, or where it lies on the axis of the master, in ux and uy.

    Args:
        coordinates: (n, 3) m.
        node_floor: (n,) diaphragm of each node, from 0; -1: none.
        masters: (f, 2) place of each master in plan, m; often the centre of mass.
        fixed: (n, 6) True where ux, uy, uz, rx, ry, rz is restrained.
        springs: (n, 6) stiffness to the ground, N/m and N m/rad.
        node_names, member_names: for messages.

    Raises:
        CoreError: the frame is a mechanism, a node is connected to no support, a property is out of range, or the
            direction of a web is not at right angles to its member; the message names the node, degree or member.
        ValueError: an array has another shape than the others ask for.
    """

    def __init__(
        self,
        coordinates: ArrayLike,
        node_floor: ArrayLike,
        masters: ArrayLike,
        fixed: ArrayLike,
        springs: ArrayLike,
        members: SpaceMembers,
        node_names: Sequence[str],
        member_names: Sequence[str],
    ) -> None:
        n, m = len(node_names), len(member_names)
        self.node_names, self.member_names = tuple(node_names), tuple(member_names)
        self.n_nodes, self.n_members = n, m
        self.coordinates = _doubles("coordinates", coordinates, (n, 3))
        self.node_floor = _integers("node_floor", node_floor, n)
        self.masters = _doubles("masters", masters, (np.asarray(masters).size // 2, 2))
        self.n_floors = len(self.masters)
        self._properties = np.empty((m, len(PROPERTIES)))
        for k, name in enumerate(PROPERTIES):
            self._properties[:, k] = _doubles(name, getattr(members, name), (m,))
        arrays = {
            "coordinates": self.coordinates,
            "node_floor": self.node_floor,
            "masters": self.masters,
            "fixed": np.ascontiguousarray(_shaped("fixed", np.asarray(fixed, dtype=bool), (n, 6)), dtype=np.intc),
            "springs": _doubles("springs", springs, (n, 6)),
            "start": _integers("start", members.start, m),
            "end": _integers("end", members.end, m),
            "web": _doubles("web", members.web, (m, 3)),
            "properties": self._properties,
            "ends": _doubles("ends", members.ends, (m, 4)),
            "axial_only": np.ascontiguousarray(
                _shaped("axial_only", np.asarray(members.axial_only, dtype=bool), (m,)), dtype=np.intc
            ),
        }
        data = ffi.new("ed_space_input *")
        data.n_nodes, data.n_floors, data.n_members = n, self.n_floors, m
        keep = [_texts(self.node_names), _texts(self.member_names)]
        data.node_name, data.member_name = keep[0][0], keep[1][0]
        for name, values in arrays.items():
            setattr(data, name, _c(values))
        status, message = ffi.new("int *"), ffi.new("char[]", 1024)
        handle = lib.ed_space_new(data, status, message, 1024)
        if handle == ffi.NULL:
            raise CoreError(status_name(status[0]), ffi.string(message).decode(errors="replace"))
        self._handle = ffi.gc(handle, lib.ed_space_free)
        self.n_equations = int(lib.ed_space_n_equations(self._handle))
        self._equation = np.empty(6 * n + 3 * self.n_floors, dtype=np.intc)
        lib.ed_space_equations(self._handle, _c(self._equation))

    def _check(self, status: int) -> None:
        if status < 0:
            message = ffi.string(lib.ed_space_message(self._handle)).decode(errors="replace")
            raise CoreError(status_name(status), message)

    @property
    def n_nonzeros(self) -> int:
        """Number of values that the sparse stiffness holds."""
        return int(lib.ed_space_n_nonzeros(self._handle))

    def static(
        self, nodal: ArrayLike | None = None, uniform: ArrayLike | None = None, points: Points | None = None
    ) -> Static:
        """Solve static cases; as many as the loads have.

        Args:
            nodal: (c, n, 6) forces and moments on nodes, global, N and N m.
            uniform: (c, m, 3) force a length of the member, global, N/m.
            points: forces on members; without other loads there are as many cases as they name.

        Raises:
            CoreError: a load is not finite, on no member, or at a degree that nothing resists.
        """
        c = self._cases(nodal, uniform, points)
        forces = None if nodal is None else _doubles("nodal", nodal, (c, self.n_nodes, 6))
        loads, keep = self._loads(c, uniform, points)
        result = Static(
            np.empty((c, self.n_nodes, 6)), np.empty((c, self.n_members, 12)), np.empty((c, self.n_nodes, 6))
        )
        arrays = _c(result.displacements), _c(result.end_forces), _c(result.reactions)
        self._check(lib.ed_space_static(self._handle, c, ffi.NULL if forces is None else _c(forces), loads, *arrays))
        del keep
        return result

    def internal(
        self,
        end_forces: ArrayLike,
        stations: ArrayLike,
        uniform: ArrayLike | None = None,
        points: Points | None = None,
    ) -> np.ndarray:
        """Return internal forces N, V_y, V_z, T, M_y, M_z at stations: (c, m, s, 6), N and N m.

        Args:
            end_forces: (c, m, 12) as of `Static`.
            stations: (s,) fractions of the length.
            uniform: (c, m, 3) force a length of these cases, N/m, global axes.
            points: point loads of these cases. Of a force at a station what is just before it counts, at the end of the
                member what is behind it.

        Returns:
            (c, m, s, 6) N, V_y, V_z, T, M_y, M_z; N and N m.

        Raises:
            CoreError: a station is not from 0 to 1, or a load is wrong.
        """
        c = np.asarray(end_forces).size // (12 * self.n_members)
        ends = _doubles("end_forces", end_forces, (c, self.n_members, 12))
        at = _doubles("stations", stations, (np.asarray(stations).size,))
        loads, keep = self._loads(c, uniform, points)
        result = np.empty((c, self.n_members, at.size, 6))
        self._check(lib.ed_space_internal(self._handle, c, _c(ends), loads, at.size, _c(at), _c(result)))
        del keep
        return result

    def modes(
        self,
        node_mass: ArrayLike,
        count: int | None = None,
        origin: ArrayLike | None = None,
        mass_shift: ArrayLike | None = None,
    ) -> SpaceModes:
        """Return the lowest natural modes of lumped masses that act horizontally.

        Args:
            node_mass: (n,) kg. The degrees with mass are ux, uy, rz of diaphragms, and ux, uy of nodes without one.
            count: how many modes; all without it.
            origin: (2,) place in plan of the vertical axis that participation and effective mass in rotation refer to;
                the centre of all masses without it.
            mass_shift: (n, 2) m, by how much the masses of nodes of diaphragms lie beside them in plan; no other node
                may have one.

        Raises:
            ValueError: a mass is negative or not finite, a shift is where no diaphragm is, or there are fewer modes
                than asked for.
            CoreError: a result is not finite.
        """
        mass, places = _doubles("node_mass", node_mass, (self.n_nodes,)), self.coordinates
        if mass_shift is not None:
            shift = _doubles("mass_shift", mass_shift, (self.n_nodes, 2))
            if shift[self.node_floor < 0].any():
                raise ValueError("only masses of diaphragms can lie beside their nodes")
            places = places + np.pad(shift, ((0, 0), (0, 1)))
        factor = mass_factor(mass, places, self.node_floor, self.masters, self._equation)
        massive = np.ascontiguousarray(factor.equations, dtype=np.intc)
        flexibility = np.empty((massive.size, massive.size))
        self._check(lib.ed_space_flexibility(self._handle, massive.size, _c(massive), _c(flexibility)))
        axis = None if origin is None else _doubles("origin", origin, (2,))
        found = mass_modes(flexibility, factor, count, axis)
        k = found.omega.size
        inertia = np.zeros((k, self.n_equations))
        inertia[:, massive] = found.inertia
        shapes = self.solve(inertia)
        displacements, end_forces = np.empty((k, self.n_nodes, 6)), np.empty((k, self.n_members, 12))
        self._check(lib.ed_space_expand(self._handle, k, _c(shapes), _c(displacements), _c(end_forces)))
        of_floors = self._equation[6 * self.n_nodes :]
        padded = np.concatenate([shapes, np.zeros((k, 1))], axis=1)
        return SpaceModes(
            omega=found.omega,
            period=2.0 * np.pi / found.omega,
            shapes=shapes,
            floor_shapes=padded[:, of_floors].reshape(k, self.n_floors, 3),
            displacements=displacements,
            participation=found.participation,
            effective_mass_ratio=found.effective_mass_ratio,
            end_forces=end_forces,
        )

    def change_sections(self, numbers: ArrayLike, properties: ArrayLike) -> None:
        """Give members other sections and factor again, without a new symbolic analysis.

        Args:
            numbers: (c,) members.
            properties: (c, 8) in the order of `PROPERTIES`.

        Raises:
            CoreError: a property is out of range; nothing has changed then.
        """
        members = _integers("numbers", numbers, np.asarray(numbers).size)
        values = _doubles("properties", properties, (members.size, len(PROPERTIES)))
        self._check(lib.ed_space_change(self._handle, members.size, _c(members), _c(values)))
        self._properties[members] = values

    def critical_factor(self, axial: ArrayLike) -> float:
        """Return the least factor > 0 of axial forces at which the frame buckles by bending; infinite if none does.

        Members bow between their nodes: their own buckling is in it, from above by at most 6e-4 for one member that is
        fixed at both ends, and by less than 1e-6 for one on hinges or one that sways. Bars never buckle between their
        nodes. Twisting and lateral torsional buckling are not in it.

        Args:
            axial: (m,) N, tension positive.

        Raises:
            CoreError: a force is not finite, or the factor was not found.

        Source: Przemieniecki (1968), chapter 15; K + lambda K_G singular.
        """
        force, factor = _doubles("axial", axial, (self.n_members,)), ffi.new("double *")
        self._check(lib.ed_space_critical(self._handle, _c(force), factor))
        return float(factor[0])

    def shape_length(self, axial: ArrayLike) -> int:
        """Return how many numbers a shape has under axial forces: equations, then bows of the members with a force.

        Args:
            axial: (m,) N.
        """
        return int(lib.ed_space_shape_length(self._handle, _c(_doubles("axial", axial, (self.n_members,)))))

    def geometric(self, axial: ArrayLike, shapes: ArrayLike, image: np.ndarray | None = None) -> np.ndarray:
        """Return -K_G times shapes: the forces of axial forces on them, (k, shape_length).

        Of bows K is the unit matrix, and has no terms between bows and equations.

        Args:
            axial: (m,) N, tension positive.
            shapes: (k, shape_length).
            image: (k, shape_length) where to write the result.

        Raises:
            CoreError: a force is not finite.
        """
        force, length = _doubles("axial", axial, (self.n_members,)), self.shape_length(axial)
        given = _doubles("shapes", shapes, (len(np.asarray(shapes)), length))
        image = np.empty_like(given) if image is None else image
        self._check(lib.ed_space_geometric(self._handle, _c(force), len(given), _c(given), _c(image)))
        return image

    def solve(self, forces: ArrayLike) -> np.ndarray:
        """Return displacements over the equations under forces there, (k, n_equations).

        Args:
            forces: (k, n_equations) N and N m.
        """
        solution = np.array(forces, dtype=float, order="C")
        _shaped("forces", solution, (len(solution), self.n_equations))
        self._check(lib.ed_space_solve(self._handle, len(solution), _c(solution)))
        return solution

    def _cases(self, nodal: ArrayLike | None, uniform: ArrayLike | None, points: Points | None) -> int:
        if nodal is not None:
            return len(np.asarray(nodal))
        if uniform is not None:
            return len(np.asarray(uniform))
        if points is not None and np.asarray(points.case).size:
            return int(np.max(points.case)) + 1
        raise ValueError("no load is given")

    def _loads(self, cases: int, uniform: ArrayLike | None, points: Points | None) -> tuple[Any, list[np.ndarray]]:
        """The loads as the core reads them, and what must live as long."""
        loads, keep = ffi.new("ed_space_loads *"), []
        if uniform is not None:
            keep.append(_doubles("uniform", uniform, (cases, self.n_members, 3)))
            loads.uniform = _c(keep[-1])
        if points is not None:
            p = np.asarray(points.case).size
            keep += [_integers("case", points.case, p), _integers("member", points.member, p)]
            keep += [_doubles("position", points.position, (p,)), _doubles("force", points.force, (p, 3))]
            loads.n_points = p
            loads.point_case, loads.point_member, loads.point_position, loads.point_force = map(_c, keep[-4:])
        return loads, keep


def combine(values: np.ndarray, rho: np.ndarray) -> np.ndarray:
    """Return sqrt(r rho r) of modal values r of each quantity: (q,).

    Args:
        values: (q, k) of each quantity in each mode. Quickest where the values of one mode lie side by side, as in
            `end_forces.reshape(k, -1).T`.
        rho: (k, k) symmetric: correlation of the modes, which may be scaled by their ordinates; SRSS: the unit matrix.

    Raises:
        CoreError: rho is not symmetric, or a value is not finite.

    Source: EN 1998-1, 4.3.3.3.2; Wilson, Der Kiureghian & Bayo (1981).
    """
    modal = np.ascontiguousarray(np.asarray(values, dtype=float).T)
    k, q = modal.shape
    result = np.empty(q)
    _combined(lib.ed_combine(q, k, _c(modal), _c(_doubles("rho", rho, (k, k))), _c(result)))
    return result


def combine_internal(end_forces: np.ndarray, rho: np.ndarray, stations: ArrayLike) -> np.ndarray:
    """Return combined internal forces N, V_y, V_z, T, M_y, M_z at stations of members without loads: (m, s, 6).

    Modal moments are linear along a member, so that three forms of its ends serve all stations.

    Args:
        end_forces: (k, m, 12) of each mode, N and N m.
        rho: (k, k) as for `combine`.
        stations: (s,) fractions of the length.

    Raises:
        CoreError: rho is not symmetric, a station is not from 0 to 1, or a value is not finite.
    """
    k, m = np.asarray(end_forces).shape[:2]
    modal = _doubles("end_forces", end_forces, (k, m, 12))
    at = _doubles("stations", stations, (np.asarray(stations).size,))
    result = np.empty((m, at.size, 6))
    correlation = _doubles("rho", rho, (k, k))
    _combined(lib.ed_combine_stations(m, k, _c(modal), _c(correlation), at.size, _c(at), _c(result)))
    return result


def _combined(status: int) -> None:
    if status == lib.ED_E_ARGUMENT:
        raise CoreError(status_name(status), "modal combination: rho is not symmetric, or a station is not from 0 to 1")
    if status < 0:
        raise CoreError(status_name(status), f"modal combination: {ffi.string(lib.ed_status_text(status)).decode()}")


def _shaped(name: str, array: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    if array.shape != shape:
        raise ValueError(f"{name} has the shape {array.shape}, not {shape}")
    return array


def _doubles(name: str, values: ArrayLike, shape: tuple[int, ...]) -> np.ndarray:
    array = np.asarray(values, dtype=float)
    return np.ascontiguousarray(_shaped(name, array if array.size else array.reshape(shape), shape))


def _integers(name: str, values: ArrayLike, count: int) -> np.ndarray:
    array = np.asarray(values)
    if array.size and not np.issubdtype(array.dtype, np.integer):
        raise ValueError(f"{name} has values of the type {array.dtype}, not whole numbers")
    return np.ascontiguousarray(_shaped(name, np.clip(array.reshape(-1), -(2**31), 2**31 - 1), (count,)), dtype=np.intc)


def _texts(texts: Sequence[str]) -> tuple[Any, list[Any]]:
    each = [ffi.new("char[]", text.encode()) for text in texts]
    return ffi.new("char *[]", each), each


def _c(array: np.ndarray) -> Any:
    return ffi.from_buffer("int[]" if array.dtype == np.intc else "double[]", array)
