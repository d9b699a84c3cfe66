# SPDX-License-Identifier: Apache-2.0
"""Parses the public headers: functions, types and their public members in namespace hogel. Supports the layout of the project's
headers, not all of C++. test_coverage.py tests the parser on examples."""
import re

FUNCTIONS = (
    re.compile(r"^HOGEL_API\s+(?:\[\[\w+\]\]\s*)?[^;{()=]*?\b(\w+)\(", re.MULTILINE),
    re.compile(r"^\[\[noreturn\]\] HOGEL_API void (\w+)\(", re.MULTILINE),
    re.compile(r"^(?:inline|constexpr) [^;{()=]*?\b(\w+)\(", re.MULTILINE),
)
TYPE = re.compile(r"(?:template\s*<[^{;]*?>\s*)?(enum class|struct|class)\s+(?:HOGEL_API\s+)?(\w+)\s*(?:final)?\s*(?::[^{]*)?$", re.DOTALL)


def plain(text):
    """Removes comments, string literals and preprocessor lines."""
    text = re.sub(r"//.*", "", text)
    text = re.sub(r'"(?:[^"\\]|\\.)*"', '""', text)
    return re.sub(r"^\s*#.*$", "", text, flags=re.MULTILINE)


def inside(text, begin):
    """Returns the position after the brace that closes the one at `begin`."""
    depth = 0
    for position in range(begin, len(text)):
        depth += {"{": 1, "}": -1}.get(text[position], 0)
        if depth == 0:
            return position + 1
    raise ValueError("a brace is not closed")


def declarations(body):
    """Yields the declarations of a body: the text before the semicolon or brace, and the text within braces, or None."""
    start = position = brackets = 0
    while position < len(body):
        letter = body[position]
        brackets += {"(": 1, "[": 1, ")": -1, "]": -1}.get(letter, 0)
        if letter == ";" and brackets == 0:
            yield body[start:position], None
            start = position + 1
        elif letter == "{" and brackets == 0:
            end = inside(body, position)
            follows = body[end:].lstrip()[:1]
            if follows == ",":  # the first of several members with values
                body = body[:position] + body[end:]
                continue
            yield body[start:position], body[position + 1 : end - 1]
            position = end - 1
            start = end + (body[end:].index(";") + 1 if follows == ";" else 0)
            position = max(position, start - 1)
        position += 1


def members(kind, name, body):
    """The public members of a type, or the values of an enumeration, by name."""
    if kind == "enum class":
        return set(re.findall(r"(\w+)\s*(?:=[^,]*)?(?:,|$)", body.strip()))
    found, public = set(), kind != "class"
    for head, inner in declarations(re.sub(r"\b(public|private|protected)\s*:(?!:)", r"; @\1;", body)):
        head = re.sub(r"^template\s*<.*?>\s*(?=\w)", "", head.strip(), flags=re.DOTALL)
        if head.startswith("@"):
            public = head == "@public"
        elif not public or not head or re.match(r"(friend|using|static_assert)\b", head) or "operator" in head or "requires" in head:
            continue
        elif inner is not None and re.match(r"(enum|struct|class)\b", head) and "(" not in head:
            found.add(re.match(r"(?:enum class|struct|class)\s+(\w+)", head).group(1))
        else:
            found.update(names(re.sub(r"^constexpr\s+|^explicit\s+", "", head)))
    return {member for member in found if member.lstrip("~") != name}


def names(declaration):
    """The names that a declaration of a member function or of members declares."""
    before = declaration.split("=")[0]
    function = re.search(r"(~?\w+)\s*\(", before)
    if function and not re.search(r"<[^>]*\([^>]*$", before[: function.end()]):
        return [function.group(1)]
    while re.search(r"<[^<>]*>|\([^()]*\)", declaration):
        declaration = re.sub(r"<[^<>]*>|\([^()]*\)", "", declaration)
    return [re.findall(r"\w+", part.split("=")[0])[-1] for part in declaration.split(",") if re.findall(r"[A-Za-z_]\w*", part.split("=")[0])]


def functions(text):
    return {name for pattern in FUNCTIONS for name in pattern.findall(re.sub(r"//.*", "", text)) if name != "operator"}


def types(text):
    """The types of a header: name, and names of members."""
    space = re.search(r"namespace hogel\s*\{(.*)\}", plain(text), re.DOTALL)
    for head, body in declarations(space.group(1)) if space else ():
        match = TYPE.match(head.strip())
        if match and body is not None:
            yield match.group(2), members(match.group(1), match.group(2), body)
