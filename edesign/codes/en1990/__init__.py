"""EN 1990:2002+A1:2005, basis of structural design: combinations of actions for buildings."""

from edesign.codes.en1990.combinations import (
    Combination,
    characteristic,
    frequent,
    fundamental,
    quasi_permanent,
    seismic,
)

__all__ = ["Combination", "characteristic", "frequent", "fundamental", "quasi_permanent", "seismic"]
