"""What each control writes of its memory: kinds of data, their files, and their texts.

kinds       what a module of a control says, and the table of all of them
mills       machining centres of FANUC and MELDAS: offsets, work offsets, variables as programs with G10
lathe       the lathe: its offset files
syntec      SYNTEC: macro programs
sinumerik   SINUMERIK: initialisation programs
parameters  parameters of FANUC and MELDAS: `N… P…` and G10 L50
"""
