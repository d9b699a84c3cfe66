#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes hogel/_core.pyi, the types of the extension module, from what pybind11 says in its documentation strings.

usage: make_stub.py FOLDER      FOLDER: that of the built package, hogel

The build runs it where mypy is installed.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HEAD = '''# SPDX-License-Identifier: Apache-2.0
# The types of the extension module; written by python/make_stub.py.
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


def stub(packages):
    """The text of the file, of the package in a folder."""
    path = os.pathsep.join(filter(None, (packages, os.environ.get("PYTHONPATH"))))
    with tempfile.TemporaryDirectory() as folder:
        stubgen = "import sys, mypy.stubgen; mypy.stubgen.main(sys.argv[1:])"  # a compiled module, which -m cannot run
        command = [sys.executable, "-B", "-c", stubgen, "-q", "-p", "hogel._core", "-o", folder]
        subprocess.run(command, check=True, cwd=folder, env={**os.environ, "PYTHONPATH": path})
        text = Path(folder, "hogel", "_core.pyi").read_text()
    for pattern, replacement in CHANGES:
        text = re.sub(pattern, replacement, text, flags=re.MULTILINE)
    return HEAD + text.strip("\n") + "\n"


if __name__ == "__main__":
    folder = Path(sys.argv[1]).resolve()
    text = stub(str(folder))
    Path(folder, "hogel", "_core.pyi").unlink(missing_ok=True)  # a link in a folder of an earlier version
    Path(folder, "hogel", "_core.pyi").write_text(text)
