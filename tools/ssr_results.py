#!/usr/bin/env python3
"""ssr_results.py [--quick | --beyond] [--scene NAME] [--program FILE] [--out FILE]: the table of docs/ssr.md: what each
sampler does to screen-space reflections at each roughness, one ray a pixel, against real rays.

Every surface gets the same roughness, all reflect, nothing fades, the camera stands still; all rows have the same
frames and the same truth. Errors are relative (relMSE), the mean over the frames without history (--accumulation 0) and
over the second half of the frames with it; +- is one standard error, from the spread over the frames.
--beyond: instead, three scenes (two by ssr_scenes.py) and a moving camera: HDRP mode with its defaults against the
resolves by ratio and by confidence, the errors on the screen of the last 6 of 12 frames.
--quick: 96 x 54, 8 frames (a few minutes on an idle core); else 192 x 108, 16 frames.
"""
import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ROUGHNESS = (0.1, 0.3, 0.5, 0.7)
SAMPLERS = (("ndf", ["--mode", "ndf"]),
            ("ellipsoid", ["--method", "ellipsoid"]),
            ("caps", ["--method", "caps"]),
            ("bounded", ["--method", "bounded"]),
            ("optimal", ["--method", "optimal"]),
            ("horizon", ["--method", "horizon"]),
            ("ellipsoid, --as-hdrp, bias 0.5",
             ["--method", "ellipsoid", "--resolve", "neighbourhood", "--as-hdrp", "--bias", "0.5"]))
COMMON = ["--camera-path", "still", "--smoothness-fade-start", "0", "--min-smoothness", "0",
          "--edge-fade", "0", "--max-iterations", "256"]


HDRP = ["--method", "ellipsoid", "--resolve", "neighbourhood", "--as-hdrp"]
OPEN = ["--thickness", "0.1", "--edge-fade", "0"]
WAYS = (("HDRP mode", HDRP), ("HDRP mode, open", [*HDRP, *OPEN]),
        ("ratio", ["--resolve", "neighbourhood-ratio"]), ("confidence", ["--resolve", "confidence"]),
        ("ratio, open", ["--resolve", "neighbourhood-ratio", "--bias", "0", *OPEN]),
        ("confidence, open", ["--resolve", "confidence", "--bias", "0", *OPEN]))


def frames_of(program, folder, arguments):
    subprocess.run([program, "ssr", *arguments, "-o", folder], check=True)
    return json.loads((Path(folder) / "stats.json").read_text())["frames"]


def mean(numbers):
    return f"{statistics.fmean(numbers):.3f} ± {statistics.stdev(numbers) / len(numbers) ** 0.5:.3f}"


def row(program, folder, arguments):
    """Cells: shares rejected and hit, and the errors without and with history."""
    if "--bias" not in arguments:
        arguments = [*arguments, "--bias", "0"]
    alone = frames_of(program, folder, [*arguments, "--accumulation", "0"])
    gathered = frames_of(program, folder, arguments)[len(alone) // 2:]
    rays = sum(frame["rays"] for frame in alone)
    shares = (sum(frame["rejected"] for frame in alone) / rays,
              statistics.fmean(frame["hit_rate"] for frame in alone))
    return [f"{share:.3f}" for share in shares] + [
        mean([frame["truth"][name] for frame in frames])
        for frames in (alone, gathered) for name in ("relmse", "relmse_onscreen")]


def table(program, scene, size, frames, spp, rays):
    yield "| roughness | sampler | rejected | hits | relMSE | on screen | with history | on screen |"
    yield "|---|---|---|---|---|---|---|---|"
    for roughness in ROUGHNESS:
        with tempfile.TemporaryDirectory() as folder:
            for name, options in SAMPLERS:
                cells = row(program, folder, [scene, *COMMON, *options, "--size", size, "--frames", frames,
                                       "--spp", spp, "--roughness", str(roughness), "--truth",
                                       "--truth-rays", rays])
                yield f"| {roughness} | {name} | {' | '.join(cells)} |"


def beyond(program, rays):
    """Errors of each way, and of the last the share of the first."""
    yield "| scene | roughness | " + " | ".join(name for name, _ in WAYS) + " | ratio |"
    yield "|---" * (len(WAYS) + 3) + "|"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([ROOT / "tools/ssr_scenes.py", folder], check=True)
        for scene in ("gallery", f"{folder}/floor.glb", f"{folder}/arcade.glb"):
            for roughness in ("0.1", "0.3", "0.6"):
                common = [scene, "--roughness", roughness, "--smoothness-fade-start", "0", "--min-smoothness",
                          "0", "--size", "192x108", "--frames", "12", "--spp", "32", "--truth",
                          "--truth-rays", rays]
                errors = [[frame["truth"]["relmse_onscreen"] for frame in
                           frames_of(program, f"{folder}/out", [*common, *way])[6:]] for _, way in WAYS]
                share = statistics.fmean(errors[-1]) / statistics.fmean(errors[0])
                yield (f"| {Path(scene).stem} | {roughness} | {' | '.join(mean(e) for e in errors)} | "
                       f"{share:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--beyond", action="store_true")
    parser.add_argument("--program", default=ROOT / "build/lobe")
    parser.add_argument("--scene", default="cornell")
    parser.add_argument("--out", default="/dev/stdout")
    options = parser.parse_args()
    settings = ("96x54", "8", "8", "32") if options.quick else ("192x108", "16", "64", "256")
    with open(options.out, "w", encoding="utf-8", buffering=1) as out:
        lines = (beyond(options.program, "96") if options.beyond
                 else table(options.program, options.scene, *settings))
        for line in lines:
            print(line, file=out)


if __name__ == "__main__":
    main()
