"""The machining cycles of SINUMERIK: from the call in a program to the generators of `polycnc.cycles`.

`table` has the signature of every cycle and names its function; `arguments` gives it the values of its parameters,
`levels` what they say of the cycle's axis. The function notes what the cycle does, block by block, in `moves`, and
`calls` runs the blocks as a program level. The cycles themselves:

    drilling             CYCLE81, CYCLE82, CYCLE84 to CYCLE89, CYCLE840
    deep_holes           CYCLE83, CYCLE830
    patterns             HOLES1, HOLES2, CYCLE801, CYCLE802
    chamfers             VARI 5 of the milling cycles
    milling              POCKET1 to POCKET4, SLOT1, SLOT2, LONGHOLE, CYCLE899
    surfaces             CYCLE61, CYCLE71, CYCLE72, CYCLE76, CYCLE77, CYCLE79
    milled_threads       CYCLE70, CYCLE78, CYCLE90
    engraving            CYCLE60
    contours             CYCLE62 to CYCLE64
    turning              CYCLE93 to CYCLE99, CYCLE951
    swivel               CYCLE800
    swivel_record        its data records
    high_speed_settings  CYCLE832

A program without cycles loads none of this.
"""
