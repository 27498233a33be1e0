"""The seismic action of EN 1998-1:2004: ground, spectra, importance, accelerograms."""
