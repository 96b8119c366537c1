#!/usr/bin/python3
"""Writes the malformed files of this folder, one or more for each clause by which a reader must reject a file, and manifest.csv.

Each malformed file starts from a golden file, which is taken apart into chunks, damaged in one way, and put together with correct
checksums, so that only one clause is broken. The cases are in the folder `cases`, in a file for each page of format-spec.
Usage: make_malformed.py [FOLDER]; FOLDER defaults to this script's.
"""
import csv
import glob
import importlib
import os
import sys

sys.dont_write_bytecode = True
from damage import CASES, File  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
UNSUPPORTED = {1003, 1004, 1014, 2001, 2008, 2010}


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else HERE
    for path in sorted(glob.glob(os.path.join(HERE, "cases", "*.py"))):
        importlib.import_module("cases." + os.path.basename(path)[:-3])
    rows = []
    for clause, name, base, damage in CASES:
        file = File(base)
        result = damage(file)
        data = result if isinstance(result, bytes) else file.bytes()
        path = f"{clause}-{name}.bvhx"
        with open(os.path.join(folder, path), "wb") as out:
            out.write(data)
        rows.append((path, "unsupported" if clause in UNSUPPORTED else "invalid", clause))
    assert len({row[0] for row in rows}) == len(rows)
    with open(os.path.join(folder, "manifest.csv"), "w", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(("file", "kind", "clause"))
        writer.writerows(sorted(rows))


main()
