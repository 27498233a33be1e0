"""Lists in which equal values in a row may stand together: `[4 m, {count: 2, height: 3.5 m}]`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, get_args

from pydantic import Field, GetCoreSchemaHandler, create_model
from pydantic_core import core_schema

from edesign.project.notation.units import PositiveStiffness
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import Alternatives, OneOf

Count = Annotated[int, Field(ge=1, le=1000)]


@dataclass(frozen=True)
class Repeated(Alternatives):
    """Metadata of a list with one value for each storey, floor or bay, which may have items for several of them.

    It is kept as the list of all values: `Annotated[tuple[PositiveLength, ...], Repeated(EqualStoreys)]`.

    Attributes:
        equal: model of such an item: its `count`, and the value.
        fewest, most: how many values the whole list may have.
    """

    equal: type[Model]
    fewest: int = 1
    most: int | None = None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        spread = core_schema.no_info_after_validator_function(
            self._spread, handler.generate_schema(self.tagged(source))
        )
        whole = core_schema.tuple_schema(
            [core_schema.any_schema()], variadic_item_index=0, min_length=self.fewest, max_length=self.most
        )
        return core_schema.chain_schema([spread, whole])

    def tagged(self, annotation: Any) -> Any:
        """Return the list whose items are values, or equal ones together."""
        item: Any = get_args(annotation)[0] | self.equal
        whole: Any = tuple
        return whole[Annotated[item, OneOf()], ...]

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        found = handler(schema["steps"][0])
        return {**found, "minItems": 1} if self.fewest else found

    def _spread(self, items: tuple[Any, ...]) -> tuple[Any, ...]:
        (key,) = self.equal.model_fields.keys() - {"count"}
        found: list[Any] = []
        for item in items:
            equal = isinstance(item, self.equal)
            found += [getattr(item, key)] * getattr(item, "count", 1) if equal else [item]
        return tuple(found)


def equal_values(name: str, item: Any) -> type[Model]:
    """Return the model of items `{count, value}` of a list.

    Args:
        name: of the model, such as EqualForces; schemas have one of each name.
        item: type of the value.
    """
    text = """Equal values in a row of a list.

    Attributes:
        count: how many there are.
        value: of each of them.
    """
    made: type[Model] = create_model(name, __base__=Model, __doc__=text, count=(Count, ...), value=(item, ...))
    return made


EqualStiffnesses = equal_values("EqualStiffnesses", PositiveStiffness)
