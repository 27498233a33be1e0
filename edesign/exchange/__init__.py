"""Models of projects for other programs: `edesign translate`.

`formats` knows which file names belong to which program. `opensees` writes scripts for OpenSees, `sap2000`
writes and reads the text of SAP2000.
"""
