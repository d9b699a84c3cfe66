# SPDX-License-Identifier: Apache-2.0
"""Decorators for functions with **options: signatures, documentation and errors for unknown keywords."""
from __future__ import annotations

import difflib
import functools
import inspect
from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeVar

_Function = TypeVar("_Function", bound=Callable[..., Any])


def _keywords(function: Callable[..., Any]) -> list[str]:
    """Returns the names of the options of a function."""
    passed_on: list[str] = getattr(function, "_passed_on", [])
    return passed_on + [p.name for p in inspect.signature(function).parameters.values() if p.kind is p.KEYWORD_ONLY]


def _refuse_unknown(function: Callable[..., Any], options: Iterable[str], known: list[str]) -> None:
    for name in options:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1, 0.5)
            hint = f"; did you mean '{near[0]}'?" if near else ""
            raise TypeError(f"{function.__qualname__}() got an unexpected keyword argument '{name}'{hint}")


def takes(parameters: Sequence[tuple[str, str, str]]) -> Callable[[_Function], _Function]:
    """Decorates a function whose **options are parameters of the command line: name, default and help. Adds them to its
    signature and documentation. A TypeError for an unknown option names the nearest one."""

    def decorate(function: _Function) -> _Function:
        signature = inspect.signature(function)
        explicit = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        names = [name for name, _, _ in parameters]
        keyword_only = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=Any) for name in names]
        known = sorted([*names, *(p.name for p in explicit)])

        @functools.wraps(function)
        def checked(*arguments: Any, **options: Any) -> Any:
            _refuse_unknown(function, options, known)
            return function(*arguments, **options)

        setattr(checked, "__signature__", signature.replace(parameters=[*explicit, *keyword_only]))
        rows = [f"{name:<19}{help.partition(chr(10))[0]}{f' [{shown}]' if shown else ''}" for name, shown, help in parameters]
        checked.__doc__ = inspect.cleandoc(function.__doc__ or "") + "\n\n" + "\n".join(rows) + "\n"
        return checked  # type: ignore[return-value]

    return decorate


def passes_options_to(*others: Callable[..., Any]) -> Callable[[_Function], _Function]:
    """Decorates a function that passes its **options to other functions. A TypeError for an unknown option names this
    function and the nearest option."""

    def decorate(function: _Function) -> _Function:
        passed_on = [name for other in others for name in _keywords(other)]
        positional = [p.name for p in inspect.signature(function).parameters.values() if p.kind is p.POSITIONAL_OR_KEYWORD]
        known = sorted({*passed_on, *positional, *_keywords(function)} - {"self", "cls"})

        @functools.wraps(function)
        def checked(*arguments: Any, **options: Any) -> Any:
            _refuse_unknown(function, options, known)
            return function(*arguments, **options)

        setattr(checked, "_passed_on", passed_on)
        return checked  # type: ignore[return-value]

    return decorate
