# SPDX-License-Identifier: Apache-2.0
"""Exceptions of hogel: one class for each kind of failure (docs/errors.md), derived from the matching Python exception.

>>> import hogel
>>> try:
...     hogel.length("16", "size")
... except ValueError as error:
...     print(error.name, error.status)
usage 2
"""
from __future__ import annotations


class Error(Exception):
    """Failure reported by hogel. The message is one line: what, where, what was expected.

    >>> import hogel
    >>> issubclass(hogel.BadInputError, hogel.Error), hogel.BadInputError.status
    (True, 3)
    """

    name = "internal"  #: name of the exit status of the command line
    status = 70  #: exit status of the command line
    parameter = ""  #: name of the bad parameter, "pitch", or of several, "eye, pitch"; may be empty


class UsageError(Error, ValueError):
    """Invalid request: wrong unit, contradicting or impossible options."""

    name, status = "usage", 2


class BadInputError(Error, ValueError):
    """A file or a scene is missing, damaged, or not what it claims to be."""

    name, status = "bad_input", 3


class CannotWriteError(Error, OSError):
    """An output cannot be created, or the disk is full."""

    name, status = "cannot_write", 4


class NotBuiltInError(Error, NotImplementedError):
    """This build lacks the feature."""

    name, status = "not_built_in", 5


class CancelledError(Error, RuntimeError):
    """The caller's progress function returned False."""

    name, status = "cancelled", 6


class InternalError(Error, RuntimeError):
    """A condition that the library itself should have ensured: a bug."""

    name, status = "internal", 70


def usage_error(parameter: str, text: str) -> UsageError:
    """Returns an error about a parameter, or several, "eye, pitch". The message begins with their names."""
    error = UsageError(f"{parameter}: {text}")
    error.parameter = parameter
    return error


_CLASSES = {
    kind.status: kind for kind in (UsageError, BadInputError, CannotWriteError, NotBuiltInError, CancelledError, InternalError)
}


def of(status: int, message: str, parameter: str = "") -> Error:
    """Returns the error of an exit status. The message begins with the names of its parameters."""
    if parameter and not message.startswith(f"{parameter}:"):
        message = f"{parameter}: {message}"
    error = _CLASSES.get(status, InternalError)(message)
    error.parameter = parameter
    return error
