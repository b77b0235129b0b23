#!/usr/bin/env python3
"""tests/kernel/special_vectors.h: exact values of the special functions of kernel/ (needs mpmath).

Usage: tools/numerics/special_vectors.py > tests/kernel/special_vectors.h
Each row is a double x and the value there, in 60 digits, as the sum of two doubles. The points are
spaced evenly, evenly in their logarithm, and crowded at the ends and where the kernels change formula.
"""
from random import Random

from mpmath import erf, erfc, exp, findroot, log, mp, mpf, pi, sqrt

mp.dps = 60


def erfcx(x):
    return exp(x * x) * erfc(x)


def defect(x):
    """1 - sqrt(pi) x exp(x^2) erfc(x), in enough digits for its cancellation"""
    with mp.workdps(60 + 2 * len(str(int(x)))):
        return 1 - sqrt(pi) * x * exp(x * x) * erfc(x)


def erfinv(x):
    start = sqrt(-log((1 - x) * (1 + x)))
    return findroot(lambda z: erf(z) - x, min(start, x), tol=mpf(10) ** -80) if x < 0.9 else tail(1 - x)


def tail(y):
    """z with erfc(z) = y, by Newton on the logarithm"""
    z = sqrt(-log(y)) if y < 0.5 else mpf(0)
    for _ in range(200):
        step = log(erfc(z) / y) * erfc(z) / (-2 / sqrt(pi) * exp(-z * z))
        z -= step
        if abs(step) < mpf(10) ** -50:
            break
    return z


def spread(low, high, count):
    """Evenly spaced numbers, moved at random by up to half a space"""
    return [low + (high - low) * (k + random.random()) / count for k in range(count)]


def decades(low, high, count):
    return [10**e for e in spread(low, high, count)]


random = Random(4)
near = [a + d * e for a in (0.5, 1.0, 6.25, 25.0) for d in (1e-3, 1e-9, 2.0**-52) for e in (-1, 1)]
small_tails = decades(-43, -3, 120)
FUNCTIONS = [
    ("LOG", log, spread(0.3, 3, 120) + decades(-300, 300, 120) + [1 - 2.0**-53, 1 + 2.0**-52]),
    ("EXP", exp, spread(-708, 709.7, 240) + spread(-1, 1, 80) + [0.0, -708.39, 709.78]),
    ("ERF", erf, spread(-6, 6, 240) + decades(-300, 0, 60) + near[:12]),
    ("ERFC", erfc, spread(-6, 26.5, 320) + decades(-20, 0, 60) + near[:12] + [26.54]),
    ("ERFCX", erfcx, spread(-26.6, 30, 240) + spread(-2, 2, 80) + decades(-20, 2, 60) + near),
    ("DEFECT", defect, spread(0, 30, 240) + decades(-20, 2, 60) + near),
    ("ERFINV", erfinv, spread(0, 1, 200) + [1 - y for y in decades(-15.9, -1, 120)] + [1 - 2.0**-53]),
    ("ERFCINV", tail, spread(0, 1, 200) + small_tails + [1e-43]),
]


def main():
    print("/* tests/kernel/special_vectors.h: written by tools/numerics/special_vectors.py. */")
    for name, function, points in FUNCTIONS:
        for x in points:
            value = function(mpf(x))
            high = float(value)
            print(f"SPECIAL({name}, {x.hex()}, {high.hex()}, {float(value - high).hex()})")


if __name__ == "__main__":
    main()
