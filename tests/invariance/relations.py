"""Rows of the table: what must not change the answer of a command. Other files add rows by @relation."""

ROWS = []


def relation(part, command, change, expectation):
    """Registers a function of a Context that raises AssertionError where the answer changes, and returns what it saw.

    `part` is the group it runs in, `expectation` what physics or arithmetic says must hold: bits, rounding or intervals."""

    def register(function):
        ROWS.append((part, command, change, expectation, function))
        return function

    return register
