"""Cross checks of the specimen: a law that is there, once, at a size that fits."""

from __future__ import annotations

from edesign.project.checks.dampers import check_law
from edesign.project.dampers.dampers import DamperLaw
from edesign.project.reading.checks_files import check_file
from edesign.project.reading.problems import Keys, Problems, unknown_name
from edesign.project.substructure.rts_file import RtsFile
from edesign.project.substructure.structure import ProjectStructure, ShearBuilding

_KEYS: Keys = ("specimen",)
_WHAT = "substructure test file"


def check_specimen(rts: RtsFile, problems: Problems) -> None:
    """Check the specimen in the laboratory; the file has no schema problems."""
    specimen = rts.specimen
    if specimen.law is not None and specimen.law_file is not None:
        problems.at_key((*_KEYS, "law_file"), "give either `law` or `law_file`, one of them [E-KEY-03]")
        return
    if specimen.law_file is not None:
        check_file(rts.folder / specimen.law_file, (*_KEYS, "law_file"), problems, _WHAT)
    elif isinstance(specimen.law, DamperLaw):
        _own_law(rts, specimen.law, problems)
    elif specimen.law is not None:
        _named_law(rts, specimen.law, problems)
    elif isinstance(rts.structure, ShearBuilding):
        missing = "a shear building does not say which; give its `law`, or a `law_file`"
        if "specimen" in rts.model_fields_set:
            problems.under(_KEYS, "law", f"this key is missing; {missing} [E-KEY-02]")
        else:
            problems.under((), "specimen", f"this key is missing; {missing} [E-KEY-02]")
    _size(rts, problems)
    if rts.structure is None and specimen.law is None and specimen.law_file is None:
        for key in ("effects", "temperature"):
            if key in specimen.model_fields_set:
                problems.at_key((*_KEYS, key), "the specimen has no law; give `law` or `law_file` [E-KEY-02]")


def _own_law(rts: RtsFile, law: DamperLaw, problems: Problems) -> None:
    keys = (*_KEYS, "law")
    check_law(problems, keys, law)
    if law.file is not None:
        check_file(rts.folder / law.file, (*keys, "file"), problems, _WHAT)
    if law.temperature_law is not None and law.temperature is None and rts.specimen.temperature is None:
        problems.at_key(
            (*keys, "temperature_law"), "a temperature law needs the `temperature` of the specimen [E-KEY-02]"
        )


def _named_law(rts: RtsFile, name: str, problems: Problems) -> None:
    keys = (*_KEYS, "law")
    if not isinstance(rts.structure, ProjectStructure):
        message = f"`{name}` would be a law of a project, and the file names none under `structure`; write the law here"
        problems.at_value(keys, f"{message}, `{{type: , parameters: }}`, or give a `law_file` [E-KEY-02]")
    elif rts.project is not None:
        laws = rts.project.dampers.laws if rts.project.dampers is not None else {}
        if name not in laws:
            problems.at_value(keys, unknown_name("damper law", name, laws))


def _size(rts: RtsFile, problems: Problems) -> None:
    """The size is said once, and a law that is changed in size has a prototype."""
    specimen = rts.specimen
    for key in specimen.size_keys:
        if isinstance(rts.structure, ProjectStructure):
            problems.at_key((*_KEYS, key), "the devices of the project have their size; leave this key out [E-KEY-03]")
        elif (
            key != "number"
            and isinstance(specimen.law, DamperLaw)
            and not (specimen.law.prototype or specimen.law.file)
        ):
            problems.at_key((*_KEYS, key), "the law has no `prototype` whose size could be changed [E-DAMPER-03]")
