"""The FANUC machining centre (`fanuc-m`).

`control`, `codes` and `rules` (its tables), `cycles` (drilling), `variables`, `parameters` (written from the list
beside it), `smoothing` (G05.1).

Of five axes `mechanism` (19666, 19697 on), `standing_system` (G43.4 by WKP), `table_system` (G41.2 by TBP),
`leaning` (Q of G43.5), `five_axes` (G41.2), `leading_edge` (G41.3).
"""
