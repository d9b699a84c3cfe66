# SPDX-License-Identifier: Apache-2.0
"""Metadata of a request, stored in files: identical to that of the command line (apps/cli/run_record.h). Contains the
options that acted, by their names and in the order of the command."""
from __future__ import annotations

from typing import Optional

from . import _core

Record = dict[str, str]

_ORDERS = {command: list(dict.fromkeys(names)) for command, names in _core.command_parameters().items()}
#: Commands whose files store their options.
commands = list(_ORDERS)


def entries(command: str, record: Record) -> list[tuple[str, str]]:
    """Returns the version, the command and the options that acted, as pairs."""
    made = [("software", f"hogel {_core.__version__}"), ("command", f"hogel {command}")]
    return made + [(f"option {name}", record[name]) for name in _ORDERS[command] if record.get(name)]


def by_function(name: str) -> list[tuple[str, str]]:
    """Returns the metadata of a function without an equivalent command."""
    return [("software", f"hogel {_core.__version__}"), ("command", f"hogel.{name}")]


def yes_or_no(value: bool) -> str:
    """Returns the text of a flag."""
    return "yes" if value else "no"


def number(value: float) -> str:
    """Returns the shortest text that parses to the same number."""
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(float(value))


def renamed(record: Optional[Record], before: str, after: str) -> Record:
    """Converts the record of a command for another command, which names its input differently."""
    return {after if name == before else name: text for name, text in (record or {}).items()}
