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
        self.assertGreater(tried + here, 200)

    def public(self):
        """Names and objects: functions, classes, methods and properties that users call."""
        spaces = {"": [(name, getattr(hogel, name)) for name in hogel.__all__]}
        for module in ("plot", "autograd", "exports", "views", "units"):
            if all(map(importlib.util.find_spec, NEEDS.get(module, ()))):
                inside = importlib.import_module(f"hogel.{module}")
                mine = [(name, value) for name, value in vars(inside).items() if getattr(value, "__module__", "") == inside.__name__]
                spaces[f"{module}."] = [(name, value) for name, value in mine if not name.startswith("_") and inspect.isfunction(value)]
        for space, found in spaces.items():
            for name, value in found:
                if not (inspect.isclass(value) or inspect.isfunction(value)) or value.__module__ == "hogel._core":
                    continue
                yield space + name, value
                for member in dir(value) if inspect.isclass(value) else ():
                    inside = inspect.getattr_static(value, member)
                    if not member.startswith("_") and (inspect.isfunction(inside) or isinstance(inside, (property, classmethod))):
                        yield f"{space}{name}.{member}", inside if isinstance(inside, property) else getattr(value, member)

    def test_all_is_documented(self):
        bare, without = [], []
        for name, value in self.public():
            text = inspect.getdoc(value) or ""
            if not text:
                bare.append(name)
            # Errors are shown with their base class; properties with their class.
            shown = inspect.isclass(value) and issubclass(value, hogel.Error) and value is not hogel.Error
            if ">>>" not in text and not shown and not isinstance(value, property):
                without.append(name)
        self.assertEqual(bare, [], "without a documentation string")
        self.assertEqual(without, [], "without an example")


if __name__ == "__main__":
    unittest.main()
