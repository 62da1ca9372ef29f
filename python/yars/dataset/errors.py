"""Errors of the data set maker. A message says what was expected, what was found, what to do."""


class DatasetError(RuntimeError):
    """Fault of the world or of a specification, with a message for the user. The command ends with exit code 1."""


class SpecError(DatasetError):
    """Faults of a specification, one a line: FILE:LINE: expected ..., found ...; ..."""
