"""What actions do to the frame: static cases, response spectra, and what the linear model leaves out."""
