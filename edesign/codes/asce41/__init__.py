"""ASCE/SEI 41-17, Seismic Evaluation and Retrofit of Existing Buildings: the nonlinear static procedure."""
