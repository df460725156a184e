"""Mutated inputs by the hundred thousand: each must end in a table, an alarm or one clear line.

`python -m tests.fuzz --count 1000000` (`make fuzz COUNT=1000000`) runs as many as asked on all cores. An input is made
from its seed and its number alone, so a long run goes on where it stopped (`--first`), and a failure is shown again by
its number (`--show`).

What there is:
    seeds: what is mutated: programs, setups and machine files that work.
    mutation: how a text or a value is changed.
    values: YAML documents as values, and what makes them extreme.
    inputs: the input of a number, and how it is run.
    worker: runs inputs one after the other, each within its limits of time and memory.
    farm: several workers, their failures grouped by root.
    __main__: the command line.
"""
