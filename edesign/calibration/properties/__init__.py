"""Tables of moduli as a problem of the search: each row is a steady test of a damper.

`campaign.py` reads a campaign of a table, `repeatability.py` says how well its rows repeat, `from_campaign.py` makes
the problem and runs the search. `reading.py` and `arrangement.py` hold the forms of effects that tables alone ask for;
`problem.py` is what the search works on.
"""
