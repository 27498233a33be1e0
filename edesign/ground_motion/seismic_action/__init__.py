"""The hazard of a file as spectra: one class for each code, all with the interface `SeismicAction`."""
