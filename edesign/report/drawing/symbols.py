"""Symbols of the codes with an index, such as a_gR, in texts that people read: where they stand, and their parts."""

from __future__ import annotations

import re
from collections.abc import Iterator

GREEK = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "chi": "χ",
    "lambda": "λ",
    "mu": "μ",
    "epsilon": "ε",
    "zeta": "ζ",
    "kappa": "κ",
    "omega": "ω",
    "rho": "ρ",
    "theta": "θ",
    "nu": "ν",
    "psi": "ψ",
    "pi": "π",
    "xi": "ξ",
    "phi": "φ",
    "Gamma": "Γ",
    "Phi": "Φ",
    "Omega": "Ω",
    "sum": "Σ",
}
"""Letters by their names."""
SLENDERNESS = "λ\N{COMBINING MACRON}"
"""The lambda of EN 1993-1-1 that has an index; one without is that of a lateral force or of a law."""

# in texts where a name of a user's may stand: symbols that nobody gives to a member, load case or record
_SYMBOL = re.compile(
    r"(?<![A-Za-z0-9_])"
    r"(a_gR|a_g|f_y|gamma_I|gamma_Rd|(?<=gamma_Rd )Omega|T_[BCD1]|G_eq|P_CL|d_t|Q_[A-H]|F_[xyz]|M_[yz]|M_j,Rd|S_j"
    r"|A_sc|L_wp|P_ysc|[TC]_adj"
    r"|θ_p|theta_p|alpha_[012]|k_mod|c_mod|k_eq|xi(?= \[)|(?<=effective damping )xi"
    # parameters of damper laws, which stand before their values
    r"|(?:[kcf]_[0-9]+|[kc]_[ab]|c_NL|[uv]_ref|F_y|F_ysc|F_r|L_y|R_y|K_d|k_eff|zeta_eff|f_slow|f_fast|alpha_d"
    r"|c_plus|c_minus|alpha|beta|gamma|mu|nu|kappa|omega)(?= =(?: |$)))"
    r"(?![A-Za-z0-9_]|,[A-Za-z0-9])"
)
_NUMBERED = re.compile(r"(?<![A-Za-z0-9_&#;])(?:([kcf])([0-9]+)|(F)(y))(?!\.?[A-Za-z0-9_])")


def with_indices_of_laws(text: str) -> str:
    """Return a text with the parameters of damper laws as symbols with an index: k_1 for k1, F_y for Fy.

    Args:
        text: a formula or the name of a parameter; names of nodes such as A1 stay.
    """
    return _NUMBERED.sub(lambda found: "_".join(filter(None, found.groups())), text)


_POWER = re.compile(r"(?P<factor>[0-9.]+)e(?P<exponent>[-+\N{MINUS SIGN}]?[0-9]+)")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power_of_ten(text: str) -> str:
    """Return a number with an exponent as a drawing has it: 1.2 × 10⁻⁵ for 1.2e-05; another text as it stands.

    Args:
        text: the number, as Python or matplotlib writes it.
    """
    found = _POWER.fullmatch(text)
    if found is None:
        return text
    exponent = str(int(found["exponent"].replace("\N{MINUS SIGN}", "-")))
    power = f"10{exponent.translate(_RAISED)}"
    return power if found["factor"] == "1" else f"{found['factor']} × {power}"


def in_parts(text: str) -> Iterator[tuple[str, str]]:
    """Yield a text in parts: as it stands up to an index, and the index; the last part has none.

    Args:
        text: of one line; Greek letters stand by their names in it.
    """
    end = 0
    for found in _SYMBOL.finditer(text):
        name, _, index = found[0].partition("_")
        before = text[end : found.start()] + GREEK.get(name, name)
        end = found.end()
        yield before, index
    if end < len(text):
        yield text[end:], ""
