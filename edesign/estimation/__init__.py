"""Estimation of parameters from tests.

parameters: a parameter with its bounds and prior, and the coordinate that a search moves. noise: how residuals are
weighted. differences: white noise of a history. model: what is estimated. least_squares: the estimator. left_out: the
score of tests left out of the fit. uncertainty: covariance clustered by test, intervals, what tests leave open.
"""
