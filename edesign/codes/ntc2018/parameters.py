"""Parameters of NTC 2018 by the names that nationally determined ones of the Eurocodes have."""

from __future__ import annotations

from functools import cache
from importlib import resources

import yaml

from edesign.codes.ec8.national import NationalParameters, parameters_of_file

TITLE = "NTC 2018"


@cache
def ntc_parameters() -> NationalParameters:
    """Return psi, partial factors, gamma_ov, gamma_pb and the lower bound of the design spectrum of NTC 2018.

    Source: NTC 2018, Tables 2.5.I, 2.6.I and 4.2.VII, 3.2.3.5, 7.5.1 and 7.5.5.
    """
    text = resources.files("edesign.codes.ntc2018").joinpath("data/parameters.yaml").read_text(encoding="utf-8")
    return parameters_of_file(TITLE, yaml.safe_load(text))
