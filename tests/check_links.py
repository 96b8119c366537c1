#!/usr/bin/env python3
"""Checks the links between pages: each relative link leads to a file or folder of the repository, and each anchor to a heading of its page.

Usage: check_links.py [ROOT]    Prints one line for each broken link. Addresses with a scheme (https:) are not checked.
"""
import pathlib
import re
import subprocess
import sys
import urllib.parse

LINK = re.compile(r"!?\[[^\]]*\]\(\s*<?([^)\s>]+)>?[^)]*\)", re.DOTALL)
SCHEME = re.compile(r"^[a-z][a-z0-9+.-]*:")


def prose(text):
    """The text without blocks and spans of code, in which brackets are no links."""
    lines, fenced = [], False
    for line in text.splitlines():
        if line.lstrip().startswith("```"):
            fenced = not fenced
        lines.append("" if fenced or line.startswith("    ") else line)
    return re.sub(r"`[^`\n]*`", "", "\n".join(lines))


def anchors(page):
    """The anchors of a page's headings, as hosts of Markdown make them: lower case, without punctuation, hyphens for spaces."""
    found, fenced = set(), False
    for line in page.read_text().splitlines():
        fenced ^= line.lstrip().startswith("```")
        match = re.match(r"#{1,6}\s+(.*)", line)
        if match and not fenced:
            name = re.sub(r"[^\w\- ]", "", match[1].strip().lower()).replace(" ", "-")
            number = sum(1 for other in found if re.fullmatch(re.escape(name) + r"(-\d+)?", other))
            found.add(f"{name}-{number}" if number else name)
    return found


def complaints(root):
    files = subprocess.run(["git", "ls-files", "-z"], cwd=root, stdout=subprocess.PIPE, text=True, check=True).stdout.split("\0")
    known = {path for file in files if file for path in (pathlib.PurePosixPath(file), *pathlib.PurePosixPath(file).parents)}
    for file in files:
        if not file.endswith(".md"):
            continue
        page = root / file
        for link in LINK.findall(prose(page.read_text())):
            if SCHEME.match(link):
                continue
            path, _, anchor = urllib.parse.unquote(link).partition("#")
            target = (page.parent / path).resolve() if path else page.resolve()
            if not target.is_relative_to(root) or pathlib.PurePosixPath(target.relative_to(root).as_posix()) not in known:
                yield f"{file}: {link} leads to no file of the repository"
            elif anchor and (target.suffix != ".md" or anchor not in anchors(target)):
                yield f"{file}: {link} leads to no heading of {target.relative_to(root)}"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    found = list(complaints(root))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
