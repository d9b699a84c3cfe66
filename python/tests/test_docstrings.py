# SPDX-License-Identifier: Apache-2.0
"""The examples in the documentation strings show what happens; everything public has a documentation string."""
import doctest
import importlib
import importlib.util
import inspect
import os
import pkgutil
import unittest

import hogel

os.environ["MPLBACKEND"] = "Agg"

# What modules need beside NumPy.
NEEDS = {"autograd": ["torch"], "plot": ["matplotlib"]}


class Docstrings(unittest.TestCase):
    def test_examples(self):
        tried = 0
        for info in pkgutil.iter_modules(hogel.__path__):
            if info.name in ("__main__", "_core") or not all(map(importlib.util.find_spec, NEEDS.get(info.name, ()))):
                continue
            module = importlib.import_module(f"hogel.{info.name}")
            failed, here = doctest.testmod(module, extraglobs={"np": __import__("numpy")})
            self.assertEqual(failed, 0, info.name)
            tried += here
        failed, here = doctest.testmod(hogel)
        self.assertEqual(failed, 0)
        self.assertGreater(tried + here, 20)

    def test_all_is_documented(self):
        for name in hogel.__all__:
            value = getattr(hogel, name)
            if not (inspect.isclass(value) or inspect.isfunction(value)) or value.__module__ == "hogel._core":
                continue
            self.assertTrue(inspect.getdoc(value), name)
            for member, inside in vars(value).items() if inspect.isclass(value) else ():
                if not member.startswith("_") and (inspect.isfunction(inside) or isinstance(inside, (property, classmethod))):
                    self.assertTrue(inspect.getdoc(getattr(value, member)) or inside.__doc__, f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
