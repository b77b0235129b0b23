#!/usr/bin/env python3
"""normal_mapped_results.py [--quick]: the experiment of Tokuyoshi 2021, section 3, measured here.

Writes docs/normal-mapped-results.md and docs/normal-mapped.png. Needs build/lobe, NumPy, Pillow
and OpenImageIO (python3-numpy, python3-pil, python3-openimageio). About twenty minutes on two cores;
--quick: four.

The reference of each model draws all normals (`ndf`) and the lights: its density knows nothing of visible
normals, so no normalisation can bias it. The pictures draw visible normals alone (--heuristic bsdf-only),
as the paper does. Blocks are 16 x 16 pixels; their standard error comes from pictures of several seeds.
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import numpy
import OpenImageIO
from PIL import Image, ImageDraw

from horizon_results import LOBE, ROOT, SHARED, mapped_quad, sky, table

MODELS = [("Smith–GGX", ["--ndf", "ggx", "--masking", "smith"], "ellipsoid"),
          ("Smith–Beckmann", ["--ndf", "beckmann", "--masking", "smith"], "newton"),
          ("V-cavity–GGX", ["--ndf", "ggx", "--masking", "vcavity"], "vcavity"),
          ("V-cavity–Beckmann", ["--ndf", "beckmann", "--masking", "vcavity"], "vcavity")]
BLOCK = 16


def add_low_camera(path):
    """Close above the floor: there the normals turn away."""
    scene = json.loads(Path(path).read_text())
    half = numpy.radians(-9) / 2
    scene["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.45, "aspectRatio": 5 / 3,
                                                                "znear": 0.01}}]
    scene["nodes"].append({"camera": 0, "translation": [0, 0.62, 3.6],
                           "rotation": [numpy.sin(half), 0, 0, numpy.cos(half)]})
    scene["scenes"][0]["nodes"].append(1)
    Path(path).write_text(json.dumps(scene))


def scenes(folder):
    light = folder / "sky.pfm"
    sky(light)
    table = [("normal-mapped wall", ["normal-mapped", "--env", light])]
    if SHARED.is_dir():
        for name in ("sponza_floor_a_ddn.tga", "spnza_bricks_a_ddn.tga", "lion_ddn.tga"):
            quad = folder / f"{Path(name).stem}.gltf"
            mapped_quad(quad, SHARED / f"crytek-sponza-textures/{name}")
            add_low_camera(quad)
            table.append((f"floor, {name}", [quad, "--env", light]))
    return table


def channels(path, names):
    file = OpenImageIO.ImageInput.open(str(path))
    pixels = file.read_image("float")
    known = file.spec().channelnames
    return numpy.stack([pixels[:, :, known.index(n)] for n in names], axis=2).astype(float)


def render(arguments, seed, size, spp, folder):
    """The picture and the integral of the density at each pixel."""
    out = folder / "picture.exr"
    subprocess.run([LOBE, "render", *arguments, "-o", out, "--size", size, "--spp", str(spp),
                    "--depth", "1", "--seed", str(seed), "--aov", "vndf-integral"],
                   check=True, capture_output=True)
    return channels(out, "RGB"), channels(out, ["vndf-integral.Y"])[:, :, 0]


def mean_and_error(pictures):
    """The mean over seeds, of each block its mean and standard error, and the gray pictures."""
    gray = numpy.array([p.mean(axis=2) for p in pictures])
    count, height, width = gray.shape
    rows, columns = height // BLOCK, width // BLOCK
    blocks = gray[:, :rows * BLOCK, :columns * BLOCK]
    blocks = blocks.reshape(count, rows, BLOCK, columns, BLOCK).mean(axis=(2, 4))
    return (numpy.mean(pictures, axis=0), blocks.mean(axis=0),
            blocks.std(axis=0, ddof=1) / numpy.sqrt(count), gray)


class Measured:
    """One model in one scene: the reference, and the pictures of both normalisations."""

    def __init__(self, scene, model, method, size, spp, seeds, folder):
        def many(options, samples, first):
            return [render([*scene, *model, *options], first + s, size, samples, folder)
                    for s in range(seeds)]
        self.reference = mean_and_error([p for p, _ in many(["--method", "ndf"], 2 * spp, 100)])
        self.picture, self.integral = {}, {}
        for kind in ("previous", "unbiased"):
            made = many(["--method", method, "--heuristic", "bsdf-only", "--normalization", kind],
                        spp, 1)
            self.picture[kind] = mean_and_error([p for p, _ in made])
            self.integral[kind] = numpy.mean([i for _, i in made], axis=0)
        self.biased = self.integral["previous"] < 0.99

    def brightness(self, kind, where):
        """By how much the mean over these pixels is off, with its standard error, in per cent."""
        if not where.any():
            return "–"
        picture, reference = (p[3][:, where].mean(axis=1) for p in (self.picture[kind], self.reference))
        if not numpy.isfinite(picture).all():
            return "pixels overflow"  # a half holds 65,504
        ratio = picture.mean() / reference.mean()
        spread = numpy.hypot(*(p.std(ddof=1) / numpy.sqrt(len(p)) / p.mean() for p in (picture, reference)))
        return f"{100 * (ratio - 1):+.2f} ± {100 * ratio * spread:.2f} %"

    def worst_block(self, kind):
        _, mean, error, _ = self.picture[kind]
        _, expected, error_expected, _ = self.reference
        spread = numpy.hypot(error, error_expected)
        # the sky's blocks have no noise
        seen = (spread > 1e-6 * expected.mean()) & numpy.isfinite(mean) & numpy.isfinite(error)
        return numpy.max(numpy.abs(mean - expected)[seen] / spread[seen])

    def row(self, scene, name):
        everywhere = numpy.ones_like(self.biased)
        cells = [scene, name, f"{100 * self.biased.mean():.1f} %",
                 f"{self.integral['previous'].min():.2f}"]
        for kind in ("previous", "unbiased"):
            cells += [self.brightness(kind, everywhere), self.brightness(kind, self.biased),
                      f"{self.worst_block(kind):.1f}"]
        return cells


# ---- The sheet -----------------------------------------------------------------------------------

def to_srgb(rgb):
    rgb = numpy.clip(rgb, 0, 1)
    return numpy.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1 / 2.4) - 0.055)


def diverging(value):
    """-1 blue, 0 white, 1 red: safe for the colour-blind."""
    value = numpy.clip(value, -1, 1)[:, :, None]
    red, blue = numpy.array([0.70, 0.09, 0.17]), numpy.array([0.13, 0.40, 0.67])
    return 1 - numpy.abs(value) * (1 - numpy.where(value > 0, red, blue))


def sheet(rows, path):
    """Rows of models; previous: picture, error, integral; unbiased: picture, error."""
    heads = ["previous", "error (±20 %)", "VNDF integral", "unbiased", "error (±20 %)"]
    tiles = []
    for name, m in rows:
        reference = m.reference[0]
        line = []
        for kind in ("previous", "unbiased"):
            picture = m.picture[kind][0]
            error = (picture - reference).mean(axis=2) / numpy.maximum(reference.mean(axis=2), 0.02)
            line += [to_srgb(picture), diverging(error / 0.2)]
            if kind == "previous":
                line.append(numpy.repeat(m.integral[kind][:, :, None], 3, axis=2))
        tiles.append((name, line))
    height, width = tiles[0][1][0].shape[:2]
    image = Image.new("RGB", (110 + 5 * (width + 4), 22 + len(tiles) * (height + 4)), "white")
    draw = ImageDraw.Draw(image)
    for k, head in enumerate(heads):
        draw.text((112 + k * (width + 4), 6), head, fill="black")
    for r, (name, line) in enumerate(tiles):
        y = 22 + r * (height + 4)
        draw.text((4, y + height // 2), name.replace("–", "-"), fill="black")
        for k, tile in enumerate(line):
            pixels = (255 * numpy.clip(tile, 0, 1) + 0.5).astype("u1")
            image.paste(Image.fromarray(pixels), (110 + k * (width + 4), y))
    image.save(path, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    size, spp, seeds = ("160x96", 48, 8) if arguments.quick else ("240x144", 128, 8)
    rows, shown = [], []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for scene, call in scenes(folder):
            for model, options, method in MODELS:
                m = Measured(call, options, method, size, spp, seeds, folder)
                rows.append(m.row(scene, model))
                print(*rows[-1], flush=True)
                if scene == "normal-mapped wall":
                    shown.append((model, m))
    sheet(shown, ROOT / "docs/normal-mapped.png")
    head = ["scene", "model", "pixels with integral < 0.99", "least integral", "previous: brightness",
            "there", "worst block", "unbiased: brightness", "there", "worst block"]
    (ROOT / "docs/normal-mapped-results.md").write_text(f"""# Back-facing shading normals: what was measured

Written by `tools/normal_mapped_results.py{' --quick' if arguments.quick else ''}`: {size}, {spp} samples a pixel, {seeds} seeds, one scattering, under a
smooth sky. The reference of each model draws all normals and the lights. "Brightness": by how much the mean is off,
of the whole picture and of the pixels whose density does not integrate to one; "worst block": the largest
difference of a 16 × 16 block from the reference, in standard errors.

{table(head, rows)}
![The experiment: by rows the models; previous normalisation, its error, the integral of its density; the unbiased normalisation and its error](normal-mapped.png)
""")


if __name__ == "__main__":
    main()
