"""What can be wrong with a record or with the model asked of it."""


class RecordError(ValueError):
    """One sentence that names the file, column, row or option at fault."""
