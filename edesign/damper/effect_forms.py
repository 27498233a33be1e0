"""Forms of effects of damper laws: names, parameters, and where they act."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

from edesign.core.damper import PLACEMENTS, Placement
from edesign.damper.law import Law, Parameter
from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean, listed

_PAYNE = "Payne (1962), J. Appl. Polym. Sci. 6, 57-63; Kraus (1984), J. Appl. Polym. Sci. Symp. 39, 75-92"
_MULLINS = "Mullins (1969), Rubber Chem. Technol. 42, 339-362"
_KOHLRAUSCH = "q: Williams and Watts (1970), Trans. Faraday Soc. 66, 80-85"
_VISCOUS = "Soong and Dargush (1997), Passive Energy Dissipation Systems in Structural Engineering"
_ANY = -math.inf
_INSIDE = "_inside"


@dataclass(frozen=True)
class LawEffectForm(Law):
    """A form of an effect; `parameters` in the order of the core, then those that the core does not take.

    Attributes:
        for_core: how many parameters the core takes.
        constant: whether it is a factor that does not change in a run: the core takes the factor alone.
    """

    kind: ClassVar[str] = "effect"
    for_core: int = 0
    constant: bool = False

    @property
    def is_factor(self) -> bool:
        """Whether it is a factor of the law's force; else a force of its own."""
        return self.equation.startswith("phi")

    @property
    def placements(self) -> tuple[Placement, ...]:
        """Where it may act: springs or dashpots alone only as a factor that does not depend on the law's force."""
        return PLACEMENTS if self.is_factor and "F_law" not in self.equation else ("whole", "inside")


def _positive(name: str, meaning: str, unit: str) -> Parameter:
    return Parameter(name, meaning, unit)


def _any(name: str, meaning: str, unit: str) -> Parameter:
    return Parameter(name, meaning, unit, lower=_ANY)


def _share(name: str, meaning: str) -> Parameter:
    return Parameter(name, f"{meaning}; negative: that comes", "", lower=_ANY, upper=1.0)


_BROKEN = (
    _positive("a0", "envelope of the deformation at which half of it is gone", "m"),
    _positive("m", "exponent of the envelope", ""),
    _positive("tau_a", "time constant with which the envelope fades", "s"),
)
_RECOVERY = Parameter(
    "recovery",
    "share regained between two tests of a specimen; not used in a project",
    "",
    upper=1.0,
    lower_allowed=True,
    default=0.0,
    fitted=False,
)
_SIDE = Parameter(
    "side",
    "1: where the deformation is positive; -1: where it is negative",
    "",
    -1.0,
    1.0,
    True,
    fitted=False,
    choices=(1.0, -1.0),
)
_FADES = Parameter("q", "power with which it fades: below 1 ever slower", "", default=1.0)
_SIDE_OF_MOTION = replace(_SIDE, meaning="1: where the velocity is positive; -1: where it is negative")
_SIDE_OF_FORCE = replace(_SIDE, meaning="1: where the force of the law is positive; -1: where it is negative")
_T0 = Parameter("T0", "temperature at which phi is 1", "degC", _ANY, fitted=False)


def _forms() -> tuple[LawEffectForm, ...]:
    def form(
        name: str,
        title: str,
        equation: str,
        source: str,
        parameters: Sequence[Parameter],
        rate_dependent: bool = False,
        more: Sequence[Parameter] = (),
        constant: bool = False,
    ) -> LawEffectForm:
        every = (*parameters, *more)
        return LawEffectForm(
            name, title, every, equation, source, rate_dependent, for_core=len(parameters), constant=constant
        )

    return (
        form(
            "payne.whole",
            "softening with amplitude of the whole force",
            "phi = 1 - d g(a), g = (a/a0)^m / (1 + (a/a0)^m)",
            _PAYNE,
            (_share("d", "share of the force that goes"), *_BROKEN),
            True,
        ),
        form(
            "payne.elastic",
            "softening with amplitude of the elastic force",
            "-k g(a) u",
            _PAYNE,
            (_any("k", "stiffness that goes; negative: that comes", "N/m"), *_BROKEN),
            True,
        ),
        form(
            "payne.network",
            "softening by a network that breaks with motion and heals in rest",
            "phi = 1 - d x, x' = (1 - x) |u'|/s0 - x/tau",
            "Kraus (1984), J. Appl. Polym. Sci. Symp. 39, 75-92; Lion (1998), Rubber Chem. Technol. 71, 410-429",
            (
                _share("d", "share of the force that goes when all of the network is broken"),
                _positive("s0", "path that breaks 1 - 1/e of it", "m"),
                _positive("tau", "time in which it heals", "s"),
            ),
            True,
        ),
        form(
            "payne.exponential",
            "softening with amplitude that goes exponentially",
            "phi = 1 - d (1 - exp(-(a/a0)^m))",
            "Payne (1962), J. Appl. Polym. Sci. 6, 57-63; the course with amplitude: phenomenological",
            (
                _share("d", "share of the force that goes in the end"),
                _positive("a0", "envelope of the deformation at which 1 - 1/e of it is gone", "m"),
                *_BROKEN[1:],
            ),
            True,
        ),
        form(
            "mullins.path",
            "softening with the path of the whole force",
            "phi = 1 + m exp(-(s/s0)^q)",
            f"{_MULLINS}; {_KOHLRAUSCH}",
            (
                Parameter("m", "share by which the virgin damper is stronger; negative: weaker", "", lower=-1.0),
                _positive("s0", "path after which 1/e of it is left", "m"),
                _FADES,
                _RECOVERY,
            ),
        ),
        form(
            "mullins.maximum",
            "softening below the largest deformation",
            "phi = 1 - m erf((M^2 - u^2)/(r^2 + beta M^2))",
            "Ogden and Roxburgh (1999), Proc. R. Soc. Lond. A 455, 2861-2877; beta: Abaqus Theory Manual, section "
            "4.7.1; with the energy of a linear spring",
            (
                _share("m", "share of the force that goes far below the largest deformation"),
                _positive("r", "root of the fall from M^2 to u^2 over which 84 % of it goes, while M is small", "m"),
                Parameter("beta", "growth of that fall with M^2", "", lower_allowed=True),
                _RECOVERY,
            ),
        ),
        form(
            "mullins.damage",
            "softening by the largest deformation",
            "phi = 1 - m (1 - exp(-(M/r)^p))",
            "Simo (1987), Comput. Methods Appl. Mech. Engrg 60, 153-173, with deformation in place of energy",
            (
                _share("m", "share of the force that goes in the end"),
                _positive("r", "largest deformation at which 1 - 1/e of it has gone", "m"),
                _positive("p", "exponent", ""),
                _RECOVERY,
            ),
        ),
        form(
            "mullins.elastic",
            "softening with the path of the elastic force",
            "k exp(-(s/s0)^q) u",
            f"{_MULLINS}; {_KOHLRAUSCH}",
            (
                _any("k", "stiffness that the virgin damper has more; negative: less", "N/m"),
                _positive("s0", "path after which 1/e of it is left", "m"),
                _FADES,
                _RECOVERY,
            ),
        ),
        form(
            "degradation.energy",
            "softening with the work done",
            "phi = 1 - d (1 - exp(-(max(E, 0)/E0)^q))",
            "degradation with dissipated energy: Baber and Wen (1981), J. Eng. Mech. Div. 107, 1069-1087",
            (
                _share("d", "share of the force that goes in the end"),
                _positive("E0", "work after which 1 - 1/e of it has gone", "J"),
                _FADES,
            ),
        ),
        form(
            "degradation.path",
            "softening with the path",
            "phi = 1 - d (1 - exp(-(s/s0)^q))",
            "wear by path: Archard (1953), J. Appl. Phys. 24, 981-988; saturation: Simo (1987)",
            (
                _share("d", "share of the force that goes in the end"),
                _positive("s0", "path after which 1 - 1/e of it has gone", "m"),
                _FADES,
            ),
        ),
        form(
            "self_heating.rate",
            "softening by the heat of the work done",
            "phi = exp(-q), q' = -q/tau_h + beta F u'",
            "heat balance of a lump; Kasai, Munshi, Lai and Maison (1993), ATC-17-1",
            (_any("beta", "softening per work", "1/J"), _positive("tau_h", "time constant of cooling", "s")),
            True,
        ),
        form(
            "temperature_law.exponential",
            "change with temperature",
            "phi = exp(-b (T - T0))",
            "exponential softening in a small range of temperatures; Ferry (1980), Viscoelastic Properties of Polymers",
            (),
            more=(_any("b", "softening per temperature", "1/K"), _T0),
            constant=True,
        ),
        form(
            "temperature_law.wlf",
            "change with temperature at a changing rate",
            "phi = exp(-b w/(1 + c w)), w = T - T0",
            "Williams, Landel and Ferry (1955), J. Am. Chem. Soc. 77, 3701-3707; c = 1/T0 in kelvin: Arrhenius",
            (),
            more=(
                _any("b", "softening per temperature, at T0", "1/K"),
                _any("c", "how that falls with warmth: 1/C2 of WLF", "1/K"),
                _T0,
            ),
            constant=True,
        ),
        form(
            "temperature_law.transition",
            "change with temperature across a transition",
            "phi = 1 - d (S(T) - S(T0)), S(T) = 1/(1 + exp(-(T - Tc)/w))",
            "Mahieux and Reifsnider (2001), Polymer 42, 3281-3291, with a logistic step",
            (),
            more=(
                _any("d", "share of the force that goes across the transition", ""),
                _any("Tc", "its middle", "degC"),
                _positive("w", "its width", "K"),
                _T0,
            ),
            constant=True,
        ),
        form(
            "ageing.linear",
            "change from test to test",
            "phi = 1 + rate n",
            "trend over the order of the tests",
            (),
            more=(
                _any("rate", "change of the force from one test to the next; negative: it falls", ""),
                Parameter("n", "tests before: the state that is used", "", lower_allowed=True, fitted=False),
            ),
            constant=True,
        ),
        form(
            "ageing.logarithmic",
            "change from test to test that slows down",
            "phi = 1 + rate ln(1 + n/n0)",
            "Struik (1978), Physical Aging in Amorphous Polymers and Other Materials",
            (),
            more=(
                _any("rate", "change of the force over e times as many tests; negative: it falls", ""),
                Parameter("n", "tests before: the state that is used", "", lower_allowed=True, fitted=False),
                Parameter("n0", "tests after which it slows down", "", default=1.0),
            ),
            constant=True,
        ),
        form(
            "hardening.power",
            "hardening spring",
            "k u (|u|/r)^(p-1)",
            "Duffing's spring for p = 3; hardening of elastomers: Treloar (1975), The Physics of Rubber Elasticity",
            (
                _any("k", "secant stiffness at r", "N/m"),
                Parameter("p", "exponent", "", lower=1.0, lower_allowed=True),
                Parameter("r", "deformation at which the secant stiffness is k", "m", fitted=False),
            ),
        ),
        form(
            "hardening.exponential",
            "spring that stiffens exponentially",
            "k u (exp((u/u0)^2) - 1)",
            "Fung (1993), Biomechanics: Mechanical Properties of Living Tissues, section 7.5",
            (
                _any("k", "stiffness that its rise is a multiple of", "N/m"),
                _positive("u0", "deformation at which the secant stiffness is (e - 1) k", "m"),
            ),
        ),
        form(
            "hardening.saturating",
            "spring that saturates",
            "k u0 tanh(u/u0)",
            "spring of a pile in sand: API RP 2A-WSD, section 6.8.7",
            (
                _any("k", "stiffness at u = 0", "N/m"),
                _positive("u0", "deformation over which it bends: its force ends at k u0", "m"),
            ),
        ),
        form(
            "hardening.threshold",
            "hardening beyond a deformation",
            "k max(|u| - u0, 0) sgn u",
            "bilinear spring with a gap",
            (
                _any("k", "stiffness beyond u0", "N/m"),
                Parameter("u0", "deformation at which it begins", "m", lower_allowed=True),
            ),
        ),
        form(
            "one_sided.factor",
            "stronger to one side",
            "phi = 1 + b where side u > 0",
            "asymmetric loops",
            (Parameter("b", "share by which it is stronger; negative: weaker", "", lower=-1.0), _SIDE),
        ),
        form(
            "one_sided.valve",
            "stronger in motion to one side",
            "phi = 1 + b max(tanh(side u'/v0), 0)",
            "valves of rebound and compression: Dixon (2007), The Shock Absorber Handbook, Wiley, chapter 7",
            (
                Parameter("b", "share by which it is stronger; negative: weaker", "", lower=-1.0),
                _positive("v0", "velocity over which that rises", "m/s"),
                _SIDE_OF_MOTION,
            ),
            True,
        ),
        form(
            "one_sided.force",
            "stronger where it pulls, or pushes",
            "phi = 1 + b where side F_law > 0",
            "factors of tension and compression",
            (Parameter("b", "share by which it is stronger; negative: weaker", "", lower=-1.0), _SIDE_OF_FORCE),
        ),
        form(
            "one_sided.spring",
            "spring to one side",
            "k max(side u - u0, 0) side",
            "contact with a gap",
            (
                _any("k", "stiffness beyond u0", "N/m"),
                Parameter("u0", "deformation at which it begins", "m", lower_allowed=True),
                _SIDE,
            ),
        ),
        form(
            "one_sided.contact",
            "contact to one side that stiffens",
            "k x (x/r)^(n-1) side, x = max(side u - u0, 0)",
            "Jankowski (2005), Earthquake Engng Struct. Dyn. 34, 595-611 (n = 3/2: Hertz)",
            (
                _any("k", "secant stiffness at r beyond u0", "N/m"),
                Parameter("u0", "deformation at which it begins", "m", lower_allowed=True),
                Parameter("n", "exponent", "", lower=1.0, lower_allowed=True),
                _SIDE,
                Parameter("r", "deformation beyond u0 at which the secant stiffness is k", "m", fitted=False),
            ),
        ),
        form(
            "one_sided.even",
            "stiffer to one side, softer to the other",
            "k |u| (|u|/r)^(n-1)",
            "Kovacic and Brennan (2011), The Duffing Equation, Wiley (Helmholtz-Duffing: n = 2)",
            (
                _any("k", "secant stiffness at r; negative: softer where the deformation is positive", "N/m"),
                Parameter("n", "exponent", "", lower=1.0, lower_allowed=True),
                Parameter("r", "deformation at which the secant stiffness is k", "m", fitted=False),
            ),
        ),
        form(
            "gas_spring.polytropic",
            "gas that is compressed",
            "P (1 - c u)^-n",
            "polytropic change of a gas: Dixon (2007), The Shock Absorber Handbook, Wiley, section 5.11",
            (
                _any("P", "force of the gas at u = 0; negative: to the other side", "N"),
                _any("c", "1 over the deformation at which no room is left; negative: on the other side", "1/m"),
                Parameter("n", "exponent: 1 isothermal, 1.4 adiabatic", "", fitted=False),
            ),
        ),
        form(
            "relaxation_branch.maxwell",
            "further Maxwell branch",
            "Q' + Q/tau = k u'",
            "Maxwell (1867); thesis Eq. 4.19",
            (_any("k", "stiffness of the branch", "N/m"), _positive("tau", "relaxation time", "s")),
            True,
        ),
        form(
            "velocity_exponent.dashpot",
            "further power-law dashpot",
            "c |u'|^alpha sgn u'",
            _VISCOUS,
            (
                _any("c", "damping coefficient", "N*(s/m)^alpha"),
                Parameter("alpha", "exponent of the velocity", ""),
            ),
            True,
        ),
        form(
            "velocity_exponent.flow",
            "viscous force that saturates with the velocity",
            "f asinh(u'/v0)",
            "Eyring (1936), J. Chem. Phys. 4, 283-291",
            (
                _any("f", "force over its logarithm of the velocity", "N"),
                _positive("v0", "velocity of the bend", "m/s"),
            ),
            True,
        ),
        form(
            "velocity_exponent.position",
            "power-law dashpot that is stronger at larger deformation",
            "c (|u|/r)^q |u'|^alpha sgn u'",
            "Hunt and Crossley (1975), J. Appl. Mech. 42, 440-445 (alpha = 1)",
            (
                _any("c", "damping coefficient at r", "N*(s/m)^alpha"),
                Parameter("alpha", "exponent of the velocity", ""),
                _positive("q", "exponent of the deformation", ""),
                Parameter("r", "deformation at which the coefficient is c", "m", fitted=False),
            ),
            True,
        ),
        form(
            "hysteresis.stretch",
            "hysteresis whose force grows with the deformation",
            "F_y (|u|/r)^n z/Y, z' = u' - |u'| z/Y",
            "friction proportional to the spring's force, as of ring springs: Nims, Richter and Bachman (1993), "
            "Earthquake Spectra 9, 467-489",
            (
                _positive("F_y", "force at r of what has slid", "N"),
                _positive("Y", "way over which it builds up", "m"),
                _positive("n", "exponent of the deformation", ""),
                Parameter("r", "deformation at which the force is F_y", "m", fitted=False),
            ),
        ),
        form(
            "hysteresis.bouc_wen",
            "hysteresis that stiffens or softens on its way",
            "k z, z' = u' - gamma |u'| z - beta u' |z|",
            "Bouc (1967); Wen (1976), J. Eng. Mech. Div. 102, 249-263; gamma + beta < 0: hardening, as of Noel and "
            "Schoukens (2016)",
            (
                _positive("k", "stiffness at z = 0", "N/m"),
                _any("beta", "share of the bend that is alike in both directions", "1/m"),
                _positive("gamma", "share of the bend that makes loops", "1/m"),
            ),
        ),
        form(
            "pinching.slip",
            "force that slips through the middle of the loops",
            "phi = 1 - d exp(-(u/(w M))^2)",
            "Baber and Noori (1986), J. Vib. Acoust. Stress Reliab. Des. 108, 411-420 (Gaussian function of slip), of "
            "the deformation",
            (
                _share("d", "share of the force that goes at u = 0"),
                _positive("w", "half width of the zone of slip, of the largest deformation so far", ""),
            ),
        ),
        form(
            "limit.force",
            "limit of the force",
            "phi F_law = F_law - s max(|F_law| - F_l, 0) sgn F_law",
            "relief valves: JSSI (2003), manual for passively controlled buildings; Kasai and Kibayashi (2004)",
            (
                Parameter("s", "share of what is beyond the limit that is lost; 1: it is all", "", 0.0, 1.0, True),
                _positive("F_l", "limit of the force", "N"),
                Parameter(
                    "side",
                    "1: where the force of the law is positive; -1: where it is negative; 0: both",
                    "",
                    -1.0,
                    1.0,
                    True,
                    default=0.0,
                    fitted=False,
                    choices=(1.0, -1.0, 0.0),
                ),
            ),
        ),
        form(
            "friction.coulomb",
            "friction",
            "F_c tanh(u'/v0)",
            "Coulomb (1785); Andersson et al. (2007), Tribology International 40, 580-587, Eq. 4",
            (_positive("F_c", "friction force", "N"), _positive("v0", "velocity over which it rises", "m/s")),
            True,
        ),
        form(
            "friction.presliding",
            "friction that builds up over a way",
            "F_c z, x0 z' = u' - |u'| z |z|^(n-1)",
            "Dahl (1968), Aerospace Corp. TOR-0158(3107-18)-1; Dahl (1976), AIAA Journal 14, 1675-1682",
            (
                _positive("F_c", "friction force", "N"),
                _positive("x0", "way over which it builds up", "m"),
                Parameter("n", "sharpness: 1 Dahl's, a large one elastic-plastic", "", 1.0, 100.0, True, default=1.0),
            ),
        ),
        form(
            "friction.stribeck",
            "friction that falls from breaking away to sliding",
            "F_c (1 + s exp(-(u'/v_s)^2)) tanh(10 u'/v_s)",
            "Armstrong-Helouvry, Dupont and Canudas de Wit (1994), Automatica 30, 1083-1138, section 2.1",
            (
                _positive("F_c", "friction force of fast sliding", "N"),
                Parameter("s", "share by which it is larger near rest", "", lower_allowed=True),
                _positive("v_s", "velocity over which it falls", "m/s"),
            ),
            True,
        ),
        form(
            "friction.loaded",
            "friction that grows with the force",
            "(F_c + mu |F_law|) tanh(u'/v0)",
            "Coulomb (1785), the load of seals or guides a share of the law's force",
            (
                Parameter("mu", "share of the law's force", "", lower_allowed=True),
                Parameter("F_c", "friction force without a force of the law", "N", lower_allowed=True),
                _positive("v0", "velocity over which it rises", "m/s"),
            ),
            True,
        ),
    )


LAW_EFFECTS: dict[tuple[str, str], LawEffectForm] = {
    (name, form): one for one in _forms() for name, form in (one.name.split("."),)
}
"""All forms of effects of laws by the name of the effect and of the form."""

_ONCE_INSIDE = ("payne", "mullins", "hardening", "one_sided", "velocity_exponent")
_WITH_PLACEMENTS = ("exponential", "saturating", "valve", "force", "position")  # which came with placements, or later

FORMER_FORMS: dict[tuple[str, str], tuple[str, Placement]] = {
    (name, form + _INSIDE): (form, "inside")
    for name, form in LAW_EFFECTS
    if name in _ONCE_INSIDE and form not in _WITH_PLACEMENTS
}
"""Forms that law files had before they said placements, by effect and form: the form today, and its placement."""


def placed_form(name: str, form: str) -> tuple[str, Placement]:
    """Return the form of an effect as it is called today, and the placement that a former name says with it.

    Args:
        form: of the effect, e.g. "whole" or "whole_inside".
    """
    return FORMER_FORMS.get((name, form), (form, "whole"))


def form_if_known(name: str, form: str) -> LawEffectForm | None:
    """Return the form of an effect by a name of today or a former one; None: there is none."""
    return LAW_EFFECTS.get((name, placed_form(name, form)[0]))


def parameters_in_core() -> dict[str, tuple[Parameter, ...]]:
    """Parameters that the core takes of each effect, in its order, by what it calls the effect.

    All that do not change in a run are one effect there, `constant`, whose factor they make.
    """
    changing = [one for one in LAW_EFFECTS.values() if not one.constant]
    constant = {"constant": (_positive("factor", "of the force of the law", ""),)}
    return constant | {one.name: one.parameters[: one.for_core] for one in changing}


def law_effect_form(name: str, form: str) -> LawEffectForm:
    """Return the form of an effect.

    Args:
        form: of the effect; a former name is that of today.

    Raises:
        InputError: there is no such effect, or it has no such form.
    """
    known = form_if_known(name, form)
    if known is not None:
        return known
    forms = [of_effect for effect, of_effect in LAW_EFFECTS if effect == name]
    if not forms:
        names = list(dict.fromkeys(effect for effect, _ in LAW_EFFECTS))
        hint = did_you_mean(name, names)
        raise InputError(f"there is no effect `{name}` of a damper law{hint} (there are: {listed(names)}) [E-LAW-01]")
    hint = did_you_mean(form, forms)
    raise InputError(f"the effect `{name}` has no form `{form}`{hint} (there are: {listed(forms)}) [E-LAW-01]")
