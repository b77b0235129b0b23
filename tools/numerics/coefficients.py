#!/usr/bin/env python3
"""Every polynomial of kernel/, from its definition: Chebyshev fits in 50 digits (needs mpmath).

Usage: tools/numerics/coefficients.py
Prints for each the coefficients, lowest first, and the largest error of the fit. The first column of
the output is the file that uses it; the precision is told by the number of coefficients there.
"""
from mpmath import atan, chebyfit, findroot, log, mp, mpf, factorial, nstr, nsum, pi, sin, cos, sqrt

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


FITS = [
    ("trig.h", "sin", sine_ratio, 0, mpf(1) / 64, (4, 7)),
    ("trig.h", "cos", lambda x: cos(2 * pi * sqrt(x)), 0, mpf(1) / 64, (5, 8)),
    ("arc.h", "atan", arc_ratio, 0, (sqrt(mpf(2)) - 1) ** 2, (6, 12)),
    ("log.h", "atanh tail", atanh_tail, 0, mpf("0.02945"), (4, 8)),
    ("kepler.h", "sine defect", sine_defect, 0, pi**2, (7, 11)),
    ("kepler.h", "start", kepler_start, 0, (6 * pi) ** (mpf(2) / 3), (5,)),
    ("fresnel.h", "average near 1", fresnel_near_one, 0, mpf(1) / 2, (10, 16)),
]


def main():
    for file, name, function, low, high, counts in FITS:
        for count in counts:
            terms, error = chebyfit(function, [mpf(low), mpf(high)], count, error=True)
            print(f"{file} {name}: {count} terms, error {nstr(error, 3)}")
            for term in reversed(terms):
                print("   ", nstr(term, 20))


if __name__ == "__main__":
    main()
