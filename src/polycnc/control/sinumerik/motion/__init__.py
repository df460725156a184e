"""Motion: `moves` (G0, G1, G33, G4 …), `circles`, `splines` with `spline_stage`, `indexing`, `repositioning`."""
