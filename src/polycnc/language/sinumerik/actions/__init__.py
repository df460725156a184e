"""Synchronised actions as the language reads them (job planning 10): once, into functions for the main run.

code     what an action is, compiled, and what its functions call
live     expressions of which one part is read in every cycle, the other one where the block is prepared
block    a block that is an action
cycle    technology cycles
"""
