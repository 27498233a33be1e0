"""EN 1994-1-1:2004, composite structures of steel and concrete: the stiffness of beams with which a slab acts."""
