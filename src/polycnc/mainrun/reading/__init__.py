"""What a panel or a factory system reads.

readings       readings of the whole control
snapshot       values that belong to one moment
view           where the axes of a channel are now
display        from machine positions to what the displays show
"""
