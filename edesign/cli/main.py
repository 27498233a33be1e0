"""The command `edesign` and its parts. Exit codes are listed in docs/reference/command_line.md."""

from __future__ import annotations

import errno
import logging
import os
import sys
import traceback
from collections.abc import Sequence
from contextlib import suppress
from typing import Annotated, Any

import typer

from edesign._version import __version__
from edesign.cli.shared.lazy import LazyGroup
from edesign.cli.shared.stages import end_with
from edesign.cli.shared.streams import progress_line, visible_streams
from edesign.errors import ArchiveError, EdesignError, InputError, Interrupted, StageFailed
from edesign.input_files import noting_inputs
from edesign.optional_stages import failure_text, noting_failures, words_of_mistake
from edesign.renamed_names import current_option, noting_renamed

EPILOG = (
    "Exit codes: 0 done; 2 something in the input is wrong; 3 an analysis failed (the others are archived); "
    "4 an archive cannot be read or written; 5 the results are written, but not all that follows them, such as a "
    "figure; 130 interrupted; 1 an error in edesign itself."
)

_WRONG_USAGE: Any = next(kind for kind in typer.BadParameter.__mro__ if kind.__name__ == "ClickException")
"""What typer raises for words that it cannot take; not all of its versions have it in a public place."""
_REFUSED = (
    *(errno.ENAMETOOLONG, errno.ELOOP, errno.ENOTDIR, errno.EISDIR),
    *(errno.EACCES, errno.EPERM, errno.EROFS),
)

COMPLETE = "_EDESIGN_COMPLETE"
"""Set in the environment by a shell that asks for completions."""
COMPLETIONS = {"--install-completion", "--show-completion"}
"""Options of typer's, which write to the user's shell configuration, or print what they would."""
_NO_SHELL = "this shell is not known; completions are for bash, zsh, fish and PowerShell"


class _Commands(LazyGroup):
    table = {
        "new": (
            "edesign.cli.new",
            "Make a folder with a small project that runs as it is: of a frame, or by another --template.",
        ),
        "check": (
            "edesign.cli.check",
            "Check a file of any kind: a project with its records and frame, tests, laws, suites, ...; "
            "print a summary.",
        ),
        "run": (
            "edesign.cli.run",
            "Run the analyses of a project or study, or design checks of a building, archive them, "
            "and print a summary.",
        ),
        "design": (
            "edesign.cli.design",
            "Choose the lightest sections that meet all checks, and write the building file with them, "
            "and its archive.",
        ),
        "show": (
            "edesign.cli.show",
            "Print what an archive holds: verdicts, means of the response and what governs; with --all every table.",
        ),
        "compare": (
            "edesign.cli.compare",
            "Print each printed value of a reference beside the one of an archive, with its difference.",
        ),
        "report": (
            "edesign.cli.report",
            "Write the report of an archive as one HTML page that opens offline and can be mailed, or as a PDF.",
        ),
        "export": (
            "edesign.cli.export",
            "Write the tables of an archive as a workbook, or as CSV or Parquet files, with units and all digits.",
        ),
        "extract": (
            "edesign.cli.extract",
            "Write plane frames of a building as a project file, with the loads and masses that fall to them.",
        ),
        "translate": (
            "edesign.cli.translate",
            "Write the model of a project or building for another program, or a SAP2000 model as a file of edesign.",
        ),
        "inspect": ("edesign.cli.inspect", "Print what a table of numbers is read as, and the YAML that reads it."),
        "spectrum": (
            "edesign.cli.spectrum",
            "Print the elastic spectrum (acceleration, velocity, displacement), and those of records beside it.",
        ),
        "match": (
            "edesign.cli.match",
            "Fit recordings to the elastic spectrum, check them against the code, archive originals and results.",
        ),
        "records": (
            "edesign.cli.records",
            "List the recordings of a folder, package or suite with their measures; without a name, what there is.",
        ),
        "sections": (
            "edesign.cli.sections",
            "Print the sections that a file may name, with their properties.",
        ),
        "laws": ("edesign.cli.laws", "Print the damper laws, or one law's parameters with unit, bounds and default."),
        "effects": (
            "edesign.cli.effects",
            "Print the effects that `edesign calibrate` looks for, or the forms and parameters of one.",
        ),
        "quantities": (
            "edesign.cli.quantities",
            "Print the quantities and measures that criteria of a study may limit, with their units and keys.",
        ),
        "schema": (
            "edesign.cli.schema",
            "Print or write the JSON Schema of a kind of YAML file; without a kind list them, or write all.",
        ),
        "test": (
            "edesign.cli.test",
            "Run tests of a damper law as a laboratory would run them, and write them as a campaign.",
        ),
        "characterise": (
            "edesign.cli.characterise",
            "Find storage, equivalent and loss modulus and loss factor of each test with a steady amplitude.",
        ),
        "sheet": (
            "edesign.cli.sheet",
            "Print stiffness, damping, energy and forces of each test of a device, and whether standards accept it.",
        ),
        "fit": (
            "edesign.cli.fit",
            "Fit damper laws to measured forces or properties; say how sure the parameters are, "
            "and which law suffices.",
        ),
        "calibrate": (
            "edesign.cli.calibrate",
            "Predict measured tests, find what the law or structure lacks, add it, and report errors before and after.",
        ),
        "rts": ("edesign.cli.rts", "Real-time substructure tests: will one be stable, how wrong, and how good was it."),
    }


app = typer.Typer(
    name="edesign",
    cls=_Commands,
    help="Seismic design and evaluation of steel frames and buildings with braces and dampers, and tests of dampers.",
    epilog=EPILOG,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(asked: bool) -> None:
    if asked:
        print(f"edesign {__version__}")
        raise typer.Exit


@app.callback()
def _common(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version and leave.", callback=_version, is_eager=True)
    ] = False,
    debug: Annotated[bool, typer.Option("--debug", help="Show tracebacks of errors; may stand anywhere.")] = False,
) -> None:
    pass


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Args:
        arguments: the words after `edesign`; those of the process if None.

    Returns:
        The exit code.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    debug = "--debug" in words
    with visible_streams():
        logging.basicConfig(level=logging.INFO if debug else logging.CRITICAL, format="%(name)s: %(message)s")
        if arguments is None:  # in this process nobody else wants Python's warnings; --debug shows them
            logging.captureWarnings(True)
        code = _run([word for word in words if word != "--debug"], debug)
    if arguments is None:
        end_with(code)
    return code


def _run(words: list[str], debug: bool) -> int:
    """Return the exit code of a command, and report stages that failed after its results."""
    with noting_failures() as failures, noting_renamed() as renamed:
        code = _called([current_option(word) for word in words], debug)
    for note in renamed:
        progress_line(f"edesign: note: {note}")
    if not failures:
        return code
    if debug:
        for failure in failures:
            with suppress(OSError):  # the exit code must do
                traceback.print_exception(failure.error)
    return _fail(failure_text(failures), code or StageFailed.exit_code, debug=False)


def _called(words: list[str], debug: bool) -> int:
    try:
        with noting_inputs():
            code = app(words, prog_name="edesign", standalone_mode=False)  # which leaves errors and exit codes to this
        if code == 1 and COMPLETIONS & {word.partition("=")[0] for word in words}:
            return _fail(_NO_SHELL, InputError.exit_code, debug)
        sys.stdout.flush()
        if code == Interrupted.exit_code:  # what is made of a Ctrl-C between the steps that ask for it
            return _fail("interrupted", code, debug)
        return code if isinstance(code, int) else 0
    except _WRONG_USAGE as error:  # a word of the command line
        if error.format_message():  # else the help was printed
            error.show()
        return error.exit_code
    except KeyboardInterrupt:
        return _fail("interrupted", Interrupted.exit_code, debug)
    except EdesignError as error:
        return _fail(str(error), error.exit_code, debug)
    except BrokenPipeError:  # the reader of a pipe left, as `head` does
        _give_up_output()
        return 0
    except SystemExit as error:
        return _left(error)
    except OSError as error:
        if COMPLETIONS & {word.partition("=")[0] for word in words}:
            return _fail(f"{_name(error.filename)}: {error.strerror}", InputError.exit_code, debug)
        if error.errno in _REFUSED and error.filename is not None:  # a path of the user that no check has met
            return _fail(f"{_name(error.filename)}: {error.strerror}", InputError.exit_code, debug)
        if error.errno not in (errno.ENOSPC, errno.EDQUOT, errno.EIO):
            return _fail(_unexpected(error), 1, debug)
        _give_up_output()
        return _fail(f"the output cannot be written: {error.strerror}", ArchiveError.exit_code, debug)
    except Exception as error:
        return _fail(_unexpected(error), 1, debug)


def _left(error: SystemExit) -> int:
    """Return the exit code where typer exits by itself.

    It does so when a shell has asked for completions, and when it took the reader of a pipe to have left.
    """
    code = error.code if isinstance(error.code, int) else 0
    if code == 0 or COMPLETE in os.environ:
        try:
            sys.stdout.flush()
            return code
        except BrokenPipeError:
            code = 0
    _give_up_output()
    return 0


def _name(path: object) -> str:
    return os.fsdecode(path) if isinstance(path, (str, bytes, os.PathLike)) else str(path)


def _unexpected(error: Exception) -> str:
    return f"{words_of_mistake(error)}; please report it with the output of --debug"


def _give_up_output() -> None:
    """Let what is still buffered for standard output vanish, so that the end of the process does not try again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _fail(message: str, code: int, debug: bool) -> int:
    try:
        if debug:
            traceback.print_exc()
        printable = message.encode("utf-8", "backslashreplace").decode()  # names of files need not be text
        print(f"edesign: {printable}", file=sys.stderr, flush=True)
    except OSError:  # the exit code must do
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stderr.fileno())
    return code


if __name__ == "__main__":
    sys.exit(main())
