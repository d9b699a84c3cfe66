#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks a folder of `hogel make`: the report is self-contained and lists exactly the files of the folder.

usage: check_report.py FOLDER
"""
import base64
import json
import pathlib
import re
import sys

folder = pathlib.Path(sys.argv[1])
report = json.loads((folder / "report.json").read_text())
page = (folder / "report.html").read_text()

pictures = [base64.b64decode(data) for data in re.findall(r'src="data:image/png;base64,([^"]+)"', page)]
named = [photo[kind] for photo in report["photographs"] for kind in ("wave", "expected", "geometric") if kind in photo]
assert len(pictures) == len(named) == len(set(named)), (len(pictures), len(named))
for name in named:
    assert (folder / name).is_file() and (folder / name).with_suffix(".exr").is_file(), name
assert all(picture.startswith(b"\x89PNG") and picture.endswith(b"IEND\xaeB`\x82") for picture in pictures)
assert not re.search(r"(?:src|href)=\"(?:https?:)?//", page), "the page loads something from elsewhere"
assert "{{" not in page and "}}" not in page, "a placeholder was left"
field = report["light_field"]
assert (folder / "lightfield.h5").is_file() == ("file" in field), "a light field is kept and listed, or neither"
assert "file" not in field or (folder / field["file"]).stat().st_size == field["bytes"]
assert field["render"].startswith("hogel render ") and (field["render"] in page) == ("file" not in field)
assert report["seconds"] > 0 and all(stage["seconds"] >= 0 for stage in report["stages"])
assert len({(tuple(photo["eye"]), photo["focus_depth"]) for photo in report["photographs"]}) == len(report["photographs"])
print(len(report["photographs"]), "pairs")
