"""Spectrum matching: a recorded motion changed until its response spectrum is the target's."""

from edesign.ground_motion.matching.match import match_record
from edesign.ground_motion.matching.options import MatchOptions
from edesign.ground_motion.matching.result import Adjusted, Match, Misfit, misfit

__all__ = ["Adjusted", "Match", "MatchOptions", "Misfit", "match_record", "misfit"]
