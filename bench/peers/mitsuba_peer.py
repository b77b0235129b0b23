#!/usr/bin/env python3
"""mitsuba_peer.py [--rows N] [--repeats N]: draws with density, ours beside Mitsuba 3's on one thread.

Needs build/liblobe.so (make) and the packages mitsuba and numpy of the Python registry. Mitsuba's LLVM
variant needs libLLVM 16 or later, as from Debian's libllvm19, named by DRJIT_LIBLLVM_PATH. Both read the same u1, u2 and wi from memory and write the
normal and its density; Mitsuba's kernels are traced and compiled before the clock starts. Prints a
table: median and spread of ns a draw, the time of a plain copy of the same bytes, and how far
Mitsuba's densities are from ours at its own directions.
"""
import argparse
import ctypes
import time
from pathlib import Path

import drjit
import mitsuba
import numpy

ROOT = Path(__file__).resolve().parents[2]
ALPHA = 0.3


class Options(ctypes.Structure):  # lobe_reflection_options
    _fields_ = [("ndf", ctypes.c_int), ("masking", ctypes.c_int), ("method", ctypes.c_int),
                ("g2", ctypes.c_int), ("normalization", ctypes.c_int), ("floor", ctypes.c_double)]


class View(ctypes.Structure):  # lobe_in_f32, lobe_out_f32
    _fields_ = [("data", ctypes.c_void_p), ("stride", ctypes.c_ssize_t)]


class SampleBatch(ctypes.Structure):  # lobe_sample_batch_f32
    _fields_ = [("count", ctypes.c_size_t), ("prepared", ctypes.c_void_p), ("options", Options),
                ("wi", View * 3), ("alpha", View * 2), ("u", View * 3), ("seed", ctypes.c_uint64),
                ("offset", ctypes.c_uint64), ("m", View * 3), ("wo", View * 3), ("cos_im", View),
                ("pdf_m", View), ("pdf", View), ("weight", View)]


class EvalBatch(ctypes.Structure):  # lobe_eval_batch_f32
    _fields_ = [("count", ctypes.c_size_t), ("prepared", ctypes.c_void_p), ("options", Options),
                ("wi", View * 3), ("alpha", View * 2), ("wo", View * 3), ("pdf", View),
                ("f_cos", View), ("cos_im", View)]


def load_lobe():
    library = ctypes.CDLL(str(ROOT / "build/liblobe.so"))
    library.lobe_isa.restype = ctypes.c_char_p
    library.lobe_reflection_default_options.restype = Options
    return library


def view(array, stride=1):
    return View(array.ctypes.data, stride)


def views(arrays):
    return (View * len(arrays))(*[view(a) for a in arrays])


class Draws:
    """The inputs, and where we write."""

    def __init__(self, rows):
        random = numpy.random.default_rng(1)
        self.rows = rows
        self.u = list(random.random((2, rows), dtype=numpy.float32))
        z = random.random(rows) * 0.95 + 0.05
        turn = 2 * numpy.pi * random.random(rows)
        radius = numpy.sqrt(1 - z * z)
        self.wi = [a.astype(numpy.float32) for a in (radius * numpy.cos(turn), radius * numpy.sin(turn), z)]
        self.alpha = numpy.array([ALPHA], numpy.float32)
        self.m = [numpy.empty(rows, numpy.float32) for _ in range(3)]
        self.pdf = numpy.empty(rows, numpy.float32)

    def options(self, library, ndf, method):
        options = library.lobe_reflection_default_options()
        options.ndf, options.method = ndf, method
        return options


def lobe_draw(library, draws, options):
    batch = SampleBatch(count=draws.rows, options=options)
    batch.wi = views(draws.wi)
    batch.alpha = (View * 2)(*[view(draws.alpha, 0)] * 2)
    batch.u[0], batch.u[1] = view(draws.u[0]), view(draws.u[1])
    batch.m = views(draws.m)
    batch.pdf_m = view(draws.pdf)
    return lambda: library.lobe_reflection_sample_batch_f32(ctypes.byref(batch))


def lobe_density(library, draws, options, wo):
    """Of directions, at given ones."""
    pdf = numpy.empty(draws.rows, numpy.float32)
    batch = EvalBatch(count=draws.rows, options=options)
    batch.wi, batch.wo = views(draws.wi), views(wo)
    batch.alpha = (View * 2)(*[view(draws.alpha, 0)] * 2)
    batch.pdf = view(pdf)
    library.lobe_reflection_eval_batch_f32(ctypes.byref(batch))
    return pdf


def mitsuba_draw(draws, ndf):
    wi = mitsuba.Vector3f(*draws.wi)
    u = mitsuba.Point2f(*draws.u)
    drjit.eval(wi, u)
    kind = mitsuba.MicrofacetType.GGX if ndf == "ggx" else mitsuba.MicrofacetType.Beckmann
    distribution = mitsuba.MicrofacetDistribution(kind, ALPHA, ALPHA, True)

    def run():
        run.result = distribution.sample(wi, u)
        drjit.eval(run.result)
        drjit.sync_thread()
    return run


def copy(draws):
    source = numpy.concatenate(draws.u + draws.wi)
    target = numpy.empty(4 * draws.rows, numpy.float32)

    def run():
        target[:] = source[:len(target)]
    return run


def scalar_nanoseconds(ndf, rows=20000):
    """Mitsuba's scalar variant has no loop of its own: Python calls it row by row, so only the shortest
    call time can be told apart from Python's, by taking off that of an empty call."""
    mitsuba.set_variant("scalar_rgb")
    kind = mitsuba.MicrofacetType.GGX if ndf == "ggx" else mitsuba.MicrofacetType.Beckmann
    distribution = mitsuba.MicrofacetDistribution(kind, ALPHA, ALPHA, True)
    wi, u = mitsuba.Vector3f(0.6, 0, 0.8), mitsuba.Point2f(0.3, 0.7)
    times = {}
    for name, call in (("sample", lambda: distribution.sample(wi, u)), ("nothing", distribution.alpha_u)):
        start = time.perf_counter()
        for _ in range(rows):
            call()
        times[name] = time.perf_counter() - start
    return 1e9 * (times["sample"] - times["nothing"]) / rows


def interleaved(runs, repeats):
    """Seconds of every run, in turn, so that a slow moment meets all."""
    seconds = {name: [] for name in runs}
    for _ in range(repeats):
        for name, run in runs.items():
            start = time.perf_counter()
            run()
            seconds[name].append(time.perf_counter() - start)
    return seconds


def compare(library, draws, options, run):
    """Largest relative difference of Mitsuba's density from ours at its directions, and its NaNs."""
    m, pdf_m = run.result
    m = [numpy.array(c) for c in (m.x, m.y, m.z)]
    pdf_m = numpy.array(pdf_m)
    nan = int(numpy.sum(~numpy.isfinite(pdf_m)))
    cosine = sum(a.astype(float) * b for a, b in zip(m, draws.wi))
    wo = [(2 * cosine * a - b).astype(numpy.float32) for a, b in zip(m, draws.wi)]
    ours = lobe_density(library, draws, options, wo)
    theirs = pdf_m / (4 * cosine)
    seen = (wo[2] > 0.01) & (cosine > 0.05) & numpy.isfinite(theirs) & (ours > 0)
    return numpy.quantile(numpy.abs(theirs[seen] / ours[seen] - 1), 0.999), nan


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, default=10_000_000)
    parser.add_argument("--repeats", type=int, default=9)
    arguments = parser.parse_args()
    mitsuba.set_variant("llvm_ad_rgb")
    drjit.set_thread_count(1)
    library, draws = load_lobe(), Draws(arguments.rows)
    methods = {"ggx": ["ellipsoid", "caps", "bounded", "horizon"], "beckmann": ["newton"]}
    ndfs = {library_name(library, "ndf", i): i for i in range(2)}
    runs, kept = {"copy": copy(draws)}, {}
    for ndf, names in methods.items():
        if ndf not in ndfs:
            continue
        for name in names:
            method = library.lobe_method_from_name(name.encode())
            options = draws.options(library, ndfs[ndf], method)
            kept.setdefault(ndf, options)
            runs[f"lobe {ndf} {name}"] = lobe_draw(library, draws, options)
        runs[f"Mitsuba {ndf}"] = mitsuba_draw(draws, ndf)
    compile_seconds = interleaved(runs, 1)
    seconds = interleaved(runs, arguments.repeats)
    print(f"Mitsuba {mitsuba.__version__} (LLVM, one thread), lobe by {library.lobe_isa().decode()}; "
          f"{arguments.rows} draws\n\n| | ns a draw | spread | first run, s |\n|---|---|---|---|")
    for name, list_ in seconds.items():
        ns = 1e9 * numpy.array(list_) / arguments.rows
        print(f"| {name} | {numpy.median(ns):.2f} | {ns.min():.2f} to {ns.max():.2f} | "
              f"{compile_seconds[name][0]:.3f} |")
    print()
    for ndf, options in kept.items():
        difference, nan = compare(library, draws, options, runs[f"Mitsuba {ndf}"])
        print(f"{ndf}: 99.9 % of Mitsuba's densities within {difference:.1e} of ours; {nan} not finite")
    for ndf in kept:
        print(f"{ndf}: Mitsuba's scalar variant, called from Python: about {scalar_nanoseconds(ndf):.0f} ns a draw")


def library_name(library, list_, index):
    function = getattr(library, f"lobe_{list_}_name")
    function.restype = ctypes.c_char_p
    name = function(index)
    return name.decode() if name else None


if __name__ == "__main__":
    main()
