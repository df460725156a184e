"""What costs time to make is made when it is first used, so that a short program pays for nothing but what it uses.

`records` has the decorator of dataclasses, `regexes` regular expressions; both are used as those of the
standard library.
"""
