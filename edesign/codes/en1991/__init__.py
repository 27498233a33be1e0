"""EN 1991-1-1:2002, actions on structures: imposed loads of buildings."""
