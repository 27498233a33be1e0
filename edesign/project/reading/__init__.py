"""How YAML files become checked models, and what is wrong with them is reported to people."""
