# The search for a form chooses what keeps to the limit, and says which and how to make it again.
grid 12 | bvh-build -o tree.bvhx
quick="--count 300 --repeat 1"
# shellcheck disable=SC2086
bvh-compress tree.bvhx --max-bytes-per-primitive 1000 $quick --pareto forms.csv --report report.json -o chosen.bvhx
bvh-trace chosen.bvhx --rays random --count 2000 --compare tree.bvhx >/dev/null || echo "other hits"
bvh-stats chosen.bvhx --format json >chosen.json
head -n 1 forms.csv
python3 - <<'PYTHON'
import csv, json, subprocess
rows = list(csv.DictReader(open("forms.csv")))
chosen = [row for row in rows if row["status"] == "chosen"]
fastest = min(rows, key=lambda row: float(row["slowdown"]))
print(len(chosen), "chosen", chosen == [fastest])
report, stats = json.load(open("report.json")), json.load(open("chosen.json"))
name = f"{fastest['form']} {fastest['parameters']}".strip()
print(report["search"]["chosen"] == name, len(report["search"]["candidates"]) == len(rows), stats["form"] == fastest["form"])
# What the table calls a row makes that row, with nothing to search; and provenance has the same options.
for row in rows:
    command = ["bvh-compress", "tree.bvhx", "--form", row["form"], *row["parameters"].split(), "-o", "row.bvhx"]
    subprocess.run(command, check=True)
    made = json.loads(subprocess.run(["bvh-stats", "row.bvhx", "--no-epo", "--format", "json"], stdout=subprocess.PIPE).stdout)
    if abs(made["bytes_per_primitive"] - float(row["bytes_per_primitive"])) > 1e-4 * made["bytes_per_primitive"]:
        print(row, made["bytes_per_primitive"])
    if row is fastest:
        wanted = made["provenance"][-1]["options"]
        for key, value in stats["provenance"][-1]["options"].items():
            if key in wanted and wanted[key] != value:
                print(key, value, "not", wanted[key])
        print(subprocess.run(["bvh-stats", "row.bvhx", "--diff", "chosen.bvhx"], stdout=subprocess.PIPE).stdout.decode().split("\n")[0])
PYTHON
# Without a limit there is the table alone; the form is the one that was asked for.
# shellcheck disable=SC2086
bvh-compress tree.bvhx --form ssh $quick --pareto all.csv | bvh-stats --format json | json form
cut -d , -f 1,2 forms.csv | cmp - <(cut -d , -f 1,2 all.csv)
# One form's parameters alone.
# shellcheck disable=SC2086
bvh-compress tree.bvhx --form ssh --max-slowdown 1000 $quick --pareto ssh.csv | bvh-stats --format json | json form
cut -d , -f 1 ssh.csv | sort -u

code bvh-compress tree.bvhx --form aabb --max-bytes-per-primitive 0.01 $quick -o no.bvhx --pareto no.csv
code bvh-compress tree.bvhx --max-slowdown 0 --max-bytes-per-primitive 1 -o no.bvhx
code bvh-compress tree.bvhx --max-slowdown -1 -o no.bvhx
code bvh-compress tree.bvhx --seed 1 -o no.bvhx
code bvh-compress tree.bvhx --max-slowdown 9 --codec topology -o no.bvhx
code bvh-compress tree.bvhx --pareto no.bvhx -o no.bvhx
ls
