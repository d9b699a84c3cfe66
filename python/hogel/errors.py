# SPDX-License-Identifier: Apache-2.0
"""What hogel raises: one class for each kind of failure (docs/errors.md), below the fitting class of Python.

>>> import hogel
>>> try:
...     hogel.length("16", "size")
... except ValueError as error:
...     print(error.name, error.status)
usage 2
"""
from __future__ import annotations


class Error(Exception):
    """A failure that hogel reports, in one line: what, where, what was expected.

    >>> import hogel
    >>> issubclass(hogel.BadInputError, hogel.Error), hogel.BadInputError.status
    (True, 3)
    """

    name = "internal"  #: of the exit status of the command line
    status = 70  #: the exit status of the command line
    parameter = ""  #: the parameter that the error is about, "pitch", or several, "eye, pitch"; or an empty text


class UsageError(Error, ValueError):
    """The request makes no sense: wrong unit, contradicting or impossible options."""

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
    """The error about a parameter, or several, "eye, pitch", with which its message begins."""
    error = UsageError(f"{parameter}: {text}")
    error.parameter = parameter
    return error


_CLASSES = {
    kind.status: kind for kind in (UsageError, BadInputError, CannotWriteError, NotBuiltInError, CancelledError, InternalError)
}


def of(status: int, message: str, parameter: str = "") -> Error:
    """The error of an exit status, whose message begins with its parameters."""
    if parameter and not message.startswith(f"{parameter}:"):
        message = f"{parameter}: {message}"
    error = _CLASSES.get(status, InternalError)(message)
    error.parameter = parameter
    return error
