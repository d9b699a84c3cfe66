#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes manual pages from the help of hogel: hogel(1), and one page per command, such as hogel-make(1).

usage: manual.py HOGEL FOLDER      writes NAME.1.gz to FOLDER for each page; equal help gives equal bytes

The help (apps/cli/help.cpp) consists of a summary, "Usage: ...", and sections with headings that end with a colon. The name of
an option begins in column 2, its description in column 24. A description is a paragraph, optionally followed by a list of
"name: text".
"""
import gzip
import pathlib
import re
import subprocess
import sys

COLUMN = 24
SECTIONS_OF_THEIR_OWN = {"Commands": "COMMANDS", "Options": "OPTIONS", "Examples": "EXAMPLES"}


def ask(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def entries(lines):
    """Formats options or commands with their descriptions; other lines become a paragraph."""
    out, in_paragraph = [], False
    for line in lines:
        name = line[:COLUMN].strip() if line[COLUMN - 1:COLUMN] in ("", " ") else line.strip()
        text = line.strip()[len(name):].strip()
        if not line.startswith("  "):
            out += [roff(line)] if in_paragraph else [".PP", roff(line)]
            in_paragraph = True
            continue
        in_paragraph = False
        if name:
            out += [".TP", "\\fB" + roff(name) + "\\fR"]
        elif re.match(r"[\w-]+: ", text):
            out.append(".br")
        if text:
            out.append(roff(text))
    return out


def sections(text):
    """Returns pairs of heading and lines. Lines before the first heading have an empty heading."""
    found = [("", [])]
    for line in filter(None, text.splitlines()):
        usage = line.removeprefix("Usage: ")
        if usage != line:
            found.append(("Usage", [usage]))
        elif re.fullmatch(r"\S+( \S+){0,5}:", line):
            found.append((line[:-1], []))
        else:
            found[-1][1].append(line)
    return found


def page(name, help_text, version, names):
    (_, (summary, *more)), *rest = sections(help_text)
    summary = summary.removeprefix("hogel: ")
    out = [f'.TH "{name.upper()}" 1 "" "hogel {version}" "User Commands"', ".SH NAME",
           f"{roff(name)} \\- {roff(summary[0].lower() + summary[1:])}"]
    about = more
    for heading, lines in rest:
        if heading == "Usage":
            out += [".SH SYNOPSIS", "\\fB" + roff(lines[0]) + "\\fR"]
            about += lines[1:]
            if about:
                out += [".SH DESCRIPTION", *entries(about)]
        elif heading == "Examples":
            out += [".SH EXAMPLES", ".nf", *map(roff, lines), ".fi"]
        elif heading in SECTIONS_OF_THEIR_OWN:
            out += [".SH " + SECTIONS_OF_THEIR_OWN[heading], *entries(lines)]
        else:
            out += [".SS " + roff(heading), *entries(lines)]
    out += [".SH SEE ALSO", ",\n".join(f"\\fB{roff(other)}\\fR(1)" for other in names if other != name)]
    return "\n".join(out) + "\n"


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    version = ask(program, "--version").split()[1]
    general = ask(program, "--help")
    commands = [line.split()[0] for line in dict(sections(general))["Commands"] if line.startswith("  ")]
    help_texts = {"hogel": general} | {f"hogel-{command}": ask(program, "help", command, "all") for command in commands}
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in help_texts.items():
        data = page(name, text, version, list(help_texts)).encode()
        (folder / f"{name}.1.gz").write_bytes(gzip.compress(data, 9, mtime=0))


main()
