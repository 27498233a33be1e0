"""The dampers that the designs of a study have found, as an archive holds them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import TypeAdapter, ValidationError

from edesign.archive.reader import Archive
from edesign.project.dampers.dampers import Dampers, Device
from edesign.project.reading.yaml_nodes import parse
from edesign.project.study.study import Study
from edesign.study.plan.variants import dampers_at_temperature
from edesign.study.results.kinds import DESIGNS


def archived_dampers(archive: Archive, study: Study) -> dict[str, Dampers]:
    """Return the dampers that the designs of an archive have found; arguments and result as of `designed_dampers`."""
    return designed_dampers(
        study, {name: archive.group_attributes(f"{DESIGNS}/{name}") for name in archive.names(DESIGNS)}
    )


def designed_dampers(study: Study, designs: Mapping[str, Mapping[str, Any]]) -> dict[str, Dampers]:
    """Return the dampers that designs have found, by name of the design.

    A design that failed or goes on has none, though its last sizes are archived: no variant was analysed with them.

    Args:
        study: with the laws.
        designs: attributes of the groups of designs, by name of the design.
    """
    found: dict[str, Dampers] = {}
    adapter: TypeAdapter[tuple[Device, ...]] = TypeAdapter(tuple[Device, ...])
    for name, attributes in designs.items():
        if attributes.get("status") != "completed" or "devices" not in attributes or name not in study.designs:
            continue
        try:
            devices = adapter.validate_python(parse(str(attributes["devices"]))[0].plain()["devices"])
        except (ValidationError, KeyError, TypeError):  # of another version
            continue
        dampers = dampers_at_temperature(study.base, study.designs[name])
        found[name] = dampers.model_copy(update={"devices": devices})
    return found
