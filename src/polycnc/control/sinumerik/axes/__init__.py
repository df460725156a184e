"""Which axes take part, and how fast by hand.

`geometry` exchanges the geometry axes (GEOAX), `jogging` has the velocities of jog, `spindles` knows the axes that
spindles are.
"""
