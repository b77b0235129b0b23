#!/usr/bin/env python3
"""ssr_beyond.py [--program FILE] [--out FILE]: a table of docs/ssr.md: HDRP mode with its defaults against the
resolves by ratio and by confidence, on the screen, against real rays.

Three scenes (two by ssr_scenes.py), a moving camera, every surface of the same roughness, one ray a pixel, 192 x 108.
Errors are relative (relMSE) over the pixels whose truth comes from the screen, the mean over the last 6 of 12
frames; +- is one standard error from the spread over them. Open: no fade toward the edge, a finer thickness.
"""
import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HDRP = ["--method", "ellipsoid", "--resolve", "neighbourhood", "--as-hdrp"]
OPEN = ["--thickness", "0.1", "--edge-fade", "0"]
WAYS = (("HDRP mode", HDRP), ("HDRP mode, open", [*HDRP, *OPEN]),
        ("ratio", ["--resolve", "neighbourhood-ratio"]), ("confidence", ["--resolve", "confidence"]),
        ("ratio, open", ["--resolve", "neighbourhood-ratio", "--bias", "0", *OPEN]),
        ("confidence, open", ["--resolve", "confidence", "--bias", "0", *OPEN]))
COMMON = ["--smoothness-fade-start", "0", "--min-smoothness", "0", "--size", "192x108", "--frames", "12", "--spp", "32",
          "--truth", "--truth-rays", "96"]
FIRST = 6


def errors(program, folder, arguments):
    subprocess.run([program, "ssr", *arguments, *COMMON, "-o", folder], check=True)
    frames = json.loads((Path(folder) / "stats.json").read_text())["frames"]
    return [frame["truth"]["relmse_onscreen"] for frame in frames[FIRST:]]


def mean(numbers):
    return f"{statistics.fmean(numbers):.3f} ± {statistics.stdev(numbers) / len(numbers) ** 0.5:.3f}"


def table(program):
    """Lines of Markdown; at the end of each, the share of the first error that the last one is."""
    yield "| scene | roughness | " + " | ".join(name for name, _ in WAYS) + " | ratio |"
    yield "|---" * (len(WAYS) + 3) + "|"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([ROOT / "tools/ssr_scenes.py", folder], check=True)
        for scene in ("gallery", f"{folder}/floor.glb", f"{folder}/arcade.glb"):
            for roughness in ("0.1", "0.3", "0.6"):
                found = [errors(program, f"{folder}/out", [scene, "--roughness", roughness, *way]) for _, way in WAYS]
                share = statistics.fmean(found[-1]) / statistics.fmean(found[0])
                yield f"| {Path(scene).stem} | {roughness} | {' | '.join(map(mean, found))} | {share:.2f} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build/lobe")
    parser.add_argument("--out", default="/dev/stdout")
    options = parser.parse_args()
    with open(options.out, "w", encoding="utf-8", buffering=1) as out:
        for line in table(options.program):
            print(line, file=out)


if __name__ == "__main__":
    main()
