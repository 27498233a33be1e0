"""What a search found, as the user gets it: fitted to all samples, held against tests for validation, as files.

`fit.py` fits what was found to all samples and keeps no effect that may be nothing; `predictions.py` has the errors of
each test, `floor.py` what no model can go below, `models.py` which models of the search the tests leave probable.
`next_test.py` asks which test would separate these, `other_law.py` whether another law does better, `law_file.py` what
a law file carries. `result.py` holds all of it, `practical_units.py` turns it into kN and mm, `write.py`
makes the files.
"""
