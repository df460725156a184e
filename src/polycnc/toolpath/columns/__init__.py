"""The rows of a chunk as the columns of a table.

names     columns of the table, and a record by them
shown     kernel: what the displays show, column by column
compiled  this kernel as machine code
numbers   all columns of a chunk as numbers
lines     rows as text that has one form for each kind
"""
