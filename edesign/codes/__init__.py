"""Clauses of design codes: what they require, as functions of plain numbers in SI."""

from edesign.codes.registry import Code, codes, find_code
from edesign.codes.spectrum import Spectrum

__all__ = ["Code", "Spectrum", "codes", "find_code"]
