"""The memory of a control as the text files that the control itself writes and reads, and as a setup.

writing     everything that a memory holds, as files; what they cannot say is told
reading     files into a memory: all of them, or nothing at all
power_on    a channel that stands on a memory and lets nothing of what it does last before it is asked to
errors      files that are refused
programs    program sets between `%`, archives, program files
numbers     numbers as text, to the last bit
setups      a memory as a setup, and back
comparison  what two memories have that differs
controls    what each control writes: kinds of data, their files and their texts
"""
