#!/usr/bin/env python3
"""bounds.py [--cpu znver4] [METHOD...]: what bounds the vector loops, told by llvm-mca.

Takes the loop over rows out of a release build (make), batch of draws, float, AVX-512, each row prepared, and lets
llvm-mca (package llvm-19) schedule it for a processor it has a model of. Prints a table: instructions and cycles
of 16 draws, the two busiest units with the share of the cycles that they are taken, and the cycles if every division
were a multiplication and every square root a move.
"""
import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
OBJECT = ROOT / "build/lib/CMakeFiles/lobe_objects.dir/batch_avx512_f32.c.o"
METHODS = ["ggx_ndf", "ggx_caps", "ggx_bounded", "ggx_optimal", "ggx_horizon", "ggx_slope", "ggx_vcavity",
           "beckmann_newton"]
CHEAP = [(r"\bvdivps\b", "vmulps"), (r"\bvsqrtps\b", "vmovaps"), (r"\bvdivss\b", "vmulss")]


def run(*command):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE).stdout


def loop_of(function):
    """The longest loop of a function, as assembler text that jumps to its own beginning."""
    text = run("objdump", "-d", "--no-show-raw-insn", "--disassemble=" + function, str(OBJECT))
    found = [re.match(r"\s*([0-9a-f]+):\s+(.*)", line) for line in text.splitlines()]
    code = [(int(m[1], 16), m[2].split("#")[0].strip()) for m in found if m]
    places = {address: i for i, (address, _) in enumerate(code)}
    longest = (0, 0)
    for i, (address, instruction) in enumerate(code):
        jump = re.match(r"j(?!mp)\w+\s+([0-9a-f]+)", instruction)
        first = places.get(int(jump[1], 16)) if jump else None
        if first is not None and first < i and i - first > longest[1] - longest[0]:
            longest = (first, i)
    body = [re.sub(r"<[^>]*>", "", t) for _, t in code[longest[0]:longest[1] + 1]]
    return [re.sub(r"^(j\w+)\s.*", r"\1 .Lloop", t) for t in body]


def schedule(body, cpu):
    """(cycles a pass, {unit: share of the cycles})"""
    tool = shutil.which("llvm-mca-19") or shutil.which("llvm-mca")
    text = ".Lloop:\n" + "\n".join(body) + "\n"
    out = subprocess.run([tool, "-mcpu=" + cpu, "-iterations=100", "-"], input=text, check=True, text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE).stdout
    cycles = int(re.search(r"Total Cycles:\s+(\d+)", out)[1]) / 100
    names = re.findall(r"^\[[\d.]+\]\s+- (?:Zn4|ICX)?(\S+)", out, re.M)
    pressure = re.search(r"Resource pressure per iteration:\n.*\n(.*)", out)[1].split()
    return cycles, {n: (float(p) if p != "-" else 0.0) / cycles for n, p in zip(names, pressure)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cpu", default="znver4")
    parser.add_argument("methods", nargs="*", default=METHODS)
    arguments = parser.parse_args()
    if not OBJECT.exists():
        sys.exit(f"bounds: no {OBJECT}; run make on an x86 machine first")
    print("| loop | instructions | cycles | busiest units | cycles without division and root |")
    print("|---|---|---|---|---|")
    for method in arguments.methods:
        body = loop_of(method + "_sample_each")
        cycles, units = schedule(body, arguments.cpu)
        cheap = body
        for pattern, instead in CHEAP:
            cheap = [re.sub(pattern, instead, line) for line in cheap]
        if any("vmovaps" in line and line.count(",") > 1 for line in cheap):
            cheap = [re.sub(r"(vmovaps\s+[^,]+,)[^,]+,", r"\1", line) for line in cheap]
        busy = sorted(units.items(), key=lambda unit: -unit[1])[:2]
        print(f"| {method} | {len(body)} | {cycles:.0f} | " + ", ".join(f"{n} {s:.0%}" for n, s in busy) +
              f" | {schedule(cheap, arguments.cpu)[0]:.0f} |")


if __name__ == "__main__":
    main()
