#!/usr/bin/env python3
"""Runs the examples of a page in Markdown and compares what they print with what the page says.

Usage: run_examples.py [--update] PAGE.md    in a directory of its own, with the tools on PATH

An example is a line of an indented block that begins with "$ "; the lines up to the next one are what it prints, on standard output and
standard error together. Examples run in the order of the page, in the current directory. --update writes what they print into the page.
"""
import difflib
import pathlib
import subprocess
import sys

INDENT, PROMPT = "    ", "    $ "


def run(command):
    """What a shell prints for the command, line by line. Pipes that are closed early are no failure here."""
    result = subprocess.run(["bash", "-c", command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return [INDENT + line for line in result.stdout.splitlines()]


def main():
    update = sys.argv[1] == "--update"
    page = pathlib.Path(sys.argv[-1])
    lines, new, at = page.read_text().splitlines(), [], 0
    while at < len(lines):
        new.append(lines[at])
        at += 1
        if new[-1].startswith(PROMPT):
            while at < len(lines) and lines[at].startswith(INDENT) and not lines[at].startswith(PROMPT):
                at += 1  # what the page says
            new += run(new[-1][len(PROMPT):])
    if update:
        page.write_text("\n".join(new) + "\n")
        return 0
    difference = list(difflib.unified_diff(lines, new, page.name, "what the examples print", lineterm=""))
    print("\n".join(difference), end="\n" if difference else "")
    return 1 if difference else 0


if __name__ == "__main__":
    sys.exit(main())
