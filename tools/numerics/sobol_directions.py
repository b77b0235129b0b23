#!/usr/bin/env python3
"""Write sobol_nibbles.inc: what four bits of the index make of a point, by Sobol direction numbers of four
dimensions, bit-reversed. Row 16 k + n: the bits 4 k to 4 k + 3 of the index are n, the first one on top.

The recurrence is Sobol's (1967), as in Bratley & Fox 1988. The initial numbers are those, of all
odd choices, whose two-dimensional projections are stratified best: the script tries them all and
sums over the pairs and over m = 1..12 how far the first 2^m points are from being a net in base 2.
"""
import itertools

BITS = 32
# (degree, inner coefficients) of primitive polynomials over GF(2), after x (van der Corput).
POLYNOMIALS = [(1, 0), (2, 1), (3, 1)]


def column(degree, inner, initial):
    m = list(initial)
    for i in range(degree, BITS):
        value = m[i - degree] ^ (m[i - degree] << degree)
        for k in range(1, degree):
            if (inner >> (degree - 1 - k)) & 1:
                value ^= m[i - k] << k
        m.append(value)
    return [m[i] << (BITS - 1 - i) for i in range(BITS)]


def rank(rows):
    basis = []
    for row in rows:
        for b in basis:
            row = min(row, row ^ b)
        if row:
            basis.append(row)
    return len(basis)


def digits(dimension, count, m):
    """The first `count` digit rows of the generator matrix, as masks over the m index bits."""
    return [sum(((dimension[j] >> (BITS - 1 - i)) & 1) << j for j in range(m)) for i in range(count)]


def defect(a, b):
    """Sum over m of the net quality parameter t of the pair."""
    total = 0
    for m in range(1, 13):
        for t in range(m + 1):
            k = m - t
            if all(rank(digits(a, i, m) + digits(b, k - i, m)) == k for i in range(k + 1)):
                total += t
                break
    return total


def main():
    van_der_corput = [1 << (BITS - 1 - i) for i in range(BITS)]
    choices = []
    for degree, inner in POLYNOMIALS:
        odd = [range(1, 2 << i, 2) for i in range(degree)]
        choices.append([column(degree, inner, start) for start in itertools.product(*odd)])
    best = min(itertools.product(*choices), key=lambda c: sum(
        defect(a, b) for a, b in itertools.combinations([van_der_corput, *c], 2)))
    table = [van_der_corput, *best]
    for nibble in range(BITS // 4):
        for bits in range(16):
            row = [0] * len(table)
            for i in range(4):
                if bits >> (3 - i) & 1:
                    row = [x ^ int(f"{d[4 * nibble + i]:032b}"[::-1], 2) for x, d in zip(row, table)]
            print("    {" + ", ".join(f"0x{x:08x}u" for x in row) + "},")


main()
