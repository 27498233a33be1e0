"""The search for effects that a base model of tests lacks.

`problem.py` is what it works on, `search.py` the search, `settings.py` its numbers. `screening.py` says what each
effect would gain, `models.py` fits and scores models, `variants.py` other equations and effects in the place of one.
`adoption.py` has all gates that an effect passes before it is adopted.
"""
