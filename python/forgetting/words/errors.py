"""What a user can get wrong besides the numbers of an estimator."""


class RecordError(ValueError):
    """One sentence that names the file, column, row or option at fault."""


def first_line(error: BaseException) -> str:
    """Shorten a library's message to its first line."""
    return str(error).strip().splitlines()[0].rstrip(".") if str(error).strip() else "unreadable"
