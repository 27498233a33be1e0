"""AISC 341-16, Seismic Provisions for Structural Steel Buildings."""
