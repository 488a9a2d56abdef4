"""The exception of this package."""

WRONG_INPUT, NOT_WRITTEN = 2, 3  # exit codes


class BristleError(Exception):
    """Wrong input, or output that could not be written. The message is one line for the user."""

    def __init__(self, message, exit_code=WRONG_INPUT):
        super().__init__(message)
        self.exit_code = exit_code
