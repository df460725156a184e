"""The screens of the controls: what a page shows, and what its keys do. Nothing here knows a browser.

pages     what a family has: pages, their windows, soft keys and function keys, read from the TOML files beside it
view      what is on the screen at one moment: windows with rows of cells, soft keys, status lines
windows   what a window of each kind shows
operate   windows of SINUMERIK and SYNTEC alone: alarms with date and time, messages, channels, the blank
masks     input masks from text files: calls of user cycles, dialogs
forms     windows and keys of user cycles, dialogs of the program, the step view
words     words of a program under edit
sources   where the fields of tables come from
tables    windows with fields that can be written: offsets, tools, variables
actions   what soft keys and keys of the MDI unit do with the key-in buffer
programs  what keys do with programs: words, blocks, background, MDI, teach-in
measuring measured input B of the lathe
card      the memory card
transfer  data between the control and the card
state     the page, the cursor, the key-in buffer
screen    a screen: its keys, and what it shows
"""
