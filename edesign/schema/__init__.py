"""JSON Schemas of all YAML files, made from the models that read them, and the reference of their keys."""
