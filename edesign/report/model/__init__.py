"""The model drawn before it is analysed: what stands where, its supports, its loads and its dampers."""
