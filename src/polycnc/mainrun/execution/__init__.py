"""Execution: what is prepared is carried out in time.

execution      from event to event, one channel
channel_run    a channel with all that executes it
machinery      what the machine does with M, T, S and messages
"""
