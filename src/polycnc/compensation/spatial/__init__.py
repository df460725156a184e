"""Radius compensation in space: across a tool that tilts.

stage             the tip moves by the radius across path and tool, corners as the control has them
arcs              where parallels of arcs and lines meet
chords            in how many chords the tip goes
rules             how controls differ
limiting_surface  floors beside walls, which the mill meets with its end
"""
