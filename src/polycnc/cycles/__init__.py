"""Machining cycles as generators of moves, free of any control's words."""
