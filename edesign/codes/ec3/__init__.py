"""EN 1993-1-1:2005, buildings of steel.

Clauses are functions of plain numbers in SI; `member` and `utilisation` put them together, and record each step in a
`Trace` if they are given one. Partial factors are arguments; their defaults are the recommended ones (6.1(1) Note 2B).
Axial forces are positive in tension, and magnitudes where a clause speaks of compression.
"""
