"""The exception of this package, and parts of its messages."""

import difflib
import errno
import os

WRONG_INPUT, NOT_WRITTEN = 2, 3  # exit codes


class BristleError(Exception):
    """Wrong input, or output that could not be written. The message is one line for the user."""

    def __init__(self, message, exit_code=WRONG_INPUT):
        super().__init__(message)
        self.exit_code = exit_code


def system_reason(error):
    """The words of an OSError, with the remedy if it is a limit of the shell."""
    reason = os.strerror(error.errno) if error.errno else str(error)
    return f"{reason}; raise the limit of the shell, for instance by `ulimit -n 256`" if error.errno == errno.EMFILE else reason


def is_of_the_system(error):
    """Whether the system refused something for a reason that is not in the file: nobody may call it damaged."""
    return isinstance(error, OSError) and error.errno in (errno.EMFILE, errno.ENFILE, errno.EIO, errno.ESTALE)


def did_you_mean(word, known):
    """The known word that is most similar, in which capitals and small letters are the same."""
    small = {}
    for name in known:
        small.setdefault(name.lower(), name)
    found = [word] if word in small.values() else difflib.get_close_matches(word.lower(), list(small), 1)
    return f"; did you mean {small.get(found[0], found[0])}?" if found else ""
