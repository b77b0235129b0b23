#!/usr/bin/env python3
"""Every polynomial of kernel/, from its definition: Chebyshev fits in 50 digits (needs mpmath).

Usage: tools/numerics/coefficients.py
Prints for each the coefficients, lowest first, and the largest error of the fit. The first column of
the output is the file that uses it; the precision is told by the number of coefficients there.
"""
from struct import pack, unpack

from mpmath import atan, chebyfit, erf, erfc, exp, expm1, findroot, log, mp, mpf
from mpmath import factorial, nstr, nsum, pi, sin, cos, sqrt

mp.dps = 50


def sine_ratio(x):
    """sin(2 pi r)/r of x = r^2"""
    r = sqrt(x)
    return sin(2 * pi * r) / r if x > 0 else 2 * pi


def atanh_tail(y):
    """(2 atanh(s) - 2 s)/s^3 of y = s^2"""
    if y < mpf(10) ** -12:
        return mpf(2) / 3 + 2 * y / 5
    s = sqrt(y)
    return (log((1 + s) / (1 - s)) - 2 * s) / s**3


def arc_ratio(x):
    """atan(t)/t of x = t^2"""
    t = sqrt(x)
    return atan(t) / t if x > 0 else mpf(1)


def sine_defect(y):
    """(e - sin e)/e^3 of y = e^2"""
    return nsum(lambda k: (-1) ** int(k) * y**k / factorial(2 * k + 3), [0, 30])


def kepler_start(x):
    """e/t of x = t^2 where e - sin e = t^3/6"""
    if x < mpf(10) ** -6:
        return 1 + x / 60
    t = sqrt(x)
    guess = t * (1 + x / 60 + x * x / 1400 + x**3 / 25200)
    return findroot(lambda e: e - sin(e) - t**3 / 6, guess) / t


def fresnel_near_one(d):
    """The average dielectric Fresnel reflectance without its logarithm of (n-1)/(n+1), over d = n - 1"""
    d = max(d, mpf(10) ** -12)
    n = 1 + d
    smooth = (
        mpf(1) / 2
        + (n - 1) * (3 * n + 1) / (6 * (n + 1) ** 2)
        - 2 * n**3 * (n * n + 2 * n - 1) / ((n * n + 1) * (n**4 - 1))
        + 8 * n**4 * (n**4 + 1) / ((n * n + 1) * (n**4 - 1) ** 2) * log(n)
    )
    return smooth / d


def exp_tail(r):
    """(exp(r) - 1 - r)/r^2"""
    if abs(r) < mpf(10) ** -10:
        return mpf(1) / 2 + r / 6
    return (expm1(r) - r) / r**2


def erf_ratio(y):
    """erf(x)/x - 1 of y = x^2"""
    if y < mpf(10) ** -30:
        return 2 / sqrt(pi) - 1
    return erf(sqrt(y)) / sqrt(y) - 1


def far_series(x, first):
    """sum_{k >= first} (-1)^k (2k-1)!!/(2 x^2)^k, for x > 25"""
    total, term = mpf(0), mpf(1)
    for k in range(60):
        total += term if k >= first else 0
        term *= -mpf(2 * k + 1) / (2 * x * x)
    return total


def half_line(t):
    """x in [0, inf) of t = (x - 3)/(x + 3)"""
    return 3 * (1 + t) / (1 - t)


def erfcx_bend(t):
    """b of (1 + 2x) exp(x^2) erfc(x) = 1 + (1 + t)(1/sqrt(pi) - 1/2 + (1 - t) b)"""
    end = 1 / sqrt(pi) - mpf(1) / 2
    if t > 1 - mpf(10) ** -12:
        return 1 / (12 * sqrt(pi)) + end / 2
    if t < mpf(10) ** -12 - 1:
        return (3 - 3 / sqrt(pi) - end) / 2
    x = half_line(t)
    scaled = exp(x * x) * erfc(x) if x < 25 else far_series(x, 0) / (x * sqrt(pi))
    return (((1 + 2 * x) * scaled - 1) / (1 + t) - end) / (1 - t)


def defect_bend(t):
    """b of (1 + 7/4 x + 2x^2)(1 - sqrt(pi) x exp(x^2) erfc(x)) = 1 + (1 - t^2) b"""
    x = half_line(t) if t < 1 else mpf(10) ** 50
    if x > mpf(10) ** 12:
        return mpf(7) / 96
    if x < mpf(10) ** -12:
        return (mpf(7) / 4 - sqrt(pi)) * mpf(3) / 4
    near = 1 - sqrt(pi) * x * exp(x * x) * erfc(x) if x < 25 else 0
    scaled = near if x < 25 else -far_series(x, 1)
    return ((1 + x * (mpf(7) / 4 + 2 * x)) * scaled - 1) / ((1 + t) * (1 - t))


def erfinv_ratio(w):
    """z/x where x = erf(z) and 1 - x^2 = exp(-w)"""
    if w < mpf(10) ** -14:
        return sqrt(pi) / 2
    x = sqrt(-expm1(-w))
    tail = exp(-w) / (1 + x)
    z = sqrt(w - log((1 + x) * (1 + 2 * sqrt(w)))) if w > 3 else x * sqrt(pi) / 2
    for _ in range(100):  # Newton on log erfc: converges from any start
        step = log(erfc(z) / tail) * erfc(z) / (-2 / sqrt(pi) * exp(-z * z))
        z -= step
        if abs(step) < mpf(10) ** -40:
            break
    return z / x


def erfinv_far(scale, shift):
    """z/(x sqrt(w)) - 1 of t = scale/sqrt(w) - shift"""

    def function(t):
        v = (t + mpf(shift)) / scale
        return erfinv_ratio(1 / (v * v)) * v - 1

    return function


FITS = [
    ("trig.h", "sin", sine_ratio, 0, mpf(1) / 64, (4, 7)),
    ("trig.h", "cos", lambda x: cos(2 * pi * sqrt(x)), 0, mpf(1) / 64, (5, 8)),
    ("arc.h", "atan", arc_ratio, 0, (sqrt(mpf(2)) - 1) ** 2, (6, 12)),
    ("log.h", "atanh tail", atanh_tail, 0, mpf("0.02945"), (4, 8)),
    ("kepler.h", "sine defect", sine_defect, 0, pi**2, (7, 11)),
    ("kepler.h", "start", kepler_start, 0, (6 * pi) ** (mpf(2) / 3), (5,)),
    ("fresnel.h", "average near 1", fresnel_near_one, 0, mpf(1) / 2, (10, 16)),
    ("exp.h", "tail", exp_tail, "-0.34658", "0.34658", (11,)),
    ("erf.h", "erf ratio", erf_ratio, 0, 1, (12,)),
    ("erf.h", "erfcx bend", erfcx_bend, -1, 1, (25,)),
    ("erf.h", "defect bend", defect_bend, -1, 1, (27,)),
    ("erfinv.h", "near", erfinv_ratio, 0, "6.25", (24,)),
    ("erfinv.h", "far", erfinv_far(12, "3.82"), -1, 1, (20,)),
    ("erfinv.h", "farthest", erfinv_far(mpf("14.5"), "2.43"), -1, 1, (20,)),
]

# Fits whose coefficients are single-precision numbers already.
SINGLE_FITS = [
    ("exp.h", "tail", exp_tail, "-0.34658", "0.34658", 5),
    ("erf.h", "erf ratio", erf_ratio, 0, 1, 7),
    ("erf.h", "erfcx bend", erfcx_bend, -1, 1, 12),
    ("erf.h", "defect bend", defect_bend, -1, 1, 13),
    ("erfinv.h", "near", erfinv_ratio, 0, "6.25", 11),
    ("erfinv.h", "far", erfinv_far(8, "2.24"), -1, 1, 11),
]


def to_single(x):
    return unpack("f", pack("f", float(x)))[0]


def step_single(x, steps):
    """The neighbour of a single-precision number, some steps away in its bits."""
    return unpack("f", pack("i", unpack("i", pack("f", x))[0] + steps))[0]


def single_fit(function, low, high, count):
    """Coefficients, lowest first, and the largest error: all rounded, then the one or two near ones moved by
    one digit that bring the largest error down most, while any does."""
    low, high = mpf(low), mpf(high)
    terms = [to_single(x) for x in reversed(chebyfit(function, [low, high], count))]
    grid = [low + (high - low) * k / 100 for k in range(101)]
    powers = [[float(x**k) for x in grid] for k in range(count)]
    left = [float(function(x) - sum(mpf(t) * x**k for k, t in enumerate(terms))) for x in grid]

    def moves():
        single = [(k, d) for k in range(count) for d in (-1, 1)]
        yield from ([move] for move in single)
        yield from ([a, b] for a in single for b in single if 0 < b[0] - a[0] < 3)

    def after(move):
        deltas = [(k, step_single(terms[k], d) - terms[k]) for k, d in move]
        return [e - sum(d * powers[k][n] for k, d in deltas) for n, e in enumerate(left)]

    while True:
        best = min(moves(), key=lambda move: max(map(abs, after(move))))
        if max(map(abs, after(best))) >= max(map(abs, left)):
            return terms, max(map(abs, left))
        left = after(best)
        for k, d in best:
            terms[k] = step_single(terms[k], d)


def main():
    for file, name, function, low, high, counts in FITS:
        for count in counts:
            terms, error = chebyfit(function, [mpf(low), mpf(high)], count, error=True)
            print(f"{file} {name}: {count} terms, error {nstr(error, 3)}")
            for term in reversed(terms):
                print("   ", nstr(term, 20))
    for file, name, function, low, high, count in SINGLE_FITS:
        terms, error = single_fit(function, low, high, count)
        print(f"{file} {name}: {count} terms in single precision, error {nstr(error, 3)}")
        for term in terms:
            print("   ", nstr(term, 9))


if __name__ == "__main__":
    main()
