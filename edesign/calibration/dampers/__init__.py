"""Tests of dampers as a problem of the search: experiments, effects with priors, predictions of whole campaigns.

`from_campaign.py` makes the problem of a campaign file, `problem.py` is what the search works on. `mechanisms.py` says
where an effect acts, `effects` holds the tables of their forms; `prediction.py` predicts all tests for many sets of
parameters, with forces of the law from the core. `nuisance.py` is what belongs to single tests, `uncertain_inputs.py`
what is not known of them.
"""
