"""The model of a study as figures: the frame that its variants share, and what each of them adds or changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from edesign.project.dampers.dampers import DamperRun, Dampers
from edesign.project.dampers.designs import Design, Kind
from edesign.project.dampers.device_names import laws_of_design
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.notation.selections import NumberSelection
from edesign.project.project import Project
from edesign.project.study.study import Study, Variant
from edesign.report.drawing.captions import file_name, some_names
from edesign.report.model.figures import Named, dampers_figure, geometry, has_dampers, has_loads, loads_and_masses
from edesign.study.plan.variants import dampers_at_temperature, variant_project

if TYPE_CHECKING:
    from collections.abc import Collection

GEOMETRY = ("sections", "materials", "elements", "hinges", "joints", "panel_zones", "soils")
LOADS = ("loads", "masses")
"""Parts of a project that its drawings show, besides frame and dampers."""
MOST_NOTES = 6


@dataclass
class _Drawn:
    """A model that is drawn once for all variants that look alike.

    Attributes:
        project: of the first of them.
        design: of its dampers, which has found no sizes; "": they are known.
        variants: their names.
        notes: what distinguishes them, a clause each.
    """

    project: Project
    design: str
    variants: list[str]
    notes: list[str] = field(default_factory=list)

    @property
    def named(self) -> str:
        """Its variants in words."""
        return f"variant{'s' * (len(self.variants) > 1)} {some_names(self.variants, 4)}"

    @property
    def differences(self) -> str:
        """The notes as a sentence, "" without any."""
        return f" {_some_names_of(self.notes)}." if self.notes else ""


def study_figures(study: Study, designed: Mapping[str, Dampers], heading: Sequence[str] = ()) -> Iterator[Named]:
    """Yield the frame of a study with its loads, then each set of dampers, and the frames of variants that differ.

    Args:
        designed: dampers by name of the design, as far as they are known; of others the places are drawn.
        heading: lines above each drawing; (): none.
    """
    bare = study.plane.with_dampers(None)
    yield geometry(bare, heading)
    if has_loads(bare):
        yield loads_and_masses(bare, heading)
    loaded = [bare]
    for drawn in _different(study, designed):
        project = drawn.project
        if not _same(project, bare, GEOMETRY):
            name, caption, figure = geometry(project, heading, drawn.named)
            yield name, f"{caption}{drawn.differences}", figure
        elif has_dampers(project):
            yield _dampers(drawn, heading)
        if not any(_same(project, other, LOADS) and project.isolation == other.isolation for other in loaded):
            loaded.append(project)
            yield loads_and_masses(project, heading, drawn.named)


def _some_names_of(notes: Collection[str]) -> str:
    """Return the first notes as one clause, and how many more there are."""
    more = len(notes) - MOST_NOTES
    return "; ".join(list(notes)[:MOST_NOTES]) + (f"; and {more} more" if more > 0 else "")


def _dampers(drawn: _Drawn, heading: Sequence[str]) -> Named:
    what = "where they act, laws and sizes"
    if drawn.design:
        what = f"the places of the design {drawn.design}, without sizes"
    isolated = drawn.project.isolation is not None
    caption = f"{'Isolated base and dampers' if isolated else 'Dampers'} of the {drawn.named}: {what}."
    above = (*heading, caption.rstrip(".")) if heading else ()
    figure = dampers_figure(drawn.project, above, drawn.design)
    return file_name("model", drawn.variants[0]), f"{caption}{drawn.differences}", figure


def _different(study: Study, designed: Mapping[str, Dampers]) -> list[_Drawn]:
    """The models of the variants that differ; one that was made of another is named with that one."""
    found: list[_Drawn] = []
    for name, variant in study.variants.items():
        source = study.derived.get(name)
        if source is not None:
            of = next((one for one in found if source.of in one.variants), None)
            what = f"{source.bound} bound of the properties" if source.bound else f"{source.vary} = {source.said}"
            if of is not None:
                of.notes.append(f"{name}: {what}")
                continue
        dampers, design, base = dict(designed), "", study.project_of(name)
        assert isinstance(base, Project), "the model of a building is drawn elsewhere"
        if unsized := [one for one in variant.designs if one not in designed]:
            design = " and ".join(unsized)
            dampers |= {one: _planned_dampers(base, study.designs[one]) for one in unsized}
        project = variant_project(study, name, dampers)
        assert isinstance(project, Project)
        notes = _notes(name, variant)
        like = next((one for one in found if one.design == design and _alike(one.project, project)), None)
        if like is None:
            found.append(_Drawn(project, design, [name], notes))
        else:
            like.variants.append(name)
            like.notes += notes
    return found


def _notes(name: str, variant: Variant) -> list[str]:
    """What is not drawn of a variant: its values, the temperature of its dampers, and the factor on their forces."""
    notes = [f"{place} = {value}" for place, value in variant.values.items()]
    notes += [f"dampers at {variant.temperature:g} °C"] if variant.temperature is not None else []
    notes += [f"forces of the dampers × {variant.property_factor:g}"] if variant.property_factor is not None else []
    return [f"{name}: {', '.join(notes)}"] if notes else []


def _alike(one: Project, other: Project) -> bool:
    """Whether two models look alike, but for temperatures and factors of laws, which are named."""
    if (one.dampers is None) != (other.dampers is None) or not _same(one, other, (*GEOMETRY, *LOADS)):
        return False
    if one.dampers is None or other.dampers is None:
        return True
    parts = ("devices", "attachments", "isolation")
    return all(getattr(one.dampers, part) == getattr(other.dampers, part) for part in parts) and all(
        one.dampers.laws[law].parameters == other.dampers.laws[law].parameters for law in one.dampers.used_laws
    )


def _same(one: Project, other: Project, parts: Collection[str]) -> bool:
    """Whether parts of two projects, and their frames as the files give them, are the same."""
    frames = one.frame, other.frame
    same = all(getattr(frames[0], key) == getattr(frames[1], key) for key in type(one.frame).model_fields)
    return same and all(getattr(one, part) == getattr(other, part) for part in parts)


def _planned_dampers(project: Project, design: Design) -> Dampers:
    """Dampers in the places of a design that has found no sizes; of a placement in all its candidate places."""
    dampers = dampers_at_temperature(project, design)
    places: list[tuple[Kind, NumberSelection, NumberSelection]]
    if isinstance(design, PlacementDesign):
        places = [(design.kind, at.bays, at.storeys) for at in design.candidates]
    else:
        places = [(at.kind, at.bays, at.storeys) for at in design.runs]
    runs = [
        DamperRun.model_construct(kind=kind, bays=bays, storeys=storeys, law=law)
        for law in laws_of_design(design)
        for kind, bays, storeys in places
    ]
    return dampers.model_copy(update={"devices": tuple(runs)})
