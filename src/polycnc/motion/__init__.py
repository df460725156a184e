"""From path to time: look-ahead speed planning."""
