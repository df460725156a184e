"""Transformations of SINUMERIK (job planning 6): which one acts, and how programs tell the direction of the tool.

    data_sets      the transformations that machine data and machine file configure, and what each makes of the axes
    selection      TRAORI, TRANSMIT, TRACYL, TRAANG, TRACON, TRAFOOF and their restrictions
    seat           frames in front of the transformation that acts, the tool behind it, names of the axes
    words          words of orientation: what a block says of the tool's direction
    posture        between work, basic system and rotary axes; what later blocks go on from
    orientation    where these words lead the rotary axes, at the end of a block and on the way
    standing       blocks that name a direction and turn the tool by little, for the scanner as well
    directions     from the words to the way of the direction: great circle, cones, curves, relative to the path
    smoothing      how far OSD, OST and the compressors let the axes leave the programmed way
    history        ORISON
    spin           THETA, ORIROTA and the like
    start          ORIRESET
    point_to_point PTP, CP, STAT, TU
    oblique        G05, G07
    pole_sides     the side of the centre on which the infeed axis is, and the rotary axis in it (TRANSMIT)
    walls          the linear axis that keeps groove walls square (TRACYL)

The mathematics is that of the layer `transformation/`.
"""
