"""Ground motions: readers of record files, response spectra, suites, selection, and the spectra of a hazard.

`read.py` opens a record of any known format and `suite.py` a suite. `study.motions` makes the records of a project
ready by them; `edesign spectrum` and `edesign match` call them too.
"""
