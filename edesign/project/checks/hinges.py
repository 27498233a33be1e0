"""Cross checks of hinges, joints, panel zones and springs of supports."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Protocol

from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.selections import Selections
from edesign.project.frame.hinges import AnyHinges, AnyJoints, HingeSide, HingeValues
from edesign.project.frame.supports import SupportSprings, VerticalSpring
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems


def check_hinges(project: Project, problems: Problems) -> None:
    """Check where hinges, joints and panel zones stand, and that their values fit together.

    Args:
        project: read without schema problems.
    """
    check = Selections(project.frame, problems)
    check_ends(project, problems, check, project.frame)
    for i, zones in enumerate(project.panel_zones):
        check.nodes(("panel_zones", i), zones.lines, zones.floors)
        no_rigid_ends(project, problems, ("panel_zones", i))
    _supports(project, problems)


class _Checks(Protocol):
    """Checks of selections of members."""

    def standing_beams(self, keys: Keys, chosen: Any) -> object:
        """Check that beams that are selected one by one exist."""

    def standing_columns(self, keys: Keys, chosen: Any) -> object:
        """Check that columns that are selected one by one exist."""


class _Members(Protocol):
    """Members of a plane frame or a building."""

    @property
    def released(self) -> Mapping[str, tuple[bool, bool]]:
        """Members that are free of moment at the start or the end, by name."""

    def members_in(self, beams: Any, columns: Any) -> Iterator[tuple[str, str]]:
        """Yield the first and the last member of each selected beam or column that exists; of most they are one."""


def check_ends(file: AnalysisFile, problems: Problems, check: _Checks, members: _Members) -> None:
    """Check where hinges and joints stand, and that their values fit together.

    Args:
        file: read without schema problems.
        members: its columns and beams.
    """
    for i, hinges in enumerate(file.hinges):
        keys: Keys = ("hinges", i)
        if _places(problems, check, keys, hinges):
            _released(members, problems, keys, hinges, "hinge")
            _rigid(file, problems, keys, hinges, "hinges")
        if isinstance(hinges.parameters, HingeValues):
            _values(problems, keys, hinges, hinges.parameters)
        else:
            _regression(problems, keys, hinges)
        if hinges.reduced_section is not None and hinges.columns is not None:
            problems.at_key((*keys, "reduced_section"), "only beams have a reduced section [E-FRAME-05]")
    for i, joints in enumerate(file.joints):
        keys = ("joints", i)
        if _places(problems, check, keys, joints):
            _released(members, problems, keys, joints, "joint")
            _rigid(file, problems, keys, joints, "joints")
        if joints.hardening and joints.resistance is None:
            problems.at_key(
                (*keys, "hardening"), "a joint without `resistance` stays elastic and has no hardening [E-KEY-03]"
            )


def no_rigid_ends(file: AnalysisFile, problems: Problems, keys: Keys) -> None:
    """Refuse rigid ends beside panel zones.

    Args:
        file: read without schema problems.
        keys: place of the panel zones.
    """
    rigid = file.elements.rigid_ends
    if rigid.beams.value or rigid.columns.value:
        message = (
            "members begin to bend at the edges of panel zones and have no rigid ends beside them; leave out "
            "`elements: rigid_ends` [E-KEY-03]"
        )
        problems.at_value(keys, message)


def _places(problems: Problems, check: _Checks, keys: Keys, chosen: AnyHinges | AnyJoints) -> bool:
    """Whether beams or columns are named, one of them; those named one by one stand."""
    if (chosen.beams is None) == (chosen.columns is None):
        problems.at_value(keys, "give either `beams` or `columns`, one of them [E-KEY-03]")
        return False
    before = len(problems.found)
    if chosen.beams is not None:
        check.standing_beams((*keys, "beams"), chosen.beams)
    if chosen.columns is not None:
        check.standing_columns((*keys, "columns"), chosen.columns)
    return len(problems.found) == before


def _released(members: _Members, problems: Problems, keys: Keys, chosen: AnyHinges | AnyJoints, what: str) -> None:
    released = members.released
    for first, last in members.members_in(chosen.beams, chosen.columns):
        for name, end, word in ((first, 0, "start"), (last, 1, "end")):
            if chosen.ends in ("both", word) and released.get(name, (False, False))[end]:
                message = (
                    f"the {word} of {name} is released, so it has no {what}; choose other members or `ends`"
                    " [E-FRAME-05]"
                )
                problems.at_value(keys, message)
                return


def _rigid(file: AnalysisFile, problems: Problems, keys: Keys, chosen: AnyHinges | AnyJoints, what: str) -> None:
    kind = "columns" if chosen.beams is None else "beams"
    if getattr(file.elements.rigid_ends, kind).value:
        message = f"{kind} with rigid ends have no {what}; leave out `elements: rigid_ends: {kind}` [E-KEY-03]"
        problems.at_key((*keys, kind), message)


def _values(problems: Problems, keys: Keys, hinges: AnyHinges, values: HingeValues) -> None:
    at: Keys = (*keys, "parameters")
    if hinges.columns is not None and values.hogging.model_fields_set:
        problems.at_key((*at, "hogging"), "only beams have other values under hogging moments [E-FRAME-05]")
    for place, ratio in (
        ((*at, "M_c_ratio"), values.M_c_ratio),
        ((*at, "hogging", "M_c_ratio"), values.hogging.M_c_ratio),
    ):
        if ratio is not None and ratio < 1.0:
            problems.at_value(
                place, f"the moment at capping, {ratio:g} M_y, is below M_y; at least 1 is allowed [E-VALUE-02]"
            )
    _side(problems, at, values, values)
    if hinges.columns is None:
        _side(problems, (*at, "hogging"), values, values.hogging)
    if hinges.unbraced_length is not None:
        problems.at_key(
            (*keys, "unbraced_length"), "it is for the regression; here the parameters are given [E-KEY-03]"
        )


def _side(problems: Problems, at: Keys, values: HingeValues, own: HingeValues | HingeSide) -> None:
    """Check the values of one way of turning, `own` at `at`, with what they take from the other way, `values`."""

    def of(name: str) -> float:
        given = getattr(own, name)
        return float(getattr(values, name) if given is None else given)

    def place(name: str, other: str) -> Keys | None:
        """Where the first of two values stands, or the second; None: both are those of the other way."""
        found = (key for key in (name, other) if key in own.model_fields_set)
        return next(((*at, key) for key in found), None)

    where = place("theta_u", "theta_p")
    if where is not None and of("theta_u") <= of("theta_p"):
        message = (
            f"the ultimate rotation {of('theta_u'):g} rad is not beyond theta_p, {of('theta_p'):g} rad [E-VALUE-04]"
        )
        problems.at_value(where, message)
    where = place("M_r_ratio", "M_c_ratio")
    if where is not None and of("M_c_ratio") >= 1.0 and of("M_r_ratio") >= of("M_c_ratio"):
        message = (
            f"the residual moment, {of('M_r_ratio'):g} M_y, is not below that at capping, {of('M_c_ratio'):g} M_y"
            " [E-VALUE-04]"
        )
        problems.at_value(where, message)


def _regression(problems: Problems, keys: Keys, hinges: AnyHinges) -> None:
    if hinges.columns is not None:
        message = "the regression is for beams; give the parameters of columns one by one [E-KEY-03]"
        problems.at_value((*keys, "parameters"), message)


def _supports(project: Project, problems: Problems) -> None:
    supports = project.frame.supports
    for line, support in supports.items() if isinstance(supports, dict) else ():
        if not isinstance(support, SupportSprings):
            continue
        at: Keys = ("frame", "supports", line)
        vertical = support.vertical
        if isinstance(vertical, VerticalSpring) and vertical.uplift and vertical.hardening:
            message = "a spring with `uplift` gives way at its resistance and has no hardening [E-FRAME-06]"
            problems.at_key((*at, "vertical", "hardening"), message)
        for direction in ("horizontal", "vertical", "rotation"):
            spring = getattr(support, direction)
            if getattr(spring, "hardening", 0.0) and spring.resistance is None:
                message = "a spring without `resistance` stays elastic and has no hardening [E-KEY-03]"
                problems.at_key((*at, direction, "hardening"), message)
