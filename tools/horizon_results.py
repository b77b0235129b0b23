#!/usr/bin/env python3
"""horizon_results.py [--quick | --full] [--scenes PATTERN] [--out FILE]: the numbers of
docs/horizon-sampling.md, measured here.

Writes docs/horizon-results.md and beside it horizon-samples.svg, horizon-time.svg. Needs build/lobe,
build/furnace_variance (make horizon-results makes both) and NumPy; without ../shared/scenes only the built-in
scenes are measured. About twelve minutes on two idle cores; --quick: four, --full: forty.

Error of a picture: the variance between pictures of different seeds, pixel by pixel. All methods have the
same expectation (render.agreement), so no reference is needed, and none can be favoured by one. Relative
(relMSE): divided pixel by pixel by the square of the mean over all methods; absolute (RMSE): the root of the
mean over the picture. Both without the pixels of the top 0.1 % of all methods together, the same for all.
An error bar is one standard error, from the spread over the seeds.
"""
import argparse
import fnmatch
import json
import os
import subprocess
import tempfile
from pathlib import Path

import numpy

ROOT = Path(__file__).resolve().parent.parent
LOBE = ROOT / "build/lobe"
SHARED = ROOT.parent / "shared/scenes"
METHODS = [("ellipsoid", []), ("caps", []), ("bounded", []), ("optimal", []),
           ("horizon-mirror", []), ("horizon-uniform", []), ("horizon", ["--floor", "0.5"]),
           ("horizon", ["--floor", "0.25"]), ("horizon", ["--floor", "0.1"]),
           ("horizon", ["--floor", "0"]), (None, [])]
BASE = ("bounded", [])


def title(method):
    name, options = method
    if name is None:
        return "default"
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


# Every normal map under another panorama.
FLOORS = [("leather", "forest"), ("rock", "hall"), ("rough-weave", "venice"), ("steps", "night"),
          ("tiles", "sunset"), ("waves", "sky")]


def shared_scenes(folder, skies):
    """Those that need ../shared/scenes."""
    def panorama(name):
        return SHARED / f"environments/{name}.exr"

    bunny = [SHARED / "models/stanford-bunny.obj", "--material", "0.95,0.64,0.54,1,0.7"]
    barrel = [SHARED / "models/barrel.glb"]
    table = [(f"bunny, {name}", bunny + ["--env", light]) for name, light in skies]
    table += [("bunny, workshop lamps", bunny + ["--env", panorama("workshop")]),
              ("brushed, studio lamps", ["brushed", "--env", panorama("studio")])]
    table += [(f"barrel, {name}", barrel + ["--env", panorama(name)]) for name in ("venice", "studio")]
    for normal_map, name in FLOORS:
        quad = folder / f"{normal_map}.gltf"
        mapped_quad(quad, SHARED / f"normal-maps/{normal_map}.png")
        table.append((f"{normal_map} floor, {name}", [quad, "--env", panorama(name)]))
    return table


def scenes(folder):
    """Name and arguments of each scene."""
    smooth, high, low = (folder / f"{name}.pfm" for name in ("smooth", "high", "low"))
    sky(smooth)
    sky(high, 60)
    sky(low, 3)
    skies = [("smooth sky", smooth), ("high sun", high), ("low sun", low)]
    table = [("gallery, its soft box", ["gallery"]), ("cornell, lamp in a box", ["cornell"])]
    for scene in ("gallery", "brushed", "normal-mapped"):
        table += [(f"{scene}, {name}", [scene, "--env", light]) for name, light in skies]
    return table + (shared_scenes(folder, skies) if SHARED.is_dir() else [])


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
    chosen = [] if name is None else ["--method", name]
    out = folder / "picture.pfm"
    run = subprocess.run([LOBE, "render", *arguments, "-o", out, "--size", size, "--spp", str(spp),
                          "--seed", str(seed), *chosen, *options, "--json"],
                         check=True, capture_output=True, text=True)
    said = json.loads(run.stdout)
    return read_pfm(out), said["cpu_seconds"], said["rejected_share"]


def variances(pictures, scale):
    """Of each seed its share of the unbiased variance, pixel by pixel."""
    mean = numpy.mean(pictures, axis=0)
    return [(p - mean) ** 2 / scale * (len(pictures) / (len(pictures) - 1)) for p in pictures]


def summary(pictures, scale):
    """For each method the mean over pixels, and its standard error from the spread over seeds."""
    errors = {n: [v.mean(axis=2) for v in variances(p, scale)] for n, p in pictures.items()}
    total = sum(e for list_ in errors.values() for e in list_)
    kept = total <= numpy.quantile(total, 0.999)
    values = {n: [e[kept].mean() for e in list_] for n, list_ in errors.items()}
    return {n: (float(numpy.mean(v)), float(numpy.std(v, ddof=1) / numpy.sqrt(len(v))))
            for n, v in values.items()}


def measure(arguments, size, spp, seeds, folder):
    """For each method: errors, CPU seconds, rejected share."""
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
    relative = summary(pictures, mean ** 2 + 1e-4 * numpy.mean(mean) ** 2)
    absolute = summary(pictures, 1.0)
    return {n: {"relmse": relative[n], "mse": absolute[n],
                "seconds": float(numpy.median(seconds[n])), "rejected": rejected[n]}
            for n in pictures}


# ---- Tables ------------------------------------------------------------------------------------

NAMES = [title(m) for m in METHODS]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def gain(rows, name, with_time):
    """By how much less error than the base, and its standard error."""
    base, row = rows[title(BASE)], rows[name]
    value = base["relmse"][0] / row["relmse"][0]
    if with_time:
        value *= base["seconds"] / row["seconds"]
    if name == title(BASE):
        return 1.0, 0.0
    spread = [r["relmse"][1] / r["relmse"][0] for r in (base, row)]
    return value, value * float(numpy.hypot(*spread))


def geometric_mean(results, name, with_time):
    return float(numpy.exp(numpy.mean([numpy.log(gain(rows, name, with_time)[0])
                                       for _, rows in results])))


def gain_table(results, with_time):
    lines = []
    for scene, rows in results:
        gains = [gain(rows, n, with_time) for n in NAMES]
        error = max(e / g for g, e in gains)
        lines.append([scene] + [f"{g:.2f}" for g, _ in gains] + [f"{100 * error:.0f} %"])
    lines.append(["geometric mean"] + [f"{geometric_mean(results, n, with_time):.2f}" for n in NAMES]
                 + [""])
    lines.append(["least"] + [f"{min(gain(r, n, with_time)[0] for _, r in results):.2f}"
                              for n in NAMES] + [""])
    return table(["scene"] + NAMES + ["largest standard error"], lines)


def value_table(results, value):
    return table(["scene"] + NAMES, [[scene] + [value(rows[n]) for n in NAMES]
                                     for scene, rows in results])


# ---- Plots -------------------------------------------------------------------------------------

SHOWN = [("optimal", "#8a8a8a"), ("horizon-uniform", "#2a78d6"), ("horizon 0.25", "#1baf7a"),
         ("default", "#eb6834")]
STYLE = """text{font:13px sans-serif;fill:#222}.faint{stroke:#ddd}.one{stroke:#777}
@media(prefers-color-scheme:dark){svg{background:#161616}text{fill:#e4e4e4}.faint{stroke:#333}.one{stroke:#999}}"""


def plot(results, with_time, title_text):
    """One row a scene: gains over bounded caps on a logarithmic axis, with standard errors."""
    left, width, row, low, high = 230, 560, 22, 0.4, 2.5

    def x_of(value):
        share = numpy.log(min(max(value, low), high) / low) / numpy.log(high / low)
        return left + width * share

    rows = results + [("geometric mean", None)]
    bottom = 70 + row * len(rows)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {left + width + 30} {bottom + 34}" '
           f'role="img"><title>{title_text}</title><style>{STYLE}</style>',
           f'<text x="{left}" y="20">{title_text}</text>']
    for k, (name, color) in enumerate(SHOWN):
        out.append(f'<circle cx="{left + 6 + 140 * k}" cy="40" r="5" fill="{color}"/>'
                   f'<text x="{left + 16 + 140 * k}" y="45">{name}</text>')
    for tick in (0.5, 0.7, 1, 1.4, 2):
        out.append(f'<line class="{"one" if tick == 1 else "faint"}" x1="{x_of(tick):.1f}" '
                   f'x2="{x_of(tick):.1f}" y1="58" y2="{bottom}"/><text text-anchor="middle" '
                   f'x="{x_of(tick):.1f}" y="{bottom + 18}">{tick:g}</text>')
    for k, (scene, measured) in enumerate(rows):
        y = 72 + row * k
        out.append(f'<text text-anchor="end" x="{left - 10}" y="{y + 5}">{scene}</text>')
        for j, (name, color) in enumerate(SHOWN):
            value, error = (gain(measured, name, with_time) if measured
                            else (geometric_mean(results, name, with_time), 0.0))
            place = y + 3 * (j - 1.5)
            out.append(f'<line stroke="{color}" x1="{x_of(value - error):.1f}" '
                       f'x2="{x_of(value + error):.1f}" y1="{place:.1f}" y2="{place:.1f}"/>'
                       f'<circle cx="{x_of(value):.1f}" cy="{place:.1f}" r="4" fill="{color}"/>')
    return "\n".join(out + ["</svg>"]) + "\n"


def machine():
    """The processor's name and how many of it."""
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return f"{os.cpu_count()} cores of {line.split(':')[1].strip()}"
    return f"{os.cpu_count()} cores"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    sizes = parser.add_mutually_exclusive_group()
    sizes.add_argument("--quick", action="store_true", help="four minutes")
    sizes.add_argument("--full", action="store_true", help="forty minutes")
    parser.add_argument("--scenes", default="*", help="shell pattern of scene names")
    parser.add_argument("--out", default=ROOT / "docs/horizon-results.md", type=Path)
    arguments = parser.parse_args()
    size, spp, seeds = ("128x72", 8, 4) if arguments.quick else ("192x108", 16, 6)
    if arguments.full:
        size, spp, seeds = "256x144", 16, 12
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
            print(scene, {n: round(gain(results[-1][1], n, False)[0], 2) for n in NAMES}, flush=True)
    for stem, with_time, text in (
            ("horizon-samples", False, "Error of bounded caps over that of the method, equal samples"),
            ("horizon-time", True, "Error of bounded caps over that of the method, equal time")):
        arguments.out.with_name(stem + ".svg").write_text(plot(results, with_time, text))
    kind = " --quick" if arguments.quick else " --full" if arguments.full else ""
    arguments.out.write_text(f"""# Horizon sampling: what was measured

Written by `tools/horizon_results.py{kind}` on {machine()}. The article is [horizon-sampling.md](horizon-sampling.md).

## White furnace

{variance}
## In the path tracer: error at equal samples

relMSE of `bounded` over that of the method, with emitter sampling; {size}, {spp} samples a pixel, {seeds} seeds.
`horizon-uniform` stands for δ = 1, in the smaller ellipse under normal maps; `default` is what `lobe render` takes
by surface where no method is asked for. Last column: the largest standard error of a number of the row.

![Gains at equal samples](horizon-samples.svg)

{gain_table(results, False)}
## At equal time

The same, times CPU seconds of `bounded` over those of the method.

![Gains at equal time](horizon-time.svg)

{gain_table(results, True)}
## Errors

relMSE, in thousandths:

{value_table(results, lambda r: f"{1e3 * r['relmse'][0]:.3g}")}
RMSE:

{value_table(results, lambda r: f"{r['mse'][0] ** 0.5:.3g}")}
## CPU seconds of a picture

{value_table(results, lambda r: f"{r['seconds']:.3f}")}
## Rejected draws, per cent

{value_table(results, lambda r: f"{100 * r['rejected']:.2f}")}
## Time of a draw

`lobe bench`:

```
{bench}```
""")


if __name__ == "__main__":
    main()
