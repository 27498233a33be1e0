"""Compensators of the delay, and their export for a laboratory."""
