"""The FANUC family: machining centres (Hartford) and the 0i-TF Plus lathe."""
