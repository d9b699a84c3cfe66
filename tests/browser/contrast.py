#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Computes the contrast of the page's colours in both themes and looks for controls without a label, by WCAG 2.1 at level AA:
4.5 to 1 for text (1.4.3), 3 to 1 for what a control is recognised by (1.4.11), a name for each control (4.1.2).

usage: contrast.py FOLDER     of the page, apps/view/web
"""
import html.parser
import pathlib
import re
import sys

FOLDER = pathlib.Path(sys.argv[1])
# Foreground, background, least ratio: what stands on what in style.css.
PAIRS = [
    ("text", "ground", 4.5), ("text", "panel", 4.5), ("quiet", "ground", 4.5), ("quiet", "panel", 4.5),
    ("on-accent", "accent", 4.5), ("problem", "problem-ground", 4.5), ("problem", "panel", 4.5),
    ("line", "ground", 3), ("line", "panel", 3), ("accent", "ground", 3), ("accent", "panel", 3), ("problem", "ground", 3),
]


def luminance(colour):
    """Relative luminance of #rrggbb, WCAG 2.1."""
    values = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055)**2.4 for v in values]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    high, low = sorted((luminance(a), luminance(b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def themes(css):
    """The custom properties of the light theme, of the dark one, and of the dark one that the system asks for."""
    light = re.search(r"^:root \{(.*?)\}", css, re.S | re.M).group(1)
    dark = re.search(r':root\[data-theme="dark"\] \{(.*?)\}', css, re.S).group(1)
    system = re.search(r':root:not\(\[data-theme="light"\]\) \{(.*?)\}', css, re.S).group(1)
    read = lambda text: dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", text))
    return {"light": read(light), "dark": read(dark), "dark by the system": read(system)}


class Labels(html.parser.HTMLParser):
    """Controls and what names them."""

    def __init__(self):
        super().__init__()
        self.named, self.controls, self.inside, self.depth = set(), [], [], 0

    def handle_starttag(self, tag, attributes):
        own = dict(attributes)
        if tag == "label":
            self.depth += 1
            if "for" in own:
                self.named.add(own["for"])
        if tag in ("input", "select", "progress", "canvas", "dialog") or (tag == "img" and "alt" not in own):
            self.controls.append((own.get("id", tag), "aria-label" in own or "aria-labelledby" in own or self.depth > 0))
        if tag == "button":
            self.inside.append([own.get("id", tag), "aria-label" in own])

    def handle_endtag(self, tag):
        if tag == "label":
            self.depth -= 1
        if tag == "button":
            self.controls.append(tuple(self.inside.pop()))

    def handle_data(self, data):
        if self.inside and data.strip():
            self.inside[-1][1] = True


def main():
    css = (FOLDER / "style.css").read_text()
    wrong, lowest = [], {}
    found = themes(css)
    for name, colours in found.items():
        for front, back, least in PAIRS:
            ratio = contrast(colours[front], colours[back])
            lowest[least] = min(lowest.get(least, 99), ratio)
            if ratio < least:
                wrong.append(f"{name}: {front} on {back} has a contrast of {ratio:.2f}; at least {least} is needed")
    if found["dark"] != found["dark by the system"]:
        wrong.append("the two dark themes differ")
    # Colours beside those of the table are ones whose contrast nobody computed; black is what pictures lie on.
    for colour in set(re.findall(r"#[0-9a-f]{3,6}\b", re.sub(r"--[\w-]+: #[0-9a-f]{6};", "", css))) - {"#000"}:
        if not re.fullmatch(r"#[0-9a-f]{6}", colour) or contrast(colour, "#000000") < 3:
            wrong.append(f"style.css: {colour} is no colour of the theme, and hardly seen on black")
    page = Labels()
    page.feed((FOLDER / "index.html").read_text())
    wrong += [f"{name} has no label" for name, named in page.controls if not named and name not in page.named]
    for line in wrong:
        print(line)
    if wrong:
        sys.exit(1)
    print(f"{len(page.controls)} controls with labels; text at least {lowest[4.5]:.2f} to 1, controls {lowest[3]:.2f} to 1")


main()
