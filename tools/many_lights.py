#!/usr/bin/env python3
"""A hall of many small lights, and what choosing among them by a tree gains there.

    tools/many_lights.py COUNT FILE.obj            write the hall, of 2 COUNT glowing triangles, and FILE.mtl
    tools/many_lights.py --measure PROGRAM FOLDER [COUNT...]

Lamps hang at random over a floor with blocks, of powers that differ by up to 100. Measured: the variance that lobe render
tells (noise squared) and the seconds of the processor, by power and by tree, and how many times less time the tree takes
for the same noise."""
import json
import pathlib
import random
import subprocess
import sys


def write(count, path):
    generator = random.Random(count)
    path = pathlib.Path(path)
    size = 40.0
    quads = [("wall", [(-size, 0, -size), (-size, 0, size), (size, 0, size), (size, 0, -size)]),
             ("wall", [(-size, 0, -size), (size, 0, -size), (size, 12, -size), (-size, 12, -size)])]
    for _ in range(60):
        x, z, h = generator.uniform(-35, 35), generator.uniform(-35, 35), generator.uniform(1, 5)
        a, b, c, d = (x - 1, z - 1), (x - 1, z + 1), (x + 1, z + 1), (x + 1, z - 1)
        quads.append(("wall", [(*p[:1], h, p[1]) for p in (a, b, c, d)]))
        for p, q in ((a, b), (b, c), (c, d), (d, a)):
            quads.append(("wall", [(p[0], 0, p[1]), (q[0], 0, q[1]), (q[0], h, q[1]),
                                   (p[0], h, p[1])]))
    for _ in range(count):
        x, y, z = generator.uniform(-38, 38), generator.uniform(2, 9), generator.uniform(-38, 38)
        r = 0.1
        quads.append((f"lamp{generator.randrange(5)}", [(x - r, y, z - r), (x + r, y, z - r),
                                                        (x + r, y, z + r), (x - r, y, z + r)]))
    total = 4000.0 / count  # the hall is about as bright with few as with many
    with open(path.with_suffix(".mtl"), "w", encoding="ascii") as file:
        file.write("newmtl wall\nKd 0.6 0.6 0.6\nKs 0 0 0\n")
        for i in range(5):
            file.write(f"newmtl lamp{i}\nKd 0 0 0\nKs 0 0 0\nKe" + f" {total * 10 ** (i / 2):g}" * 3
                       + "\n")
    with open(path, "w", encoding="ascii") as file:
        file.write(f"mtllib {path.with_suffix('.mtl').name}\n")
        for number, (material, corners) in enumerate(quads):
            for corner in corners:
                file.write("v %g %g %g\n" % corner)
            first = 4 * number + 1
            file.write(f"usemtl {material}\nf {first} {first + 1} {first + 2} {first + 3}\n")


def measure(program, folder, counts):
    print("| glowing triangles | noise by power | by tree | seconds by power | by tree | time saved |\n"
          "|---|---|---|---|---|---|")
    camera = pathlib.Path(folder, "hall.json")
    camera.write_text(json.dumps({"frames": [{"camera": {
        "position": [0, 6, 38], "target": [0, 1, 0], "degrees": 55}}]}), encoding="ascii")
    for count in counts:
        scene = pathlib.Path(folder, f"hall{count}.obj")
        write(count, scene)
        told = []
        for how in ("power", "tree"):
            runs = [json.loads(subprocess.run(
                [program, "render", str(scene), "--camera-path", str(camera), "--size", "160x90",
                 "--spp", "64", "--lights", how, "--seed", str(seed), "--json"], check=True,
                capture_output=True).stdout) for seed in range(3)]
            noise = (sum(r["noise"] ** 2 for r in runs) / len(runs)) ** .5
            told.append((noise, sorted(r["cpu_seconds"] for r in runs)[1]))
        (a, s), (b, t) = told
        print(f"| {2 * count} | {a:.4f} | {b:.4f} | {s:.2f} | {t:.2f} | "
              f"{a * a * s / (b * b * t):.2f}× |", flush=True)


if __name__ == "__main__":
    if sys.argv[1] == "--measure":
        measure(sys.argv[2], sys.argv[3],
                [int(n) for n in sys.argv[4:]] or [1, 4, 16, 64, 500, 5000])
    else:
        write(int(sys.argv[1]), sys.argv[2])
