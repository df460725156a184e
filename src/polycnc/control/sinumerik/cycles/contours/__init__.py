"""Contours of cycles: `reading` is CYCLE62 and how a contour is read, `pockets` CYCLE63 and CYCLE64."""
