"""The kit that the expressions of all languages share."""
