"""The study file: variants, incremental analyses, and the reference it is compared with."""
