"""Units of length."""

#: Millimetres of an inch.
INCH_MM = 25.4
