"""Kinds of random programs beside those of `random_programs`, and which seed draws which.

`mixed`: what every mill has between its blocks; `milling`: cycles, contours and transformations of the mills with word
addresses; `sinumerik`: those of SINUMERIK; `kinds`: the writer of a seed.
"""
