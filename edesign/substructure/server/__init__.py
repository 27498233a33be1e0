"""The laboratory behind a port, for OpenSees."""
