"""What acts on the frame: loads, masses, and the seismic action at the site."""
