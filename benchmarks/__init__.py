"""Speed and accuracy side by side with other programs (`make bench`), and the cost of single parts."""
