"""What an operator may ask for, and the programs that a cycle start runs.

states       modes, states, and the table of the commands that each allows
permission   whether a command may be given
program_keys load, start, hold, reset; power and modes
hand         the axes without a program
switches     overrides and the switches of the panel
settings     what they and the locks are set to
data         variables and programs that an operator reads and writes
programs     the loaded program, what was typed in, the text of blocks
search       block search with calculation
"""
