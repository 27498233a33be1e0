"""The model drawn before it is analysed: what stands where, how it is held, what loads it, and which dampers it has."""
