"""A calculation by a code, step by step, as a report prints it."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Step:
    """A quantity of a calculation.

    Attributes:
        symbol: as the code has it: `chi_LT`.
        value: in SI; or a word, such as the name of a buckling curve.
        unit: SI unit, "1" of a ratio, "" of a word.
        expression: what it follows from.
        clause: of EN 1993-1-1 unless another standard is named.
    """

    symbol: str
    value: float | str
    unit: str
    expression: str = ""
    clause: str = ""


@dataclass
class Trace:
    """Records the steps of a calculation while clauses compute it.

    Attributes:
        steps: in their order, each once.
        keeps: whether steps are recorded; otherwise values pass through.
    """

    steps: list[Step] = field(default_factory=list)
    keeps: bool = True

    def add(self, symbol: str, value: float, unit: str, expression: str = "", clause: str = "") -> float:
        """Record a number, and return it.

        Args:
            symbol: of the quantity.
            value: in `unit`.
            unit: SI.
            expression: in symbols; "" for a given value.
            clause: of EN 1993-1-1, or with its code.
        """
        if self.keeps and (step := Step(symbol, float(value), unit, expression, clause)) not in self.steps:
            self.steps.append(step)
        return float(value)

    def word(self, symbol: str, value: str, expression: str = "", clause: str = "") -> str:
        """Record a result that is a word, and return it; arguments as `add`."""
        if self.keeps:
            self.steps.append(Step(symbol, value, "", expression, clause))
        return value


def kept(trace: Trace | None) -> Trace:
    """Return a trace that may be called: without one, a trace that records nothing."""
    return Trace(keeps=False) if trace is None else trace
