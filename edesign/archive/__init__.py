"""Archives: HDF5 files of results, written as a whole and read with their checks. The only package that knows h5py.

`dataset.py` is the neutral form of results; `writer.py` and `reader.py` take it into a file and out of it. Runs
(`study.run`), designs and calibrations write here; `report` reads.
"""
