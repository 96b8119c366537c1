#!/usr/bin/env python3
"""Checks the include arrows: a folder of libbvhio includes only folders to its left in
    core <- {tree, container} <- scene <- {importers, build, restructure, relayout, compress, rays} <- {metrics, pictures}
    <- {trace, stats, file} <- {api, reader} <- tools
(folders inside braces never include each other), and each third-party header is included only in its listed places. Prints one line
for each include that breaks a rule. Usage: check_arrows.py [ROOT]"""

import pathlib
import re
import sys

RANKS = [
    ["core"],
    ["tree", "container"],
    ["scene"],
    ["importers", "build", "restructure", "relayout", "compress", "rays"],
    ["metrics", "pictures"],
    ["trace", "stats", "file"],
    ["api", "reader"],
]
RANK = {folder: rank for rank, folders in enumerate(RANKS) for folder in folders}

# Which files may include a third-party header: a prefix of the header, and prefixes of paths. Tests may include what they like.
THIRD_PARTY = {
    "tbb/": ["libbvhio/core/parallel.cpp"],
    "nlohmann/": ["libbvhio/core/report"],
    "xxhash.h": ["libbvhio/core/hash"],
    "zstd.h": ["libbvhio/container/"],
    "draco/": ["libbvhio/importers/"],
    "tiny_gltf.h": ["libbvhio/importers/"],
    "meshoptimizer.h": ["libbvhio/importers/"],
    "png.h": ["libbvhio/pictures/"],
    "hwy/": ["libbvhio/tree/", "libbvhio/build/", "libbvhio/restructure/", "libbvhio/trace/"],
    "CLI/": ["tools/common/"],
    "spdlog/": ["tools/common/"],
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def complaints(root):
    for path in sorted(p for top in ("libbvhio", "tools") for p in (root / top).rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        relative = path.relative_to(root)
        folder = relative.parts[1] if relative.parts[0] == "libbvhio" else None
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            where, header = f"{relative}:{number}", match[2]
            for prefix, homes in THIRD_PARTY.items():
                if header.startswith(prefix) and not any(str(relative).startswith(home) for home in homes):
                    yield f"{where}: includes {header}, whose place is {' or '.join(homes)}"
            target = header.split("/")[0]
            if folder is None or match[1] == "<" or target == folder:
                continue
            if target not in RANK:
                yield f"{where}: includes {header}, which is in no folder of the library"
            elif RANK[target] >= RANK[folder]:
                yield f"{where}: {folder} may not include {target}"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    found = list(complaints(root))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
