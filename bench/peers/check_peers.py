#!/usr/bin/env python3
"""check_peers.py [--pictures K] [--spp N] [--only NAME]: our pictures against Mitsuba's, scene by scene (make check-peers).

Both render K pictures of each scene of peer_scenes.py, from fixed seeds. Of each block of 8 x 8 pixels, and of the whole picture,
the means have to be within 4 standard errors of a normal distribution; Student's t of the K pictures is translated to it
(Wallace 1959). Mitsuba renders parts of pixels, which are then filtered as ours are. Mitsuba's Beckmann follows its masking by a fit that is good to 0.35 %, once for each direction: there the
difference may be 0.7 % larger. The chance that a right renderer fails is at most the number of blocks times 6.3e-5; it is printed.

Then our scenes with a mistake have to disagree. Status 1: something did not hold. Needs the packages mitsuba and numpy, and build/lobe;
LLVM from version 16 on is found by DRJIT_LIBLLVM_PATH or where Debian has it, without it Mitsuba's scalar variant is compared.
"""
import argparse
import copy
import glob
import json
import math
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy

import peer_scenes
from pfm import read_pfm

LOBE = Path(__file__).resolve().parents[2] / "build/lobe"
BLOCK, LIMIT, BECKMANN_FIT = 8, 4.0, 0.007
# what a mistake does to our scene: (scene, options, change of a material)
MISTAKES = {
    "a roughness 5 % too great": ("ggx", {}, lambda m: m.update(roughness=1.05 * m["roughness"])),
    "an anisotropy 10 % too small": ("ggx brushed", {}, lambda m: m.update(strength=0.9 * m["strength"])),
    "GGX for Beckmann": ("beckmann", {"--ndf": "ggx"}, None),
    "light scattered twice at most": ("diffuse", {"--depth": "2"}, None),
    "a picture 1 % too bright": ("diffuse", {"--exposure": str(math.log2(1.01))}, None),
}


def options_of(name):
    _, distribution, conductor = peer_scenes.SCENES[name]
    options = {"--ndf": distribution, "--g2": "separable", "--depth": str(peer_scenes.DEPTH)}
    if conductor:
        options["--metal"] = "conductor:" + ",".join(str(x) for row in conductor for x in row)
    return options


def ours(parts, options, panorama, count, spp, folder):
    """Pictures of independent seeds and the seconds of processor time they took."""
    scene, out, pictures, seconds = folder / "scene.glb", folder / "out.pfm", [], 0.0
    peer_scenes.write_glb(parts, scene)
    for seed in range(1, count + 1):
        line = [LOBE, "render", scene, "--env", panorama, "--size", f"{peer_scenes.WIDTH}x{peer_scenes.HEIGHT}", "--spp",
                str(spp), "--seed", str(seed), "--threads", "2", "--strict", "--json", "-o", out]
        run = subprocess.run(line + [word for pair in options.items() for word in pair], stdout=subprocess.PIPE, check=True)
        seconds += json.loads(run.stdout)["cpu_seconds"]
        pictures.append(read_pfm(out))
    return numpy.array(pictures, dtype=float), seconds


def theirs(mitsuba, name, panorama, count, spp, folder):
    """The same, compiled before the clock starts, by paths a part of a pixel."""
    scene = peer_scenes.mitsuba_scene(mitsuba, name, panorama, folder)
    each = max(1, spp // peer_scenes.FINE ** 2)
    numpy.array(mitsuba.render(scene, spp=each, seed=0))
    seconds, pictures, paths = 0.0, [], 0
    for seed in range(1, count + 1):
        start = time.process_time()
        fine = numpy.array(mitsuba.render(scene, spp=each, seed=seed), dtype=float)
        seconds += time.process_time() - start
        paths += each * fine.shape[0] * fine.shape[1]
        pictures.append(peer_scenes.filtered(fine))
    return numpy.array(pictures), 1e-6 * paths / seconds


def block_means(pictures):
    """Of the mean of the channels: a row a picture, a column a block, the last one for all of it."""
    count, height, width, _ = pictures.shape
    grey = pictures.mean(axis=3).reshape(count, height // BLOCK, BLOCK, width // BLOCK, BLOCK)
    blocks = grey.mean(axis=(2, 4)).reshape(count, -1)
    return numpy.hstack([blocks, blocks.mean(axis=1, keepdims=True)])


def normal_of_student(t, freedom):
    """The value of a normal distribution with the tails of Student's t."""
    return (8 * freedom + 1) / (8 * freedom + 3) * numpy.sqrt(freedom * numpy.log1p(t ** 2 / freedom))


def distances(a, b, allowed):
    """Of each block, in standard errors. Welch's degrees of freedom; the floor is the rounding of even blocks."""
    a, b = block_means(a), block_means(b)
    va, vb = a.var(axis=0, ddof=1) / len(a), b.var(axis=0, ddof=1) / len(b)
    mean = (a.mean(axis=0) + b.mean(axis=0)) / 2
    error = va + vb + (1e-6 * mean) ** 2
    freedom = error ** 2 / (va ** 2 / (len(a) - 1) + vb ** 2 / (len(b) - 1) + 1e-300)
    excess = numpy.maximum(abs(a.mean(axis=0) - b.mean(axis=0)) - allowed * mean, 0)
    return normal_of_student(excess / numpy.sqrt(error), freedom), numpy.sqrt(error) / mean


def load_mitsuba():
    names = sorted(glob.glob("/usr/lib/*/libLLVM-1[6-9].so*") + glob.glob("/usr/lib/*/libLLVM.so.*"))
    if names:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", names[-1])
    import drjit
    import mitsuba
    if "DRJIT_LIBLLVM_PATH" not in os.environ:
        print("no LLVM from version 16 on: apt-get install libllvm16; the scalar variant is compared", file=sys.stderr)
        return mitsuba, "scalar_rgb"
    drjit.set_thread_count(2)  # with one, Mitsuba 3.9 does not go on
    return mitsuba, "llvm_ad_rgb"


def agree(result, parts, options, panorama, arguments, folder, name):
    _, distribution, _ = peer_scenes.SCENES[name]
    a, seconds = ours(parts, options, panorama, arguments.pictures, arguments.spp, folder)
    z, error = distances(a, result, BECKMANN_FIT if distribution == "beckmann" else 0.0)
    return z, error, seconds


def check_scene(mitsuba, variant, name, panorama, arguments, folder):
    mitsuba.set_variant(variant)
    result, vector = theirs(mitsuba, name, panorama, arguments.pictures, arguments.spp, folder)
    mitsuba.set_variant("scalar_rgb")
    _, scalar = theirs(mitsuba, name, panorama, 2, arguments.spp, folder)
    z, error, seconds = agree(result, peer_scenes.SCENES[name][0], options_of(name), panorama, arguments, folder, name)
    own = 1e-6 * peer_scenes.WIDTH * peer_scenes.HEIGHT * arguments.spp * arguments.pictures / seconds
    holds = z.max() < LIMIT
    print(f"{name:18}{z[:-1].max():8.2f}{z[-1]:9.2f}{100 * numpy.median(error[:-1]):10.2f} %"
          f"{own:8.2f}{vector:9.2f}{scalar:9.2f}"
          f"   {'agrees' if holds else 'DISAGREES'}", flush=True)
    return holds, result, len(z)


def check_mistake(label, results, panorama, arguments, folder):
    name, options, change = MISTAKES[label]
    parts = copy.deepcopy(peer_scenes.SCENES[name][0])
    for _, m in parts:
        if change and m["kind"] == "metal":
            change(m)
    z, _, _ = agree(results[name], parts, options_of(name) | options, panorama, arguments, folder, name)
    seen = z.max() >= LIMIT
    print(f"{label:32}{z[:-1].max():8.2f}{z[-1]:9.2f}   {'seen' if seen else 'NOT SEEN'}", flush=True)
    return seen


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pictures", type=int, default=24, help="of each scene and renderer [24]")
    parser.add_argument("--spp", type=int, default=128, help="camera paths a pixel [128]")
    parser.add_argument("--only", default="", help="scenes whose name begins so, and no mistakes")
    arguments = parser.parse_args()
    mitsuba, variant = load_mitsuba()
    names = [n for n in peer_scenes.SCENES if n.startswith(arguments.only)]
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        panorama = folder / "panorama.pfm"
        peer_scenes.write_panorama(panorama)
        print(f"Mitsuba {mitsuba.__version__}; {arguments.pictures} pictures of {peer_scenes.WIDTH} x {peer_scenes.HEIGHT}, "
              f"{arguments.spp} paths a pixel; million paths a second of processor time\n"
              f"{'difference in standard errors:':>35}{'error':>9}{'':11}{'Mitsuba':>16}\n"
              f"{'':18}{'worst':>8}{'whole':>9}{'of a block':>12}{'lobe':>8}{variant.split('_')[0]:>9}{'scalar':>9}")
        results, holds, blocks = {}, [], 0
        for name in names:
            held, results[name], count = check_scene(mitsuba, variant, name, panorama, arguments, folder)
            holds.append(held)
            blocks += count
        print(f"{blocks} means; a right renderer fails with a probability of at most {6.3e-5 * blocks:.1%}")
        if not arguments.only:
            print("\nMistakes of ours, to be seen:")
            holds += [check_mistake(label, results, panorama, arguments, folder) for label in MISTAKES]
    return 0 if all(holds) else 1


if __name__ == "__main__":
    sys.exit(main())
