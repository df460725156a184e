"""Which axes take part, and how fast by hand.

`geometry` exchanges the geometry axes (GEOAX), `jogging` has the velocities of jog.
"""
