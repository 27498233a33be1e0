"""Rules of EN 1998-1 for the whole building: modes, ductility, regularity, storeys, overstrength, joints."""
