"""Oscillation: an axis moves to and fro beside the program, with infeed axes or without (job planning 11).

words     OS, OSP1 … OSB, OSCILL with POSP
strokes   what an axis does between switching on and off
infeed    partial infeeds
"""
