"""What analyses of frames with hinges, joints and springs under the columns record of these."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.codes.ec3.joints import classified
from edesign.frame.frame_model import FrameModel
from edesign.frame.hinges import END_NAMES, EndSpring, SpringKind
from edesign.project.reading.words import counted
from edesign.study.results.recording import Quantity, Terms, coordinate
from edesign.study.results.warnings import AnalysisWarning

UNAFFECTED = 0.25
"""N / N_pl up to which the plastic moment stays: EN 1993-1-1, 6.2.9.1(4), Eq. 6.33."""
_KINDS: tuple[SpringKind, ...] = ("hinge", "joint")
_SUPPORT = (
    ("support_displacement_x", "displacement", 0, "m", "horizontal displacement of the node from the ground below"),
    (
        "support_displacement_y",
        "displacement",
        1,
        "m",
        "vertical displacement of the node from the ground below, upwards",
    ),
    ("support_rotation", "displacement", 2, "rad", "rotation of the supported node, anticlockwise"),
    ("support_reaction_x", "reaction", 0, "N", "horizontal reaction of the spring"),
    ("support_reaction_y", "reaction", 1, "N", "vertical reaction of the spring, upwards"),
    ("support_reaction_moment", "reaction", 2, "N*m", "moment of the spring on the column base, anticlockwise"),
)
_SUPPORT_IN_SPACE = tuple(
    (f"{name}_{axis}", what, first + at, unit, f"{label} {axis}")
    for name, what, first, unit, label in (
        ("support_displacement", "displacement", 0, "m", "displacement of the node from the ground below along"),
        ("support_rotation", "displacement", 3, "rad", "rotation of the supported node about"),
        ("support_reaction", "reaction", 0, "N", "reaction of the spring along"),
        ("support_reaction_moment", "reaction", 3, "N*m", "moment of the spring on the column base about"),
    )
    for at, axis in enumerate("xyz")
)


def _end_springs(frame: FrameModel, kind: SpringKind) -> dict[str, EndSpring]:
    """Return the hinges or joints of a frame by their names, such as B_1_2:start."""
    return {
        f"{member.name}:{END_NAMES[end]}": spring
        for member in frame.members.values()
        for end in (0, 1)
        for spring in member.springs[end]
        if spring.kind == kind
    }


def spring_quantities(frame: FrameModel, group: Group) -> list[Quantity]:
    """Return the recorded quantities of hinges, joints, panel zones and sprung supports, and add them to a group.

    Args:
        group: of the analysis, to which names and properties of the springs are added.
    """
    found = []
    way = "anticlockwise" if frame.model.dimension == 2 else "about local y"
    for kind in _KINDS:
        springs = _end_springs(frame, kind)
        if not springs:
            continue
        coordinate(group, kind, list(springs), "", f"{kind} as member:end")
        _facts(group, kind, list(springs.values()))
        quantities = [
            ("moment", "axial_force", "N*m", f"moment on the member's end, {way}"),
            ("rotation", "deformation", "rad", f"rotation of the {kind}, {way}"),
            ("plastic_rotation", "plastic_rotation", "rad", f"rotation of the {kind} less its elastic part"),
        ]
        if kind == "hinge":
            quantities.append(("strength_left", "strength_left", "1", "yield moment over that at first, weaker side"))
        for name, what, unit, label in quantities:
            cells = tuple(((1.0, what, spring.element, 0),) for spring in springs.values())
            keep = ("final",) if what == "strength_left" else ("max", "min", "final")
            found.append(Quantity(f"{kind}_{name}", (kind,), (len(cells),), cells, unit, label, keep=keep))
    return found + _panels(frame, group) + _supports(frame, group)


def hinge_warnings(group: Group, frame: FrameModel) -> list[AnalysisWarning]:
    """Return the warning about columns with hinges whose axial force would lower their moments.

    Args:
        group: results of a history or a pushover.
    """
    hinged = {name.partition(":")[0] for name in _end_springs(frame, "hinge")}
    squash = {b.name: b.strut.squash for b in frame.bars if b.strut is not None and b.name in hinged}
    if not squash or "column_axial_force_max" not in group.variables:
        return []
    most, least = (np.asarray(group.variables[f"column_axial_force_{which}"].values) for which in ("max", "min"))
    names = [str(name) for name in group.coords["column"].values]
    ratios = {n: max(a, -b) / squash[n] for n, a, b in zip(names, most, least, strict=True) if n in squash}
    worst = max(ratios, key=lambda name: ratios[name], default="")
    if not worst or ratios[worst] <= UNAFFECTED:
        return []
    count = sum(ratio > UNAFFECTED for ratio in ratios.values())
    text = (
        f"{counted(count, 'column')} with hinges {'has' if count == 1 else 'have'} axial forces above "
        f"{UNAFFECTED:g} A f_y, most {worst} with {ratios[worst]:.2g}; hinges yield at their M_y whatever these are, "
        "and EN 1993-1-1, 6.2.9.1(4), asks for less moment there"
    )
    return [AnalysisWarning("hinge_axial", text, float(ratios[worst]) / UNAFFECTED)]


def _facts(group: Group, kind: SpringKind, values: list[EndSpring]) -> None:
    group.add(f"{kind}_stiffness", (kind,), [s.stiffness for s in values], "N*m/rad", "stiffness at the start")
    label = "effective yield moment" if kind == "hinge" else "resistance; infinite: it stays elastic"
    group.add(f"{kind}_M_y", (kind,), [s.M_y for s in values], "N*m", label)
    if kind == "hinge":
        for i, name in enumerate(("theta_p", "theta_pc", "theta_u")):
            label = f"{name} of the hinge, of beams under sagging moments"
            group.add(f"hinge_{name}", (kind,), [s.rotations[i] for s in values], "rad", label)
        return
    classes = [classified(s.stiffness, s.of_member) for s in values]
    group.add("joint_stiffness_ratio", (kind,), [c.ratio for c in classes], "1", "S_j L_b / (E I_b)")
    words = np.asarray([c.name for c in classes])
    group.add("joint_class", (kind,), words, "", "of an unbraced frame by stiffness (EN 1993-1-8, 5.2.2.5)")


def _panels(frame: FrameModel, group: Group) -> list[Quantity]:
    if not frame.panels:
        return []
    coordinate(group, "panel", list(frame.panels), "", "panel zone, by the node of its joint")
    panels = [built.panel for built in frame.panels.values()]
    for name, unit, label in (
        ("stiffness", "N*m/rad", "moment over distortion before yield"),
        ("yield_moment", "N*m", "moment at yield of the web in shear, V_y d_b"),
        ("full_moment", "N*m", "moment at four times the distortion at yield, V_p d_b"),
    ):
        group.add(f"panel_{name}", ("panel",), [getattr(panel, name) for panel in panels], unit, label)
    shape = (len(panels),)
    return [
        Quantity(
            f"panel_{name}",
            ("panel",),
            shape,
            tuple(((1.0, what, p.element, 0),) for p in frame.panels.values()),
            unit,
            label,
        )
        for name, what, unit, label in (
            ("moment", "axial_force", "N*m", "moment of the panel zone, its shear times d_b"),
            ("distortion", "deformation", "rad", "distortion of the panel zone"),
            ("plastic_distortion", "plastic_rotation", "rad", "distortion of the panel zone less its elastic part"),
        )
    ]


def _supports(frame: FrameModel, group: Group) -> list[Quantity]:
    if not frame.grounds:
        return []
    coordinate(group, "sprung_support", list(frame.grounds), "", "name of the node that springs support")
    found = []
    for name, what, degree, unit, label in _SUPPORT if frame.model.dimension == 2 else _SUPPORT_IN_SPACE:
        cells = tuple(_at_spring(frame, node, what, degree) for node in frame.grounds)
        if any(cells):
            shape = (len(cells),)
            found.append(Quantity(name, ("sprung_support",), shape, cells, unit, f"{label}; 0: no spring there"))
    return found


def _at_spring(frame: FrameModel, node: str, what: str, degree: int) -> Terms:
    """Displacement or reaction of the spring at a degree of a node; nothing where there is none."""
    ground = frame.grounds[node][degree]
    if ground is None:
        return ()
    if what == "displacement":
        return tuple((sign, what, at, degree) for sign, at in ((1.0, frame.nodes[node]), (-1.0, ground)))
    return frame.reaction(node, degree)
