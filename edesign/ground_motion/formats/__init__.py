"""Files of records: a reader for each format, and what they share.

`read.py` opens a file of any known format, which it recognises by content; `write.py` writes one for other programs.
"""
