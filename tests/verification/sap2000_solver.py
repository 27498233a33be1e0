"""A small direct stiffness method on the tables of a SAP2000 text alone, which shares no code with edesign.

Frames with shear deformation, releases and partial fixity by condensation, local axes turned by an angle, rigid
diaphragms, added masses of joints. Source: Przemieniecki (1968), Table 5.1 for the stiffness with shear; CSI Analysis
Reference Manual for what the tables mean.
"""

from __future__ import annotations

import re
from collections import defaultdict

import numpy as np

Rows = list[dict[str, str]]
RELEASES = ("P", "V2", "V3", "T", "M2", "M3")


def tables(text: str) -> dict[str, Rows]:
    """The records of each table."""
    found: dict[str, Rows] = defaultdict(list)
    name = ""
    for line in re.sub(r" _\s*\n", " ", text.replace("\r\n", "\n")).split("\n"):
        if line.startswith("TABLE:"):
            name = line.split('"')[1]
        elif "=" in line and name:
            pairs = re.findall(r'(\w+)=("[^"]*"|\S*)', line)
            found[name].append({key: value.strip('"') for key, value in pairs})
    return found


class Solved:
    """The structure of tables in kN and m.

    Args:
        text: of the file.
    """

    def __init__(self, text: str) -> None:
        self.t = tables(text)
        self.joints = {
            r["Joint"]: np.array([float(r[k]) for k in ("XorR", "Y", "Z")]) for r in self.t["JOINT COORDINATES"]
        }
        self.number = {name: n for n, name in enumerate(self.joints)}
        self.angle = {r["Frame"]: float(r["Angle"]) for r in self.t["FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL"]}
        self.released = {r["Frame"]: r for r in self.t["FRAME RELEASE ASSIGNMENTS 1 - GENERAL"]}
        self.partial = {r["Frame"]: r for r in self.t["FRAME RELEASE ASSIGNMENTS 2 - PARTIAL FIXITY"]}
        sections = {r["SectionName"]: r for r in self.t["FRAME SECTION PROPERTIES 01 - GENERAL"]}
        materials = {r["Material"]: r for r in self.t["MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES"]}
        assigned = {r["Frame"]: r["AnalSect"] for r in self.t["FRAME SECTION ASSIGNMENTS"]}
        n = 6 * len(self.joints)
        self.K = np.zeros((n, n))
        self.ends, self.frames, self.weights = {}, {}, {}
        for r in self.t["CONNECTIVITY - FRAME"]:
            name = r["Frame"]
            self.ends[name] = r["JointI"], r["JointJ"]
            section = sections[assigned[name]]
            material = materials[section["Material"]]
            self.weights[name] = float(section["Area"]) * float(material["UnitWeight"])
            self._frame(name, section, material)
        for r in self.t["JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED"]:
            at = 6 * self.number[r["Joint"]]
            for k, key in enumerate(("U1", "U2", "U3", "R1", "R2", "R3")):
                self.K[at + k, at + k] += float(r[key])
        self.T = self._reduction()

    def _frame(self, name: str, section: dict[str, str], material: dict[str, str]) -> None:
        i, j = (self.joints[end] for end in self.ends[name])
        L = float(np.linalg.norm(j - i))
        one = (j - i) / L
        two = np.array([1.0, 0, 0]) if np.hypot(*one[:2]) < 1e-3 else np.array([0, 0, 1.0])
        two = two - (two @ one) * one
        two /= np.linalg.norm(two)
        three = np.cross(one, two)
        a = np.deg2rad(self.angle.get(name, 0.0))
        R = np.array([one, np.cos(a) * two + np.sin(a) * three, np.cos(a) * three - np.sin(a) * two])
        turn = np.kron(np.eye(4), R)
        E, G = float(material["E1"]), float(material["G12"])
        A, J, I33, I22, AS2, AS3 = (float(section[k]) for k in ("Area", "TorsConst", "I33", "I22", "AS2", "AS3"))
        A *= float(section["AMod"])
        k = np.zeros((12, 12))
        k[np.ix_([0, 6], [0, 6])] += E * A / L * np.array([[1, -1], [-1, 1]])
        k[np.ix_([3, 9], [3, 9])] += G * J / L * np.array([[1, -1], [-1, 1]])
        for EI, GA, at, sign in ((E * I33, G * AS2, (1, 5, 7, 11), 1.0), (E * I22, G * AS3, (2, 4, 8, 10), -1.0)):
            phi = 12.0 * EI / (GA * L**2) if GA else 0.0
            b, c, d = 6.0 * L * sign, (4.0 + phi) * L**2, (2.0 - phi) * L**2
            m = np.array([[12, b, -12, b], [b, c, -b, d], [-12, -b, 12, -b], [b, d, -b, c]])
            k[np.ix_(at, at)] += EI / (L**3 * (1.0 + phi)) * m
        loose, springs = [], []
        for end in (0, 1):
            for n, key in enumerate(RELEASES):
                field = f"{key}{'IJ'[end]}"
                if self.released.get(name, {}).get(field) == "Yes":
                    loose.append(6 * end + n)
                    springs.append(float(self.partial.get(name, {}).get(field, 0.0)))
        self.frames[name] = (k, turn, L, loose, springs)
        k, _ = self._condensed(name, np.zeros(12))
        at = self._degrees(name)
        self.K[np.ix_(at, at)] += turn.T @ k @ turn

    def _degrees(self, name: str) -> list[int]:
        return [6 * self.number[end] + n for end in self.ends[name] for n in range(6)]

    def _condensed(self, name: str, fixed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Stiffness and forces of a frame whose ends are fixed, after its releases; springs stand at the joints."""
        k, _, _, loose, springs = self.frames[name]
        if not loose:
            return k, fixed
        inner = k[np.ix_(loose, loose)] + np.diag(springs)
        to = np.zeros((len(loose), 12))  # of the loose ends by the displacements of the joints
        kept = [n for n in range(12) if n not in loose]
        to[:, kept] = -np.linalg.solve(inner, k[np.ix_(loose, kept)])
        to[:, loose] = np.linalg.solve(inner, np.diag(springs))
        full = np.eye(12)
        full[loose] = to
        free = np.zeros(12)
        free[loose] = -np.linalg.solve(inner, fixed[loose])
        spring = np.zeros((12, 12))
        spring[np.ix_(loose, loose)] = np.diag(springs)
        apart = np.eye(12) - full
        whole = full.T @ k @ full + apart.T @ spring @ apart
        return whole, full.T @ (fixed + k @ free) - apart.T @ spring @ free

    def _reduction(self) -> np.ndarray:
        """All degrees by the free ones: restraints, inactive degrees, diaphragms."""
        n = self.K.shape[0]
        fixed = np.zeros(n, bool)
        active = [value == "Yes" for value in list(self.t["ACTIVE DEGREES OF FREEDOM"][0].values())[:6]]
        fixed |= ~np.tile(active, n // 6)
        for r in self.t["JOINT RESTRAINT ASSIGNMENTS"]:
            at = 6 * self.number[r["Joint"]]
            fixed[at : at + 6] |= [r[k] == "Yes" for k in ("U1", "U2", "U3", "R1", "R2", "R3")]
        floors: dict[str, list[str]] = defaultdict(list)
        for r in self.t["JOINT CONSTRAINT ASSIGNMENTS"]:
            floors[r["Constraint"]].append(r["Joint"])
        tied = {6 * self.number[joint] + k for joints in floors.values() for joint in joints for k in (0, 1, 5)}
        columns = []
        for d in range(n):
            if not fixed[d] and d not in tied:
                columns.append(np.eye(n)[d])
        for joints in floors.values():
            for motion in range(3):
                column = np.zeros(n)
                for joint in joints:
                    at, (x, y, _) = 6 * self.number[joint], self.joints[joint]
                    column[[at, at + 1, at + 5]] = ([1, 0, 0], [0, 1, 0], [-y, x, 1])[motion]
                if not column[fixed].any():
                    columns.append(column)
        return np.array(columns).T

    def forces(self, pattern: str) -> tuple[np.ndarray, np.ndarray]:
        """Forces on joints, and the part that loads on frames between fixed ends bring to them, (6 n,) kN, kN m."""
        on_joints, from_frames = np.zeros(self.K.shape[0]), np.zeros(self.K.shape[0])
        for r in self.t["JOINT LOADS - FORCE"]:
            if r["LoadPat"] == pattern:
                at = 6 * self.number[r["Joint"]]
                on_joints[at : at + 6] += [float(r[k]) for k in ("F1", "F2", "F3", "M1", "M2", "M3")]
        loads = [(r, float(r["FOverLA"]), float(r["FOverLB"])) for r in self.t["FRAME LOADS - DISTRIBUTED"]]
        for r, first, last in loads:
            if r["LoadPat"] == pattern:
                self._spread(r["Frame"], r["Dir"], float(r["RelDistA"]), float(r["RelDistB"]), first, last, from_frames)
        for r in self.t["FRAME LOADS - POINT"]:
            if r["LoadPat"] == pattern:
                self._on_frame(r["Frame"], r["Dir"], float(r["RelDist"]), float(r["Force"]), from_frames)
        for r in self.t["LOAD PATTERN DEFINITIONS"]:
            if r["LoadPat"] == pattern and float(r["SelfWtMult"]):
                for name, weight in self.weights.items():
                    self._spread(name, "Z", 0.0, 1.0, -weight, -weight, from_frames)
        return on_joints, from_frames

    def _spread(self, name: str, way: str, a: float, b: float, first: float, last: float, into: np.ndarray) -> None:
        points, weights = np.polynomial.legendre.leggauss(4)  # exact for the cubic shapes times a linear load
        for x, w in zip(points, weights, strict=True):
            at = 0.5 * (a + b) + 0.5 * (b - a) * x
            q = first + (last - first) * (at - a) / (b - a)
            self._on_frame(name, way, at, 0.5 * w * (b - a) * self.frames[name][2] * q, into)

    def _on_frame(self, name: str, way: str, s: float, force: float, into: np.ndarray) -> None:
        """A force on a frame, by the shapes of a beam with shear deformation."""
        k, turn, L, _, _ = self.frames[name]
        local = turn[:3, :3] @ (force * np.eye(3)["XYZ".index(way)])
        fixed = np.zeros(12)
        fixed[[0, 6]] = local[0] * np.array([1 - s, s])
        for f, at, sign in ((local[1], (1, 5, 7, 11), 1.0), (local[2], (2, 4, 8, 10), -1.0)):
            # a released cantilever's flexibility gives what the fixed end holds: by reciprocity from the stiffness
            stiff = k[np.ix_(at, at)]
            EI_phi = stiff[1, 1] + stiff[1, 3]  # 6 EI / (L (1 + phi))
            EI = (stiff[1, 1] - stiff[1, 3]) * L / 2.0
            phi = 6.0 * EI / (L * EI_phi) - 1.0
            shapes = np.array(
                [
                    (1 - 3 * s**2 + 2 * s**3 + phi * (1 - s)) / (1 + phi),
                    sign * L * (s - 2 * s**2 + s**3 + phi / 2 * (s - s**2)) / (1 + phi),
                    (3 * s**2 - 2 * s**3 + phi * s) / (1 + phi),
                    sign * L * (s**3 - s**2 - phi / 2 * (s - s**2)) / (1 + phi),
                ]
            )
            fixed[list(at)] += f * shapes
        _, condensed = self._condensed(name, -fixed)
        into[self._degrees(name)] += turn.T @ -condensed

    def displacements(self, pattern: str) -> dict[str, np.ndarray]:
        """Displacements and rotations of the joints, (6,) m and rad, by name."""
        on_joints, from_frames = self.forces(pattern)
        u = self.T @ np.linalg.solve(self.T.T @ self.K @ self.T, self.T.T @ (on_joints + from_frames))
        return {name: u[6 * n : 6 * n + 6] for name, n in self.number.items()}

    def reactions(self, pattern: str) -> dict[str, np.ndarray]:
        """Forces of the supports, (6,) kN and kN m, by joint."""
        on_joints, from_frames = self.forces(pattern)
        u = np.concatenate(list(self.displacements(pattern).values()))
        r = self.K @ u - from_frames - on_joints
        return {s["Joint"]: r[6 * self.number[s["Joint"]] :][:6] for s in self.t["JOINT RESTRAINT ASSIGNMENTS"]}

    def periods(self) -> np.ndarray:
        """Natural periods, longest first, s."""
        mass = np.zeros(self.K.shape[0])
        for r in self.t["JOINT ADDED MASS ASSIGNMENTS"]:
            at = 6 * self.number[r["Joint"]]
            mass[at : at + 3] = [float(r[k]) for k in ("Mass1", "Mass2", "Mass3")]
        K, M = self.T.T @ self.K @ self.T, self.T.T @ (mass[:, None] * self.T)
        flexibility = np.linalg.solve(np.linalg.cholesky(K), M)
        values = np.linalg.eigvalsh(np.linalg.solve(np.linalg.cholesky(K), flexibility.T))
        values = np.sort(values[values > 1e-12 * values.max()])[::-1]
        return 2.0 * np.pi * np.sqrt(values)
