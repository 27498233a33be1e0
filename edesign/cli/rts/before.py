"""`edesign rts check`, `export` and `serve`: what a laboratory asks before and during a test."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_file
from edesign.cli.rts.tests_file import load_tests
from edesign.cli.shared.complete import compensator_names
from edesign.cli.shared.streams import progress_line
from edesign.errors import InputError
from edesign.optional_stages import optional
from edesign.project.reading.problems import unknown_name
from edesign.report.drawing.style import check_figure_name
from edesign.report.substructure.advice_tables import advice_tables
from edesign.report.substructure.map_figures import draw_map
from edesign.report.tables.text import print_tables
from edesign.substructure.advice.advice import advise
from edesign.substructure.compensation.described import compensator_of
from edesign.substructure.compensation.export import export as write
from edesign.substructure.laboratory import laboratory
from edesign.substructure.server.serve import serve as wait
from edesign.substructure.sized_damper import SizedDamper
from edesign.substructure.virtual_tests import VirtualLaboratory

File = Annotated[Path, typer.Argument(help="The file of substructure tests.", show_default=False)]


def check(
    file: File,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", metavar="FILE", help="Draw where the test is stable: .svg, .png or .pdf."),
    ] = None,
) -> None:
    """Say, without running the loop, whether it is stable, how wrong it will be, and which compensator suits."""
    if figure is not None:
        check_figure_name(figure)
        check_file(figure)
    laboratory = VirtualLaboratory(load_tests(file))
    advice = advise(laboratory)
    print_tables(advice_tables(advice))
    if figure is not None:
        drawn = True
        with optional("the figure", "what was found is printed above"):
            drawn = draw_map(laboratory, advice.recommended, figure)
        if not drawn:
            raise InputError(f"{file}: --figure: no map without a test with a loop and a stable rig [E-CLI-08]")


def export(
    file: File,
    compensator: Annotated[
        str, typer.Argument(help="Which compensator of the file.", show_default=False, autocompletion=compensator_names)
    ],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="DIR", help="Where the files go.")],
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace other files of the same names.")] = False,
) -> None:
    """Write a compensator as C99 for a signal processor, with a self test, a timing program, and matrices."""
    tests = load_tests(file)
    if compensator not in tests.compensators:
        raise InputError(f"{file}: {unknown_name('compensator', compensator, tests.compensators)}")
    step = tests.loop.main_step
    made = compensator_of(tests.compensators[compensator], step, laboratory(tests).transfer)
    for path in write(made, step, output, compensator, overwrite=overwrite):
        print(path)


def serve(
    file: File,
    port: Annotated[int, typer.Option("--port", "-p", min=0, max=65535, help="Of TCP; 0 for a free one.")] = 8090,
    host: Annotated[
        str, typer.Option("--host", help="Address of this machine; 0.0.0.0 lets everybody in who reaches it.")
    ] = "127.0.0.1",
    between: Annotated[
        bool, typer.Option("--between", help="The specimen stands between the client's two degrees of freedom.")
    ] = False,
    iterations: Annotated[
        bool, typer.Option("--iterations", help="Let an implicit client try several displacements a step.")
    ] = False,
    record: Annotated[Path | None, typer.Option("--record", help="Write the committed steps to a CSV file.")] = None,
) -> None:
    """Be the laboratory of OpenSees' genericClient: the virtual specimen of the file behind a TCP port."""
    damper = laboratory(load_tests(file)).damper
    if damper is None:
        raise InputError(f"{file}: specimen: a laboratory needs a law; give `law` or `law_file` [E-KEY-02]")
    found = wait(
        SizedDamper(damper.values, damper.scales),
        port,
        host,
        interface=(-1.0, 1.0) if between else (1.0,),
        allow_iterations=iterations,
        record=record,
        on_event=progress_line,
    )
    print(found.text())
