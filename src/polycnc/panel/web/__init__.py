"""The panel in a browser: what stands on the page, and the server. Needs the extra `panel` (NiceGUI).

desk      a control with its screen and its machine panel, and the time that passes for them
markup    a screen as HTML
crt       the content of a screen: cells that have changed are sent alone
page      the page: screen, keyboard, machine panel
editor    the program editor
teacher   the sheet with exercise and faults
messages  the JSON interface: commands in, snapshots out
guard     who may come in: token, origin
interrupts  how the server is told to close
server    all of it together
"""
