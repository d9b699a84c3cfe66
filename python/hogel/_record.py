# SPDX-License-Identifier: Apache-2.0
"""What a file says of the request that made it: the same as the command line's (apps/cli/run_record.h), with the options
that acted, by their names there, in the order in which the command declares them."""
from __future__ import annotations

from typing import Optional

from . import _core

Record = dict[str, str]

_ORDERS = {command: list(dict.fromkeys(names)) for command, names in _core.command_parameters().items()}
#: The commands whose files say what made them.
commands = list(_ORDERS)


def entries(command: str, record: Record) -> list[tuple[str, str]]:
    """The version, the command and the options that acted, as pairs."""
    made = [("software", f"hogel {_core.__version__}"), ("command", f"hogel {command}")]
    return made + [(f"option {name}", record[name]) for name in _ORDERS[command] if record.get(name)]


def by_function(name: str) -> list[tuple[str, str]]:
    """What is said where no command does the same."""
    return [("software", f"hogel {_core.__version__}"), ("command", f"hogel.{name}")]


def yes_or_no(value: bool) -> str:
    """The text of a flag."""
    return "yes" if value else "no"


def number(value: float) -> str:
    """The shortest digits that give the number again."""
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(float(value))


def renamed(record: Optional[Record], before: str, after: str) -> Record:
    """The record of a command for another, whose input has another name."""
    return {after if name == before else name: text for name, text in (record or {}).items()}
