# SPDX-License-Identifier: Apache-2.0
"""The pages of docs/examples hold the code of the examples, and a picture for each that they write."""
import re
import sys
import unittest

from common import SOURCES

sys.path.insert(0, str(SOURCES / "python"))
import render_examples


class Pages(unittest.TestCase):
    def test_are_those_of_the_scripts(self):
        scripts = sorted(render_examples.EXAMPLES.glob("*.py"))
        self.assertGreaterEqual(len(scripts), 8)
        self.assertEqual([path.stem for path in scripts], sorted(path.stem for path in render_examples.PAGES.glob("*.md")))
        for script in scripts:
            with self.subTest(script.stem):
                page = (render_examples.PAGES / f"{script.stem}.md").read_text()
                cells = render_examples.cells(script.read_text())
                self.assertEqual(cells[0][0], "text")
                code = [content for kind, content in cells if kind == "code"]
                again = "run python/render_examples.py " + script.stem
                self.assertEqual(re.findall(r"```python\n(.*?)\n```", page, re.DOTALL), code, again)
                for _, text in (cell for cell in cells if cell[0] == "text"):
                    self.assertIn(text, page, again)
                self.assertGreater(page.count("!["), 0, "a picture one is glad to show")

    def test_cells(self):
        text = "# SPDX-License-Identifier: X\n# %% [markdown]\n# # Title\n#\n# Text\n\n# %%\na = 1\n\n# %% [markdown]\n# More\n"
        self.assertEqual(render_examples.cells(text), [("text", "# Title\n\nText"), ("code", "a = 1"), ("text", "More")])


if __name__ == "__main__":
    unittest.main()
