#!/usr/bin/env python3
"""What --adaptive gains: mean square errors of lobe render with and without it, at equal --spp.

    tools/adaptive_results.py PROGRAM [--bias SEEDS] [SCENE...]

A picture x is compared with two references a and b of other seeds: the mean of (x - a)(x - b) is the square error of x
without the noise of the references. Relative: over m^2 + 0.01, m the mean of a and b. The gain is how many times more
samples, or seconds of the processor, an even picture needs for the same error, which falls as 1/samples.

With --bias: so many pictures of other seeds both ways, at 64 samples a pixel; the differences of the means of 32 blocks and
of the whole picture, in standard errors.
"""
import array
import json
import statistics
import subprocess
import sys
import tempfile

SCENES = "gallery", "cornell", "glass"
SIZE, SPP, SEEDS, REFERENCE = "96x54", (64, 256, 1024), 4, 4096


def render(program, scene, spp, seed, *options, size=SIZE):
    """Luminances, and what was told."""
    with tempfile.TemporaryDirectory() as folder:
        name = folder + "/a.pfm"
        told = json.loads(subprocess.run(
            [program, "render", scene, "--size", size, "--spp", str(spp), "--seed", str(seed), "-o",
             name, "--json", *options], check=True, capture_output=True).stdout)
        with open(name, "rb") as file:
            rgb = array.array("f", file.read().split(b"\n", 3)[3])
    return [0.2126 * rgb[i] + 0.7152 * rgb[i + 1] + 0.0722 * rgb[i + 2]
            for i in range(0, len(rgb), 3)], told


def errors(picture, a, b):
    square = relative = 0
    for x, y, z in zip(picture, a, b):
        mean = 0.5 * (y + z)
        square += (x - y) * (x - z)
        relative += (x - y) * (x - z) / (mean * mean + 0.01)
    return square / len(picture), relative / len(picture)


def measure(program, scene, spp, references, *options):
    """Mean square error, relative one, samples, seconds: means over the seeds."""
    sums = [0.0] * 4
    for seed in range(SEEDS):
        picture, told = render(program, scene, spp, seed, *options)
        row = (*errors(picture, *references), told["samples"], told["cpu_seconds"])
        sums = [s + r / SEEDS for s, r in zip(sums, row)]
    return sums


def block_means(picture):
    """Of 8 x 8 pixels of a picture of 64 x 32, and of all of it."""
    blocks = [0.0] * 33
    for i, x in enumerate(picture):
        blocks[i // 512 * 8 + i % 64 // 8] += x / 64
        blocks[32] += x / 2048
    return blocks


def show_bias(program, seeds, scenes):
    for scene in scenes:
        sums = []
        for mode, options in enumerate(((), ("--adaptive",))):
            rows = [block_means(render(program, scene, 64, 1 + mode * seeds + seed, *options,
                                       size="64x32")[0]) for seed in range(seeds)]
            means = [statistics.fmean(column) for column in zip(*rows)]
            sums.append([(m, statistics.variance(column, m) / seeds)
                         for m, column in zip(means, zip(*rows))])
        z = [(b - a) / max((u + v) ** .5, 1e-12) for (a, u), (b, v) in zip(*sums)]
        print(f"{scene}: whole {z[32]:+.2f}, blocks {min(z[:32]):+.2f} to {max(z[:32]):+.2f}, root of "
              f"the mean square {statistics.fmean(x * x for x in z[:32]) ** .5:.2f}; standard error "
              f"of the whole {(sums[0][32][1] + sums[1][32][1]) ** .5 / sums[0][32][0]:.1e} of it",
              flush=True)


def main():
    program, *scenes = sys.argv[1:]
    if scenes[:1] == ["--bias"]:
        return show_bias(program, int(scenes[1]), scenes[2:] or SCENES)
    print("| scene | --spp | RMSE, even | adaptive | relative, even | adaptive | samples saved "
          "| relative | time saved, relative |\n|---|---|---|---|---|---|---|---|---|")
    for scene in scenes or SCENES:
        references = [render(program, scene, REFERENCE, seed)[0] for seed in (1001, 1002)]
        for spp in SPP:
            even = measure(program, scene, spp, references)
            adaptive = measure(program, scene, spp, references, "--adaptive")
            gains = [even[i] * even[2] / (adaptive[i] * adaptive[2]) for i in (0, 1)]
            time = even[1] * even[3] / (adaptive[1] * adaptive[3])
            numbers = [even[0] ** .5, adaptive[0] ** .5, even[1] ** .5, adaptive[1] ** .5]
            print(f"| {scene} | {spp} | " + " | ".join(f"{x:.3g}" for x in numbers) + " | " +
                  " | ".join(f"{g:.2f}×" for g in (*gains, time)) + " |", flush=True)


if __name__ == "__main__":
    main()
