# SPDX-License-Identifier: Apache-2.0
"""Terminals and notebooks: bars of progress by tqdm and without it, Ctrl-C meanwhile, and pictures in IPython."""
import fcntl
import importlib.util
import os
import pty
import re
import signal
import struct
import subprocess
import sys
import termios
import unittest

import hogel
import numpy as np
from common import InFolder, light_field

# Work of minutes that shows a bar from its beginning on, and of less than a second.
LONG = """
import sys
{before}
import hogel
hogel._progress.patience = 0
lf = hogel.Scene.load("pumpkin").render(hogels={hogels}, directions=64, size="20mm", algorithm="raytrace")
try:
    lf.save("a.h5")
    print("ended", flush=True)
except KeyboardInterrupt:
    print("stopped", flush=True)
"""
WITHOUT_TQDM = 'sys.modules["tqdm"] = None'
NOTEBOOK = 'import types; sys.modules["ipykernel"] = types.ModuleType("ipykernel")'
TQDM = importlib.util.find_spec("tqdm") is not None
needs_tqdm = unittest.skipUnless(TQDM, "tqdm is not installed")


class Progress(InFolder):
    def shown(self, before, hogels=24, interrupt=None):
        """What the program prints, and what its terminal shows; with `interrupt` Ctrl-C is pressed when that is shown."""
        ours, theirs = pty.openpty()
        fcntl.ioctl(ours, termios.TIOCSWINSZ, struct.pack("4H", 24, 100, 0, 0))
        program = subprocess.Popen([sys.executable, "-c", LONG.format(before=before, hogels=hogels)], stdout=subprocess.PIPE,
                                   stderr=theirs, text=True)
        os.close(theirs)
        text = ""
        while True:
            try:
                read = os.read(ours, 4096).decode(errors="replace")
            except OSError:  # the program has ended
                read = ""
            if not read:
                break
            text += read
            if interrupt and re.search(interrupt, text):
                interrupt = None
                program.send_signal(signal.SIGINT)
                self.assertEqual(program.stdout.readline(), "stopped\n")
        os.close(ours)
        said = program.communicate(timeout=60)[0]
        self.assertEqual(program.returncode, 0, text)
        self.assertIsNone(interrupt, text)
        return said, text

    @needs_tqdm
    def test_tqdm_in_terminals(self):
        said, text = self.shown("")
        self.assertEqual(said, "ended\n")
        self.assertRegex(text, r"writing: +\d+%\|")

    def test_a_line_without_tqdm(self):
        said, text = self.shown(WITHOUT_TQDM)
        self.assertEqual(said, "ended\n")
        self.assertRegex(text, r"\rwriting: +\d+ %")
        self.assertNotIn("|", text)

    @needs_tqdm
    def test_notebooks(self):
        """By tqdm.auto, which shows a widget, or a line where there are no widgets."""
        said, text = self.shown(NOTEBOOK)
        self.assertIn("ended\n", said)
        self.assertRegex(text + said, r"writing: +\d+%")
        said, text = self.shown(NOTEBOOK + "\n" + WITHOUT_TQDM)
        self.assertRegex(text, r"\rwriting: +\d+ %")

    def test_control_c_while_a_bar_is_shown(self):
        for before in ("", WITHOUT_TQDM):
            self.shown(before, hogels=2000, interrupt=r"writing: ")
            self.assertEqual(os.listdir(), [])  # nor the file of work that came to its end

    def test_files_hear_of_nothing(self):
        words = [sys.executable, "-c", LONG.format(before="", hogels=8)]
        self.assertEqual(subprocess.run(words, capture_output=True, text=True).stderr, "")


@unittest.skipUnless(importlib.util.find_spec("IPython"), "IPython is not installed")
class Pictures(unittest.TestCase):
    def test_in_notebooks(self):
        from IPython.core.interactiveshell import InteractiveShell

        shell = InteractiveShell.instance()
        shell.display_formatter.active_types = list(shell.display_formatter.formatters)
        lf, _ = light_field()
        field = hogel.Field.from_array(np.ones((6, 8), np.complex64), pitch="1um", wavelength="633nm")
        for value in lf, field, hogel.Picture(np.full((4, 5, 3), 0.5)):
            data, _ = shell.display_formatter.format(value)
            self.assertEqual(data["image/png"][:8], b"\x89PNG\r\n\x1a\n", type(value))
            self.assertEqual(data["text/plain"], repr(value))


if __name__ == "__main__":
    unittest.main()
