#!/usr/bin/env python3
"""dielectric_furnace.py [LOBE]: the tables of docs/dielectrics.md: what a rough dielectric reflects and
transmits of even light, by quadrature and by the mean weight of draws, and with compensation; what it reflects
of all scatterings, as compensated and as walked."""
import csv
import math
import struct
import subprocess
import sys

LOBE = sys.argv[1] if len(sys.argv) > 1 else "build/lobe"
DRAWS = 1000000
INDICES, ALPHAS, COSINES = ("1.33", "1.5", "2.4"), ("0.1", "0.5", "1"), ("1", "0.3", "-0.3", "-1")


def run(*arguments):
    return subprocess.run([LOBE, *arguments], check=True, capture_output=True).stdout


def integrals(model, cosine, *more):
    text = run("albedo", *model, "--mu", cosine, *more).decode()
    return {name: float(x) for name, x in next(csv.DictReader(text.splitlines())).items()}


def sampled(model, cosine, seed):
    """Mean weight and its standard error."""
    z = float(cosine)
    wi = f"{math.sqrt(1 - z * z)!r},0,{z!r}"
    draws = run("sample", *model, "--wi", wi, "--count", str(DRAWS), "--seed", str(seed),
                "--format", "f32le")
    weights = [row[8] for row in struct.iter_unpack("<9f", draws)]
    mean = math.fsum(weights) / DRAWS
    variance = math.fsum((w - mean) ** 2 for w in weights) / DRAWS
    return mean, math.sqrt(variance / DRAWS)


def reflected_shares():
    """Correlated heights; the difference is that to the walk."""
    print("\n| index | alpha | cosine | once | compensated | walked | off by |")
    print("|---|---|---|---|---|---|---|")
    for index in INDICES:
        for alpha in ALPHAS:
            for cosine in COSINES:
                model = ["--bsdf", "dielectric", "--fresnel", "dielectric:" + index, "--alpha", alpha]
                once, made_up, walked = (
                    integrals(model, cosine, "--multiscatter", m)["all_r"]
                    for m in ("none", "turquin", "walk"))
                print(f"| {index} | {alpha} | {cosine} | {once:.4f} | {made_up:.4f} | {walked:.4f} | "
                      f"{made_up - walked:+.4f} |")


def main():
    print("| index | alpha | cosine | R | T | R + T | by draws | off by | compensated |")
    print("|---|---|---|---|---|---|---|---|---|")
    errors = []
    for index in INDICES:
        for alpha in ALPHAS:
            for cosine in COSINES:
                model = ["--bsdf", "dielectric", "--fresnel", "dielectric:" + index, "--alpha", alpha,
                         "--transport", "importance"]
                once = integrals(model, cosine)
                made_up = integrals(model, cosine, "--multiscatter", "turquin")["furnace"]
                mean, error = sampled(model, cosine, len(errors))
                off = (mean - once["energy"]) / error
                errors.append(off)
                print(f"| {index} | {alpha} | {cosine} | {once['r']:.4f} | {once['t']:.4f} | "
                      f"{once['energy']:.5f} | {mean:.5f} ± {error:.5f} | {off:+.1f} σ | {made_up:.4f} |")
    rms = math.sqrt(math.fsum(x * x for x in errors) / len(errors))
    print(f"\nRoot mean square of {len(errors)} deviations: {rms:.2f} standard errors.")
    reflected_shares()


if __name__ == "__main__":
    main()
