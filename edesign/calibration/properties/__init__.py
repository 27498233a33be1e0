"""Tables of moduli as a problem of the search: each row is a steady test of a damper.

`campaign.py` reads a campaign of a table, `repeatability.py` says how well its rows repeat, `from_campaign.py` makes
the problem. `outcome.py` holds what was found against all rows. `corrected.py` has the law as a law file carries it,
`next_test.py` what would determine more, `residual_words.py` says in words what is left, `write.py` what files say.

`reading.py` and `arrangement.py` hold the forms of effects that tables alone ask for; `problem.py` is what the search
works on.
"""
