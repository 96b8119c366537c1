#!/usr/bin/env python3
"""Checks that a shared library exports the functions of bvhio.h and nothing else. With --reader: the functions whose comment
starts with [reader]. Usage: exports_test.py LIBRARY.so bvhio.h [--reader]"""

import re
import subprocess
import sys


def declared(header, reader_only):
    """The functions of the header; each belongs to the comment before it."""
    names = set()
    for comment, code in re.findall(r"/\*(.*?)\*/(.*?)(?=/\*|\Z)", header, flags=re.S):
        if not reader_only or comment.strip().startswith("[reader]"):
            names.update(re.findall(r"BVHIO_API[^;(]*?\b(bvhio\w+)\s*\(", code))
    return names


def exported(library):
    lines = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True).stdout.splitlines()
    symbols = [line.split()[-2:] for line in lines]
    return {name.split("@")[0] for kind, name in symbols if kind != "A"}  # A: the name of the version


def main():
    library, header = sys.argv[1:3]
    with open(header, encoding="utf-8") as file:
        wanted = declared(file.read(), "--reader" in sys.argv[3:])
    found = exported(library)
    for name in sorted(found - wanted):
        print(f"{library} exports {name}, which bvhio.h does not have")
    for name in sorted(wanted - found):
        print(f"{library} does not export {name}")
    print(f"{library}: {len(found)} functions")
    return 0 if wanted and found == wanted else 1


if __name__ == "__main__":
    sys.exit(main())
