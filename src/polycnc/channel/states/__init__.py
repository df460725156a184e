"""What features own of a channel: `state` declares it with its lifetime, `snapshot` notes a channel and brings it back.

Of some objects `unchanging` says that they stay. `passes` compares states: whether a main program that begins again
does nothing new; `standstill` whether a loop does.
"""
