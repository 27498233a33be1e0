"""The kinds of files that edesign knows: what they are, what it does with them, and which models read them."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class FileKind:
    """A kind of file.

    Attributes:
        name: with which messages go on after "this is a": "project file".
        use: what edesign does with it, a clause.
        keys: of its outermost mapping, which it has all; none: it is no YAML.
        without: keys that it does not have.
        entries: a list in it, and a key that an item of it has, where another kind has the same keys.
        schema: its name in `edesign schema NAME`, "" without a schema.
        model: module and class that read it.
        guide: page of docs/ that explains it.
        files: names that such files often have, for settings of editors.
        needed: keys without which a whole file is refused, though its model does without them elsewhere.
        title: for people where `name` does not distinguish it from other kinds; "": it does.
    """

    name: str
    use: str
    keys: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    entries: tuple[str, str] | None = None
    schema: str = ""
    model: str = ""
    guide: str = ""
    files: tuple[str, ...] = ()
    needed: tuple[str, ...] = ()
    title: str = ""

    @property
    def described(self) -> str:
        """Name of the kind with its article and format."""
        article = "an" if self.name[0] in "aeiou" else "a"
        return f"{article} {self.name} (YAML)" if self.keys else f"{article} {self.name}"

    @property
    def titled(self) -> str:
        """Title of the kind among those that have a schema."""
        return self.title or self.name


ARCHIVE = FileKind("archive of results (HDF5)", "`edesign show` prints what it holds")
TABLE = FileKind(
    "table of numbers (CSV)",
    "`edesign inspect` prints what is in it; `characterise`, `sheet`, `rts identify` and `rts judge` read such",
)
PROJECT = FileKind(
    "project file",
    "`edesign run` runs it",
    keys=("edesign",),
    schema="project",
    model="edesign.project.project.Project",
    guide="reference/project_file.md",
    files=("project.yaml",),
)
STUDY = FileKind(
    "study file",
    "`edesign run` runs it",
    keys=("edesign_study",),
    schema="study",
    model="edesign.project.study.study.Study",
    guide="reference/study_file.md",
    files=("study.yaml", "study_*.yaml"),
)
BUILDING = FileKind(
    "building file",
    "`edesign run` runs it",
    keys=("edesign_building",),
    schema="building",
    model="edesign.project.building.building.Building",
    guide="reference/building_file.md",
    files=("building.yaml",),
)
SUBSTRUCTURE_TESTS = FileKind(
    "substructure test file",
    "`edesign rts run` runs it",
    keys=("edesign_rts",),
    schema="rts",
    model="edesign.project.substructure.rts_file.RtsFile",
    guide="reference/rts_file.md",
    files=("rts.yaml", "rts_*.yaml"),
)
SUITE = FileKind(
    "suite file",
    "`edesign records`, `match` and `spectrum` read it",
    keys=("edesign_suite",),
    schema="suite",
    model="edesign.ground_motion.suite.Suite",
    guide="how_to/suites.md",
    files=("suite.yaml", "suite_*.yaml"),
)
REFERENCE = FileKind(
    "reference file",
    "`edesign compare ARCHIVE` puts an archive beside it",
    keys=("edesign_reference",),
    schema="reference",
    model="edesign.project.study.reference.Reference",
    guide="reference/reference_files.md",
    files=("reference.yaml", "reference_*.yaml"),
)
RIG = FileKind(
    "rig file",
    "a substructure test file names it by `rig: {file: ...}`",
    keys=("rig",),
    without=("compensators", "tests"),
    schema="rig",
    model="edesign.project.substructure.rig.RigFile",
    guide="reference/rts_file.md",
    files=("rig.yaml", "rig_*.yaml"),
)
LAW = FileKind(
    "law file",
    "a project names it by `dampers: {laws: {NAME: {file: ...}}}`, substructure tests by `law_file`",
    keys=("type", "parameters"),
    schema="law",
    model="edesign.project.dampers.dampers.LawDescription",
    guide="reference/laws/README.md",
    files=("law.yaml", "law_*.yaml"),
    needed=("type", "parameters"),
)
STRUCTURE_CAMPAIGN = FileKind(
    "campaign file",
    "`edesign calibrate` reads it",
    keys=("structure", "channels"),
    schema="structure_campaign",
    model="edesign.calibration.structures.structure_file.StructureFile",
    guide="how_to/structures.md",
    files=("structure_campaign.yaml",),
    title="campaign file of a structure",
)
PROPERTY_CAMPAIGN = FileKind(
    "campaign file",
    "`edesign calibrate` reads it",
    keys=("properties", "specimen"),
    schema="property_campaign",
    model="edesign.calibration.properties.campaign.PropertyCampaignFile",
    guide="how_to/calibration.md",
    files=("property_campaign.yaml",),
    title="campaign file of a property table",
)
CAMPAIGN_OR_PROGRAMME = FileKind(
    "campaign or programme file",
    "of a campaign `edesign characterise`, `sheet`, `fit` and `calibrate` take the tests; `test` runs a programme",
    keys=("tests",),
    without=("channels", "compensators", "rig", "structure"),
    schema="campaign",
    model="edesign.damper.testing.campaign.CampaignFile",
    guide="how_to/damper_tests.md",
    files=("campaign.yaml", "campaign_*.yaml"),
    title="campaign file of damper tests",
)
PROGRAMME = replace(
    CAMPAIGN_OR_PROGRAMME,
    entries=("tests", "type"),
    schema="programme",
    model="edesign.damper.testing.programme_file.Programme",
    files=("programme.yaml", "programme_*.yaml"),
    title="programme file",
)
"""A schema knows it from a campaign by its list; the outermost keys, by which edesign knows kinds, are the same."""
STRUCTURE = FileKind(
    "structure file",
    "its `structure` goes into a campaign of records",
    keys=("structure",),
    without=("channels", "compensators", "rig", "tests"),
)
NATIONAL = FileKind(
    "national data file",
    "a `hazard` names it by `country: NAME.yaml`",
    keys=("zones",),
    schema="national",
    model="edesign.project.actions.national_file.NationalFile",
    guide="reference/hazard.md",
)
SAP2000 = FileKind("model of SAP2000 (text)", "`edesign translate MODEL.s2k project.yaml` makes a project of it")
PDF = FileKind("PDF document", "edesign writes such and reads none")
PICTURE = FileKind("picture", "edesign writes such and reads none")
PAGE = FileKind("page of HTML", "edesign writes such and reads none; the archive that it shows has the numbers")
WORKBOOK = FileKind("workbook or another zip file", "save a sheet of numbers as CSV; unpack other files")
PACKED = FileKind("compressed file", "unpack it")
JSON = FileKind("file of JSON", "edesign writes such beside its results and reads none")
EMPTY = FileKind("file without content", "it may not have been written to its end")
RECORDING = FileKind(
    "recorded motion", "`edesign inspect`, `spectrum` and `match` read it; a project names it under `records`"
)
TEXT = FileKind("file of text", "`edesign check` says what edesign takes it for")
YAML_KINDS = (
    PROJECT,
    STUDY,
    BUILDING,
    SUBSTRUCTURE_TESTS,
    SUITE,
    REFERENCE,
    RIG,
    LAW,
    STRUCTURE_CAMPAIGN,
    PROPERTY_CAMPAIGN,
    PROGRAMME,
    CAMPAIGN_OR_PROGRAMME,
)
"""Those with a key of their own, then those that are known by several; with keys in common the narrower one first."""
CHECKED_KINDS = (STRUCTURE, NATIONAL)
"""Which no command takes but `check`; they are known by a key that other files may have as well."""
