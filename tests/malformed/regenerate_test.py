#!/usr/bin/python3
"""make_malformed.py must still write the malformed files of this folder, bit by bit. Exit code 77: cannot tell here."""
import glob
import os
import subprocess
import sys
import tempfile

import zstandard

HERE = os.path.dirname(os.path.abspath(__file__))
ZSTD_VERSION = (1, 5, 4)  # other versions compress otherwise


def contents(folder):
    files = {}
    for path in glob.glob(os.path.join(folder, "*.bvhx")) + [os.path.join(folder, "manifest.csv")]:
        with open(path, "rb") as file:
            files[os.path.basename(path)] = file.read()
    return files


def main():
    if zstandard.ZSTD_VERSION != ZSTD_VERSION:
        print(f"SKIPPED: zstandard has zstd {zstandard.ZSTD_VERSION}, the files were made with {ZSTD_VERSION}")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, os.path.join(HERE, "make_malformed.py"), folder], check=True)
        made, kept = contents(folder), contents(HERE)
    wrong = sorted(name for name in made.keys() | kept.keys() if made.get(name) != kept.get(name))
    for name in wrong:
        print(f"{name}: " + ("is not written any more" if name not in made else
                             "is written, but not kept" if name not in kept else "other bytes are written"))
    print(f"{len(kept) - 1} malformed files, {len(wrong)} differences")
    return 1 if wrong else 0


sys.exit(main())
