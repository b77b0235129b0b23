#!/usr/bin/env python3
"""Where the inverse of the visible Gaussian slopes begins (kernel/beckmann_slopes.h, needs NumPy).

Usage: OMP_NUM_THREADS=1 tools/numerics/beckmann_start.py   (half a minute)
A Gaussian slope w, counted downwards, and the visible slope at depth t with the same share below it: t is fitted
over (w, c) by a polynomial of degree 5 in w whose coefficients are cubics in a number made of c,
    c <  2:  sqrt(gap/scale) in c/root,  gap = max(c, 0) + t,  scale = 1/(root - c),  root = sqrt(c^2 + 12),
    c >= 2:  root (t - w) in 1/root,
where the series about c does not serve (is_near). Errors count relative to what bends the density, and by the
fifth root of the smaller share: the step that follows takes them to the fifth power. Prints the
coefficients, for each power of w those of the cubic, lowest first; before them those of the series about c,
gap = root (1 + ...) of root^2 = gap^2 S, in p = 2c root and q = root^2.
"""
from fractions import Fraction
from math import erfc, exp, factorial, pi, sqrt

import numpy as np

SWITCH = 2.0
BEND = 12.0
POWERS_OF_W, POWERS_OF_C = 6, 4


def scaled_erfc(x):
    """exp(x^2) erfc(x), x >= 0"""
    if x < 5:
        return exp(x * x) * erfc(x)
    ratio = 0.0
    for n in range(80, 0, -1):
        ratio = n / 2 / (x + ratio)
    return 1 / (sqrt(pi) * (x + ratio))


def defect(x):
    """1 - sqrt(pi) x exp(x^2) erfc(x), x >= 0"""
    if x < 3:
        return 1 - sqrt(pi) * x * scaled_erfc(x)
    ratio = 0.0
    for n in range(150, 0, -1):
        ratio = 1 / (2 * x + 2 * (n + 1) * ratio)
    return ratio / (x + ratio)


class Slopes:
    """The visible slopes of one c."""

    def __init__(self, c):
        self.c, self.above, self.s = c, max(c, 0.0), max(-c, 0.0)
        self.end = exp(-c * c) * defect(c) if c >= 0 else 0.0
        self.k = 2 * sqrt(pi) * c + self.end if c >= 0 else defect(-c)

    def shares(self, t):
        """deeper than t, and above it"""
        rise = sqrt(pi) * self.above * scaled_erfc(abs(t))
        if t < 0:
            shallow = (exp(-t * t) * (rise - 1) + self.end) / self.k
            return 1 - shallow, shallow
        y = self.s + t
        k = (t + self.s * defect(y)) / y if self.s > 0 else 1 + rise
        deep = exp(-t * (t + 2 * self.s)) * k / self.k
        return deep, 1 - deep

    def depth(self, w):
        """of the share that a Gaussian has below -w"""
        tail = erfc(abs(w)) / 2
        low, high = -self.above, 60.0
        for _ in range(80):
            t = (low + high) / 2
            deep, shallow = self.shares(t)
            low, high = (t, high) if (deep > tail if w > 0 else shallow < tail) else (low, t)
        return t

    def is_near(self, w):
        """The series about c serves."""
        shallow = erfc(-w) / 2
        root = sqrt(self.k * shallow) * exp(self.above**2 / 2) if self.above < 9 else 1e9
        return 2 * abs(self.c) * root < 0.7 and root < 0.35


GRADE = 5  # of the series: that of p^i q^j is i + 2j


def times(a, b):
    """of polynomials {(i, j): factor of p^i q^j}"""
    product = {}
    for (i, j), x in a.items():
        for (k, l), y in b.items():
            if i + k + 2 * (j + l) <= GRADE:
                product[i + k, j + l] = product.get((i + k, j + l), 0) + x * y
    return product


def series_of_gap():
    """g of g^2 S(p g, q g^2) = 1, S = int_0^1 2h exp(p h - q h^2) dh"""
    g = {(0, 0): Fraction(1)}
    for _ in range(GRADE):
        powers = [{(0, 0): Fraction(1)}]
        for _ in range(GRADE + 2):
            powers.append(times(powers[-1], g))
        off = {(0, 0): Fraction(-1)}
        for i in range(GRADE + 1):
            for j in range((GRADE - i) // 2 + 1):
                factor = Fraction(2 * (-1) ** j, (i + 2 * j + 2) * factorial(i) * factorial(j))
                for at, x in times({(i, j): factor}, powers[i + 2 * j + 2]).items():
                    off[at] = off.get(at, 0) + x
        for at, x in off.items():
            g[at] = g.get(at, 0) - x / 2
    return g


def minimax(basis, wanted, weight):
    """Lawson's algorithm"""
    load, best = np.ones(len(wanted)), None
    for _ in range(150):
        scale = np.sqrt(load) * weight
        terms = np.linalg.lstsq(basis * scale[:, None], wanted * scale, rcond=None)[0]
        error = np.abs(basis @ terms - wanted) * weight
        if best is None or error.max() < best[0]:
            best = (error.max(), terms)
        load *= error / error.max() + 1e-3
        load /= load.mean()
    return best


def main():
    for (i, j), x in sorted(series_of_gap().items(), key=lambda term: term[0][0] + 2 * term[0][1]):
        print(f"p^{i} q^{j}: {x}")
    fits = {"below": [], "above": []}
    for angle in (np.arange(121) + 0.5) / 121 * pi:
        c = 1 / np.tan(angle)
        slopes = Slopes(c)
        for w in np.arange(-48, 51) / 10:
            if slopes.is_near(w):
                continue
            t = slopes.depth(w)
            gap = slopes.above + t
            size = max(0.5 / gap, abs(0.5 / gap - (t + slopes.s)), 0.7)
            size *= max(erfc(abs(w)) / 2, 1e-5) ** 0.2
            root = sqrt(c * c + BEND)
            if c < SWITCH:
                wanted = sqrt(gap * (root - c))
                fits["below"].append((w, c / root, wanted, size * 2 * gap / wanted))
            else:
                fits["above"].append((w, 1 / root, (t - w) * root, size / root))
    for name, rows in fits.items():
        w, x, wanted, weight = np.array(rows).T
        basis = np.stack([w**i * x**j for i in range(POWERS_OF_W) for j in range(POWERS_OF_C)], 1)
        error, terms = minimax(basis, wanted, weight)
        print(f"{name}: largest weighted error {error:.3g}")
        for row in terms.reshape(POWERS_OF_W, POWERS_OF_C):
            print("   ", *(f"{term:.9g}" for term in row))


if __name__ == "__main__":
    main()
