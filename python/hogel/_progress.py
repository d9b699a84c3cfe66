# SPDX-License-Identifier: Apache-2.0
"""Progress of long work."""
from __future__ import annotations

import importlib
import sys
import time
from collections.abc import Callable
from typing import Optional, Union

Progress = Union[None, bool, Callable[[float], Optional[bool]]]

#: Default of the argument `progress`: True shows a bar, False nothing, None a bar in terminals and notebooks.
default: Optional[bool] = None
#: Seconds of work before a bar appears.
patience = 1.0


def _is_watched() -> bool:
    return "ipykernel" in sys.modules or (sys.stderr is not None and sys.stderr.isatty())


class _Line:
    """Progress line for terminals, used without tqdm."""

    def __init__(self, what: str) -> None:
        self.what = what

    def show(self, fraction: float) -> None:
        sys.stderr.write(f"\r{self.what}: {100 * fraction:3.0f} %")
        sys.stderr.flush()

    def close(self) -> None:
        sys.stderr.write("\n")


class _Tqdm:
    def __init__(self, what: str, tqdm) -> None:  # type: ignore[no-untyped-def]
        self.bar = tqdm(total=100, desc=what, unit="%", leave=False, bar_format="{desc}: {percentage:3.0f}%|{bar}| {remaining}")

    def show(self, fraction: float) -> None:
        self.bar.update(100 * fraction - self.bar.n)

    def close(self) -> None:
        self.bar.close()


def _new_bar(what: str) -> Union[_Line, _Tqdm]:
    try:
        # Imported by name: stubs of tqdm, which may be installed without it, give the two modules different types.
        module = importlib.import_module("tqdm.auto" if "ipykernel" in sys.modules else "tqdm")
        return _Tqdm(what, module.tqdm)
    except ImportError:
        return _Line(what)


class Bar:
    """Progress function that opens a bar when work takes long. Context manager."""

    def __init__(self, what: str) -> None:
        self.what, self.began = what, time.monotonic()
        self.bar: Union[_Line, _Tqdm, None] = None

    def __call__(self, fraction: float) -> None:
        if self.bar is None and fraction < 1 and time.monotonic() - self.began > patience:
            self.bar = _new_bar(self.what)
        if self.bar is not None:
            self.bar.show(fraction)

    def __enter__(self) -> Optional[Callable[[float], Optional[bool]]]:
        return self

    def __exit__(self, *_: object) -> None:
        if self.bar is not None:
            self.bar.close()


class _Callback:
    def __init__(self, call: Optional[Callable[[float], Optional[bool]]]) -> None:
        self.call = call

    def __enter__(self) -> Optional[Callable[[float], Optional[bool]]]:
        return self.call

    def __exit__(self, *_: object) -> None:
        pass


def reporting(progress: Progress, what: str) -> Union[Bar, _Callback]:
    """Returns a context manager that yields the progress function of the work, or None."""
    if callable(progress):
        return _Callback(progress)
    enabled = default if progress is None else progress
    if enabled is None:
        enabled = _is_watched()
    return Bar(what) if enabled else _Callback(None)
