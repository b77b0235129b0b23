#!/usr/bin/env python3
"""The closed fits of kernel/albedo_fit.h: E and E_avg of GGX for F = 1, from the quadrature of liblobe.

Usage: OMP_NUM_THREADS=1 tools/numerics/albedo_fit.py build/liblobe.so     (needs numpy; a minute)
With t = sqrt(mu), r = sqrt(alpha), s = t + r, x = t/s:
    1 - E = (1 - x)^4 sum_k s^k N_k(x)/sum_k s^k D_k(x),   N_k of degree 3 + k, k to 3; D_k of 5 + k, k to 2
with another x before N_k for the correlated G2, of which E = 1 at the horizon. Errors count absolutely,
and relative to what is missing where that is little: else a lobe that is divided by its average would
be wrong. Linearised least squares (Sanathanan & Koerner 1963), weights raised where the error is large
(Lawson 1961). Prints the lines of the kernel and the largest errors.
"""
import ctypes
import sys

import numpy as np

N_TERMS, N_DEGREE, D_TERMS, D_DEGREE = 4, 3, 3, 5


class Surface(ctypes.Structure):
    _fields_ = [("ndf", ctypes.c_int), ("masking", ctypes.c_int), ("g2", ctypes.c_int),
                ("alpha_x", ctypes.c_double), ("alpha_y", ctypes.c_double)]


class Reflectance(ctypes.Structure):
    _fields_ = [("law", ctypes.c_int), ("a", ctypes.c_double), ("b", ctypes.c_double)]


class Vector(ctypes.Structure):
    _fields_ = [("x", ctypes.c_double), ("y", ctypes.c_double), ("z", ctypes.c_double)]


def load(path):
    lib = ctypes.CDLL(path)
    lib.lobe_albedo.restype = lib.lobe_albedo_average.restype = ctypes.c_double
    lib.lobe_albedo.argtypes = [Surface, Reflectance, Vector, ctypes.c_int]
    lib.lobe_albedo_average.argtypes = [Surface, Reflectance, ctypes.c_int]
    return lib


def grid(lib, g2, count=44):
    """Rows (r, mu, 1 - E), crowded where E turns."""
    crowded = 0.5 - 0.5 * np.cos(np.pi * (np.arange(count) + 0.5) / count)
    rows = []
    for q in crowded:
        r = (0.1 + 0.9 * q) ** 2
        for p in np.append(crowded, 1.0):
            mu = min(max((p * r / (1 + r - p)) ** 2, 1e-6), 1.0)
            e = lib.lobe_albedo(Surface(0, 0, g2, r * r, r * r), Reflectance(0, 0, 0),
                                Vector(np.sqrt(1 - mu * mu), 0, mu), 2)
            rows.append((r, mu, 1 - e))
    return np.array(rows).T


def fit(numerator, denominator, y, importance, steps=120):
    """Coefficients; the first of the denominator is 1."""
    n = numerator.shape[1]
    weight, last, best = np.ones(len(y)), np.ones(len(y)), None
    for step in range(steps):
        scale = np.sqrt(weight) * importance / last
        a = np.hstack([numerator, -denominator[:, 1:] * y[:, None]]) * scale[:, None]
        norm = np.linalg.norm(a, axis=0)
        c = np.linalg.lstsq(a / norm, y * denominator[:, 0] * scale, rcond=1e-14)[0] / norm
        below = denominator[:, 0] + denominator[:, 1:] @ c[n:]
        error = np.abs(numerator @ c[:n] / below - y) * importance
        if below.min() > 0 and (best is None or error.max() < best[0]):
            best = error.max(), c[:n], np.append(1.0, c[n:])
        last = np.abs(below) + 1e-9
        if step > 8:
            weight *= error + 0.05 * error.max()
            weight /= weight.mean()
    return best[1:]


def print_polynomials(name, order, coefficients):
    for k in range(max(k for k, _ in order) + 1):
        row = [c for (kk, _), c in zip(order, coefficients) if kk == k]
        first = min(i for kk, i in order if kk == k)
        print(f"  {name}{k} from x^{first}:", ", ".join("%.9g" % c for c in row))


def print_fit(lib, g2, name):
    r, mu, missing = grid(lib, g2)
    t = np.sqrt(mu)
    s, x = t + r, t / (t + r)
    first = 1 if g2 == 0 else 0
    top = [(k, first + i) for k in range(N_TERMS) for i in range(N_DEGREE + k + 1)]
    bottom = [(k, i) for k in range(D_TERMS) for i in range(D_DEGREE + k + 1)]
    above = np.stack([(1 - x) ** 4 * s**k * x**i for k, i in top], 1)
    below = np.stack([s**k * x**i for k, i in bottom], 1)
    n, d = fit(above, below, missing, 1 + 0.04 / (missing + 2e-6))
    fitted = above @ n / (below @ d)
    print(f"{name}: largest error {np.abs(fitted - missing).max():.2e}, "
          f"of E/fit {np.abs((1 - missing) / (1 - fitted) - 1).max():.2e}")
    print_polynomials("N", top, n)
    print_polynomials("D", bottom, d)


def print_average(lib, g2, name):
    r = 0.01 + 0.99 * (0.5 - 0.5 * np.cos(np.pi * (np.arange(120) + 0.5) / 120))
    missing = np.array([1 - lib.lobe_albedo_average(Surface(0, 0, g2, q**2, q**2),
                                                    Reflectance(0, 0, 0), 2) for q in r])
    above = np.stack([r**k for k in range(3, 9)], 1)
    below = np.stack([r**k for k in range(5)], 1)
    n, d = fit(above, below, missing, 1 / (missing + 1e-7))
    error = np.abs(above @ n / (below @ d) - missing)
    print(f"{name}, average: largest error {error.max():.2e}, of 1 - E_avg {(error / missing)[r > 0.0316].max():.2e}")
    print("  1 - E_avg, above from r^3:", ", ".join("%.9g" % v for v in n))
    print("  1 - E_avg, below from r^0:", ", ".join("%.9g" % v for v in d))


def main():
    lib = load(sys.argv[1])
    for g2, name in ((0, "correlated"), (1, "separable")):
        print_fit(lib, g2, name)
        print_average(lib, g2, name)


if __name__ == "__main__":
    main()
