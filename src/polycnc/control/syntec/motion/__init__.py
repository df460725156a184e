"""Motion codes of SYNTEC: `moves` (G00, G31, G33, G45 …), `arcs`, `planes`, `polar` (G12.1), `skips` (G31.10, G28.1).

`rotary_ways` (Pr221), `dwell` (G04), `smoothing` (G05), `fitting` (blocks that G05 fits), `smoother` (cuts it leads
beside their ends), `oscillation` (G81.1), `quiet` (#1500), `operation` (G10.6, G121), `conditions` (G120.1).
"""
