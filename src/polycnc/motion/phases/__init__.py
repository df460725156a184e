"""Phases of constant acceleration that are looked for at any moment.

speed       over a piece of the path
axis_move   one axis from where it is to rest
"""
