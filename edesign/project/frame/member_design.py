"""How steel members of a frame or building are checked: lengths, restraints, partial factors."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from edesign.project.frame.members import BeamPlaces
from edesign.project.notation.units import PositiveFactor, PositiveForce
from edesign.project.notation.written import Written, given
from edesign.project.reading.base import Model


def _by_thickness(value: Any) -> Any:
    return {True: "en10025-2", False: None}[value] if isinstance(value, bool) else value


class LengthFactors(Model):
    """Buckling length over length between nodes, about both axes of the section.

    Attributes:
        y: factor about the y axis of the section, the strong one.
        z: factor about the z axis of the section, the weak one.
    """

    y: PositiveFactor = 1.0
    z: PositiveFactor = 1.0


class BucklingLength(Model):
    """Buckling lengths by the kind of member.

    Attributes:
        columns: factors of columns.
        beams: factors of beams.
        braces: factors of braces.
    """

    columns: LengthFactors = LengthFactors()
    beams: LengthFactors = LengthFactors()
    braces: LengthFactors = LengthFactors()


class LateralRestraint(Model):
    """The lateral restraint of the compressed flange.

    Attributes:
        beams: by the slab all along, or at the ends only.
        columns: at the floors, or all along.
    """

    beams: Literal["slab", "ends"] = "slab"
    columns: Literal["floors", "all_along"] = "floors"


class MemberStability(Model):
    """How members are checked by EN 1993-1-1.

    Attributes:
        interaction: interaction factors k_ij of EN 1993-1-1, 6.3.3.
        buckling_length: buckling length over the length between nodes, by kind of member.
        lateral_restraint: what restrains the compressed flange.
        yield_by_thickness: f_y by the thickest part of a section: EN 10025-2 (`true`), EN 1993-1-1, Table 3.1, or not;
            the country chooses (3.2.1(1)).
    """

    interaction: Literal["annex_a", "annex_b"] = "annex_b"
    buckling_length: BucklingLength = BucklingLength()
    lateral_restraint: LateralRestraint = LateralRestraint()
    yield_by_thickness: Annotated[
        Literal["en10025-2", "table-3.1"] | None,
        Written(_by_thickness, given({"enum": ["en10025-2", "table-3.1", True, False]})),
    ] = None


class SteelFactors(Model):
    """Partial factors of EN 1993-1-1, 6.1; the country's where they are not given.

    Attributes:
        M0: partial factor of cross-sections (EN 1993-1-1, 6.1).
        M1: partial factor of members, for instability (EN 1993-1-1, 6.1).
    """

    M0: PositiveFactor = 1.0
    M1: PositiveFactor = 1.0


class AcrossBracing(Model):
    """The bracing of frames across that a column of this frame belongs to.

    Attributes:
        frames: their names in the building.
        N: axial force that the seismic action across brings to the column where the one along this frame leads, with
            its factor in that combination.
        V: vertical reaction of the support below a column of the first storey, likewise, with gamma_Rd Omega of
            foundations.
    """

    frames: Annotated[tuple[str, ...], Field(min_length=1)]
    N: PositiveForce
    V: PositiveForce | None = None


class ElasticUse(Model):
    """The largest use of a member in the elastic design of the building that a frame is taken from.

    Attributes:
        use: largest ratio of demand and resistance over all checks.
        check: which it is, such as `EQ_6_62`.
        combination: combination of actions under which it is.
        across: the bracing across that a column belongs to.
    """

    use: PositiveFactor
    check: str
    combination: str
    across: AcrossBracing | None = None


class Dissipative(Model):
    """Members that are meant to yield in an earthquake: their plastic rotations judge them, not their use.

    Attributes:
        beams: beams with plastic hinges, of moment frames.
        braces: whether the braces are, of concentrically braced frames.
    """

    beams: tuple[BeamPlaces, ...] = ()
    braces: Literal["all", "none"] = "none"


class FrameDesign(Model):
    """What the checks of a plane frame's members go by.

    Attributes:
        members: how members are checked.
        partial_factors: partial factors; without a key that of the country.
        dissipative: members that are meant to yield; tables of use have them apart.
        elastic_use: by member what the elastic design of its building found, which `edesign extract` writes; tables
            have it beside the use under the forces of histories.
    """

    members: MemberStability = MemberStability()
    partial_factors: SteelFactors = SteelFactors()
    dissipative: Dissipative = Dissipative()
    elastic_use: dict[str, ElasticUse] = {}

    @property
    def across(self) -> dict[str, float]:
        """Axial force of the seismic action across by column, N."""
        return {name: of.across.N for name, of in self.elastic_use.items() if of.across is not None}
