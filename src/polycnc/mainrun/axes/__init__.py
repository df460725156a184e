"""The axes in the main run: where each shall be is the sum of its sources.

axis           an axis and its sources; how another one is added
hand           jog, steps, handwheel, reference approach
manual_offset  what an operator has moved while a program waits, until the program takes it back
about_tip      linear axes that follow rotary ones about the tip of the tool
along_line     linear axes that go together along an axis of the work or the tool
commanded      what an action, or a positioning word, moves of an axis beside the path
spindle_turning  what a spindle has turned that leads an axis
overlay        a shift beside everything else
channel_axes   the axes of a channel, all at once
machine_axes   the axes of the machine, and which channel leads each
"""
