"""What a search for effects works on: a problem with tests, a base model and effects that this may lack."""
