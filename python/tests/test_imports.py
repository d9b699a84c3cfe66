# SPDX-License-Identifier: Apache-2.0
"""No module of the package imports one that imports it, not within functions and not for types alone either."""
import ast
import graphlib
import unittest
from pathlib import Path

import hogel

PACKAGE = Path(hogel.__file__).parent


def imported(path):
    """The modules of the package that a module names in its imports, wherever they stand."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            names |= {node.module} if node.module else {alias.name for alias in node.names}
        elif isinstance(node, ast.Import):
            names |= {alias.name.partition(".")[2] or "__init__" for alias in node.names if alias.name.partition(".")[0] == "hogel"}
    return names - {"_core"}


class Imports(unittest.TestCase):
    def test_nothing_runs_in_a_circle(self):
        graph = {path.stem: imported(path) for path in PACKAGE.glob("*.py")}
        self.assertGreater(sum(map(len, graph.values())), 80)
        self.assertEqual(set().union(*graph.values()) - graph.keys(), set())
        graphlib.TopologicalSorter(graph).prepare()  # throws CycleError, which names the circle


if __name__ == "__main__":
    unittest.main()
