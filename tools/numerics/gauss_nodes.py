#!/usr/bin/env python3
"""The nodes and weights of kernel/beckmann_slopes.h: Gauss quadrature on [0, 1] with the weight 2x
(Gauss-Jacobi), 5 nodes for single precision and 9 for double (needs mpmath).

Usage: tools/numerics/gauss_nodes.py
"""
from mpmath import findroot, jacobi, mp, mpf, nstr, quad

mp.dps = 40


def nodes(count):
    """Roots of the Jacobi polynomial P(0,1) on [-1, 1], moved to [0, 1]"""
    steps = 400
    points = [mpf(2 * k) / steps - 1 for k in range(steps + 1)]
    roots = []
    for low, high in zip(points, points[1:]):
        if jacobi(count, 0, 1, low) * jacobi(count, 0, 1, high) < 0:
            roots.append(findroot(lambda x: jacobi(count, 0, 1, x), (low, high), solver="anderson"))
    assert len(roots) == count
    return [(1 + x) / 2 for x in roots]


def weight(k, at):
    """The integral of 2x times the Lagrange polynomial of node k"""

    def polynomial(x):
        product = 2 * x
        for j, node in enumerate(at):
            if j != k:
                product *= (x - node) / (at[k] - node)
        return product

    return quad(polynomial, [0, 1])


def main():
    for count in (5, 9):
        at = nodes(count)
        print(f"beckmann_slopes.h: {count} nodes and weights")
        for k, node in enumerate(at):
            print("   ", nstr(node, 20), nstr(weight(k, at), 20))


if __name__ == "__main__":
    main()
