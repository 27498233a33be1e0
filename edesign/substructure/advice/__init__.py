"""What is said before a test."""
