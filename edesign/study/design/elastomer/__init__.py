"""Designs of dampers of elastomer: properties at frequency and strain, two methods, distributions, bounds."""
