"""Safety verifications of EN 1998-1:2004, 4.4, and of existing members: drift, P-Delta, capacity design."""
