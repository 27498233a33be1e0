"""Makes OpenSeesPy importable on machines without BLAS before the tests beside it are collected."""

import benchmarks.peers  # noqa: F401 - importing it is what does it
