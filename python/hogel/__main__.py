# SPDX-License-Identifier: Apache-2.0
"""python -m hogel ...: the command line. It runs the program hogel in place of this one."""
from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path


def find() -> str:
    """Returns the program installed with this module, of the same build, or in the PATH, in this order."""
    package = Path(__file__).parent
    for folder in (package, package.parent):
        for candidate in (folder / "bin" / "hogel", folder.parent / "bin" / "hogel"):
            if candidate.is_file() and os.access(candidate, os.X_OK):
                return str(candidate)
    found = os.environ.get("HOGEL_PROGRAM") or shutil.which("hogel")
    if found is None:
        raise SystemExit("hogel: the program hogel was not found; build it with -DHOGEL_APPS=ON, or set HOGEL_PROGRAM to its path")
    return found


if __name__ == "__main__":
    program = find()
    os.execv(program, ["hogel", *sys.argv[1:]])
