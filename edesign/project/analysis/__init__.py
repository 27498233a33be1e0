"""What is analysed in a project file, with which damping and integration, and what is kept."""
