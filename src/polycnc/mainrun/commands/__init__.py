"""What an operator may ask for, and the programs that a cycle start runs.

states       modes, states, and the table of the commands that each allows
programs     the loaded program, what was typed in, the text of blocks
search       block search with calculation
"""
