#!/usr/bin/env python3
"""Test vectors of horizon sampling, from the NumPy reference of the method, in extended precision.

Usage: tools/numerics/horizon_vectors.py REFERENCE.py | clang-format > tests/vectors/horizon.h
(needs NumPy)

The reference turns its frame arbitrarily; the kernels take the angle 2 pi u1 in a basis that is
continuous in i (kernel/ggx_horizon_frame.h). The reference is given u1 minus the angle between the two.
All inputs are floats, so that both precisions draw from the same ones.
"""
import importlib.util
import sys

import numpy as np

REAL = np.longdouble


def load(path):
    spec = importlib.util.spec_from_file_location("reference", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def as_float(x):
    return np.asarray(x, np.float32).astype(REAL)


def inputs():
    """wi, alpha, delta, u: the check value of the method's description, then drawn ones"""
    rng = np.random.default_rng(20)
    rows = [((0.6123724, 0.6123724, 0.5), (0.1, 1), 0.1, (0.3, 0.4, 0.7))]
    pairs = [(0.2, 0.8), (0.1, 1), (0.5, 1), (0.05, 0.3), (0.3, 0.3), (1, 1), (1.8, 0.6), (3, 2), (0.01, 0.02), (2, 0.04)]
    for k in range(79):
        z = [rng.uniform(0.05, 1), rng.uniform(0.5, 1), -rng.uniform(0.02, 0.8), rng.uniform(0.02, 0.2)][k % 4]
        phi = (np.pi / 2 * (k % 5) if k % 7 == 0 else rng.uniform(0, 2 * np.pi))
        s = np.sqrt(1 - z * z)
        if k == 5:
            s, z = 0, 1
        delta = [0.25, 0.1, 0, 1, 0.5][k % 5]
        u = rng.random(3)
        if k % 6 == 0:
            u[1] = 1 - 10 ** rng.uniform(-4, -1)
        rows.append(((s * np.cos(phi), s * np.sin(phi), z), pairs[k % len(pairs)], delta, u))
    return [tuple(as_float(part) for part in row) for row in rows]


def turn(P):
    """the angle from the carried basis to (e1, e2), in turns"""
    n, e1 = P["n"], P["e1"]
    k = 1 / (1 + n[2])
    t1 = np.array([1 - n[0] * n[0] * k, -n[0] * n[1] * k, -n[0]])
    t2 = np.array([-n[0] * n[1] * k, 1 - n[1] * n[1] * k, -n[1]])
    return np.arctan2(e1 @ t2, e1 @ t1) / (2 * REAL(np.pi))


def uniform(P, u1, s):
    """section 3 of the method's description, "Uniform": o and p"""
    k = np.array([P["k1"], P["k2"]])
    g = np.array([P["g1"], P["g2"]])
    v = 1 - s
    d = np.zeros(2, REAL)
    if k @ k > 0:
        d = k * np.sqrt(s / (v + s * (k * k @ g) / (k @ k)))
    d *= min(REAL(1), np.sqrt(REAL("0.98") / max(d @ d, REAL(1e-9))))
    theta = 2 * np.arctan2(REAL(0), REAL(-1)) * u1
    e = np.array([np.cos(theta), np.sin(theta)]) + d
    e /= np.sqrt(e @ e)
    t = d @ e
    p_y = 1 + t / np.sqrt(1 - d @ d + t * t)
    y = np.sqrt(s) * e
    z = np.sqrt(v + g @ (y * y))
    m = P["a"] * y[0] * P["e1"] + P["b"] * y[1] * P["e2"] + z * P["n"]
    am = P["A"] * m
    am2 = am @ am
    im = P["nn"] * (z + k @ y)
    o = 2 * P["L"] * im / am2 * am - P["i"]
    density = am2 * am2 / (np.pi * P["A"][0] * P["A"][1])
    return o, density * P["norm"] * p_y * z / im


def row(reference, wi, alpha, delta, u):
    P = reference.prepare(wi, alpha[0], alpha[1], delta, dtype=REAL, newton=200)
    u1 = u[0] - turn(P)
    results = [
        reference.sample_mirror(P, u1, 1 - u[1], u[2]),
        uniform(P, u1, u[1]),
        reference.sample_exact(P, u1, u[1], steps=20),
        reference.sample(P, u1, u[1]),
    ]
    numbers = lambda *x: ", ".join(f"{np.float64(v):.17g}" for v in x)
    drawn = ", ".join("{" + numbers(*o, p) + "}" for o, p in results)
    return f"    {{{{{numbers(*wi)}}}, {{{numbers(*alpha)}}}, {numbers(delta)}, {{{numbers(*u)}}}, {{{drawn}}}}},"


def main():
    reference = load(sys.argv[1])
    print("/* tests/vectors/horizon.h: made by tools/numerics/horizon_vectors.py; do not edit. */")
    print("typedef struct horizon_vector {")
    print("    double wi[3], alpha[2], delta, u[3];")
    print("    double drawn[4][4]; /* mirror, uniform, exact, horizon: o and p(o) */")
    print("} horizon_vector;\n")
    print("static const horizon_vector horizon_vectors[] = {")
    for inputs_of_row in inputs():
        print(row(reference, *inputs_of_row))
    print("};")


if __name__ == "__main__":
    main()
