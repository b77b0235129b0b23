#!/usr/bin/env python3
"""The closed fits of kernel/albedo_fit.h and albedo_fit_beckmann.h: E and E_avg for F = 1, from the quadrature
of liblobe.

Usage: OMP_NUM_THREADS=1 tools/numerics/albedo_fit.py build/liblobe.so ggx|beckmann   (needs numpy; a minute)
With t = sqrt(mu), r = sqrt(alpha), s = t + r, x = t/s:
    1 - E = (1 - x)^4 sum_k s^k N_k(x)/sum_k s^k D_k(x),   N_k of degree 3 + k, k to 3; D_k of 5 + k, k to 2
with another x before N_k for the correlated G2, of which E = 1 at the horizon. Errors count absolutely,
and relative to what is missing where that is little: else a lobe that is divided by its average would
be wrong. Linearised least squares (Sanathanan & Koerner 1963), weights raised where the error is large
(Lawson 1961). Beckmann: a Gaussian times a polynomial. Prints the polynomials of the kernel and the largest
errors.
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


def grid(lib, ndf, g2, count=44):
    """Rows (r, mu, 1 - E), crowded where E turns."""
    crowded = 0.5 - 0.5 * np.cos(np.pi * (np.arange(count) + 0.5) / count)
    rows = []
    for q in crowded:
        r = (0.1 + 0.9 * q) ** 2
        for p in np.append(crowded, 1.0):
            mu = min(max((p * r / (1 + r - p)) ** 2, 1e-6), 1.0)
            e = lib.lobe_albedo(Surface(ndf, 0, g2, r * r, r * r), Reflectance(0, 0, 0),
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


def print_polynomial(name, first, coefficients):
    """A function of the kernel: x^first times a polynomial, two coefficients a step."""
    c = [f"R({float('%.9g' % v)!r})" for v in coefficients]
    print(f"K_FN real {name}(real x) {{\n    real p = {c.pop()};")
    while len(c) > 1:
        high, low = c.pop(), c.pop()
        print(f"    p = {low} + x * ({high} + x * p);")
    if c:
        print(f"    p = {c.pop()} + x * p;")
    print("    return " + "x * " * first + "p;\n}\n")


def print_polynomials(name, order, coefficients):
    for k in range(max(k for k, _ in order) + 1):
        row = [c for (kk, _), c in zip(order, coefficients) if kk == k]
        print_polynomial(f"{name}{k}", min(i for kk, i in order if kk == k), row)


def print_fit(lib, g2, name):
    r, mu, missing = grid(lib, 0, g2)
    t = np.sqrt(mu)
    s, x = t + r, t / (t + r)
    first = 1 if g2 == 0 else 0
    top = [(k, first + i) for k in range(N_TERMS) for i in range(N_DEGREE + k + 1)]
    bottom = [(k, i) for k in range(D_TERMS) for i in range(D_DEGREE + k + 1)]
    above = np.stack([(1 - x) ** 4 * s**k * x**i for k, i in top], 1)
    below = np.stack([s**k * x**i for k, i in bottom], 1)
    n, d = fit(above, below, missing, 1 + 0.04 / (missing + 2e-6))
    fitted = above @ n / (below @ d)
    print(f"/* {name}: largest error {np.abs(fitted - missing).max():.2e}, "
          f"of E/fit {np.abs((1 - missing) / (1 - fitted) - 1).max():.2e} */")
    print_polynomials(f"albedo_{name}_above", top, n)
    print_polynomials(f"albedo_{name}_below", bottom, d)


def print_average(lib, g2, name):
    r = 0.01 + 0.99 * (0.5 - 0.5 * np.cos(np.pi * (np.arange(120) + 0.5) / 120))
    missing = np.array([1 - lib.lobe_albedo_average(Surface(0, 0, g2, q**2, q**2),
                                                    Reflectance(0, 0, 0), 2) for q in r])
    above = np.stack([r**k for k in range(3, 9)], 1)
    below = np.stack([r**k for k in range(5)], 1)
    n, d = fit(above, below, missing, 1 / (missing + 1e-7))
    error = np.abs(above @ n / (below @ d) - missing)
    print(f"/* {name}, average: largest error {error.max():.2e}, "
          f"of 1 - E_avg {(error / missing)[r > 0.0316].max():.2e} */")
    print_polynomial(f"albedo_{name}_average_above", 3, n)
    print_polynomial(f"albedo_{name}_average_below", 0, d)


# ---- Beckmann -----------------------------------------------------------------------------------

ROWS, COLUMNS, AVERAGE = 8, 9, 8


def fit_linear(terms, y, importance, steps=100):
    """Coefficients of the smallest largest error (Lawson 1961)."""
    weight, best = np.ones(len(y)), None
    for step in range(steps):
        scale = np.sqrt(weight) * importance
        a = terms * scale[:, None]
        norm = np.linalg.norm(a, axis=0)
        c = np.linalg.lstsq(a / norm, y * scale, rcond=1e-13)[0] / norm
        error = np.abs(terms @ c - y) * importance
        if best is None or error.max() < best[0]:
            best = error.max(), c
        if step > 4:
            weight *= error + 0.05 * error.max()
            weight /= weight.mean()
    return best[1]


def print_beckmann(lib, g2, name):
    """What is missing falls like a Gaussian of q, the slope that turns the reflection to the horizon over alpha."""
    r, mu, missing = grid(lib, 1, g2, 36)
    alpha = r * r
    q = mu / (1 + np.sqrt(1 - mu * mu)) / alpha
    v, w = 2 * q / (1 + q) - 1, 2 * alpha**2 - 1
    falls = np.exp(-0.5 * q * q) * (q / (1 + q) if g2 == 0 else 1)
    terms = np.stack([falls * w**k * v**i for k in range(ROWS) for i in range(COLUMNS)], 1)
    seen = q < 6
    c = fit_linear(terms[seen], missing[seen],
                   (1 + 0.04 / (missing + 0.2 * alpha**2 + 1e-6))[seen])
    fitted = terms @ c
    print(f"/* {name}: largest error {np.abs(fitted - missing).max():.2e}, "
          f"of E/fit {np.abs((1 - missing) / (1 - fitted) - 1).max():.2e} */")
    for k in range(ROWS):
        print_polynomial(f"albedo_beckmann_{name}{k}", 0, c[k * COLUMNS:(k + 1) * COLUMNS])


def print_beckmann_average(lib, g2, name):
    alpha = 2e-3 + 0.998 * (0.5 - 0.5 * np.cos(np.pi * (np.arange(60) + 0.5) / 60))
    missing = np.array([1 - lib.lobe_albedo_average(Surface(1, 0, g2, a, a),
                                                    Reflectance(0, 0, 0), 2) for a in alpha])
    terms = np.stack([alpha**2 * (2 * alpha - 1)**k for k in range(AVERAGE)], 1)
    c = fit_linear(terms, missing, 1 / (missing + 1e-8))
    error = np.abs(terms @ c - missing)
    print(f"/* {name}, average: largest error {error.max():.2e}, "
          f"of 1 - E_avg {(error / missing).max():.2e} */")
    print_polynomial(f"albedo_beckmann_{name}_average", 0, c)


def main():
    lib = load(sys.argv[1])
    for g2, name in ((0, "correlated"), (1, "separable")):
        if sys.argv[2] == "beckmann":
            print_beckmann(lib, g2, name)
            print_beckmann_average(lib, g2, name)
        else:
            print_fit(lib, g2, name)
            print_average(lib, g2, name)


if __name__ == "__main__":
    main()
