"""Punching and nibbling: strokes at the ends of blocks, and paths that are cut into segments (job planning 12).

`block` says what the words and functions of a block ask for, `strokes` is the stage that cuts its moves into segments
and puts the strokes between them.
"""
