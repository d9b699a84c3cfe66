# SPDX-License-Identifier: Apache-2.0
"""Functions that pass options on to others, which refuse unknown ones by their own names."""
from __future__ import annotations

import difflib
import functools
import inspect
from collections.abc import Callable
from typing import Any, TypeVar

_Function = TypeVar("_Function", bound=Callable[..., Any])


def _keywords(function: Callable[..., Any]) -> list[str]:
    """The names of the options that a function takes."""
    passed_on: list[str] = getattr(function, "_passed_on", [])
    return passed_on + [p.name for p in inspect.signature(function).parameters.values() if p.kind is p.KEYWORD_ONLY]


def passes_options_to(*others: Callable[..., Any]) -> Callable[[_Function], _Function]:
    """For a function whose **options are those of others: a TypeError for an unknown one names this function and the
    nearest known option."""

    def decorate(function: _Function) -> _Function:
        passed_on = [name for other in others for name in _keywords(other)]
        positional = [p.name for p in inspect.signature(function).parameters.values() if p.kind is p.POSITIONAL_OR_KEYWORD]
        known = sorted({*passed_on, *positional, *_keywords(function)} - {"self", "cls"})

        @functools.wraps(function)
        def checked(*arguments: Any, **options: Any) -> Any:
            for name in options:
                if name not in known:
                    near = difflib.get_close_matches(name, known, 1, 0.5)
                    hint = f"; did you mean '{near[0]}'?" if near else ""
                    raise TypeError(f"{function.__qualname__}() got an unexpected keyword argument '{name}'{hint}")
            return function(*arguments, **options)

        setattr(checked, "_passed_on", passed_on)
        return checked  # type: ignore[return-value]

    return decorate
