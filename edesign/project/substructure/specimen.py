"""What stands in the laboratory."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from pydantic import Field

from edesign.project.dampers.dampers import Count, DamperLaw, Effect, Layers
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import PositiveArea, PositiveLength
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import Keys
from edesign.project.reading.yaml_nodes import Node

LawChoice = Annotated[Annotated[str, Field(min_length=1)] | DamperLaw, OneOf()]


class Specimen(Model):
    """The virtual damper.

    Attributes:
        law: name of a law of the project, or a law as projects have it; without a law the physical devices say it.
        law_file: law file of `edesign fit` or `calibrate`, in place of `law`.
        effects: effects in the forces of the specimen, which the law that the written campaign names does not have.
        temperature: temperature of the specimen; without the key that of the law.
        number: specimens side by side.
        layers: layers of elastomer; without the key those of the prototype.
        layer_area: area of a layer; without the key that of the prototype.
        layer_thickness: thickness of a layer; without the key that of the prototype.
    """

    law: LawChoice | None = None
    law_file: Annotated[str, Field(min_length=1)] | None = None
    effects: tuple[Effect, ...] = ()
    temperature: Temperature | None = None
    number: Count = 1
    layers: Layers | None = None
    layer_area: PositiveArea | None = None
    layer_thickness: PositiveLength | None = None

    @property
    def size_keys(self) -> tuple[str, ...]:
        """The keys of the size that are given."""
        names = ("number", "layers", "layer_area", "layer_thickness")
        return tuple(name for name in names if name in self.model_fields_set)


@dataclass(frozen=True)
class PlacedLaw:
    """A law and its place in a file.

    Attributes:
        law: type and parameters, or the name of a law file; its temperature is that of the specimen.
        path: of the file that it stands in; a law file is relative to its folder.
        root: the YAML tree of that file.
        keys: of the law in it.
    """

    law: DamperLaw
    path: Path
    root: Node
    keys: Keys
