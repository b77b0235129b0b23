#!/usr/bin/env python3
"""lib/albedo_nodes.inc: the double exponential rule on (0, 1), x = 1/(1 + exp(-pi sinh t)).

Usage: tools/numerics/albedo_nodes.py > lib/albedo_nodes.inc
Each row: x, 1 - x (each to all its digits) and the weight.
The step of t is 1/10; every second or fourth row makes the coarser rules.
"""
from math import cosh, exp, pi, sinh

LAST = 32

print("/* Made by tools/numerics/albedo_nodes.py. */")
for k in range(-LAST, LAST + 1):
    t = k / 10
    e = pi * sinh(t)
    x, rest = 1 / (1 + exp(-e)), 1 / (1 + exp(e))
    weight = pi / 10 * cosh(t) * x * rest
    print("{%.17g, %.17g, %.17g}," % (x, rest, weight))
