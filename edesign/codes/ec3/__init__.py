"""EN 1993-1-1:2005, buildings of steel: what the assessment of frames needs of it.

Clauses are functions of plain numbers in SI. The partial factor is the recommended one (6.1(1) Note 2B).
"""
