# SPDX-License-Identifier: Apache-2.0
"""Tests of cmake/check_licences.py: what cannot be used without the GPL."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cmake"))
from check_licences import gpl_alone  # noqa: E402

ALONE = ["GPL-2.0-only", "AGPL-3.0-or-later", "MIT AND GPL-3.0-or-later", "GPL-2.0-only OR GPL-3.0-only",
         "GPL-2.0-only WITH Bison-exception-2.2", "(MIT OR Zlib) AND GPL-2.0-only", "GPL-2.0-only AND MIT OR AGPL-3.0-only"]
FREE = ["MIT", "LGPL-2.1-or-later", "GPL-2.0-only OR MIT", "LGPL-3.0-or-later OR GPL-2.0-or-later",
        "GPL-3.0-or-later WITH GCC-exception-3.1", "LGPL-2.1-or-later AND (LGPL-3.0-or-later OR GPL-2.0-or-later)",
        "MIT OR GPL-2.0-only AND BSD-2-Clause", "LicenseRef-MIT-SIPB"]

wrong = [text for text in ALONE if not gpl_alone(text)] + [text for text in FREE if gpl_alone(text)]
sys.exit(f"taken wrongly: {wrong}" if wrong else 0)
