"""Plane frames of a building as the text of a project file."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from fractions import Fraction
from types import MappingProxyType

from edesign.codes.aisc341.buckling_restrained import RestrainedBrace
from edesign.errors import InputError
from edesign.frame.sections.tapered import tapered_name
from edesign.project.building.building import Building
from edesign.project.building.layout import ways
from edesign.project.building.members import BeamRun, BraceRun, ColumnRun
from edesign.project.building.names import BracePlace, column_name, node_name
from edesign.project.frame.materials import ElasticMaterial, Material, MenegottoPintoMaterial, with_stiffness
from edesign.project.frame.member_design import ElasticUse, MemberStability, SteelFactors
from edesign.project.frame.sections import BoxSection, PlateSection, RectangleSection
from edesign.project.reading.yaml_edit import yaml_text
from edesign.space.checks.capacity import dissipative_members
from edesign.space.extract.ends_text import ends_text
from edesign.space.extract.frame_row import FrameRow
from edesign.space.extract.leaning import leaning, leaning_shares
from edesign.space.extract.plane_frame import AtNodes, PlaneFrame, parallel_frames
from edesign.space.extract.selections import runs, selection, value
from edesign.space.extract.study_text import StudyNames, study_blocks
from edesign.space.structure.area_loads import BeamShare
from edesign.space.structure.design_block import MOMENT_FRAME, design_of, system_of
from edesign.space.structure.load_cases import ALWAYS
from edesign.space.structure.masses import gravity_factor
from edesign.space.structure.restrained import law_of_run

_WEAK = "_weak"
_PARTS = 64
"""Simple fractions of a length have at most this denominator."""
LEANING = "leaning"
"""Section of the line of columns that stands for what leans on the frame, and its elastic material."""


def project_text(
    row: FrameRow, study: StudyNames | None = None, elastic: Mapping[str, ElasticUse] = MappingProxyType({})
) -> str:
    """Return plane frames as a project file: tributary loads and masses, sections, supports, and first analyses.

    The loads of a beam act where they do in the building. Beside a single frame, parallel frames that resist nothing
    stand as one more line of pin-ended columns, tied by the diaphragms, with their share of mass and load.

    Args:
        row: one frame of a building, or all of a direction.
        study: names of the files of a study of it, which needs damping, records and a law of dampers; None: no study.
        elastic: use of members in the elastic design of the building, by name; those of others are left out.

    Raises:
        InputError: it has springs at its column bases, or something else that a project file cannot say; a study is
            asked for of a frame on buckling-restrained braces.
    """
    row.check()
    if study is not None and any(run.law is not None for frame in row.frames for run in frame.braces.values()):
        raise InputError(
            f"{row.building.path.name}: {row.name} has buckling-restrained braces, which are its dampers; extract it "
            "without a study, and give it one of `method: hysteretic`, or histories as it is [E-DEVICE-04]"
        )
    text = "\n".join(_ProjectText(row, elastic).text)
    return text if study is None else f"{text}\n{study_blocks(row, study)}"


def left_out(building: Building) -> list[str]:
    """Return what a building has that frames taken out of it do not have, such as `dampers`.

    Args:
        building: from `load_building`.
    """
    of = building.dampers
    has: dict[str, object] = {}
    if of is not None:
        has = {"dampers": of.devices, "tuned masses": of.attachments, "isolators": of.isolation}
    found = [name for name, there in has.items() if there]
    return [*found, f"own load cases ({', '.join(building.loads.cases)})"] if building.loads.cases else found


def _quoted(words: str) -> str:
    """Words in a list of YAML."""
    return json.dumps(words, ensure_ascii=False)


class _ProjectText:
    """The parts of the file."""

    def __init__(self, row: FrameRow, elastic: Mapping[str, ElasticUse]) -> None:
        self.row, self.elastic = row, elastic
        self.building = row.building
        self.storeys = row.top
        self.shares = leaning_shares(row.alone) if row.alone is not None else {}
        tied = set(self.shares) <= set(self.building.diaphragms.numbers(1, self.storeys))
        self.leans = bool(self.shares) and tied
        """Whether there is a line for what leans on the frame."""
        self.leaning_top = max(self.shares) if self.leans else 0
        self.lines = range(row.n_lines + self.leans)
        self.bays = range(1, len(self.lines))
        self.leaning_line = row.n_lines
        self.leaning_steel = LEANING if LEANING not in self.building.materials else f"{LEANING}_columns"
        self.beams = row.merged(lambda frame: {(p.bay, p.floor): run for p, run in frame.beams.items()})

    @property
    def text(self) -> list[str]:
        parts = (
            self.head,
            self.grid,
            self.members,
            self.sections,
            self.materials,
            self.loads,
            self.masses,
            self.dampers,
            self.design,
            self.actions,
        )
        return [line for part in parts for line in part()]

    def head(self) -> list[str]:
        row = self.row
        text = [f"# {row.name[0].upper()}{row.name[1:]} of the building."]
        text += self._reading()
        text.append("# Beams carry their loads where these act, nodes what beams at right angles bring.")
        if without := left_out(self.building):
            stands = "The frame stands on its supports. " if self.building.isolation is not None else ""
            text.append(f"# {stands}The building has {', '.join(without)} too, which are not in this file.")
        text += self._leaning_text() if row.alone is not None and self.shares else []
        if any(not run.in_compression for frame in row.frames for run in frame.braces.values()):
            text.append("# Of diagonals that do not count in compression each has half its area, as in the building.")
        return [*text, "", "edesign: 1", f"title: {yaml_text(f'{self.building.title}, {row.name}')}", ""]

    def _reading(self) -> list[str]:
        """How results are read against the plans of the building."""
        row, first = self.row, self.row.frames[0]
        storey = min(storey for _, storey in first.columns)
        line = first.lines[min(i for i, s in first.columns if s == storey)]
        told = f"{column_name(line, storey)} is the column on line {line} in storey {storey}"
        text = [
            "# Members and nodes of its results have their names in the plans of the building:",
            f"# {told}, {node_name(line, storey)} the node above it.",
        ]
        if first.beams:
            beam = next(iter(first.beams))
            where = f"bay {beam.bay} of frame {first.name} at floor {beam.floor}"
            text.append(f"# {beam} is the beam in {where}; what else stands in a bay is named likewise.")
        if row.alone is not None:
            return [*text, "# Selections in this file take lines by these names too, and bays from the left."]
        n_bays = len(first.lines) - 1
        bays = [
            f"{start + 1} to {start + n_bays} {frame.name}" if n_bays > 1 else f"{start + 1} {frame.name}"
            for frame, start in zip(row.frames, row.starts, strict=True)
        ]
        return [*text, f"# Selections in this file count bays through: {', '.join(bays)}."]

    def _leaning_text(self) -> list[str]:
        others, along = parallel_frames(self.row.frames[0]), self.row.along
        first = next(iter(self.shares))
        leaning = ", ".join(f"{share:.4g} of {others[n].name}" for n, share in self.shares[first].items())
        shares = f"by the lever rule, at floor {first} {leaning}"
        text = f"# Frames that resist nothing along {along} lean on this one {shares}."
        if self.leans:
            line = self.row.line_name(self.leaning_line)
            return [text, f"# Line {line} is theirs: pin-ended columns with their masses and loads."]
        return [
            text,
            "# Not all floors are diaphragms, which would tie them: their masses and loads are not in this file.",
        ]

    def grid(self) -> list[str]:
        widths = list(self.row.widths)
        widths += widths[-1:] if self.leans else []
        found = self.row.merged(lambda frame: {(i, 1): frame.support(i) for i, s in frame.columns if s == 1})
        supports = {line: kind for (line, _), kind in sorted(found.items())}
        supports |= {self.leaning_line: "pinned"} if self.leans else {}
        kinds, without = set(supports.values()), left_out(self.building)
        by_line = "{" + ", ".join(f"{self.row.line_name(i)}: {kind}" for i, kind in supports.items()) + "}"
        return [
            "frame:",
            f"  bays: {_lengths(widths, 'width')}",
            f"  axes: [{', '.join(map(self.row.line_name, self.lines))}]",
            f"  in_building: [{', '.join(frame.name for frame in self.row.frames)}]",
            *([f"  left_in_building: [{', '.join(map(_quoted, without))}]"] if without else []),
            f"  storeys: {_lengths(self.building.storey_heights[: self.storeys], 'height')}",
            f"  supports: {kinds.pop() if len(kinds) == 1 else by_line}",
            f"  diaphragms: {self._diaphragms()}",
        ]

    def _diaphragms(self) -> str:
        floors = list(self.building.diaphragms.numbers(1, self.storeys))
        return selection(floors, list(range(1, self.storeys + 1)), str) if floors else "none"

    def members(self) -> list[str]:
        row = self.row
        columns = {place: self._column(run) for place, run in row.merged(lambda frame: frame.columns).items()}
        columns |= {(self.leaning_line, s): (LEANING, self.leaning_steel, "") for s in range(1, self.leaning_top + 1)}
        beams = {place: (run.section, _steel_name(run)) for place, run in self.beams.items()}
        braces = row.merged(
            lambda frame: {
                (p.bay, p.storey): (_kind(p, run), run.section, run.material, run.in_compression)
                for p, run in frame.braces.items()
                if run.law is None
            }
        )
        text = ["  columns:"]
        for at, storeys, (name, steel, axis) in runs(columns, self.lines, self.storeys, self.row.line_name):
            text.append(f"    - {{lines: {at}, storeys: {storeys}, {_section(name, steel)}{axis}}}")
        text.append("  beams:" if beams else "  beams: []")
        for at, floors, (name, steel) in runs(beams, self.bays, self.storeys, str):
            text.append(f"    - {{bays: {at}, floors: {floors}, {_section(name, steel)}}}")
        text += ["  braces:"] if braces else []
        for at, storeys, (kind, name, steel, counts) in runs(braces, self.bays, self.storeys, str):
            more = "" if counts else ", compression: false"
            text.append(f"    - {{bays: {at}, storeys: {storeys}, kind: {kind}, {_section(name, steel)}{more}}}")
        return [*text, *self._missing(columns, beams), *self._releases(), ""]

    def _column(self, run: ColumnRun) -> tuple[str, str, str]:
        """Section, material and axis of a column; about the weak axis an own section by properties has another name."""
        if run.strong == self.row.along:
            return run.section, run.material, ""
        own = self.building.sections.get(run.section)
        if own is None or isinstance(own, PlateSection):
            return run.section, run.material, ", axis: weak"
        return f"{run.section}{_WEAK}", run.material, ""

    def _missing(self, columns: Mapping[tuple[int, int], object], beams: Mapping[tuple[int, int], object]) -> list[str]:
        """Places of the grid that this frame does not fill."""
        levels = range(1, self.storeys + 1)
        no_columns = {(i, s): True for s in levels for i in self.lines if (i, s) not in columns}
        no_beams = {(b, f): True for f in levels for b in self.bays if (b, f) not in beams}
        text = ["  missing:"] if no_columns or no_beams else []
        if no_columns:
            places = runs(no_columns, self.lines, self.storeys, self.row.line_name)
            text.append("    columns: [" + ", ".join(f"{{lines: {at}, storeys: {s}}}" for at, s, _ in places) + "]")
        if no_beams:
            places = runs(no_beams, self.bays, self.storeys, str)
            text.append("    beams: [" + ", ".join(f"{{bays: {at}, floors: {f}}}" for at, f, _ in places) + "]")
        return text

    def _releases(self) -> list[str]:
        ends = {(True, True): "both", (True, False): "start", (False, True): "end"}
        pins = {}
        for place, run in self.beams.items():
            pinned = (run.ends.start == "pinned", run.ends.end == "pinned")
            if any(pinned):
                pins[place] = ends[pinned]
        text = ["  releases:"] if pins or self.leans else []
        for at, floors, which in runs(pins, self.bays, self.storeys, str):
            text.append(f"    - {{beams: {{bays: {at}, floors: {floors}}}, ends: {which}}}")
        if self.leans:
            text.append(
                f"    - {{columns: {{lines: {self.row.line_name(self.leaning_line)}, storeys: all}}, ends: both}}"
            )
        return text

    def sections(self) -> list[str]:
        """Own sections of the building, and that of what leans on the frame; all others are known by their names."""
        used: dict[str, str] = {}
        columns = [run for frame in self.row.frames for run in frame.columns.values()]
        others = [run.section for frame in self.row.frames for run in frame.braces.values() if run.law is None]
        others += [run.section for run in self.beams.values()]
        for name in [*(self._column(run)[0] for run in columns), *others]:
            of = name.removesuffix(_WEAK) if name not in self.building.sections else name
            if of in self.building.sections:
                used[name] = self._own_section(of, weak=of != name)
            elif tapered_name(of) is not None:
                raise InputError(
                    f"{self.building.path.name}: {of} has tapered flanges, which frames in a plane do not have; give "
                    "the building an I section of plates, or a section with parallel flanges [E-FRAME-02]"
                )
            elif self.row.space.section(of).axial_alone:
                shape = self.row.space.section(of)
                area, inertia = value(1e4 * shape.A, "cm^2"), value(1e8 * min(shape.I_y, shape.I_z), "cm^4")
                used[name] = f"{{area: {area}, inertia: {inertia}}}  # about its weaker axis"
        used |= {LEANING: self._leaning_section()} if self.leans else {}
        return [
            *(["sections:", *(f"  {name}: {of}" for name, of in used.items()), ""] if used else []),
            "fibres: {fillets: true}                # areas and moments of inertia of the catalogue",
            "",
            *ends_text(self.row),
        ]

    def _own_section(self, name: str, weak: bool) -> str:
        own, shape = self.building.sections[name], self.row.space.section(name)
        if isinstance(own, PlateSection):
            sizes = {key: getattr(own, key) for key in ("height", "width", "flange", "web")}
            return "{" + ", ".join(f"{key}: {value(1e3 * size, 'mm')}" for key, size in sizes.items()) + "}"
        if isinstance(own, BoxSection):
            clear = own.height - 2.0 * own.flange
            far, between = (own.width, own.flange, own.height), (2.0 * own.web, clear)
            if weak:
                far, between = (clear, own.web, own.width), (2.0 * own.flange, own.width)
            width, depth, whole = far
            beside = 0.5 * (whole - depth)
            return _rectangles([(width, depth, beside), (*between, 0.0), (width, depth, -beside)])
        if isinstance(own, RectangleSection) and not weak:
            return _rectangles([(r.width, r.depth, r.centre) for r in own.rectangles])
        inertia = shape.I_z if weak else shape.I_y
        bending = f", inertia: {value(1e8 * inertia, 'cm^4')}" if inertia > 0.0 else ""
        return f"{{area: {value(1e4 * shape.A, 'cm^2')}{bending}}}"

    def _leaning_section(self) -> str:
        """The share of the columns of the first storey; pin-ended, they do not bend."""
        others = parallel_frames(self.row.frames[0])
        area = inertia = 0.0
        for number, share in next(iter(self.shares.values())).items():
            for (_, storey), run in others[number].columns.items():
                if storey == 1:
                    shape = self.row.space.section(run.section)
                    area += share * shape.A
                    inertia += share * (shape.I_y if run.strong == self.row.along else shape.I_z)
        return f"{{area: {value(1e4 * area, 'cm^2')}, inertia: {value(1e8 * inertia, 'cm^4')}}}"

    def materials(self) -> list[str]:
        columns = [run.material for frame in self.row.frames for run in frame.columns.values()]
        used = {name: self.building.steels[name] for name in columns}
        for run in self.beams.values():
            used[_steel_name(run)] = with_stiffness(self.building.steels[run.material], run.stiffness_factor)
        others = [run.material for frame in self.row.frames for run in frame.braces.values() if run.law is None]
        used |= {name: self.building.steels[name] for name in others}
        text = ["materials:", *(f"  {yaml_text(name)}: {_law(of)}" for name, of in used.items())]
        if self.leans:
            modulus = next(iter(used.values())).E
            text.append(f"  {self.leaning_steel}: {{law: elastic, E: {value(modulus / 1e9, 'GPa')}}}")
        return [*text, ""]

    def loads(self) -> list[str]:
        """Line loads and nodal loads; of several categories Q counts by psi_2 over the largest one."""
        G = {name: 1.0 for name in ALWAYS if name in self.row.space.cases}
        Q, factor, why = self._live()
        beams_G = self.row.merged(lambda frame: frame.beam_load(G))
        beams_Q = self.row.merged(lambda frame: frame.beam_load(Q))
        nodes_G, nodes_Q = self._node_load(G), self._node_load(Q)
        beams = {place: _on_beam(load, beams_Q[place]) for place, load in beams_G.items()}
        nodes = {node: (_kilo(load), _kilo(nodes_Q.get(node, 0.0))) for node, load in nodes_G.items()}
        text = ["loads:", "  beams:" if beams else "  beams: []"]
        for at, floors, (own, live, points) in runs(beams, self.bays, self.storeys, str):
            along = f"G: {value(own, 'kN/m')}, Q: {value(live, 'kN/m')}"
            text.append(f"    - {{bays: {at}, floors: {floors}, {along}{points}}}")
        text.append("  nodes:")
        for at, floors, (own, live) in runs(nodes, self.lines, self.storeys, self.row.line_name):
            text.append(f"    - {{lines: {at}, floors: {floors}, G: {value(own, 'kN')}, Q: {value(live, 'kN')}}}")
        return [*text, f"  gravity: {{G: {self.building.loads.gravity.G}, Q: {factor:.6g}}}              # {why}", ""]

    def _node_load(self, factors: Mapping[str, float]) -> AtNodes:
        found = self.row.merged(lambda frame: frame.node_load(factors))
        if self.leans:
            weights = leaning(self.row.frames[0], lambda other: other.weight(factors))
            found |= {(self.leaning_line, floor): weight for floor, weight in weights.items()}
        return found

    def _live(self) -> tuple[dict[str, float], float, str]:
        """Factors on the live load cases, the factor of Q in the gravity loads, and what it is."""
        live = {n: case.category for n, case in self.row.space.cases.items() if case.category != "permanent"}
        masses = self.building.masses
        if self.building.loads.gravity.Q is None and (masses is None or masses.from_loads is None):
            return dict.fromkeys(live, 1.0), 0.3, "the building file does not say psi_2"
        of_cases = {name: gravity_factor(self.building, category) for name, category in live.items()}
        if len(set(of_cases.values())) <= 1:
            return dict.fromkeys(live, 1.0), next(iter(of_cases.values()), 0.0), "psi_2"
        largest = max(of_cases.values())
        by_psi = dict(sorted({live[name]: psi for name, psi in of_cases.items() if psi < largest}.items()))
        others = ", ".join(f"{category} times {psi:g}/{largest:g}" for category, psi in by_psi.items())
        return {name: psi / largest for name, psi in of_cases.items()}, largest, f"psi_2; Q of category {others}"

    def masses(self) -> list[str]:
        found = self.row.merged(PlaneFrame.node_mass)
        if self.leans:
            leans = leaning(self.row.frames[0], PlaneFrame.node_mass)
            found |= {(self.leaning_line, floor): mass for floor, mass in leans.items()}
        tonnes = {node: _kilo(mass) for node, mass in found.items() if mass > 0.0}
        if not tonnes:
            return []
        directions = self.building.masses.directions if self.building.masses is not None else "horizontal"
        text = ["masses:", f"  directions: {directions}", "  given:"]
        for at, floors, mass in runs(tonnes, self.lines, self.storeys, self.row.line_name):
            text.append(f"    - {{lines: {at}, floors: {floors}, mass: {value(mass, 't')}}}")
        return [*text, ""]

    def dampers(self) -> list[str]:
        """The buckling-restrained braces as devices; where all beams are pinned the frame stands by them."""
        braces = self.row.merged(
            lambda frame: {(p.bay, p.storey): (p, run) for p, run in frame.braces.items() if run.law is not None}
        )
        if not braces:
            return []
        laws: dict[str, RestrainedBrace] = {}
        devices: dict[tuple[int, int], tuple[str, str, float]] = {}
        for place, (brace_place, run) in braces.items():
            kind, name = _kind(brace_place, run), str(run.law)
            if kind == "v":
                where = self.building.where("braces", self.building.braces.index(run), "kind")
                raise InputError(
                    f"{where}: {brace_place}: frames in a plane have buckling-restrained braces as chevrons or "
                    "diagonals; `v` is none of them [E-DEVICE-04]"
                )
            laws[name] = law = law_of_run(self.building, run) or laws[name]
            scale = self.row.space.section(run.section).A / law.area
            devices[place] = ("chevron_braces" if kind == "chevron" else kind, name, float(f"{scale:.6g}"))
        pinned = all(run.ends.start == run.ends.end == "pinned" for run in self.beams.values())
        carries = ", carries_gravity: true" if pinned else ""
        text = ["dampers:", "  laws:", *(f"    {yaml_text(name)}: {_restrained(law)}" for name, law in laws.items())]
        text.append("  devices:                              # scale: area of the core over A_sc")
        for at, storeys, (kind, name, scale) in runs(devices, self.bays, self.storeys, str):
            stands = f"kind: {kind}, bays: {at}, storeys: {storeys}"
            text.append(f"    - {{{stands}, law: {yaml_text(name)}, scale: {scale:g}{carries}}}")
        return [*text, ""]

    def design(self) -> list[str]:
        """What the checks of members go by, as in the building."""
        if self.building.design is None:
            return []
        design = design_of(self.building)
        members = design.members.model_dump(include=set(MemberStability.model_fields), exclude_defaults=True)
        if "yield_by_thickness" in design.members.model_fields_set:  # materials have f_y by thickness, or are meant
            members["yield_by_thickness"] = False
        factors = design.partial_factors.model_dump(include=set(SteelFactors.model_fields))
        blocks = ({"members": members} if members else {}) | {"partial_factors": factors}
        text = ["design:", *(f"  {name}: {yaml_text(of).strip()}" for name, of in blocks.items())]
        return [*text, *self._dissipative(), *self._elastic_use(), ""]

    def _dissipative(self) -> list[str]:
        """Beams with hinges of a moment frame, or braces, which are to yield before all else."""
        design = design_of(self.building)
        if design.ductility_class == "low":
            return []
        system = system_of(design, self.row.along).type
        space, numbers = self.row.space, dissipative_members(self.row.space, self.row.along, system)
        members = {space.members[number].name for number in numbers}
        if system != MOMENT_FRAME:
            return ["  dissipative: {braces: all}"] if members else []
        found = self.row.merged(
            lambda frame: {(p.bay, p.floor): True for p in frame.beams if members & {str(p), f"{p}_1", f"{p}_2"}}
        )
        places = runs(found, self.bays, self.storeys, str)
        beams = ", ".join(f"{{bays: {at}, floors: {floors}}}" for at, floors, _ in places)
        return [f"  dissipative: {{beams: [{beams}]}}"] if found else []

    def _elastic_use(self) -> list[str]:
        """The use of the frame's members in the elastic design, a line each; braces that are dampers here are none."""
        here = {frame.name for frame in self.row.frames}
        braces = [pair for frame in self.row.frames for pair in frame.braces.items()]
        devices = {place.name(way) for place, run in braces if run.law is not None for way in ways(place, run)}
        of_frame = [member.name for member in self.row.space.members if here & set(member.frame)]
        names = [name for name in of_frame if name not in devices]
        text = ["  elastic_use:                 # largest of all checks of the building, by `edesign extract`"]
        for name in names:
            if (of := self.elastic.get(name)) is None:
                continue
            across = ""
            if of.across is not None:
                forces = {"N": of.across.N} | ({} if of.across.V is None else {"V": of.across.V})
                told = ", ".join(f"{symbol}: {value(_kilo(force), 'kN')}" for symbol, force in forces.items())
                across = f", across: {{frames: [{', '.join(of.across.frames)}], {told}}}"
            of_combination = f"combination: {yaml_text(of.combination)}"
            text.append(f"    {name}: {{use: {of.use:g}, check: {of.check}, {of_combination}{across}}}")
        return text if len(text) > 1 else []

    def actions(self) -> list[str]:
        """The seismic action of the building, and analyses to begin with."""
        hazard = self.building.root.child("hazard")
        text = [f"hazard: {yaml_text(hazard.plain())}", ""] if hazard is not None else []
        text += ["analyses:", "  - {name: gravity, kind: gravity}"]
        if self.masses():
            text.append(f"  - {{name: modes, kind: modal, modes: {min(3, self.storeys)}}}")
            text.append("  - {name: pushover, kind: pushover, pattern: first_mode, roof_drift: 2 %}")
        return [*text, ""]


def _on_beam(own: BeamShare, live: BeamShare) -> tuple[float, float, str]:
    """Uniform G and Q of a beam, kN/m, and its forces as a file writes them: `, points: [{at: [1/3, 2/3], G: ...}]`."""
    forces: dict[tuple[float, float], list[str]] = {}
    of_own, of_live = dict(own.points), dict(live.points)
    for place in sorted({*of_own, *of_live}):
        both = _kilo(of_own.get(place, 0.0)), _kilo(of_live.get(place, 0.0))
        forces.setdefault(both, []).append(_share(place))
    texts = (
        f"{{at: [{', '.join(places)}], G: {value(of_G, 'kN')}, Q: {value(of_Q, 'kN')}}}"
        for (of_G, of_Q), places in forces.items()
    )
    points = f", points: [{', '.join(texts)}]" if forces else ""
    return _kilo(own.uniform), _kilo(live.uniform), points


def _share(place: float) -> str:
    """A share of the length: `1/3` where a simple fraction is the share, else six digits."""
    simple = Fraction(place).limit_denominator(_PARTS)
    return str(simple) if abs(float(simple) - place) < 1e-9 else f"{place:.6g}"


def _rectangles(parts: Sequence[tuple[float, float, float]]) -> str:
    """A stack of rectangles by their widths, depths and centres, m."""
    keys = ("width", "depth", "centre")
    texts = (", ".join(f"{key}: {value(1e3 * of, 'mm')}" for key, of in zip(keys, r, strict=True)) for r in parts)
    return "{rectangles: [" + ", ".join(f"{{{text}}}" for text in texts) + "]}"


def _steel_name(run: BeamRun) -> str:
    """The steel of a beam; with a slab that acts with the beam it has a name and a modulus of its own."""
    return run.material if run.stiffness_factor == 1.0 else f"{run.material}_x{run.stiffness_factor:g}"


def _kind(place: BracePlace, run: BraceRun) -> str:
    """The kind of braces of a place in a project file, which has no alternating diagonals."""
    if run.kind != "alternating":
        return run.kind
    return "rising" if "r" in ways(place, run) else "falling"


def _section(name: str, steel: str) -> str:
    return f"section: {yaml_text(name)}, material: {yaml_text(steel)}"


def _lengths(lengths: tuple[float, ...] | list[float], key: str) -> str:
    if len(set(lengths)) == 1 and len(lengths) > 1:
        return f"{{count: {len(lengths)}, {key}: {value(lengths[0], 'm')}}}"
    return f"[{', '.join(value(length, 'm') for length in lengths)}]"


def _restrained(brace: RestrainedBrace) -> str:
    """The law of a buckling-restrained brace, as a project file has it."""
    strain, omega, beta = (", ".join(f"{of:.6g}" for of in values) for values in zip(*brace.points, strict=True))
    said = [
        f"A_sc: {value(1e6 * brace.area, 'mm^2')}",
        f"F_ysc: {value(brace.yield_stress / 1e6, 'MPa')}",
        f"E: {value(brace.modulus / 1e9, 'GPa')}",
        f"L_wp: {value(brace.length, 'm')}",
        f"L_y: {value(brace.yielding_length, 'm')}",
        f"KF: {brace.stiffness_factor:.6g}",
        f"alpha: {brace.post_yield_ratio:.6g}",
        f"R_y: {brace.overstrength:.6g}",
        f"strain: [{strain}], omega: [{omega}], beta: [{beta}]",
    ]
    return f"{{type: buckling_restrained, parameters: {{{', '.join(said)}}}}}"


def _law(material: Material) -> str:
    """A steel as a project file has it."""
    said = [f"law: {material.law}", f"E: {value(material.E / 1e9, 'GPa')}"]
    if not isinstance(material, ElasticMaterial):
        said += [f"fy: {value(material.fy / 1e6, 'MPa')}", f"hardening: {material.hardening:.6g}"]
    if isinstance(material, MenegottoPintoMaterial):
        said += [f"{key}: {getattr(material, key):.6g}" for key in ("R0", "cR1", "cR2")]
    return f"{{{', '.join(said)}}}"


def _kilo(number: float) -> float:
    """A thousandth of a number, with the digits that are written, so that equal values are written once."""
    return float(f"{number / 1e3:.6g}")
