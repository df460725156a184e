"""Signals between control, machine and panel, and the machine's own controller.

image            the signals with their edges, and the rules on them
interlocks       refuses words and raises alarms by the machine's table
program_signals  signals as programs read and write them
machine_states   signals that follow from the state of the control; the magazine
"""
