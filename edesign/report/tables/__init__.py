"""Tables as data, and how they become text: on a terminal, in files, in pipes. Every table goes through here."""
