#!/usr/bin/env python3
"""measure.py [--quick] [--peer PYTHON]: measures this processor, writes bench/results/NAME.json and the tables of
docs/performance.md.

Needs a release build (make) and builds bench_sweep and bench_inline beside it. Counts of instructions are taken if valgrind is
installed; those of AVX-512 are not, valgrind does not know it. --peer names a Python that has mitsuba
(bench/peers/mitsuba_peer.py).
"""
import argparse
import json
import os
import re
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build"
METHODS = ["bounded", "optimal", "horizon"]
COUNTED = ["ellipsoid", "caps", "bounded", "optimal", "horizon-uniform", "horizon"]


def output(*command, isa=None):
    environment = dict(os.environ, **({"LOBE_ISA": isa} if isa else {}))
    return subprocess.run([str(c) for c in command], check=True, text=True, stdout=subprocess.PIPE,
                          env=environment).stdout


def numbers(text):
    return [[float(word) for word in line.split()] for line in text.splitlines()]


def instructions(method, isa):
    """A draw, from the difference of two runs."""
    totals = []
    for rows in (100_000, 200_000):
        run = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                              "--toggle-collect=lobe_reflection_sample_batch_f32",
                              str(BUILD / "bench_sweep"), "draw", method, str(rows)],
                             check=True, text=True, stderr=subprocess.PIPE,
                             env=dict(os.environ, LOBE_ISA=isa))
        totals.append(int(re.search(r"Collected : (\d+)", run.stderr).group(1)))
    return (totals[1] - totals[0]) / 100_000


def measure(quick, peer):
    subprocess.run(["cmake", "--build", BUILD, "--target", "bench_sweep", "bench_inline"], check=True,
                   stdout=subprocess.DEVNULL)
    sweep = BUILD / "bench_sweep"
    result = {"command": "bench/measure.py" + (" --quick" if quick else "")}
    result["bench"] = json.loads(output(BUILD / "lobe", "bench", "--json", *(["--quick"] if quick else [])))
    for name in ("sizes", "angles", "stream"):
        result[name] = {m: numbers(output(sweep, name, m)) for m in METHODS}
    result["inline"] = {line.split()[0]: [float(ns) for ns in line.split()[1:]]
                        for line in output(BUILD / "bench_inline").splitlines()}
    if shutil.which("valgrind"):
        result["instructions"] = {m: {isa: instructions(m, isa) for isa in ("scalar", "sse4.1", "avx2")}
                                  for m in COUNTED}
    if peer:
        result["peer"] = output(peer, ROOT / "bench/peers/mitsuba_peer.py")
    return result


class Rows:
    """The rows of `lobe bench`, by their names."""

    def __init__(self, report):
        self.rows = {(r["ndf"], r["masking"], r["method"], r["isa"], r["precision"], r["prepared"]): r
                     for r in report["rows"]}
        self.sets = list(dict.fromkeys(r["isa"] for r in report["rows"]))
        self.models = list(dict.fromkeys(key[:3] for key in self.rows))

    def get(self, model, isa, prepared, precision="f32", field="ns"):
        return self.rows[(*model, isa, precision, prepared)][field]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def smith(method):
    return ("ggx", "smith", method)


def targets(rows, widest, stream, inline):
    """What issue and documentation promise, and what came out."""
    lines = []

    def line(what, target, value, at_least):
        met = value >= target if at_least else value <= target
        lines.append([what, ("≥ " if at_least else "≤ ") + f"{target:g}", f"{value:.2f}", "yes" if met else "**no**"])

    listing_targets = {"avx512": 9, "avx2": 7}
    for isa in (s for s in ("avx512", "avx2") if s in rows.sets):
        for method in ("ellipsoid", "caps", "bounded"):
            line(f"{method}, {isa}, each, against its listing", listing_targets[isa],
                 rows.get(smith(method), isa, "each", field="listing"), True)
    wide = [(("beckmann", "smith", "newton"), 25), (smith("slope"), 8), (smith("ndf"), 8),
            (("ggx", "vcavity", "vcavity"), 8)]
    for model, target in wide:
        line(f"{' '.join(model)}, {widest}, each, against its listing", target,
             rows.get(model, widest, "each", field="listing"), True)
    for method, each, shared in (("optimal", 2.5, 1.15), ("horizon-uniform", 4, 2), ("horizon", 5.5, 3)):
        for prepared, target in (("each", each), ("shared", shared)):
            line(f"{method} against bounded, {widest}, {prepared}", target,
                 rows.get(smith(method), widest, prepared) / rows.get(smith("bounded"), widest, prepared), False)
    threads, draw, copy = stream["bounded"][-1]
    line(f"bounded, arrays ≫ cache, {threads:.0f} threads, against copying the same bytes", 4, draw / copy, False)
    for method in ("bounded", "caps"):
        line(f"{method}, f64 against f32, {widest}, each", 2.4,
             rows.get(smith(method), widest, "each", "f64") / rows.get(smith(method), widest, "each"), False)
        inlined, _, batch = inline[method]
        line(f"{method}, one inlined call a draw (single file) against scalar batch, each", 1.2, inlined / batch, False)
    return table(["what", "target", "measured", "met"], lines)


def methods(rows, widest):
    lines = []
    for model in rows.models:
        cells = [" ".join(model)]
        for isa in dict.fromkeys(["call", "scalar", "avx2", widest]):
            if isa in rows.sets:
                cells.append(" / ".join(f"{rows.get(model, isa, p):.1f}" for p in ("each", "shared")))
        cells.append(" / ".join(f"{rows.get(model, widest, p, 'f64'):.1f}" for p in ("each", "shared")))
        normals = [rows.get(model, widest, p, field="ns_normal") for p in ("each", "shared")]
        cells.append(" / ".join(f"{n:.1f}" for n in normals) if all(normals) else "-")
        listing = rows.get(model, widest, "each", field="listing")
        cells.append(f"{listing:.1f}" if listing else "-")
        lines.append(cells)
    head = ["model", "call", "scalar"] + [s for s in dict.fromkeys(["avx2", widest]) if s in rows.sets]
    return table(head + [f"{widest} f64", f"{widest}, normals", "× listing"], lines)


def sizes(result):
    head = ["rows"] + METHODS
    columns = [result["sizes"][m] for m in METHODS]
    return table(head, [[f"{group[0][0]:.0f}"] + [f"{g[1]:.2f}" for g in group] for group in zip(*columns)])


def angles(result):
    lines = []
    for method in METHODS:
        ns = [row[2] for row in result["angles"][method]]
        lines.append([method, f"{min(ns):.2f}", f"{max(ns):.2f}"])
    return table(["method", "least ns", "most ns"], lines)


def counts(result):
    if "instructions" not in result:
        return "(valgrind was not installed)"
    return table(["method", "scalar", "sse4.1", "avx2"],
                 [[m] + [f"{c[i]:.1f}" for i in ("scalar", "sse4.1", "avx2")]
                  for m, c in result["instructions"].items()])


def write_tables(result, page):
    rows = Rows(result["bench"])
    widest = rows.sets[-1]
    report = result["bench"]
    parts = {"machine": f"{report['cpu']}; sets: {', '.join(rows.sets[1:])}; copies "
                        f"{report['copy_bytes_per_second'] / 1e9:.1f} GB/s on one thread.",
             "targets": targets(rows, widest, result["stream"], result["inline"]), "methods": methods(rows, widest),
             "sizes": sizes(result), "angles": angles(result), "instructions": counts(result)}
    if "peer" in result:
        parts["peer"] = result["peer"].strip()
    text = page.read_text()
    for name, part in parts.items():
        text = re.sub(rf"(<!-- measured: {name} -->\n).*?(<!-- end -->)",
                      lambda m, part=part: m.group(1) + "\n" + part + "\n\n" + m.group(2), text, flags=re.S)
    page.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--peer", metavar="PYTHON")
    arguments = parser.parse_args()
    result = measure(arguments.quick, arguments.peer)
    widest = Rows(result["bench"]).sets[-1]
    name = re.sub(r"[^a-z0-9]+", "-", f"{result['bench']['cpu']} {widest}".lower()).strip("-")
    results = ROOT / "bench/results"
    results.mkdir(exist_ok=True)
    (results / f"{name}.json").write_text(json.dumps(result, indent=1) + "\n")
    write_tables(result, ROOT / "docs/performance.md")


if __name__ == "__main__":
    main()
