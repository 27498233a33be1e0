"""`edesign rts ...`: real-time substructure tests, virtual and real."""

from __future__ import annotations

from edesign.cli.shared.lazy import LazyGroup


class _Commands(LazyGroup):
    table = {
        "check": (
            "edesign.cli.rts.before",
            "Say, without running the loop, whether it is stable, how wrong it will be, and which compensator suits.",
        ),
        "run": (
            "edesign.cli.rts.run",
            "Run the virtual tests of a file with all its compensators, archive them, and print a summary.",
        ),
        "export": (
            "edesign.cli.rts.before",
            "Write a compensator as C99 for a signal processor, with a self test, a timing program, and matrices.",
        ),
        "serve": (
            "edesign.cli.rts.before",
            "Be the laboratory of OpenSees' genericClient: the virtual specimen of the file behind a TCP port.",
        ),
        "identify": (
            "edesign.cli.rts.after",
            "Find delay, order, gain and noise of a rig in a measured command and displacement.",
        ),
        "judge": (
            "edesign.cli.rts.after",
            "Judge measured substructure tests: tracking, error of the response, force against the law.",
        ),
    }


rts = _Commands(
    name="rts",
    help="Real-time substructure tests: will one be stable, how wrong, and how good was it.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)
