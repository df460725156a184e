"""Tools: length, radius and what is told of them.

`length` (G43), `radius` (G40 to G42), `spatial` (G41.2), `spatial_axes` (the same where nothing leads the axes),
`corner_vectors` (G38, G39), `look_ahead` (what stops reading), `measuring` (G37), `data_input` (G10).
"""
