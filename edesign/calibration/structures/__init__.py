"""Records of buildings as a problem of the search: a shear building, fixed or isolated, and what it may lack.

`campaign.py` reads a campaign of records, `from_campaign.py` makes its problem. `outcome.py` holds what was found
against all records. `corrected.py` has what files say of a corrected building, `residual_words.py` says in words what
is left unexplained.

`building.py` has the declared building, `response.py` its response to base motion, `isolation.py` the law of its
isolation layer. `effect.py` says where an effect acts, `effects` holds the tables of their forms, `sizes.py` what their
priors go by; `problem.py` is what the search works on.
"""
