"""How the commands of this folder end: one line on stderr that says what is wrong, and the exit code of the program's table
(README.md): 0 done, 2 wrong usage, 3 input that cannot be used, 6 a file that cannot be read or written."""

import sys


class Failed(Exception):
    """What is wrong and what to do, with the exit code."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def finish(name, work):
    """Runs a command to its end and leaves Python with its exit code. SystemExit with words: a file that is not what it should be."""
    code, trouble = 0, None
    try:
        work()
    except Failed as failure:
        code, trouble = failure.code, failure
    except SystemExit as said:
        if isinstance(said.code, int):  # argparse has spoken
            raise
        code, trouble = 3, said
    except OSError as error:
        code, trouble = 6, f"{error.filename}: {error.strerror}" if error.filename else error
    if trouble:
        print(f"{name}: {trouble}", file=sys.stderr)
    sys.exit(code)
