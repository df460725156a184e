"""The ISO dialect (G291): functions of ISO code (M, on a lathe T) that the control's own language has no word for.

`language/sinumerik/iso_dialect` reads the words of a block and knows the counterparts; `dialect` runs a block and has
the table of the functions here, `running` is the block while it runs and what the dialect remembers.

    holes       drilling cycles G73 to G89, G98, G99
    frames      G50, G51 (scale), G50.1, G51.1 (mirror), G52 (shift), G68, G69 (rotation), G92 (position), G10 L2
    offsets     G43, G44, G49 with H, D
    reference   G28, G30, G53
    subprograms M98, M99, G65 to G67
    macro_words what programs of G65 and G66 read
    systems     on a lathe: codes by code system A, B or C, increments U, V, W, H
    turning     on a lathe: G33, G77, G79, T, G92 S

Source: general knowledge of the control's ISO milling and turning; the manuals at hand name G290 and G291 alone.
"""
