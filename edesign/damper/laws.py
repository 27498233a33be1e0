"""The damper laws and their parameters; docs/reference/laws has a page on each."""

from __future__ import annotations

import math

from edesign.damper.law import Law, Parameter
from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean

_K, _C, _F, _T, _STRESS = "N/m", "N*s/m", "N", "s", "Pa"


def _alpha(name: str, meaning: str) -> Parameter:
    return Parameter(name, meaning, "", upper=1.0, upper_allowed=False)


def _not_negative(name: str, meaning: str, unit: str, default: float | None = None) -> Parameter:
    return Parameter(name, meaning, unit, lower_allowed=True, default=default)


def _any(name: str, meaning: str, unit: str, default: float | None = None) -> Parameter:
    return Parameter(name, meaning, unit, lower=-math.inf, default=default)


_EXPONENT = Parameter("alpha", "exponent of the velocity", "", upper=2.0)
_BOUC_WEN = (
    Parameter("alpha", "stiffness after yielding / before", "", upper=1.0, lower_allowed=True, upper_allowed=False),
    Parameter("A", "slope of z at the start", "", default=1.0),
    Parameter("beta", "shape of loading", "", lower=-math.inf, default=0.5),
    Parameter("gamma", "shape of unloading", "", default=0.5),
    Parameter("n", "sharpness of yielding", "", lower=1.0, upper=100.0, lower_allowed=True, default=1.0),
)

_ALL = (
    Law(
        "kelvin_voigt",
        "Kelvin-Voigt: spring and dashpot side by side",
        (_not_negative("k", "stiffness", _K), _not_negative("c", "damping coefficient", _C)),
        "F = k u + c v",
        "thesis Eq. 2.49",
        True,
        speed=("c",),
    ),
    Law(
        "zener",
        "Zener (standard linear solid): spring beside a Maxwell branch",
        (
            _not_negative("k0", "stiffness of the spring", _K),
            Parameter("k1", "stiffness of the branch", _K),
            Parameter("c1", "damping coefficient of the branch", _C),
        ),
        "F + c1/k1 F' = k0 u + (k0 + k1) c1/k1 v",
        "thesis Eq. 2.72",
        True,
    ),
    Law(
        "generalised_maxwell",
        "generalised Maxwell: spring beside N Maxwell branches",
        (_not_negative("k0", "stiffness of the spring", _K),),
        "F = k0 u + sum F_i, F_i + c_i/k_i F_i' = c_i v",
        "thesis Eqs. 4.4, 4.19",
        True,
        branch=(
            Parameter("k", "stiffness of branch", _K),
            Parameter("c", "damping coefficient of branch", _C),
        ),
    ),
    Law(
        "fractional_kelvin",
        "fractional Kelvin: spring beside a springpot",
        (
            Parameter("k0", "stiffness", _K),
            Parameter("c", "coefficient of the fractional derivative", "s^alpha"),
            _alpha("alpha", "order of the derivative"),
        ),
        "F = k0 (u + c D^alpha u)",
        "thesis Eq. 2.76",
        True,
    ),
    Law(
        "fractional_zener",
        "fractional Zener: four-parameter fractional solid",
        (
            Parameter("k0", "stiffness at rest", _K),
            Parameter("a", "coefficient of the force's derivative", "s^alpha"),
            Parameter("b", "coefficient of the deformation's derivative, above a", "s^alpha"),
            _alpha("alpha", "order of the derivatives"),
        ),
        "F + a D^alpha F = k0 (u + b D^alpha u)",
        "thesis Eq. 2.74 with one term a side",
        True,
    ),
    Law(
        "viscous",
        "linear viscous dashpot",
        (Parameter("c", "damping coefficient", _C),),
        "F = c v",
        "thesis Eq. 2.24 with alpha = 1",
        True,
    ),
    Law(
        "viscous_power",
        "viscous dashpot with a power of the velocity",
        (Parameter("c", "damping coefficient", "N*(s/m)^alpha"), _EXPONENT),
        "F = c |v|^alpha sgn v",
        "thesis Eq. 2.24",
        True,
    ),
    Law(
        "asymmetric_viscous",
        "viscous dashpot with a coefficient for each direction of the motion",
        (
            Parameter("c_plus", "damping coefficient while the deformation grows", "N*(s/m)^alpha"),
            Parameter("c_minus", "damping coefficient while it falls", "N*(s/m)^alpha"),
            _EXPONENT,
        ),
        "F = c_plus |v|^alpha where v > 0, F = -c_minus |v|^alpha where v < 0",
        "thesis Eq. 2.24 on each side",
        True,
    ),
    Law(
        "bilinear_oil",
        "oil damper with a relief valve",
        (
            Parameter("c", "damping coefficient while the valve is closed", _C),
            Parameter("F_r", "relief force", _F),
            Parameter(
                "p", "damping coefficient with the valve open / closed", "", upper=1.0, lower_allowed=True, default=0.05
            ),
        ),
        "F = c v up to F_r, then (F_r + p (c |v| - F_r)) sgn v",
        "JSSI (2003), manual for passively controlled buildings; Kasai & Kibayashi (2004)",
        True,
    ),
    Law(
        "maxwell",
        "Maxwell: spring and dashpot in series",
        (Parameter("c0", "damping coefficient", _C), Parameter("lambda", "relaxation time", _T)),
        "F + lambda F' = c0 v",
        "thesis Eq. 2.25",
        True,
    ),
    Law(
        "maxwell_power",
        "power-law dashpot in series with a spring",
        (
            Parameter("c", "damping coefficient", "N*(s/m)^alpha"),
            _EXPONENT,
            Parameter("k", "stiffness of the spring", _K),
        ),
        "F' = k (v - sgn F (|F| / c)^(1/alpha))",
        "thesis Eqs. 2.24, 2.25",
        True,
    ),
    Law(
        "fractional_maxwell",
        "fractional Maxwell",
        (
            Parameter("c0", "damping coefficient", _C),
            Parameter("lambda", "relaxation coefficient", "s^nu"),
            _alpha("nu", "order of the derivative"),
        ),
        "F + lambda D^nu F = c0 v",
        "thesis Eq. 2.23; Makris & Constantinou (1991)",
        True,
    ),
    Law(
        "friction",
        "Coulomb friction",
        (
            Parameter("mu", "coefficient of friction", ""),
            Parameter("N", "normal force", _F),
            Parameter("k", "stiffness of the connection before slip", _K),
        ),
        "|F| <= mu N",
        "thesis Eq. 2.22",
        False,
    ),
    Law(
        "elastic_plastic",
        "elastic-plastic with kinematic hardening",
        (
            Parameter("k", "elastic stiffness", _K),
            Parameter("Fy", "yield force", _F),
            Parameter("b", "stiffness after yielding / before", "", upper=1.0, lower_allowed=True, upper_allowed=False),
        ),
        "F' = k v, in yielding b k v",
        "thesis 2.2.2",
        False,
    ),
    Law(
        "lead_rubber",
        "lead-rubber bearing, bilinear",
        (
            Parameter("Q", "characteristic strength", _F),
            Parameter("K_d", "stiffness after yielding", _K),
            Parameter("Y", "yield deformation", "m"),
        ),
        "F = K_d u + Q z, |z| <= 1, z' = v/Y before yielding",
        "EN 15129:2009, 8.2; Naeim & Kelly (1999)",
        False,
    ),
    Law(
        "friction_pendulum",
        "friction pendulum bearing under a constant weight",
        (
            Parameter("W", "weight on the bearing", _F),
            Parameter("R", "effective radius", "m"),
            Parameter("f_slow", "coefficient of friction at rest", ""),
            Parameter("f_fast", "coefficient of friction at high speed, at least f_slow", ""),
            _not_negative("a", "how fast friction rises with the speed", "s/m"),
            Parameter("Y", "deformation at which it slips from rest", "m"),
        ),
        "F = W/R u + Q, |Q| <= mu W, mu = f_fast - (f_fast - f_slow) exp(-a |v|)",
        "Zayas, Low & Mahin (1990); Constantinou, Mokha & Reinhorn (1990)",
        True,
        speed=("a",),
    ),
    Law(
        "self_centring",
        "self-centring device with flag-shaped loops",
        (
            Parameter("k", "initial stiffness", _K),
            Parameter("Fy", "force at which the gap opens", _F),
            Parameter("b", "stiffness after opening / before", "", upper=1.0, lower_allowed=True, upper_allowed=False),
            Parameter("beta", "1 - force at which the gap closes / Fy", "", upper=1.0, lower_allowed=True),
        ),
        "F = k u up to Fy, then (1 - b) Fy + b k u; back by (1 - b) beta Fy lower",
        "Christopoulos, Filiatrault & Folz (2002)",
        False,
    ),
    Law(
        "buckling_restrained",
        "buckling-restrained brace by its manufacturer's omega and beta",
        (
            Parameter("A_sc", "area of the steel core in its yielding length", "m^2"),
            Parameter("F_ysc", "yield stress of the steel core", _STRESS),
            Parameter("E", "modulus of elasticity of the core", _STRESS),
            Parameter("L_wp", "length between work points", "m"),
            Parameter("L_y", "yielding length of the core, at most L_wp", "m"),
            Parameter(
                "KF",
                "stiffness factor K / (E A_sc / L_wp), at most L_wp / L_y",
                "",
                lower=1.0,
                lower_allowed=True,
            ),
            Parameter(
                "alpha",
                "kinematic hardening: stiffness after yielding / before",
                "",
                upper=1.0,
                lower_allowed=True,
                upper_allowed=False,
            ),
            Parameter(
                "R_y",
                "expected / given yield stress, for adjusted strengths alone",
                "",
                lower=1.0,
                lower_allowed=True,
                default=1.0,
                fitted=False,
            ),
        ),
        "F = K (u - p), -(P_ysc + R_C(s)) <= F - H p <= P_ysc + R_T(s), s = sum of |dp|, "
        "P_ysc = F_ysc A_sc, K = KF E A_sc / L_wp, H = alpha K / (1 - alpha)",
        "AISC 341-16, F4 and K3; hardening as of Zona & Dall'Asta (2012)",
        False,
        branch=(
            Parameter("strain", "strain of the core of omega and beta, point", "", upper=1.0, upper_allowed=False),
            Parameter("omega", "strain-hardening adjustment factor", "", lower=1.0, lower_allowed=True),
            Parameter("beta", "compression strength adjustment factor", "", lower=1.0, lower_allowed=True),
        ),
    ),
    Law(
        "gap",
        "contact with a gap",
        (
            Parameter("k", "stiffness in contact", _K),
            _not_negative("gap", "deformation at which it closes", "m"),
            _not_negative("d", "loss in contact", "s/m", default=0.0),
            Parameter(
                "side",
                "1: closes at positive deformation; -1: at negative; 0: at both",
                "",
                lower=-1.0,
                upper=1.0,
                lower_allowed=True,
                default=0.0,
                fitted=False,
                choices=(-1.0, 0.0, 1.0),
            ),
        ),
        "F = k x (1 + d x') side, x = side u - gap, where both factors are above zero",
        "Hunt & Crossley (1975)",
        True,
        speed=("d",),
    ),
    Law(
        "ramberg_osgood",
        "Ramberg-Osgood with Masing's rule",
        (
            Parameter("k", "initial stiffness", _K),
            Parameter("Fy", "reference force", _F),
            Parameter("a", "share of the plastic deformation at the reference force", ""),
            Parameter("n", "exponent", "", lower=1.0),
        ),
        "u = F/k (1 + a |F/Fy|^(n-1))",
        "Ramberg & Osgood (1943); Jennings (1964)",
        False,
    ),
    Law(
        "chaboche",
        "steel with combined isotropic and kinematic hardening (Chaboche)",
        (
            Parameter("k", "elastic stiffness", _K),
            Parameter("Fy", "force at first yielding", _F),
            _not_negative("C1", "modulus of the first backstress", _K),
            _not_negative("gamma1", "recovery of the first backstress: it comes to C1 / gamma1", "1/m"),
            _not_negative("C2", "modulus of the second backstress", _K, default=0.0),
            _not_negative("gamma2", "recovery of the second backstress; 0: it grows linearly", "1/m", default=0.0),
            _any("Q", "strength that is gained in the end; negative: lost", _F, default=0.0),
            _not_negative("b", "rate at which it comes with the plastic path", "1/m", default=0.0),
        ),
        "F = k (u - p), |F - X1 - X2| <= Fy + Q (1 - exp(-b s)), X_i' = C_i p' - gamma_i X_i |p'|, s = sum of |dp|",
        "Lemaitre & Chaboche (1990), Mechanics of Solid Materials, 5.4.4; Armstrong & Frederick (1966); Voce (1955)",
        False,
    ),
    Law(
        "bouc_wen",
        "Bouc-Wen",
        (Parameter("Fy", "yield force", _F), Parameter("Y", "yield deformation", "m"), *_BOUC_WEN),
        "F = alpha Fy/Y u + (1 - alpha) Fy z, Y z' = A v - gamma |v| z |z|^(n-1) - beta v |z|^n",
        "thesis Eqs. 2.67-2.68; Wen (1976)",
        False,
    ),
    Law(
        "modified_bouc_wen",
        "Bouc-Wen with softening by the largest deformation, beside a power-law dashpot",
        (
            _not_negative("k1", "stiffness that softening takes away", _K),
            Parameter("k2", "stiffness that stays", _K),
            Parameter("u_ref", "deformation that softens", "m"),
            Parameter("Y", "yield deformation", "m"),
            *_BOUC_WEN,
            _not_negative("C", "damping coefficient", "N*(s/m)^alpha_d"),
            Parameter("alpha_d", "exponent of the velocity", "", upper=2.0),
        ),
        "F = k (alpha u + (1 - alpha) Y z) + C |v|^alpha_d sgn v, k = k1 exp(-u_max/u_ref) + k2",
        "thesis Eqs. 2.69-2.71; Karavasilis, Blakeborough & Williams (2011)",
        True,
        speed=("C",),
    ),
    Law(
        "asymptote",
        "rate-dependent law with asymptotes",
        (
            Parameter("f0", "force of the asymptotes at zero deformation", _F),
            _any("k1", "linear stiffness of the asymptotes", _K),
            _any("k2", "quadratic coefficient of the asymptotes", "N/m^2", default=0.0),
            _any("k3", "cubic coefficient of the asymptotes", "N/m^3", default=0.0),
            Parameter("kappa", "speed of the approach to the asymptote", ""),
            Parameter("n", "shape of the approach", "", lower=1.0, lower_allowed=True, default=1.0),
            _not_negative("c", "damping coefficient of the dashpot beside", _C, default=0.0),
        ),
        "F = Fa - e0 (1 + kappa (n - 1) (Fa - Fa0) / e0)^(-1/(n-1)) + c v",
        "thesis Eqs. 2.65-2.66; Sause et al. (2009), Lee et al. (2009)",
        True,
        speed=("c",),
    ),
    Law(
        "linearised",
        "linearised device",
        (
            Parameter("k_eff", "effective stiffness", _K),
            _not_negative("zeta_eff", "effective damping ratio", ""),
            Parameter("omega", "circular frequency at which they hold", "rad/s"),
        ),
        "F = k_eff u + 2 zeta_eff k_eff / omega v",
        "thesis Eqs. 2.63-2.64; FEMA 356, 9.3.3.1",
        True,
        speed=("zeta_eff",),
    ),
    Law(
        "mgmm",
        "modified generalised Maxwell model (MGMM)",
        (
            Parameter("k1", "stiffness of the Maxwell branch", _K),
            Parameter("c1", "damping coefficient of the Maxwell branch", _C),
            _not_negative("k0", "stiffness of the spring", _K),
            _not_negative("c_NL", "coefficient of the non-linear dashpot", "N*(s/m)^alpha"),
            Parameter("alpha", "exponent of the velocity", "", upper=2.0),
            _not_negative("k_a", "stiffness that the largest deformation takes away", _K),
            _not_negative("k_b", "stiffness that stays", _K),
            Parameter("u_ref", "deformation that softens", "m"),
            _not_negative("c_a", "damping that the largest velocity takes away", _C),
            _not_negative("c_b", "damping that stays", _C),
            Parameter("v_ref", "velocity that softens", "m/s"),
            Parameter(
                "consistent",
                "1: carry the derivative of k_mod u; 0: as printed",
                "",
                upper=1.0,
                lower_allowed=True,
                default=0.0,
                fitted=False,
                choices=(0.0, 1.0),
            ),
        ),
        "F + c1/k1 F' = (k0 + k_mod) u + (c1/k1 k0 + c1 + c_mod) v + c_NL |v|^alpha sgn v, "
        "k_mod = k_a exp(-u_max/u_ref) + k_b, c_mod = c_a exp(-v_max/v_ref) + c_b",
        "thesis Eqs. 4.24-4.29",
        True,
    ),
)

LAWS: dict[str, Law] = {law.name: law for law in _ALL}
"""Every law by its name."""


_ALSO_CALLED = {
    "brb": "buckling_restrained",
    "coulomb": "friction",
    "fps": "friction_pendulum",
    "fvd": "viscous_power",
    "lrb": "lead_rubber",
    "oil": "bilinear_oil",
    "pendulum": "friction_pendulum",
    "sls": "zener",
}
"""Laws by abbreviations and words of practice, for messages alone: a file names a law in one way."""


def unknown_law(name: str) -> str:
    """Return the message on the name of a law that there is not, with the law that is likely meant."""
    words = name.lower().replace("-", "_").split("_")
    meant = _ALSO_CALLED.get(name.lower()) or next((one for one in LAWS if sorted(one.split("_")) == sorted(words)), "")
    hint = f"; did you mean `{meant}`?" if meant else did_you_mean(name, LAWS)
    return f"there is no damper law `{name}`{hint} (there are: {', '.join(LAWS)}) [E-LAW-01]"


def law(name: str) -> Law:
    """Return the law of a name.

    Raises:
        InputError: there is none; the message names the nearest.
    """
    if name not in LAWS:
        raise InputError(unknown_law(name))
    return LAWS[name]
