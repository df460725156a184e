"""Contour tables, for stock removal by programs of the user (job planning, chapter 15).

`preparation` begins and ends (CONTPRON, CONTDCON, EXECUTE), `elements` are the pieces of a contour in the abscissa and
ordinate of a plane, `reliefs` finds relief cuts and links rows, `tables` writes and reads the fields of the program,
`use` has what works on a table (EXECTAB, INTERSEC) and CALCDAT.
"""
