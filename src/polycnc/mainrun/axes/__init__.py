"""What moves an axis beside its program.

manual         jog, steps, handwheel, reference approach
manual_offset  what an operator has moved while a program waits, until the program takes it back
shared_axes    axes that several channels can move
"""
