#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the examples of examples/python and writes a page of docs/examples for each, with what they print and draw.

usage: render_examples.py [NAME...]      with the built package in PYTHONPATH

The scripts are notebooks in the percent format, which Jupyter (jupytext), VS Code and Spyder open: a line "# %%" begins a
cell; a cell that begins with "# %% [markdown]" is text. A comment "# NAME.png: ..." in a cell says what a picture shows.
"""
import contextlib
import io
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[1]
# The built package is meant, not the sources beside this file.
sys.path[:] = [folder for folder in sys.path if Path(folder).resolve() != SOURCES / "python"]
EXAMPLES, PAGES, IMAGES = SOURCES / "examples" / "python", SOURCES / "docs" / "examples", SOURCES / "docs" / "images" / "examples"


def cells(text):
    """The cells of a script, as pairs of kind, "text" or "code", and content."""
    body = re.sub(r"^# SPDX-License-Identifier:.*\n", "", text)
    found = []
    for part in re.split(r"^# %%", body, flags=re.MULTILINE):
        if part.startswith(" [markdown]\n"):
            found.append(("text", re.sub(r"^# ?", "", part.split("\n", 1)[1], flags=re.MULTILINE).strip()))
        elif part.strip():
            found.append(("code", part.strip("\n")))
    return found


def pictures_of(folder, before):
    """Pictures that a cell wrote, by their names."""
    return sorted(path for path in folder.iterdir() if path.suffix in (".png", ".gif") and path not in before)


def page(name):
    """The page of an example, which is run."""
    parts, values, seen = [], {"__name__": "__main__"}, set()
    place = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            for kind, content in cells((EXAMPLES / f"{name}.py").read_text()):
                if kind == "text":
                    parts.append(content)
                    continue
                said = io.StringIO()
                with contextlib.redirect_stdout(said):
                    exec(compile(content, f"{name}.py", "exec"), values)
                parts.append(f"```python\n{content}\n```")
                if said.getvalue():
                    parts.append(f"```\n{said.getvalue().rstrip()}\n```")
                for picture in pictures_of(Path.cwd(), seen):
                    IMAGES.mkdir(parents=True, exist_ok=True)
                    shutil.copy(picture, IMAGES / f"{name}-{picture.name}")
                    caption = re.search(rf"^# {re.escape(picture.name)}: (.*)$", content, re.MULTILINE)
                    parts.append(f"![{caption.group(1)}](../images/examples/{name}-{picture.name})")
                    seen.add(picture)
        finally:
            os.chdir(place)
    source = f"The script is [examples/python/{name}.py](../../examples/python/{name}.py)."
    return "\n\n".join([parts[0], source, *parts[1:]]) + "\n"


if __name__ == "__main__":
    PAGES.mkdir(parents=True, exist_ok=True)
    for example in sys.argv[1:] or sorted(path.stem for path in EXAMPLES.glob("*.py")):
        (PAGES / f"{example}.md").write_text(page(example))
        print(example)
