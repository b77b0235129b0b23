#!/usr/bin/env python3
"""What averaging textures over footprints gains: errors of lobe render with the default --footprint and with 0.

    tools/footprint_results.py PROGRAM SCENE...

The error is against two references whose textures are not averaged: what averaging blurs counts as an error. See
tools/adaptive_results.py.
"""
import pathlib
import sys

import adaptive_results

SPP = 1, 4, 16, 64


def main():
    program, *scenes = sys.argv[1:]
    print("| scene | --spp | RMSE, texels as they are | averaged | relative, as they are | averaged | seconds of the processor |\n"
          "|---|---|---|---|---|---|---|")
    for scene in scenes:
        references = [adaptive_results.render(program, scene, 2048, seed, "--footprint", "0")[0]
                      for seed in (1001, 1002)]
        for spp in SPP:
            plain = adaptive_results.measure(program, scene, spp, references, "--footprint", "0")
            averaged = adaptive_results.measure(program, scene, spp, references)
            print(f"| {pathlib.Path(scene).stem} | {spp} | " + " | ".join(
                f"{max(x, 0) ** .5:.4g}" for x in (plain[0], averaged[0], plain[1], averaged[1])) +
                f" | {averaged[3] / plain[3]:.2f}× |", flush=True)


if __name__ == "__main__":
    main()
