"""What a panel or a factory system reads.

readings       readings of the whole control
snapshot       values that belong to one moment
view           where the axes of a channel are now
forecast       what a program will do, calculated beside the control
display        from machine positions to what the displays show
"""
