"""Tools of the lathe: `offsets` (T), `nose_radius` (G40 to G42), `data_input` (G10), `measuring` (G31, G36, G37).

`offset_memory` holds the offsets, `files` are offsets as text, `screens` what an operator does with them, `sensor`
offsets by touch.
"""
