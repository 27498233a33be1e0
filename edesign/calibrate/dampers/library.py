"""The effects that damper tests may show."""

from __future__ import annotations

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import MODULES
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.trial import Sizes
from edesign.calibrate.problem import Candidate


def candidates(sizes: Sizes, left: Left, relaxes: bool, splits: bool, powers: bool = False) -> tuple[Candidate, ...]:
    """All forms of all effects that a campaign can show.

    Args:
        sizes: of the campaign.
        left: of the tests: some forms take their starts from it.
        relaxes: whether the law is the MGMM: it relaxes all its forces, so that effects may stand inside it, and its
            springs soften.
        powers: whether one of its dashpots has a power of the velocity, beside others.
        splits: whether its springs and dashpots can be told apart, so that effects may change them differently.
    """
    found = []
    for module in MODULES:
        for form in (*(kind() for kind in module.FORMS), *getattr(module, "forms_of", lambda _: ())(sizes)):
            if form.of_mgmm and not relaxes:
                continue
            variants = [form] if splits or not form.spares_loss else []
            if relaxes and form.may_be_inside:
                variants.append(form.within())
            if splits and form.may_spare_loss:
                variants += [form.sparing_loss(), form.of_loss()]
            if powers and form.may_be_of_power:
                variants.append(form.of_power_law())
            for variant in variants:
                candidate = candidate_of(variant, sizes, left)
                if candidate is not None:
                    found.append(candidate)
    return tuple(found)


def candidate_of(form: Form, sizes: Sizes, left: Left) -> Candidate | None:
    """A form with its unknowns for a campaign; None if the campaign cannot show it."""
    starts = form.starts_from_residuals(sizes, left)
    if not starts:
        return None
    slow = type(form).series is not Form.series
    effect = (form, dict(form.fixed(sizes)))
    unknowns = form.unknowns(sizes)
    return Candidate(
        form.name,
        form.form,
        form.kind,
        unknowns,
        starts,
        effect,
        slow,
        beside_motion=form.beside_motion,
        doubted=form.of_temperature,
        between_tests=form.remembers or form.by_order,
        usual=form.usual,
    )
