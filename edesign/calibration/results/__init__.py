"""What a search found, as the user gets it: fitted to all samples, compared with validation tests, as files.

`steps.py` takes the steps of a calibration, `fit.py` fits what was found to all samples; `predictions.py` has the
errors of each test, `nuisances.py` what belongs to single ones, `floor.py` what no model can go below, `models.py`
which models of the search the tests leave probable. `evidence.py` makes a calibration of these; `outcome.py` says what
it is of tests of dampers. `next_test.py` asks which test would separate models, `other_law.py` whether another law does
better, `law_file.py` what a law file carries. `result.py` holds all of it, `practical_units.py` turns it into kN and
mm.
"""
