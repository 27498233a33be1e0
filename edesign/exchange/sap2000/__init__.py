"""Models as SAP2000's tables in a text file (.s2k): written from a frame or a building, and read back.

Source: CSI Analysis Reference Manual (local axes, releases, constraints, mass source) for what the tables mean; names
of tables and fields as SAP2000 20.2, 25.1 and 26.2 write them.
"""
