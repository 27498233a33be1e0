"""ASCE/SEI 41-17, Seismic Evaluation and Retrofit of Existing Buildings: nonlinear static procedure, steel members."""
