"""What a building is designed for: codes, ductility, analysis, limits, and the sections to choose from."""

from __future__ import annotations

import math
import re
from typing import Annotated, Any, Literal

from pydantic import Field

from edesign.project.frame.member_design import BucklingLength, LengthFactors, MemberStability, SteelFactors
from edesign.project.frame.sections import SectionChoice
from edesign.project.notation.selections import ALL_NUMBERS, Numbers
from edesign.project.notation.several import ShortName, several
from edesign.project.notation.units import (
    Factor,
    PositiveFactor,
    PositiveLength,
    PositiveRatio,
    parse_ratio,
    written_ratio,
)
from edesign.project.notation.written import Written, as_kept, either, given, one_or_list, ratio, text, words_or
from edesign.project.reading.base import Model, refuse

RESTRAINED = "buckling_restrained"
SystemType = Literal["moment_frame", "concentric_diagonal", "concentric_v", "eccentric", "buckling_restrained"]
"""Structural types of EN 1998-1, 6.3.1 and Table 6.2, and buckling-restrained braces, which it does not have."""
LeftOut = Literal[
    "4.2.3.2(6)",
    "4.4.2.2(3)",
    "4.4.2.3(4)",
    "4.4.3.2(1)",
    "6.5.3(2)",
    "6.6.3(4)",
    "6.6.3(6)",
    "6.7.1(3)",
    "6.7.3(1)",
    "6.7.3(2)",
    "6.7.3(3)",
    "6.7.3(8)",
    "6.8.2(4)",
    "6.8.2(6)",
    "6.8.2(7)",
    "6.8.2(10)",
    "7.2.1 e",
    "7.3.1",
    "7.3.6.1",
    "7.5.3.2",
    "7.5.4.2",
    "7.5.4.4",
    "7.5.5",
    "7.5.6",
]
"""Clauses of EN 1998-1 for the whole building that sections decide: torsion, theta, drift, joints, diagonals.

Those of NTC 2018 stand below them.
"""


def _q(value: Any) -> Any:
    if isinstance(value, str) and not value[:1].isdigit() and value != "table":
        raise refuse(f"`{value}`: a behaviour factor of at least 1 is needed, or `table` [E-VALUE-01]")
    return "table" if value == "table" else parse_ratio(value, 1.0, math.inf)


def _torsion(value: Any) -> Any:
    return 0.0 if value == "none" else parse_ratio(value, 0.0, 1.0)


def _directions(value: Any) -> Any:
    return "srss" if value == "srss" else parse_ratio(value, 0.0, 1.0)


def _modes(value: Any) -> Any:
    if value == "auto":
        return value
    if type(value) is not int or not 1 <= value <= 10_000:
        raise refuse("a number of modes from 1 to 10000 is needed, or `auto` [E-VALUE-01]")
    return value


def _share_of(value: Any, whole: str) -> Any:
    if value == "none":
        return None
    if isinstance(value, str) and (match := re.fullmatch(r"1 ?/ ?([0-9]{1,6}(?:\.[0-9]+)?)", value)):
        value = 1.0 / float(match[1]) if float(match[1]) else "1/0"
    if isinstance(value, str) and ("/" in value or not value[:1].isdigit()):
        raise refuse(
            f"`{value}`: a share of the {whole} is needed: `1/250`, a ratio such as `0.4 %`, or `none` [E-VALUE-01]"
        )
    return parse_ratio(value, 0.0, 1.0, False, False)


def _share_of_span(value: Any) -> Any:
    return _share_of(value, "span")


def _share_of_height(value: Any) -> Any:
    return _share_of(value, "height")


def _drift(value: Any) -> Any:
    """`none` is a limit of its own."""
    if isinstance(value, str) and value != "none":
        raise refuse(f"`{value}`: give `none`, or `{{limit: brittle}}`, `ductile` or `none_attached` [E-VALUE-01]")
    return {"limit": "none"} if value == "none" else value


class Codes(Model):
    """The codes and their editions.

    Attributes:
        actions: combinations and their factors; those of NTC 2018 with its seismic rules.
        steel: edition of EN 1993-1-1.
        seismic: edition of EN 1998-1, or NTC 2018 (Italy), chapter 7.
    """

    actions: Literal["en1990-2002", "ntc-2018"] = "en1990-2002"
    steel: Literal["ec3-2005"] = "ec3-2005"
    seismic: Literal["ec8-2004", "ntc-2018"] = "ec8-2004"


class System(Model):
    """The structural type in one direction, and its behaviour factor.

    Attributes:
        type: structural type (EN 1998-1, 6.3.1), or `buckling_restrained`, of which the code has no behaviour factor.
        q: behaviour factor; `table` takes the upper limit of EN 1998-1, Table 6.2, for the ductility class.
        q_source: of `buckling_restrained`: where its `q` is from, such as an approval or tests; reports print it.
        alpha_u_over_alpha_1: alpha_u over alpha_1 of moment frames and eccentric bracings in Table 6.2; without the
            key the default of 6.3.2(3).
    """

    type: SystemType
    q: Annotated[Literal["table"] | float, Written(_q, words_or(ratio(1.0, math.inf), "table"))] = "table"
    q_source: Annotated[str, Field(min_length=1)] | None = None
    alpha_u_over_alpha_1: Annotated[float, Field(ge=1.0, le=1.6)] | None = None


class Systems(Model):
    """The structural type in each direction.

    Attributes:
        x: structural type of the frames along x.
        y: structural type of the frames along y.
    """

    x: System
    y: System


class Drift(Model):
    """The limit of interstorey drift by the kind of partitions.

    Attributes:
        limit: kind of partitions: 0.5 % of the height of brittle, 0.75 % of ductile, 1 % of none attached (EN 1998-1,
            4.4.3.2(1); NTC 2018, 7.3.6.1, with two thirds of it in classes of use III and IV).
        nu: reduction of the action (EN 1998-1, 4.4.3.2(2)); without the key that of the country for the importance
            class. NTC 2018 has none: the action is that of SLD, or of SLO in classes of use III and IV.

    Source: EN 1998-1:2004, 4.4.3.2(1), Eqs. 4.31-4.33; NTC 2018, 7.3.6.1.
    """

    limit: Literal["brittle", "ductile", "none_attached", "none"] = "ductile"
    nu: PositiveRatio = 0.5


_OVER_SPAN = text("share of the span", r"1 ?/ ?[0-9]{1,6}(?:\.[0-9]+)?", "1/250")
ShareOfSpan = Annotated[
    float | None, Written(_share_of_span, words_or(either(_OVER_SPAN, ratio(0.0, 1.0, False, False)), "none"))
]


_OVER_HEIGHT = text("share of the height", r"1 ?/ ?[0-9]{1,6}(?:\.[0-9]+)?", "1/300")
ShareOfHeight = Annotated[
    float | None, Written(_share_of_height, words_or(either(_OVER_HEIGHT, ratio(0.0, 1.0, False, False)), "none"))
]


class BeamDeflections(Model):
    """Limits of the deflection of beams over their span.

    Attributes:
        total: largest deflection of beams over their span under all loads; without the key no limit.
        live: largest deflection of beams over their span under variable loads alone; without the key no limit.
    """

    total: ShareOfSpan = None
    live: ShareOfSpan = None


class HorizontalLimits(Model):
    """Limits of horizontal displacements over heights, as under wind (EN 1990, A1.4.3, Figure A1.2).

    Attributes:
        storey: largest drift of a storey over its height; without the key no limit.
        building: largest displacement of the roof over its height; without the key no limit.
    """

    storey: ShareOfHeight = None
    building: ShareOfHeight = None


class Serviceability(Model):
    """Limits under characteristic combinations; those of the National Annex and the client (EN 1993-1-1, 7.2).

    Attributes:
        beams: limits of the deflection of beams.
        sway: limits of horizontal displacements.
    """

    beams: BeamDeflections = BeamDeflections()
    sway: HorizontalLimits = HorizontalLimits()


class PartialFactors(SteelFactors):
    """Partial factors of EN 1993-1-1, 6.1 and of EN 1990, Table A1.2(B); the country's where they are not given.

    With NTC 2018 they are those of its Tables 4.2.VII and 2.6.I.

    Attributes:
        G: partial factor of permanent actions (EN 1990, Table A1.2(B)).
        Q: partial factor of variable actions (EN 1990, Table A1.2(B)).
    """

    G: Factor = 1.35
    Q: Factor = 1.5


def _expression(value: Any) -> Any:
    """6.10 without quotes is a number in YAML."""
    return "6.10" if isinstance(value, float) and value == 6.1 else value


class Fundamental(Model):
    """Combinations for persistent situations (EN 1990, 6.4.3.2).

    Attributes:
        expression: Eq. 6.10 of EN 1990, or the less favourable of 6.10a and 6.10b.
        favourable: whether permanent loads are also taken as favourable without variable ones, as for uplift.
        stated: more combinations, each with the factors of its load cases: `G`, `Q_B`, own ones; `-wind_x` of one
            that is reversed.
    """

    expression: Annotated[
        Literal["6.10", "6.10a/b"], Written(_expression, given({"enum": ["6.10", 6.1, "6.10a/b"]}))
    ] = "6.10"
    favourable: bool = False
    stated: tuple[Annotated[dict[str, Factor], Field(min_length=1)], ...] = ()


class PlacedLengthFactors(LengthFactors):
    """Buckling length over length between nodes of members of some groups, or of one kind, in some storeys.

    Attributes:
        kind: `columns`, `beams` or `braces`; without the key members of any kind.
        groups: groups of members; without the key all of the kind.
        storeys: storeys of the members; a beam is in the storey below its floor.
    """

    kind: Literal["columns", "beams", "braces"] | None = None
    groups: tuple[ShortName, ...] = ()
    storeys: Numbers = ALL_NUMBERS


class PlacedBucklingLength(BucklingLength):
    """Buckling lengths by the kind of member, and by place.

    Attributes:
        places: factors of members of some groups or storeys in place of those of their kind; a later entry overrides
            an earlier one.
    """

    places: tuple[PlacedLengthFactors, ...] = ()

    def of(self, kind: str, group: str, storey: int) -> LengthFactors:
        """Return the factors of a member.

        Args:
            kind: `column`, `beam` or `brace`.
            storey: from 1; of a beam that below its floor.
        """
        found: LengthFactors = getattr(self, f"{kind}s")
        for place in self.places:
            named = place.kind in (None, f"{kind}s") and (not place.groups or group in place.groups)
            if named and storey in place.storeys.numbers(1, storey):
                found = place
        return found


class MemberChecks(MemberStability):
    """How members are checked by EN 1993-1-1.

    Attributes:
        buckling_length: buckling length over the length between nodes, by kind of member and by place.
        doubler_plates: whether web panels that are too weak may have a supplementary web plate (EN 1998-1, 6.6.3(6)).
        beams_beside_links: effects on a beam beside its seismic link: `amplified` as on braces and columns, or those of
            the `seismic` situation, as EN 1998-1, 6.8.3(1), names members without links alone.
    """

    buckling_length: PlacedBucklingLength = PlacedBucklingLength()
    doubler_plates: bool = True
    beams_beside_links: Literal["amplified", "seismic"] = "amplified"


KINDS = ("columns", "beams", "braces")
DEFAULT_PRICE = "default"
"""Stands for the families whose price is not given."""


class SectionLists(Model):
    """Families (`HEB`), patterns (`HEB3*`) or sections (`HEB300`) that the design may choose from.

    Attributes:
        columns: families (`HEB`), patterns (`HEB3*`) or sections (`HEB300`) for columns.
        beams: families, patterns or sections for beams.
        braces: families, patterns or sections for braces.
        groups: lists of groups that have their own, by group.
    """

    columns: SectionChoice = ("HEB",)
    beams: SectionChoice = ("IPE",)
    braces: SectionChoice = ("SHS",)
    groups: dict[str, SectionChoice] = Field(default_factory=dict)


class PricesEach(Model):
    """Prices of pieces of work beside that of the steel, in the currency of `prices`.

    Attributes:
        splice: price of a splice of a column where its section changes; without the key splices are not counted.
        doubler: price of a web panel that needs a supplementary web plate, with the plate; without the key they are not
            counted.
    """

    splice: PositiveFactor | None = None
    doubler: PositiveFactor | None = None


class Select(Model):
    """How `edesign design` chooses sections.

    Attributes:
        lists: what the design may choose from, by kind of member.
        largest_depth: largest depth of the sections of `columns`, `beams`, `braces`, or of a group.
        objective: what is made least: mass of steel, or cost.
        prices: price of a kilogram by family, in any currency, for the objective `cost`; `default` for the others.
        prices_each: prices of pieces of work, for the objective `cost`.
        same_depth: `columns` that stand on each other have one nominal depth, `beams` that meet in a frame at a floor.
        most_sections: largest number of different sections of `columns`, `beams`, `braces`, or of `all` members.
        columns_not_larger_above: whether no column has a larger area than the one below it.
        starts: points from which the search starts, beside the sections of the file.
        evaluations: how many designs the search may ask for.
        leave_out: clauses of the seismic code that the design need not meet; the run reports them all the same.
    """

    lists: SectionLists = SectionLists()
    largest_depth: dict[str, PositiveLength] = Field(default_factory=dict)
    objective: Literal["mass", "cost"] = "mass"
    prices: dict[Annotated[str, Field(pattern=r"^[A-Za-z]+$", max_length=12)], PositiveFactor] = Field(
        default_factory=dict
    )
    prices_each: PricesEach = PricesEach()
    same_depth: Annotated[tuple[Literal["columns", "beams"], ...], Written(several, one_or_list)] = ()
    most_sections: dict[Literal["columns", "beams", "braces", "all"], Annotated[int, Field(ge=1, le=1000)]] = Field(
        default_factory=dict
    )
    columns_not_larger_above: bool = True
    starts: Annotated[int, Field(ge=1, le=100)] = 3
    evaluations: Annotated[int, Field(ge=1, le=10_000_000)] = 20_000
    leave_out: tuple[LeftOut, ...] = ()


class Design(Model):
    """The checks of a building, and the combination of the seismic action.

    Attributes:
        code: codes and their editions.
        level: hazard level of the design; without the key the only one, or that of SLV (NTC 2018).
        ductility_class: ductility class DCL, DCM or DCH; by NTC 2018 non dissipative, CD"B" or CD"A".
        systems: structural type and behaviour factor in each direction.
        regular_in_plan: if not, the default of alpha_u / alpha_1 is smaller (EN 1998-1, 6.3.2(4)); `auto` as it is
            found.
        regular_in_elevation: if not, q of the table is multiplied by 0.8 (EN 1998-1, 4.2.3.1(7)); `auto` as it is
            found.
        combination: how modes are combined.
        damping: damping ratio in the CQC coefficients.
        modes: how many modes count; `auto` takes all of them.
        accidental_torsion: eccentricity over the length of the plan (EN 1998-1, 4.3.2), or `none`.
        torsion_by: static moments (EN 1998-1, 4.3.3.3.3), or masses beside their place in the modal analysis
            (4.3.2(1)P).
        directions: share of the action in the other direction (EN 1998-1, 4.3.3.5.1(3)), or `srss`.
        imperfections: whether persistent combinations have sway imperfections (EN 1993-1-1, 5.3.2).
        second_order: whether effects are amplified for 0.1 < theta <= 0.2 (EN 1998-1, 4.4.2.2(3)).
        displacement: d_s as q d_e, at most the elastic one, or q d_e alone (EN 1998-1, 4.3.4).
        drift: limit of interstorey drift, or `none`.
        fundamental: combinations for persistent situations (EN 1990, 6.4.3.2).
        serviceability: limits under characteristic combinations.
        partial_factors: partial factors; without a key that of the country.
        overstrength: material overstrength gamma_ov (EN 1998-1, 6.2(3)); without the key that of the country, or of the
            steels (NTC 2018, 7.5.1).
        members: how members are checked.
        select: how `edesign design` chooses sections.
    """

    code: Codes = Codes()
    level: str | None = None
    ductility_class: Literal["low", "medium", "high"]
    systems: Systems
    regular_in_plan: Literal["auto"] | bool = "auto"
    regular_in_elevation: Literal["auto"] | bool = "auto"
    combination: Literal["cqc", "srss"] = "cqc"
    damping: Annotated[float, written_ratio(0.0, 1.0, False, False)] = 0.05
    modes: Annotated[Literal["auto"] | int, Written(_modes, as_kept)] = "auto"
    accidental_torsion: Annotated[float, Written(_torsion, words_or(ratio(0.0, 1.0), "none"))] = 0.05
    torsion_by: Literal["static_moments", "shifted_masses"] = "static_moments"
    directions: Annotated[Literal["srss"] | float, Written(_directions, words_or(ratio(0.0, 1.0), "srss"))] = 0.3
    imperfections: Literal["sway", "none"] = "sway"
    second_order: Literal["amplify", "none"] = "amplify"
    displacement: Literal["elastic_cap", "q_times_d_e"] = "elastic_cap"
    drift: Annotated[Drift, Written(_drift, words_or(as_kept, "none"))] = Drift()
    fundamental: Fundamental = Fundamental()
    serviceability: Serviceability = Serviceability()
    partial_factors: PartialFactors = PartialFactors()
    overstrength: PositiveFactor = 1.25
    members: MemberChecks = MemberChecks()
    select: Select = Select()
