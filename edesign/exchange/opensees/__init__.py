"""Projects and buildings as scripts for OpenSees, in Python (OpenSeesPy) and in Tcl.

Both texts are printed from one list of commands.
"""
