"""What pushovers stand for in a plan."""

from __future__ import annotations

from edesign.project.analysis.analyses import PushoverAnalysis, TargetAnalysis
from edesign.project.analysis.pushover import pattern_name


def pushover_parts(spec: PushoverAnalysis, hazard_levels: tuple[str, ...]) -> list[PushoverAnalysis | TargetAnalysis]:
    """Return the pushovers of each pattern and direction, each followed by those to its target displacements.

    Several patterns stand in the names as `push.uniform`, both directions as `push.right`, targets as `push.n2.DBE`.

    Args:
        spec: of one or several patterns, in one or both directions.
        hazard_levels: names of all levels, for which targets are found where `spec` names none.
    """
    found: list[PushoverAnalysis | TargetAnalysis] = []
    for pattern in spec.pattern:
        for direction in spec.directions:
            name = [spec.name]
            name += [pattern_name(pattern)] * (len(spec.pattern) > 1) + [direction] * (len(spec.directions) > 1)
            one = spec.model_copy(update={"name": ".".join(name), "pattern": (pattern,), "direction": direction})
            found.append(one)
            values = {key: getattr(one, key) for key in PushoverAnalysis.model_fields if key not in ("kind", "name")}
            for method in spec.targets:
                for level in spec.levels if spec.levels is not None else hazard_levels:
                    place = ".".join((one.name, method, level))
                    found.append(
                        TargetAnalysis.model_construct(kind="target", name=place, method=method, level=level, **values)
                    )
    return found
