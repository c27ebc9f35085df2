"""What a user can get wrong besides the numbers of an estimator."""


class RecordError(ValueError):
    """One sentence that names the file, column, row or option at fault."""
