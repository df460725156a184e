"""Tangential control: rotary axes follow the direction of the path (TANG, TANGON, TLIFT, TANGOF, TANGDEL).

`definitions` has the procedures and what words of a coupled axis mean, `coupling` where the axis stands for a
direction, `stage` the stage of the path that turns it. It is planned with the path, so every run of a program agrees.

Source: job planning 8.1.
"""
