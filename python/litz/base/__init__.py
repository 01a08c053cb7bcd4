"""What all other parts use: tables, names, units, notebooks, and the place of the program."""
