"""The picture in three dimensions: paths and machine as buffers that a graphics card draws as they are.

lines     a line through space as a typed buffer, which grows
rows      rows of a toolpath as such a line
bodies    the axes of a machine as bodies, and where they stand
web/      the picture in a browser

Nothing here knows a control, a panel or where a path comes from: a panel, a view of a program and a view of stock
show the same picture.
"""
