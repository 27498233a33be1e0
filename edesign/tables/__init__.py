"""Tables of numbers in files: encodings, headers, units, decimals, as machines write them or as is declared."""
