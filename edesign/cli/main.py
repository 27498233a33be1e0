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
from edesign.cli.calibrate import calibrate
from edesign.cli.characterise import characterise
from edesign.cli.check import check
from edesign.cli.compare import compare
from edesign.cli.design import design
from edesign.cli.effects import effects
from edesign.cli.export import export
from edesign.cli.extract import extract
from edesign.cli.fit import fit
from edesign.cli.inspect import inspect
from edesign.cli.laws import laws
from edesign.cli.match import match
from edesign.cli.new import new
from edesign.cli.quantities import quantities
from edesign.cli.records import records
from edesign.cli.report import report
from edesign.cli.rts import app as rts
from edesign.cli.run import run
from edesign.cli.schema import schema
from edesign.cli.sections import sections
from edesign.cli.shared.stages import end_with
from edesign.cli.shared.streams import visible_streams
from edesign.cli.sheet import sheet
from edesign.cli.show import show
from edesign.cli.spectrum import spectrum
from edesign.cli.test import test
from edesign.cli.translate import translate
from edesign.errors import ArchiveError, EdesignError, InputError, Interrupted, StageFailed
from edesign.input_files import noting_inputs
from edesign.optional_stages import noting_failures, told, words_of_mistake

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

app = typer.Typer(
    name="edesign",
    help="Seismic design and evaluation of steel moment frames.",
    epilog=EPILOG,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
_PROJECTS = (new, check, run, design, show, compare, report, export, extract, translate)
_PARTS = (
    *(inspect, spectrum, match, records, sections, laws, effects, quantities, schema),
    *(test, characterise, sheet, fit, calibrate),
)
for command in (*_PROJECTS, *_PARTS):
    app.command()(command)
app.add_typer(rts)


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
    """Return the exit code of a command, and tell of stages that failed after its results."""
    with noting_failures() as failures:
        code = _called(words, debug)
    if not failures:
        return code
    if debug:
        for failure in failures:
            with suppress(OSError):  # the exit code must do
                traceback.print_exception(failure.error)
    return _fail(told(failures), code or StageFailed.exit_code, debug=False)


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
