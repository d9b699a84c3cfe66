#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails when a link in the documentation has no target.

usage: check_links.py [ROOT]
Pages are ROOT/*.md and the .md files below docs and examples. Checked are links and pictures within the repository:
the file exists, a page has the heading that a link names, a picture is valid and has an alternative
text, and every file of docs/images is shown somewhere. Links to other sites are not checked.
"""
import pathlib
import re
import sys
import urllib.parse
import xml.etree.ElementTree

FENCED = re.compile(r"^ *(```+|~~~+).*?^ *\1 *$", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"(`+)(?!`)(?:(?!\n\n).)+?(?<!`)\1(?!`)", re.DOTALL)  # within a paragraph
TARGET = re.compile(r"""\]\(\s*<?([^)\s>]+)>?[^)]*\)             # [text](target), ![text](target "title")
                      | ^\ {0,3}\[[^\]]+\]:\s+(\S+)               # [label]: target
                      | \b(?:src|srcset|href)\s*=\s*"([^"]+)"     # HTML
                     """, re.VERBOSE | re.MULTILINE)
WITHOUT_TEXT = re.compile(r"!\[\s*\]\(|<img(?![^>]*\balt=\"[^\"])[^>]*>")
HEADING = re.compile(r"^#{1,6} +(.+?) *#*$", re.MULTILINE)


def blank(match):
    """Replaces code by empty lines, which keeps line numbers."""
    return re.sub(r"[^\n]", " ", match.group())


def anchors(text):
    """The anchors of a page: those that GitHub gives to headings, and explicit ones."""
    names = set(re.findall(r'<a (?:name|id)="([^"]+)"', text))
    for heading in HEADING.findall(FENCED.sub("", text)):
        shown = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        name = re.sub(r"[^\w\- ]", "", shown.lower()).replace(" ", "-")
        taken = sum(other == name or re.fullmatch(re.escape(name) + r"-\d+", other) is not None for other in names)
        names.add(f"{name}-{taken}" if taken else name)
    return names


def fault_of_picture(path):
    """The reason why a picture cannot be shown, or None."""
    if path.suffix == ".png" and not path.read_bytes().startswith(b"\x89PNG\r\n\x1a\n"):
        return "is no PNG"
    if path.suffix == ".svg":
        try:
            xml.etree.ElementTree.parse(path)
        except xml.etree.ElementTree.ParseError as error:
            return f"is no SVG: {error}"
    return None


def fault_of_link(root, page, target, shown):
    """The error of a link, or None. Adds the target file to `shown`."""
    url = urllib.parse.urlsplit(target)
    if url.scheme or url.netloc:
        return None
    path = (page.parent / urllib.parse.unquote(url.path)).resolve() if url.path else page
    if root not in path.parents and path != root:
        return "leads out of the repository"
    if not path.exists():
        return "is not there"
    shown.add(path)
    if url.fragment and path.suffix == ".md" and urllib.parse.unquote(url.fragment) not in anchors(path.read_text()):
        return "has no such heading"
    return fault_of_picture(path)


def faults_of_page(root, page, shown):
    text = SPAN.sub(blank, FENCED.sub(blank, page.read_text()))
    for match in TARGET.finditer(text):
        target = match.group(1) or match.group(2) or match.group(3)
        fault = fault_of_link(root, page, target, shown)
        if fault:
            yield text.count("\n", 0, match.start()) + 1, f"{target}: {fault}"
    for match in WITHOUT_TEXT.finditer(text):
        yield text.count("\n", 0, match.start()) + 1, "a picture without a text for those who cannot see it"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    pages = sorted([*root.glob("*.md"), *root.glob("docs/**/*.md"), *root.glob("examples/**/*.md")])
    shown, faults = set(), []
    for page in pages:
        faults += [f"{page.relative_to(root)}:{line}: {what}" for line, what in faults_of_page(root, page, shown)]
    unused = [path for path in sorted(root.glob("docs/images/**/*.*")) if path.resolve() not in shown]
    faults += [f"{path.relative_to(root)}: no page shows it" for path in unused]
    print("\n".join([*faults, f"{len(pages)} pages, {len(faults)} faults"]), file=sys.stderr if faults else sys.stdout)
    return 1 if faults or not pages else 0


sys.exit(main())
