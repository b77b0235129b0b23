#!/usr/bin/env python3
"""flip_reference.py: the values of tests/metrics/test_flip.c, by the authors' own program.

Needs NumPy and the package flip-evaluator (pip install flip-evaluator).
"""
import flip_evaluator
import numpy

WIDTH, HEIGHT = 72, 54


def pictures():
    """Picture and reference in linear RGB; the C side makes the same ones from the same integers."""
    y, x, c = numpy.meshgrid(numpy.arange(HEIGHT), numpy.arange(WIDTH), numpy.arange(3), indexing="ij")
    reference = ((x * (c + 1) + 2 * y) % 64) / 64.0
    noise = ((x * 11 + y * 17 + c * 5) % 16 - 7) / 32.0 * (x > 20)
    bright = numpy.where((x // 12 + y // 12) % 3 == 0, 8.0, 1.0)
    picture = numpy.maximum(reference + noise, 0)
    return (picture * bright).astype("f4"), (reference * bright).astype("f4")


def srgb(linear):
    c = numpy.clip(linear, 0, 1).astype(float)
    return numpy.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055).astype("f4")


def main():
    picture, reference = pictures()
    for name, (a, b) in {"LDR": (srgb(reference), srgb(picture)), "HDR": (reference, picture)}.items():
        map_, mean, _ = flip_evaluator.evaluate(a, b, name, name == "LDR", False)
        map_ = numpy.reshape(map_, (HEIGHT, WIDTH))
        print(name, f"mean {mean:.6f}", *(f"({x}, {y}) {map_[y, x]:.6f}"
                                          for x, y in ((0, 0), (30, 20), (71, 53), (24, 40))))


if __name__ == "__main__":
    main()
