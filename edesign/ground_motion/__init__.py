"""Ground motions: response spectra, suites, selection, and the spectra of a hazard.

`formats` opens record files and `suite.py` a suite. `study.motions` makes the records of a project ready by them;
`edesign spectrum` and `edesign match` call them too.
"""
