"""Names of files of the PEER data base: RSN6_IMPVALL.I_I-ELC180.AT2 and the forms in which they lie in folders."""

from __future__ import annotations

import re
from dataclasses import dataclass

_NAME = re.compile(r"(?:RSN([0-9]{1,6})_)?([A-Za-z0-9.]+)_([A-Za-z0-9_.+-]*[A-Za-z0-9])", re.IGNORECASE)
_SUFFIXES = (".AT2", ".time_acc.csv")
"""Endings of files: PEER's own, and two columns of time (s) and acceleration (g)."""


@dataclass(frozen=True)
class PeerName:
    """A component in the PEER data base.

    Attributes:
        event: code of the earthquake, with that of the station where PEER adds it: IMPVALL.I, KERN.PEL.
        component: code of shock, station and direction: I-ELC180.
        rsn: record sequence number, None if unknown.
    """

    event: str
    component: str
    rsn: int | None = None

    @classmethod
    def parse(cls, text: str) -> PeerName | None:
        """Read a name such as `RSN6_IMPVALL.I_I-ELC180.AT2`; RSN6_ and .AT2 may be left out. None: it is none."""
        for suffix in _SUFFIXES:
            if text.lower().endswith(suffix.lower()):
                text = text[: -len(suffix)]
        match = _NAME.fullmatch(text)
        return cls(match[2], match[3], int(match[1]) if match[1] else None) if match else None

    @property
    def file(self) -> str:
        """Name of the file as PEER gives it, as far as it is known."""
        number = "" if self.rsn is None else f"RSN{self.rsn}_"
        return f"{number}{self.event}_{self.component}.AT2"

    def is_complete(self, name: str) -> bool:
        """Say whether a file's name says earthquake and component; RSNn_ may be missing on either side."""
        number = "[0-9]+" if self.rsn is None else f"0*{self.rsn}"
        endings = "|".join(re.escape(suffix) for suffix in _SUFFIXES)
        return _matches(rf"(rsn{number}_)?{re.escape(f'{self.event}_{self.component}')}({endings})", name)

    def is_short(self, name: str) -> bool:
        """Say whether an AT2 file's name ends with the component, but does not say the earthquake in the same way.

        I-ELC180.at2, IMPVALL_I-ELC180.AT2 and NGA_no_6_I-ELC180.AT2 are such names, of older editions of the data base.
        """
        other = "" if self.rsn is None else rf"(?!rsn(?!0*{self.rsn}_)[0-9])"  # not of another number
        return _matches(rf"{other}(.+_)?{re.escape(self.component)}\.at2", name) and not self.is_complete(name)


def may_be_peer(name: str) -> bool:
    """Say whether a file's name ends like one that is looked for."""
    return name.lower().endswith(tuple(suffix.lower() for suffix in _SUFFIXES))


def _matches(pattern: str, name: str) -> bool:
    return re.fullmatch(pattern, name, re.IGNORECASE) is not None
