"""The loop on tests of a damper: the law's force with effects, how each test starts, and the next test to make.

`problem.py` is what the search works on; `effects` holds a file for each effect.
"""
