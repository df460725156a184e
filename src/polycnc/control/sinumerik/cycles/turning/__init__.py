"""The turning cycles of SINUMERIK.

work            the cuts in their own coordinates, the path of the nose
stock_removal   CYCLE95
corner          CYCLE951
contours        CYCLE952
blanks          its contour, blank and limits
contour_grooves its grooving and plunge turning
parallel_cuts   its cuts parallel to the contour
threads         CYCLE97 to CYCLE99
grooves         CYCLE93, CYCLE930
parting         CYCLE92
undercuts       CYCLE94, CYCLE96, CYCLE940
"""
