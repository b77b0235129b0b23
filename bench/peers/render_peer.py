#!/usr/bin/env python3
"""render_peer.py FOLDER [--rounds N] [--spp N]: the path tracer beside Mitsuba 3 (LLVM) on spheres_scene.py's FOLDER.

Needs build/lobe (make) and the packages mitsuba and numpy of the Python registry; DRJIT_LIBLLVM_PATH names libLLVM 16 or
later. Rounds of both alternate, two threads each, for with one Mitsuba 3.9 does not go on. Mitsuba has compiled before its
clock starts. Prints camera paths in a second of processor time, the means of the pictures and the mean relative squared
error of a pixel, told from pictures of two seeds.
"""
import argparse
import json
import subprocess
import tempfile
import time
from pathlib import Path

import drjit
import mitsuba
import numpy

from pfm import read_pfm

LOBE = Path(__file__).resolve().parents[2] / "build/lobe"
WIDTH, HEIGHT = 640, 360


def ours(folder, spp, seed):
    environment = next(folder.glob("*.exr"))
    with tempfile.TemporaryDirectory() as place:
        out = Path(place, "picture.pfm")
        run = subprocess.run([LOBE, "render", folder / "spheres.glb", "--env", environment, "--size", f"{WIDTH}x{HEIGHT}",
                              "--spp", str(spp), "--seed", str(seed), "--threads", "2", "--json", "-o", out],
                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
        return json.loads(run.stdout)["cpu_seconds"], read_pfm(out)


def theirs(scene, spp, seed):
    start = time.process_time()
    picture = numpy.array(mitsuba.render(scene, spp=spp, seed=seed))
    return time.process_time() - start, picture


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--spp", type=int, default=16)
    arguments = parser.parse_args()
    mitsuba.set_variant("llvm_ad_rgb")
    drjit.set_thread_count(2)
    scene = mitsuba.load_file(str(arguments.folder / "spheres.xml"))
    theirs(scene, arguments.spp, 0)
    renders = {"lobe": lambda seed: ours(arguments.folder, arguments.spp, seed),
               "Mitsuba": lambda seed: theirs(scene, arguments.spp, seed)}
    times, pictures = {name: [] for name in renders}, {name: [] for name in renders}
    for seed in range(1, max(arguments.rounds, 2) + 1):
        for name, render in renders.items():
            seconds, picture = render(seed)
            times[name].append(seconds)
            pictures[name] = (pictures[name] + [picture])[-2:]
    for name in renders:
        rate = WIDTH * HEIGHT * arguments.spp / numpy.array(times[name])
        a, b = pictures[name]
        error = numpy.mean((a - b) ** 2 / (((a + b) / 2) ** 2 + 0.01)) / 2
        print(f"{name:8} {1e-6 * numpy.median(rate):6.3f} million paths a second ({1e-6 * rate.min():.3f} to "
              f"{1e-6 * rate.max():.3f}), mean {((a + b) / 2).mean():.4f}, relative squared error {error:.5f}")


if __name__ == "__main__":
    main()
