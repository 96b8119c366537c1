#!/usr/bin/python3
"""The second reader of format-spec/reader must give the same verdict as the library on every golden and malformed file."""
import csv
import glob
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
sys.path.insert(0, os.path.join(ROOT, "format-spec", "reader"))
sys.dont_write_bytecode = True
import bvhx_reader  # noqa: E402


def verdict(path):
    with open(path, "rb") as file:
        data = file.read()
    try:
        bvhx_reader.read(data)
        return ("valid", 0)
    except bvhx_reader.Rejected as rejected:
        return (rejected.kind, rejected.clause)


def main():
    failures = 0
    expected = {path: ("valid", 0) for path in glob.glob(os.path.join(ROOT, "tests/golden/v*/*.bvhx"))}
    with open(os.path.join(HERE, "manifest.csv"), newline="") as manifest:
        for row in csv.DictReader(manifest):
            if row["clause"] != "2015":  # this reader does not decode Draco
                expected[os.path.join(HERE, row["file"])] = (row["kind"], int(row["clause"]))
    for path, wanted in sorted(expected.items()):
        found = verdict(path)
        if found != wanted:
            print(f"{os.path.relpath(path, ROOT)}: {found}, not {wanted}")
            failures += 1
    print(f"{len(expected)} files, {failures} other verdicts")
    return 1 if failures or len(expected) < 100 else 0


sys.exit(main())
