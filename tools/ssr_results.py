#!/usr/bin/env python3
"""ssr_results.py [--quick] [--scene NAME] [--anisotropy A] [--work DIR] [--all-pixels] [--out FILE]: a table of
docs/ssr.md: what each sampler does to screen-space reflections at each roughness, one ray a pixel, against real rays.

Every surface gets the same roughness and anisotropy, all reflect, nothing fades, the camera stands still. All samplers
reflect the same frames and are held to the same truth. Errors are relative (relMSE) over the pixels whose truth comes from
the screen, or over all: of the pixel's own ray, of the 3 x 3 resolve, and of that with 16 frames of history or more. In
brackets: how much more or less than the ellipsoid in percent of it, frame by frame, +- one standard error, from the spread
of blocks of 8 frames (history binds the frames of a block, hardly the blocks).
--quick: 96 x 54, 48 frames (8 minutes on an idle core); else 192 x 108, 80 frames. --work keeps what was measured: the same
command again prints it without measuring.
"""
import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ROUGHNESS = ("0.1", "0.3", "0.5", "0.7")
PLAIN = "ellipsoid"
OTHERS = ("ndf", "caps", "bounded", "optimal", "horizon", "hdrp")
COMMON = ["--method", PLAIN, "--bias", "0", "--compare", ",".join(OTHERS), "--camera-path", "still",
          "--smoothness-fade-start", "0", "--min-smoothness", "0", "--edge-fade", "0", "--max-iterations", "256",
          "--truth", "--backend", "cpu"]
RATIO = ["--resolve", "neighbourhood-ratio"]
# What is measured, and the frames from which on it counts.
STAGES = (("own", ["--resolve", "own", "--accumulation", "0"], 0),
          ("resolved", [*RATIO, "--accumulation", "0"], 0),
          ("history", RATIO, 16))
BLOCK = 8


def measure(program, arguments, kept):
    """The stats.json of each stage: kept ones where they are there."""
    with tempfile.TemporaryDirectory() as folder:
        for name, options, _ in STAGES:
            file = kept / f"{name}.json"
            if not file.exists():
                subprocess.run([program, "ssr", *arguments, *COMMON, *options, "-o", folder], check=True)
                kept.mkdir(parents=True, exist_ok=True)
                (Path(folder) / "stats.json").replace(file)
    return {name: json.loads((kept / f"{name}.json").read_text()) for name, _, _ in STAGES}


def frames_of(stats, sampler):
    """The frames of a sampler."""
    if sampler == PLAIN:
        return stats["frames"]
    return next(other["frames"] for other in stats["compared"] if other["name"] == sampler)


def blocks(numbers):
    """Means of blocks of frames."""
    return [statistics.fmean(numbers[i:i + BLOCK]) for i in range(0, len(numbers) - BLOCK + 1, BLOCK)]


def error(stats, sampler, first, key):
    """A cell: the error, and how much of the ellipsoid's it is more."""
    own = [frame["truth"][key] for frame in frames_of(stats, sampler)[first:]]
    plain = [frame["truth"][key] for frame in frames_of(stats, PLAIN)[first:]]
    text = f"{statistics.fmean(own):.3f}"
    if sampler == PLAIN:
        return text
    more = blocks([a - b for a, b in zip(own, plain)])
    scale = 100 / statistics.fmean(plain)
    return (f"{text} ({scale * statistics.fmean(more):+.1f} ± "
            f"{scale * statistics.stdev(more) / len(more) ** 0.5:.1f})")


def row(stages, sampler, key):
    """Cells: shares rejected and hit, and the errors."""
    alone = frames_of(stages["own"], sampler)
    yield f"{sum(frame['rejected'] for frame in alone) / sum(frame['rays'] for frame in alone):.3f}"
    yield f"{statistics.fmean(frame['hit_rate'] for frame in alone):.3f}"
    for name, _, first in STAGES:
        # of hdrp the resolve is a part
        yield "" if (name, sampler) == ("own", "hdrp") else error(stages[name], sampler, first, key)


def table(options, size, frames, rays, work):
    """Lines of Markdown."""
    key = "relmse" if options.all_pixels else "relmse_onscreen"
    yield "| roughness | sampler | rejected | hits | own ray | resolved | with history |"
    yield "|---|---|---|---|---|---|---|"
    for roughness in ROUGHNESS:
        arguments = [options.scene, "--size", size, "--frames", frames, "--truth-rays", rays, "--roughness", roughness,
                     "--anisotropy", options.anisotropy]
        kept = work / f"{options.scene}-{size}-{frames}-a{options.anisotropy}-r{roughness}".replace("/", "_")
        stages = measure(options.program, arguments, kept)
        for sampler in (PLAIN, *OTHERS):
            yield f"| {roughness} | {sampler} | {' | '.join(row(stages, sampler, key))} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--program", default=ROOT / "build/lobe")
    parser.add_argument("--scene", default="cornell")
    parser.add_argument("--anisotropy", default="0")
    parser.add_argument("--work", type=Path, help="folder of what was measured")
    parser.add_argument("--all-pixels", action="store_true")
    parser.add_argument("--out", default="/dev/stdout")
    options = parser.parse_args()
    settings = ("96x54", "48", "64") if options.quick else ("192x108", "80", "256")
    with tempfile.TemporaryDirectory() as folder, open(options.out, "w", encoding="utf-8", buffering=1) as out:
        for line in table(options, *settings, options.work or Path(folder)):
            print(line, file=out)


if __name__ == "__main__":
    main()
