"""The file of substructure tests: YAML with units to validated virtual tests in SI."""

from edesign.project.substructure.loader import RtsFileError, load_rts_file, parse_rts_file, read_rig_file
from edesign.project.substructure.rts_file import Motion, RtsFile

__all__ = ["Motion", "RtsFile", "RtsFileError", "load_rts_file", "parse_rts_file", "read_rig_file"]
