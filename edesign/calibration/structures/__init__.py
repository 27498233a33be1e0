"""Records of buildings as a problem of the search: a shear building, fixed or isolated, and what it may lack.

`campaign.py` reads a campaign of records, `from_campaign.py` makes its problem and runs the search. `building.py` has
the declared building, `response.py` its response to base motion, `isolation.py` the law of its isolation layer.
`effect.py` says where an effect acts, `effects` holds the tables of their forms, `sizes.py` what their priors go by;
`problem.py` is what the search works on.
"""
