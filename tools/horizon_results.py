#!/usr/bin/env python3
"""horizon_results.py [--quick] [--scenes PATTERN]: the numbers of docs/horizon-sampling.md, measured here.

Writes docs/horizon-results.md. Needs build/lobe, build/furnace_variance (make horizon-results makes
both) and NumPy. About twenty minutes on two idle cores; --quick: three.

Error of a picture: the variance between pictures of different seeds, pixel by pixel, relative to the
square of their mean over all methods, without the top 0.1 % of the pixels. All methods have the same
expectation (render.agreement), so no reference is needed, and none can be favoured by one.
"""
import argparse
import fnmatch
import json
import subprocess
import tempfile
from pathlib import Path

import numpy

ROOT = Path(__file__).resolve().parent.parent
LOBE = ROOT / "build/lobe"
SHARED = ROOT.parent / "shared/scenes"
METHODS = [("ellipsoid", []), ("caps", []), ("bounded", []), ("optimal", []),
           ("horizon-uniform", []), ("horizon", ["--floor", "0.5"]),
           ("horizon", ["--floor", "0.25"]), ("horizon", ["--floor", "0.1"]),
           ("horizon", ["--floor", "0"])]
BASE = ("bounded", [])


def title(method):
    name, options = method
    return f"{name} {options[1]}" if options else name


# ---- Lights and scenes -------------------------------------------------------------------------

def write_pfm(path, rgb):
    height, width, _ = rgb.shape
    with open(path, "wb") as file:
        file.write(f"PF\n{width} {height}\n-1.0\n".encode())
        file.write(rgb[::-1].astype("<f4").tobytes())


def sky(path, sun_degrees=None):
    """A smooth sky over a dark ground; with a sun of 2.5 degrees radius at this height."""
    height, width = 256, 512
    polar = (numpy.arange(height) + 0.5) / height * numpy.pi
    azimuth = ((numpy.arange(width) + 0.5) / width - 0.5) * 2 * numpy.pi
    up = numpy.cos(polar)[:, None, None] * numpy.ones((1, width, 1))
    rgb = numpy.where(up > 0, 0.5 + 0.8 * numpy.array([0.5, 0.7, 1.0]) * up, 0.12)
    if sun_degrees is not None:
        sun = numpy.radians(sun_degrees)
        cosine = (numpy.sin(polar)[:, None] * numpy.cos(azimuth - 0.9) * numpy.cos(sun)
                  + numpy.cos(polar)[:, None] * numpy.sin(sun))
        rgb = rgb + 500.0 * (cosine > numpy.cos(numpy.radians(2.5)))[:, :, None]
    write_pfm(path, rgb)


def mapped_quad(path, normal_map):
    """A rough metal floor with a normal map."""
    points = numpy.array([[-2, 0, 2], [2, 0, 2], [2, 0, -2], [-2, 0, -2]], "<f4")
    coordinates = numpy.array([[0, 2], [2, 2], [2, 0], [0, 0]], "<f4")
    indices = numpy.array([0, 1, 2, 0, 2, 3], "<u2")
    data = points.tobytes() + coordinates.tobytes() + indices.tobytes()
    Path(path).with_suffix(".bin").write_bytes(data)
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
             {"buffer": 0, "byteOffset": 48, "byteLength": 32},
             {"buffer": 0, "byteOffset": 80, "byteLength": 12}]
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                  "min": [-2, 0, -2], "max": [2, 0, 2]},
                 {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
                 {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}]
    metal = {"baseColorFactor": [0.9, 0.8, 0.6, 1], "metallicFactor": 1, "roughnessFactor": 0.6}
    Path(path).write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "buffers": [{"uri": Path(path).with_suffix(".bin").name,
                                             "byteLength": len(data)}],
        "bufferViews": views, "accessors": accessors,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2,
                                    "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": metal, "normalTexture": {"index": 0}}],
        "textures": [{"source": 0}], "images": [{"uri": Path(normal_map).name}]}))
    Path(path).with_name(Path(normal_map).name).write_bytes(Path(normal_map).read_bytes())


def scenes(folder):
    """Name and arguments of each scene."""
    smooth, high, low = (folder / f"{name}.pfm" for name in ("smooth", "high", "low"))
    sky(smooth)
    sky(high, 60)
    sky(low, 3)
    lights = [("smooth sky", smooth), ("high sun", high), ("low sun", low)]
    table = [("gallery, its soft box", ["gallery"]), ("cornell, lamp in a box", ["cornell"])]
    for name, light in lights:
        table.append((f"gallery, {name}", ["gallery", "--env", light]))
        table.append((f"brushed, {name}", ["brushed", "--env", light]))
        table.append((f"normal-mapped, {name}", ["normal-mapped", "--env", light]))
    if SHARED.is_dir():
        bunny = [SHARED / "models/stanford-bunny.obj", "--material", "0.95,0.64,0.54,1,0.7"]
        for name, light in lights:
            table.append((f"bunny, {name}", bunny + ["--env", light]))
        barrel = SHARED / "models/barrel.glb"
        for panorama in ("venice", "studio"):
            light = SHARED / f"environments/{panorama}.exr"
            table.append((f"barrel, {panorama}", [barrel, "--env", light]))
        for normal_map in ("rough-weave", "waves"):
            quad = folder / f"{normal_map}.gltf"
            mapped_quad(quad, SHARED / f"normal-maps/{normal_map}.png")
            light = SHARED / "environments/venice.exr"
            table.append((f"{normal_map} floor, venice", [quad, "--env", light]))
    return table


# ---- Rendering ---------------------------------------------------------------------------------

def read_pfm(path):
    with open(path, "rb") as file:
        assert file.readline().strip() == b"PF"
        width, height = map(int, file.readline().split())
        assert float(file.readline()) < 0
        return numpy.frombuffer(file.read(), "<f4").reshape(height, width, 3).astype(float)


def render(arguments, method, seed, size, spp, folder):
    """The picture, CPU seconds and rejected share."""
    name, options = method
    out = folder / "picture.pfm"
    run = subprocess.run([LOBE, "render", *arguments, "-o", out, "--size", size, "--spp", str(spp),
                          "--seed", str(seed), "--method", name, *options, "--json"],
                         check=True, capture_output=True, text=True)
    said = json.loads(run.stdout)
    return read_pfm(out), said["cpu_seconds"], said["rejected_share"]


def measure(arguments, size, spp, seeds, folder):
    """For each method: error of every pair of seeds, CPU seconds, rejected share."""
    pictures = {title(m): [] for m in METHODS}
    seconds = {title(m): [] for m in METHODS}
    rejected = {}
    for seed in range(seeds):  # interleaved: a slow moment meets every method
        for method in METHODS:
            picture, time, share = render(arguments, method, seed + 1, size, spp, folder)
            pictures[title(method)].append(picture)
            seconds[title(method)].append(time)
            rejected[title(method)] = share
    mean = numpy.mean([p for list_ in pictures.values() for p in list_], axis=0)
    scale = mean ** 2 + 1e-4 * numpy.mean(mean) ** 2
    kept = None
    rows = {}
    for name, list_ in pictures.items():
        variance = numpy.var(list_, axis=0, ddof=1) / scale
        error = variance.mean(axis=2).ravel()
        # the same pixels for all: those where the first method's error is not extreme
        if kept is None:
            kept = error <= numpy.quantile(error, 0.999)
        halves = [numpy.var(list_[k::2], axis=0, ddof=1) / scale for k in range(2)]
        spread = [h.mean(axis=2).ravel()[kept].mean() for h in halves]
        rows[name] = {"error": error[kept].mean(), "halves": spread,
                      "seconds": float(numpy.median(seconds[name])), "rejected": rejected[name]}
    return rows


# ---- Tables ------------------------------------------------------------------------------------

def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def gain(rows, name, with_time):
    base, row = rows[title(BASE)], rows[name]
    value = base["error"] / row["error"]
    return value * base["seconds"] / row["seconds"] if with_time else value


def scene_tables(results):
    names = [title(m) for m in METHODS]
    head = ["scene"] + names
    samples, times, rejected = [], [], []
    for scene, rows in results:
        noise = max(abs(h / rows[n]["error"] - 1) for n in names for h in rows[n]["halves"])
        samples.append([scene] + [f"{gain(rows, n, False):.2f}" for n in names]
                       + [f"{100 * noise:.0f} %"])
        times.append([scene] + [f"{gain(rows, n, True):.2f}" for n in names])
        rejected.append([scene] + [f"{100 * rows[n]['rejected']:.2f}" for n in names])
    for list_, with_time in ((samples, False), (times, True)):
        means = [numpy.exp(numpy.mean([numpy.log(gain(r, n, with_time)) for _, r in results]))
                 for n in names]
        list_.append(["geometric mean"] + [f"{m:.2f}" for m in means] + ([""] * (not with_time)))
    return (table(head + ["halves differ"], samples), table(head, times), table(head, rejected))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--scenes", default="*", help="shell pattern of scene names")
    parser.add_argument("--out", default=ROOT / "docs/horizon-results.md", type=Path)
    arguments = parser.parse_args()
    size, spp, seeds = ("128x72", 8, 4) if arguments.quick else ("256x144", 16, 8)
    variance = subprocess.run([ROOT / "build/furnace_variance"], check=True, capture_output=True,
                              text=True).stdout
    bench = subprocess.run([LOBE, "bench", "--only", "smith [bho]* * f32"]
                           + (["--quick"] if arguments.quick else []),
                           check=True, capture_output=True, text=True).stdout
    results = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for scene, call in scenes(folder):
            if not fnmatch.fnmatch(scene, arguments.scenes):
                continue
            results.append((scene, measure(call, size, spp, seeds, folder)))
            print(scene, {n: round(gain(results[-1][1], n, False), 2) for n in results[-1][1]},
                  flush=True)
    samples, times, rejected = scene_tables(results)
    arguments.out.write_text(f"""# Horizon sampling: what was measured

Written by `make horizon-results` (tools/horizon_results.py). The article is [horizon-sampling.md](horizon-sampling.md).

## White furnace

{variance}
## In the path tracer: error at equal samples

Variance of `bounded` over that of the method, with emitter sampling; {size}, {spp} samples a pixel, {seeds} seeds. "Halves
differ": the largest deviation of an error that half of the seeds gives.

{samples}
## At equal time

The same, times CPU seconds of `bounded` over those of the method.

{times}
## Rejected draws, per cent

{rejected}
## Time of a draw

`lobe bench`:

```
{bench}```
""")


if __name__ == "__main__":
    main()
