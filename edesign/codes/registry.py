"""The codes that edesign knows, by the name that a project file gives them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from edesign.codes.ec8.design import DesignSpectrum
from edesign.codes.ec8.elastic import ElasticSpectrum
from edesign.codes.ec8.national import NationalParameters, countries, national_parameters
from edesign.codes.names import unknown


@dataclass(frozen=True)
class Code:
    """An edition of a code for the seismic action.

    Attributes:
        name: as in a project file.
        title: for people.
        countries: names of the countries whose parameters are known.
        national: parameters of a country by name, the recommended ones for None.
        elastic, design: the spectra; the elastic one is a `Spectrum`.
    """

    name: str
    title: str
    countries: Callable[[], tuple[str, ...]]
    national: Callable[[str | None], NationalParameters]
    elastic: type[ElasticSpectrum]
    design: type[DesignSpectrum]


codes: Mapping[str, Code] = MappingProxyType(
    {
        "ec8-2004": Code(
            "ec8-2004", "EN 1998-1:2004", countries, national_parameters, elastic=ElasticSpectrum, design=DesignSpectrum
        )
    }
)


def find_code(name: str) -> Code:
    """Return the code of a name such as "ec8-2004".

    Raises:
        InputError: there is no such code; the message names those there are.
    """
    if name not in codes:
        raise unknown("code", name, codes)
    return codes[name]
