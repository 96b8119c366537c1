# shellcheck shell=bash
# What the cases share. Read before each of them.

# A cube of twelve triangles around the origin.
cube() {
    cat <<'OBJ'
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 1 3 2
f 1 4 3
f 5 6 7
f 5 7 8
f 1 2 6
f 1 6 5
f 3 4 8
f 3 8 7
f 2 3 7
f 2 7 6
f 4 1 5
f 4 5 8
OBJ
}

# A bumpy grid of 2 * $1 * $1 triangles.
grid() {
    awk -v n="$1" 'BEGIN {
        for (y = 0; y <= n; ++y) for (x = 0; x <= n; ++x) print "v", x, (x * 7 + y * 13) % 11 / 8, y
        for (y = 0; y < n; ++y) for (x = 0; x < n; ++x) {
            a = y * (n + 1) + x + 1
            print "f", a, a + 1, a + n + 2
            print "f", a, a + n + 2, a + n + 1
        }
    }'
}

# The names that an option takes, read from the tool's own help, so that new rows of tables are tested as they come.
choices() { # TOOL OPTION
    local names
    names=$("$1" --help | awk -v option="$2" '
        $1 == option { listing = 1; next }
        !/^            / { listing = 0 }
        listing && match($0, /^ */) && RLENGTH == 36 { print $1 }') # what is further right goes on with a summary
    [ -n "$names" ] || echo "$1 --help lists no names for $2" >&2
    echo "$names"
}

# Says how a command ended; its output goes on. For cases with several.
code() {
    local code=0
    "$@" || code=$?
    echo "exit $code"
}

# Prints values of the JSON object on standard input, by their paths.
json() {
    python3 -c '
import json, sys
report = json.load(sys.stdin)
for path in sys.argv[1:]:
    value = report
    for key in path.split("."):
        value = value[key]
    print(path, value if isinstance(value, str) else json.dumps(value))' "$@"
}

# Complains about keys that the JSON object in file $1 does not have.
keys() {
    python3 -c '
import json, sys
report = json.load(open(sys.argv[1]))
for path in sys.argv[2:]:
    value = report
    for key in path.split("."):
        value = value.get(key) if isinstance(value, dict) and key in value else print(sys.argv[1], "has no", path)' "$@"
}

# A glTF file: $1 its nodes, $2 its meshes. Accessor 0 is the three corners in triangle.bin.
gltf() {
    cat <<GLTF
{"asset": {"version": "2.0"}, "scene": 0, "nodes": [$1], "meshes": [$2],
 "scenes": [{"nodes": [$(grep -o '{[^}]*}' <<<"$1" | awk '{ printf "%s%d", (NR > 1 ? ", " : ""), NR - 1 }')]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": "triangle.bin", "byteLength": 36}]}
GLTF
}

# A PLY file of one triangle: $1 and $2 are more of its header and of its body, for printf.
ply() {
    printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n'
    printf 'element face 1\nproperty list uchar int vertex_indices\n%bend_header\n' "$1"
    printf '0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n%b' "$2"
}
