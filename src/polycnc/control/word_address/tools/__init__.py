"""Tools: `length` (G43), `radius` (G40 to G42), `corner_vectors` (G38, G39), `measuring` (G37), `data_input` (G10)."""
