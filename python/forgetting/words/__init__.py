"""What the package says to people: what is wrong, which name was meant, numbers to be read.

Only text: nothing here imports a library, so that the command can complain without loading one.
"""
