"""Analysis of buildings by EN 1998-1:2004: masses, regularity, modes, torsion, displacements, isolation."""
