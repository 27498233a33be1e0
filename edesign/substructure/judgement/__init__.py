"""What is said after a test."""
