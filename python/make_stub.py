#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes hogel/_core.pyi, the types of the extension module, from what pybind11 says in its documentation strings.

usage: make_stub.py FILE   with the built package in PYTHONPATH and mypy's stubgen in the PATH
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HEAD = '''# SPDX-License-Identifier: Apache-2.0
# The types of the extension module; written by python/make_stub.py, which a test compares with this file.
import os
from typing import Any, Callable, ClassVar, Dict, List, Optional, Sequence, Tuple, Union, overload

import numpy

__version__: str
'''
CHANGES = [
    (r"^(?:from|import) .*\n", ""),
    (r"^ +__entries.*\n", ""),
    (r"^ +__hash__: ClassVar\[None\].*\n", ""),
    (r"^ +__(eq|repr|reduce)__: ClassVar\[function\].*\n", ""),
    (r"__eq__\(self, arg0: \w+\)", "__eq__(self, arg0: object)"),
    (r"\*args, \*\*kwargs", "*args: Any, **kwargs: Any"),
    (r"__members__: ClassVar\[dict\] = \.\.\.  # read-only", "__members__: ClassVar[Dict[str, Any]]"),
    (r"List\[(\w+)\[\d+\]\]", r"Sequence[\1]"),
    (r"report: object", "report: Optional[Callable[[float], Any]]"),
    (r"(?<!other): object", ": Any"),
    (r"-> object", "-> Any"),
    (r"numpy\.ndarray(?:\[numpy\.\w+\])?", "numpy.ndarray[Any, Any]"),
    (r"os\.PathLike", "Union[str, os.PathLike[str]]"),
    (r"\btuple\b", "Tuple[Any, ...]"),
    (r"\bdict\b", "Dict[str, Any]"),
    (r"\blist\b", "List[Any]"),
    (r",(?=\w)", ", "),
]


def stub():
    """The text of the file."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["stubgen", "-q", "-p", "hogel._core", "-o", folder], check=True, cwd=folder)
        text = Path(folder, "hogel", "_core.pyi").read_text()
    for pattern, replacement in CHANGES:
        text = re.sub(pattern, replacement, text, flags=re.MULTILINE)
    return HEAD + text.strip("\n") + "\n"


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(stub())
