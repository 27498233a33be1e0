"""The kinds of YAML files that have a schema, with the models that read them."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module

from pydantic import BaseModel

from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean, listed


@dataclass(frozen=True)
class SchemaKind:
    """A kind of YAML file.

    Attributes:
        name: in the command and in the names of schemas.
        title: for people.
        module, model: where its model stands.
        keys: of its outermost mapping, by which a file is known to be of this kind.
        without: keys that a file of this kind does not have.
        files: names that such files often have, for settings of editors.
        guide: page of docs/ that explains it.
        entries: a list in it, and a key that an item of it has, where other kinds have the same keys.
        needed: keys without which a whole file is refused, though its model does without them elsewhere.
    """

    name: str
    title: str
    module: str
    model: str
    keys: tuple[str, ...]
    files: tuple[str, ...]
    guide: str
    without: tuple[str, ...] = ()
    entries: tuple[str, str] | None = None
    needed: tuple[str, ...] = ()

    def load(self) -> type[BaseModel]:
        """Import and return the model of the kind."""
        found: type[BaseModel] = getattr(import_module(self.module), self.model)
        return found


KINDS = {
    kind.name: kind
    for kind in (
        SchemaKind(
            name="project",
            title="project file",
            module="edesign.project.project",
            model="Project",
            keys=("edesign",),
            files=("project.yaml",),
            guide="reference/project_file.md",
        ),
        SchemaKind(
            name="study",
            title="study file",
            module="edesign.project.study.study",
            model="Study",
            keys=("edesign_study",),
            files=("study.yaml", "study_*.yaml"),
            guide="reference/study_file.md",
        ),
        SchemaKind(
            name="building",
            title="building file",
            module="edesign.project.building.building",
            model="Building",
            keys=("edesign_building",),
            files=("building.yaml",),
            guide="reference/building_file.md",
        ),
        SchemaKind(
            name="rts",
            title="substructure test file",
            module="edesign.project.substructure.rts_file",
            model="RtsFile",
            keys=("edesign_rts",),
            files=("rts.yaml", "rts_*.yaml"),
            guide="reference/rts_file.md",
        ),
        SchemaKind(
            name="suite",
            title="suite file",
            module="edesign.ground_motion.suite",
            model="Suite",
            keys=("edesign_suite",),
            files=("suite.yaml", "suite_*.yaml"),
            guide="how_to/suites.md",
        ),
        SchemaKind(
            name="reference",
            title="reference file",
            module="edesign.project.study.reference",
            model="Reference",
            keys=("edesign_reference",),
            files=("reference.yaml", "reference_*.yaml"),
            guide="reference/reference_files.md",
        ),
        SchemaKind(
            name="rig",
            title="rig file",
            module="edesign.project.substructure.rig",
            model="RigFile",
            keys=("rig",),
            files=("rig.yaml", "rig_*.yaml"),
            guide="reference/rts_file.md",
            without=("compensators", "tests"),
        ),
        SchemaKind(
            name="law",
            title="law file",
            module="edesign.project.dampers.dampers",
            model="LawDescription",
            keys=("type", "parameters"),
            files=("law.yaml", "law_*.yaml"),
            guide="reference/laws/README.md",
            needed=("type", "parameters"),
        ),
        SchemaKind(
            name="structure_campaign",
            title="campaign file of a structure",
            module="edesign.calibration.structures.structure_file",
            model="StructureFile",
            keys=("structure", "channels"),
            files=("structure_campaign.yaml",),
            guide="how_to/structures.md",
        ),
        SchemaKind(
            name="property_campaign",
            title="campaign file of a property table",
            module="edesign.calibration.properties.campaign",
            model="PropertyCampaignFile",
            keys=("properties", "specimen"),
            files=("property_campaign.yaml",),
            guide="how_to/calibration.md",
        ),
        SchemaKind(
            name="programme",
            title="programme file",
            module="edesign.damper.testing.programme_file",
            model="Programme",
            keys=("tests",),
            without=("channels", "compensators", "rig", "structure"),
            files=("programme.yaml", "programme_*.yaml"),
            guide="how_to/damper_tests.md",
            entries=("tests", "type"),
        ),
        SchemaKind(
            name="campaign",
            title="campaign file of damper tests",
            module="edesign.damper.testing.campaign",
            model="CampaignFile",
            keys=("tests",),
            without=("channels", "compensators", "rig", "structure"),
            files=("campaign.yaml", "campaign_*.yaml"),
            guide="how_to/damper_tests.md",
        ),
        SchemaKind(
            name="national",
            title="national data file",
            module="edesign.project.actions.national_file",
            model="NationalFile",
            keys=("zones",),
            files=(),
            guide="reference/hazard.md",
        ),
    )
}
"""By name; of kinds that have keys in common those with more of them stand first."""


def kind_named(name: str) -> SchemaKind:
    """Return a kind of file by its name.

    Raises:
        InputError: there is none.
    """
    if name not in KINDS:
        hint = did_you_mean(name, KINDS)
        raise InputError(f"there is no kind of file `{name}`{hint} (there are: {listed(KINDS, 30)})")
    return KINDS[name]
