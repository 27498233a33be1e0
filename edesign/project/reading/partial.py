"""Cross checks of a file some parts of which are wrong: those that need no such part are reported at once with it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError, create_model

from edesign.project.reading.base import Model
from edesign.project.reading.problems import Problems, nearest

M = TypeVar("M", bound=BaseModel)
_STEP = re.compile(r"[.\[]")


def readable_part(model: type[M], problems: Problems) -> M | None:
    """Return a model of those parts of a file that are right; it has no attribute for the others.

    Args:
        problems: of the file, of which the whole is not right.

    Returns:
        The model, for `check_independent` alone; None if no part is right.
    """
    names = {info.alias or name: name for name, info in model.model_fields.items()}
    if problems.root.entries is None or not set(problems.root.entries) & set(names):
        return None
    plain = problems.root.plain()
    given = {key: value for key, value in plain.items() if key in names}
    absent = [key for key in names if key not in given]
    meant = {nearest(key, absent) for key in plain if key not in names}  # by keys that are misspelt
    reported = {_STEP.split(problem.keys_text)[0] for problem in problems.found}
    wrong = {name for key, name in names.items() if key in reported | meant}
    right: dict[str, Any] = {
        name: (info.annotation, info) for name, info in model.model_fields.items() if name not in wrong
    }
    if not right:
        return None
    part = create_model("Part", __base__=Model, **right)
    try:
        values = part.model_validate({key: value for key, value in given.items() if names[key] in right})
    except ValidationError:  # of a problem that was not worth a report
        return None
    found = model.model_construct(**{name: getattr(values, name) for name in right})
    for name in wrong:
        found.__dict__.pop(name, None)
    return found


def check_independent(part: BaseModel, checks: Iterable[Callable[[], None]]) -> None:
    """Run cross checks, each until it reads a part of the file that is wrong.

    What a check has reported before that is true of what it has asked for.

    Args:
        part: as `readable_part` returns it.
        checks: that collect problems.
    """
    missing = set(type(part).model_fields) - set(part.__dict__)
    for check in checks:
        try:
            check()
        except AttributeError as error:
            if error.obj is not part or error.name not in missing:
                raise
