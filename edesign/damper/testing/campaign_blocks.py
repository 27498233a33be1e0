"""What files about damper tests share: the specimen, the law, temperatures, and their two ways to write a value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from edesign.core import CoreError
from edesign.core.damper import CoreDamper
from edesign.damper.laws import LAWS, unknown_law
from edesign.damper.parameters import ParameterError, read_parameters
from edesign.damper.temperature import GammaOf
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError
from edesign.project.notation.temperature import parse_temperature
from edesign.project.notation.units import PositiveArea, PositiveLength
from edesign.project.notation.written import Written, given
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.problems import Keys, Problems
from edesign.project.reading.yaml_nodes import Node

Text = Annotated[str, Field(min_length=1)]
Positive = Annotated[float, Field(gt=0.0)]


def parse_celsius(value: Any) -> float:
    """Read a plain number in degC.

    Raises:
        PydanticCustomError: it is none.
    """
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise refuse(f"`{value}` is no plain number of degC; `temperature: 20 degC` takes a unit [E-UNIT-02]")
    return parse_temperature(f"{value!r} degC")


Celsius = Annotated[float, Written(parse_celsius, given({"type": "number"}))]


def _law_name(value: Any) -> Any:
    if not isinstance(value, str):
        raise refuse("the name of a damper law is needed, for example `mgmm` [E-LAW-01]")
    if value not in LAWS:
        raise refuse(unknown_law(value))
    return value


class SpecimenBlock(Model):
    """The specimen that is tested; without layers a device that has none, such as a viscous or friction damper.

    Attributes:
        name: name of the specimen.
        layers: number of layers of elastomer, with `layer_area` and `layer_thickness`; without the three keys there are
            none.
        layer_area: area of a layer; this key or `layer_area_mm2`.
        layer_area_mm2: area of a layer in mm^2, as a plain number; this key or `layer_area`.
        layer_thickness: thickness of a layer; this key or `layer_thickness_mm`.
        layer_thickness_mm: thickness of a layer in mm, as a plain number; this key or `layer_thickness`.
    """

    name: Text = "specimen"
    layers: Annotated[int, Field(ge=1)] | None = None
    layer_area: PositiveArea | None = None
    layer_area_mm2: Positive | None = None
    layer_thickness: PositiveLength | None = None
    layer_thickness_mm: Positive | None = None

    @property
    def specimen(self) -> Specimen | None:
        """The layers of the specimen in SI, None if it has none; of a checked block."""
        if self.layers is None:
            return None
        area = self.layer_area if self.layer_area is not None else 1e-6 * (self.layer_area_mm2 or 0.0)
        thickness = (
            self.layer_thickness if self.layer_thickness is not None else 1e-3 * (self.layer_thickness_mm or 0.0)
        )
        return Specimen(self.name, self.layers, area, thickness)


class LayeredSpecimenBlock(SpecimenBlock):
    """A specimen whose layers must be known, since moduli are given.

    Attributes:
        layers: number of layers of elastomer.
    """

    layers: Annotated[int, Field(ge=1)]

    @property
    def specimen(self) -> Specimen:
        """The layers of the specimen in SI; of a checked block."""
        found = super().specimen
        assert found is not None  # the model demands them
        return found


Extremes = Literal["fresh", "lasting"]
"""Whether each test finds a law that extremes soften as if nothing had gone before it, or softened by what had."""


class LawBlock(Model):
    """A law with its parameters.

    Attributes:
        type: name of the law; `edesign laws` lists all.
        parameters: parameters with units, or the name of a published set.
        refit: whether the parameters are only a first guess; `false` keeps them as they are.
    """

    type: Annotated[str, BeforeValidator(_law_name)]
    parameters: str | dict[str, Any] | None = None
    refit: bool = True

    @property
    def choice(self) -> LawChoice:
        """The law as it was chosen."""
        return LawChoice(self.type, self.parameters, self.refit)


class CampaignLaw(LawBlock):
    """The law thought of in a campaign, whose specimen may remember.

    Attributes:
        extremes: whether extremes of one test soften the law in the next (`lasting`), or not; without the key it is
            found.
        gamma_T_of: what gamma_T multiplies; without the key it is found.
    """

    extremes: Extremes | None = None
    gamma_T_of: GammaOf | None = None

    @property
    def choice(self) -> LawChoice:
        """The law as it was chosen."""
        return replace(super().choice, extremes=self.extremes, gamma_T_of=self.gamma_T_of)


@dataclass(frozen=True)
class LawChoice:
    """A law as a file names it.

    Attributes:
        type: name of the law, one of `LAWS`.
        parameters: name of a set, or values by name as written; `read_parameters` makes numbers of them. None: not
            given.
        refit: whether they are only a first guess.
        extremes: whether those of one test soften the law in the next; None: not said.
        gamma_T_of: what gamma_T multiplies; None: not said.
        fitted: whether the parameters were fitted to the tests of the campaign, which names none.
    """

    type: str
    parameters: Mapping[str, Any] | str | None = None
    refit: bool = True
    extremes: Extremes | None = None
    gamma_T_of: GammaOf | None = None
    fitted: bool = False


def is_programme(root: Node) -> bool:
    """Return whether a file is a programme of tests rather than a campaign, which has the same keys in part.

    Args:
        root: outermost mapping of the file.
    """
    tests = root.child("tests")
    plans = () if tests is None else tests.items or ()
    return "sampling_rate" in (root.entries or {}) or any(plan.child("type") is not None for plan in plans)


def is_campaign(root: Node) -> bool:
    """Return whether all tests of a file are those of a campaign, which name a file and have no type.

    Args:
        root: outermost mapping of the file.
    """
    tests = root.child("tests")
    entries = () if tests is None else tests.items or ()
    return bool(entries) and all(entry.child("file") is not None and entry.child("type") is None for entry in entries)


def check_specimen(block: SpecimenBlock, problems: Problems) -> None:
    """Check that number, area and thickness of layers are there, once each, or none of them."""
    sizes = ("layer_area", "layer_area_mm2", "layer_thickness", "layer_thickness_mm")
    if block.layers is None:
        if any(getattr(block, key) is not None for key in sizes):
            problems.under(("specimen",), "layers", "this key is missing; it belongs to the size of a layer [E-KEY-02]")
        return
    for key, suffix in (("layer_area", "mm2"), ("layer_thickness", "mm")):
        check_one(block, key, f"{key}_{suffix}", ("specimen",), problems)


def check_law(block: LawBlock | None, problems: Problems, complete: bool) -> None:
    """Check the parameters of a law, if there are any.

    Args:
        block: of a file in which it stands as `law`.
        complete: whether a parameter that is missing is a problem.
    """
    if block is None or block.parameters is None:
        return
    keys: Keys = ("law", "parameters")
    law = LAWS[block.type]
    try:
        values = read_parameters(law, block.parameters)
        CoreDamper(law.name, list(values.values()))  # what no parameter alone can show
    except ParameterError as error:
        for name, message in error.problems:
            given = isinstance(block.parameters, dict) and name in block.parameters
            if given:
                problems.at_value((*keys, name), message)
            elif complete:
                problems.under(keys, name, message)
    except (InputError, CoreError) as error:
        problems.at_value(keys, str(error))


def check_one(block: Model, key: str, plain: str, keys: Keys, problems: Problems, required: bool = True) -> None:
    """Check that a value is given with its unit or as a plain number, and not twice.

    Args:
        keys: place of the block in the file.
        required: whether one of them must be there.
    """
    given = [name for name in (key, plain) if getattr(block, name) is not None]
    if len(given) == 2:
        problems.at_key((*keys, plain), f"`{key}` says this already; leave one of them out [E-KEY-03]")
    elif not given and required:
        problems.under(keys, plain, f"this key is missing (or `{key}`, with its unit) [E-KEY-02]")
