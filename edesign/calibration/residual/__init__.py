"""Residuals of a campaign read: noise, lag, harmonics, maps over what the error may depend on, its shape.

The search asks here where to look, and the report draws it.
"""
