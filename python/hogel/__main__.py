# SPDX-License-Identifier: Apache-2.0
"""python -m hogel ...: the command line. It runs the program hogel in place of this one."""
from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path


def find() -> str:
    """The program that was installed with this module, or that of the build it belongs to, or the one in the PATH."""
    package = Path(__file__).parent
    for folder in (package, package.parent):
        for place in (folder / "bin" / "hogel", folder.parent / "bin" / "hogel"):
            if place.is_file() and os.access(place, os.X_OK):
                return str(place)
    found = os.environ.get("HOGEL_PROGRAM") or shutil.which("hogel")
    if found is None:
        raise SystemExit("hogel: the program hogel was not found; build it with -DHOGEL_APPS=ON, or name it in HOGEL_PROGRAM")
    return found


if __name__ == "__main__":
    program = find()
    os.execv(program, ["hogel", *sys.argv[1:]])
