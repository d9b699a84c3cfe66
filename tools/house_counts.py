#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Counts lines, type definitions and other measures of complexity in the program's sources.

usage: house_counts.py [COMMIT ...] [--leave-out GLOB ...]

Counts the tracked files of the working tree; each commit is one more column. Leaves out tests, the folder thesis/ (in older
commits the files that it contains now), and files whose path from the repository's root matches a GLOB. A line counts unless it
is blank or a comment; Python docstrings are comments. Functions are found by their braces (C++) or by the parser (Python); their
length is the number of lines from head to end. The exit status does not depend on the numbers.
"""
import argparse
import ast
import fnmatch
import io
import pathlib
import re
import subprocess
import tarfile

FOLDERS = ("src", "apps", "python", "include")
LINES_OF = {".h", ".cpp", ".py", ".js", ".css", ".html"}
TEST = re.compile(r"(^|/)(tests?|fuzz|thesis)/|_test\.(cpp|h|py)$|(^|/)test_[^/]*\.(py|js)$|\.test\.js$")
BEFORE_THESIS = re.compile(r"src/hogel/(transform|render/simplex|codec/baselines)/|src/hogel/hologram/(basis_synthesis|fringe)"
                           r"|src/hogel/coding/(ezw|forest|header_bytes|jpeg4d|quantise|three_?pass)")
LONG_FUNCTION, MANY_PARAMETERS = 60, 8

# Comments and literals: braces and comment marks within them do not count.
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)"'
                   r'|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Za-z_])\'(?:\\.|[^\'\\\n])+\'', re.S)
TYPE = re.compile(r"^[ \t]*(?:template\s*<[^;{}]*>\s*)?(?:typedef\s+)?(?:class|struct|union|enum(?:\s+class|\s+struct)?)\s+"
                  r"(?:\[\[[^\]]*\]\]\s*|alignas\([^)]*\)\s*|[A-Z_]+\s+)?[A-Za-z_][\w:]*(?:<[^;{}]*>)?(?:\s+final)?(?:\s*:[^;{}]*)?\s*\{", re.M)
# Text between the parameter list and the body of a function.
AFTER_PARAMETERS = re.compile(r"\)\s*(?:const|noexcept(?:\([^()]*\))?|override|final|mutable|&&?|->\s*[\w:<>,&*\s]+|requires[^{};]*"
                              r"|:\s*[^;{}]*(?:\{[^{};]*\}[^;{}]*)*|\s)*$")
NO_FUNCTION = re.compile(r"\b(?:if|for|while|switch|catch|return|namespace|enum|class|struct|union)\b[^;{}]*$")


def without_comments(text):
    """Replaces comments by blanks and literals by empty ones in C++ or JavaScript. Keeps line breaks."""
    def blank(found):
        lines = "\n" * found[0].count("\n")
        return lines if found[0].startswith("/") else '""' + lines
    return TOKEN.sub(blank, text)


def filled_lines(text):
    return sum(1 for line in text.split("\n") if line.strip())


def parameters_in(head):
    """Returns the number of parameters in the last top-level parentheses of a function's head."""
    end = AFTER_PARAMETERS.search(head)
    if not end:
        return 0
    depth, commas, anything = 0, 0, False
    for at in range(end.start(), -1, -1):
        c = head[at]
        depth += (c in ")]}>") - (c in "([{<")
        if c == ">" and head[at - 1:at] in "-=":
            depth -= 1
        if depth == 0:
            return commas + 1 if anything else 0
        if depth == 1 and c == ",":
            commas += 1
        anything = anything or (not c.isspace() and at != end.start())
    return 0


def functions_of_cpp(text):
    """Returns (lines, parameters) of each function definition. Lambdas count as part of the enclosing function."""
    found, open_blocks, start, inside = [], [], 0, None
    for match in re.finditer(r"[{};]|\n[ \t]*#[^\n]*", text):
        c = match[0]
        if c == "{":
            head = text[start:match.start()]
            last = head[head.rfind(";") + 1:]
            is_function = inside is None and AFTER_PARAMETERS.search(head) and not NO_FUNCTION.search(last.split("(")[0])
            if is_function:
                inside = len(open_blocks)
                line = start + len(head) - len(head.lstrip())
                open_blocks.append((line, parameters_in(head)))
            else:
                open_blocks.append(None)
            start = match.end()
        elif c == "}" and open_blocks:
            begun = open_blocks.pop()
            if inside == len(open_blocks):
                inside = None
                found.append((text.count("\n", begun[0], match.end()) + 1, begun[1]))
            start = match.end()
        elif inside is None:
            start = match.end()
    return found


def count_cpp(text, counts):
    text = without_comments(text)
    counts["lines"] += filled_lines(text)
    counts["type definitions"] += len(TYPE.findall(text))
    counts["thread_local"] += len(re.findall(r"\bthread_local\b", text))
    counts["dynamic_cast"] += len(re.findall(r"\bdynamic_(?:pointer_)?cast\b", text))
    return functions_of_cpp(text)


def count_python(text, counts):
    tree = ast.parse(text)
    docs = set()
    functions = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            docs.update(range(node.lineno, node.end_lineno + 1))
        if isinstance(node, ast.ClassDef):
            counts["type definitions"] += 1
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            a = node.args
            functions.append((node.end_lineno - node.lineno + 1, len(a.posonlyargs) + len(a.args) + len(a.kwonlyargs)))
    counts["lines"] += sum(1 for number, line in enumerate(text.split("\n"), 1)
                           if line.strip() and not line.strip().startswith("#") and number not in docs)
    return functions


def files_of(commit):
    """Yields path and text of each tracked file of FOLDERS."""
    if commit is None:
        names = subprocess.run(["git", "ls-files", *FOLDERS], check=True, capture_output=True, text=True).stdout.split("\n")
        for name in names:
            if pathlib.Path(name).is_file() and pathlib.PurePath(name).suffix in LINES_OF:
                yield name, pathlib.Path(name).read_text()
        return
    packed = subprocess.run(["git", "archive", commit, *FOLDERS], check=True, capture_output=True).stdout
    with tarfile.open(fileobj=io.BytesIO(packed)) as tree:
        for member in tree:
            if member.isfile() and pathlib.PurePath(member.name).suffix in LINES_OF:
                yield member.name, tree.extractfile(member).read().decode()


def count(commit, left_out):
    counts = dict.fromkeys(("files", "lines", "type definitions", "public headers", "thread_local", "dynamic_cast"), 0)
    functions = []
    for name, text in files_of(commit):
        if TEST.search(name) or BEFORE_THESIS.match(name) or any(fnmatch.fnmatch(name, glob) for glob in left_out):
            continue
        counts["files"] += 1
        counts["public headers"] += name.startswith("include/")
        if name.endswith(".py"):
            functions += count_python(text, counts)
        elif name.endswith((".h", ".cpp")):
            functions += count_cpp(text, counts)
        else:
            counts["lines"] += filled_lines(without_comments(text) if name.endswith(".js") else text)
    counts["functions"] = len(functions)
    counts[f"functions above {LONG_FUNCTION} lines"] = sum(lines > LONG_FUNCTION for lines, _ in functions)
    counts[f"functions of more than {MANY_PARAMETERS} parameters"] = sum(n > MANY_PARAMETERS for _, n in functions)
    counts["longest function, lines"] = max((lines for lines, _ in functions), default=0)
    return counts


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("commits", nargs="*", metavar="COMMIT")
    arguments.add_argument("--leave-out", action="append", default=[], metavar="GLOB")
    asked = arguments.parse_args()
    columns = {commit or "working tree": count(commit, asked.leave_out) for commit in [*asked.commits, None]}
    print("".join([" " * 40, *(f"{name[:14]:>16}" for name in columns)]))
    for row in next(iter(columns.values())):
        print(f"{row:40}" + "".join(f"{found[row]:16,}" for found in columns.values()))


main()
