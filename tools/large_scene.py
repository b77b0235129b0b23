#!/usr/bin/env python3
"""Makes a large glTF file out of many copies of an OBJ mesh, to see what a scene costs.

    tools/large_scene.py bunny.obj large.glb --copies 140              one mesh of all triangles
    tools/large_scene.py bunny.obj many.glb --copies 100000 --instances nodes|gpu

Copies stand on a square grid, each turned about the vertical."""
import argparse
import json
import math
import struct
import sys
from array import array


def read_obj(path):
    """Positions in one flat list, and corners of triangles."""
    positions, corners = array("f"), array("I")
    with open(path, encoding="ascii", errors="replace") as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                positions.extend(float(word) for word in words[1:4])
            elif words[:1] == ["f"]:
                face = [int(word.split("/")[0]) - 1 for word in words[1:]]
                for k in range(1, len(face) - 1):
                    corners.extend((face[0], face[k], face[k + 1]))
    return positions, corners


def placements(count, size):
    """Where each copy stands, and how far it is turned."""
    across = math.isqrt(count - 1) + 1
    for i in range(count):
        yield (i % across) * size, (i // across) * size, 2.4 * i


def merged(positions, corners, count, size):
    """The copies as one mesh."""
    places, indices, vertices = array("f"), array("I"), len(positions) // 3
    for number, (x, z, angle) in enumerate(placements(count, size)):
        c, s = math.cos(angle), math.sin(angle)
        copy = array("f", positions)
        copy[0::3] = array("f", (c * a + s * b + x
                                 for a, b in zip(positions[0::3], positions[2::3])))
        copy[2::3] = array("f", (c * b - s * a + z
                                 for a, b in zip(positions[0::3], positions[2::3])))
        places.extend(copy)
        first = number * vertices
        indices.extend(array("I", (corner + first for corner in corners)))
    return places, indices


class Binary:
    """The buffer of the file, and what lies in it."""

    def __init__(self):
        self.parts, self.views, self.accessors, self.size = [], [], [], 0

    def add(self, numbers, component, kind, channels):
        data = numbers.tobytes()
        accessor = {"bufferView": len(self.views), "componentType": component, "type": kind,
                    "count": len(numbers) // channels}
        if channels == 3 and kind == "VEC3":
            accessor["min"] = [min(numbers[c::3]) for c in range(3)]
            accessor["max"] = [max(numbers[c::3]) for c in range(3)]
        self.views.append({"buffer": 0, "byteOffset": self.size, "byteLength": len(data)})
        self.accessors.append(accessor)
        self.parts.append(data)
        self.size += len(data)
        return len(self.accessors) - 1


def nodes_of(arguments, binary, size):
    if not arguments.instances:
        return [{"mesh": 0}]
    places = list(placements(arguments.copies, size))
    turns = [(0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2)) for _, _, angle in places]
    if arguments.instances == "nodes":
        return [{"mesh": 0, "translation": [x, 0, z], "rotation": turn}
                for (x, z, _), turn in zip(places, turns)]
    moves = array("f", (number for x, z, _ in places for number in (x, 0.0, z)))
    spins = array("f", (number for turn in turns for number in turn))
    return [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {
        "TRANSLATION": binary.add(moves, 5126, "VEC3", 3),
        "ROTATION": binary.add(spins, 5126, "VEC4", 4)}}}}]


def write_glb(path, document, parts):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    size = sum(len(part) for part in parts)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + size))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", size, b"BIN\0"))
        for part in parts:
            file.write(part)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("obj")
    parser.add_argument("glb")
    parser.add_argument("--copies", type=int, default=140)
    parser.add_argument("--instances", choices=["nodes", "gpu"])
    arguments = parser.parse_args()
    positions, corners = read_obj(arguments.obj)
    if not corners or arguments.copies < 1:
        sys.exit(f"{arguments.obj}: no faces, or no copies; give a mesh and a number")
    size = 1.2 * (max(positions) - min(positions))
    if not arguments.instances:
        positions, corners = merged(positions, corners, arguments.copies, size)
    binary = Binary()
    place = binary.add(positions, 5126, "VEC3", 3)
    index = binary.add(corners, 5125, "SCALAR", 1)
    nodes = nodes_of(arguments, binary, size)
    document = {"asset": {"version": "2.0"}, "scene": 0, "nodes": nodes,
                "scenes": [{"nodes": list(range(len(nodes)))}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": place}, "indices": index}]}],
                "bufferViews": binary.views, "accessors": binary.accessors,
                "buffers": [{"byteLength": binary.size}]}
    if arguments.instances == "gpu":
        document["extensionsUsed"] = document["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
    write_glb(arguments.glb, document, binary.parts)


if __name__ == "__main__":
    main()
