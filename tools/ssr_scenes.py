#!/usr/bin/env python3
"""ssr_scenes.py FOLDER: writes floor.glb and arcade.glb, the scenes of the second table of docs/ssr.md.

floor: tiles with a strong normal map before coloured walls, blocks and a cylinder, under the open sky.
arcade: a court between two rows of columns with arches, as in Sponza: stone with normal maps, hanging
cloths, a vault on either side and the sky above.
"""
import json
import math
import struct
import sys
import zlib
from array import array
from pathlib import Path


def png(size, pixel):
    """Three bytes a pixel, from pixel(u, v)."""
    rows = bytearray()
    for y in range(size):
        rows.append(0)
        for x in range(size):
            rows.extend(max(0, min(255, int(255 * c + 0.5))) for c in pixel((x + 0.5) / size, (y + 0.5) / size))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(bytes(rows))) + chunk(b"IEND", b""))


def normals_of(height):
    """The normal map of a height over the unit square."""
    def pixel(u, v):
        step = 1 / 512
        du = (height(u + step, v) - height(u - step, v)) / (2 * step)
        dv = (height(u, v + step) - height(u, v - step)) / (2 * step)
        length = math.sqrt(du * du + dv * dv + 1)
        return 0.5 - 0.5 * du / length, 0.5 + 0.5 * dv / length, 0.5 + 0.5 / length
    return pixel


def waves(u, v):
    turn = 2 * math.pi
    return (0.02 * math.sin(turn * 2 * u) * math.sin(turn * 2 * v) +
            0.004 * math.sin(turn * (5 * u + 3 * v)))


def bricks(u, v):
    row = math.floor(4 * v)
    x, y = (2 * u + 0.5 * (row % 2)) % 1, (4 * v) % 1
    edge = min(min(x, 1 - x) * 2, min(y, 1 - y))
    return (0.02 * min(1, edge / 0.08) +
            0.001 * math.sin(2 * math.pi * (9 * u + 4 * v)) * math.sin(2 * math.pi * (3 * u - 7 * v)))


class Scene:
    """A glTF file in the making: a mesh a material."""

    def __init__(self):
        self.blob, self.views, self.accessors = bytearray(), [], []
        self.images, self.materials, self.meshes = [], [], []

    def view(self, data):
        self.blob.extend(b"\0" * (-len(self.blob) % 4))
        self.views.append({"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data)})
        self.blob.extend(data)
        return len(self.views) - 1

    def texture(self, size, pixel):
        self.images.append({"bufferView": self.view(png(size, pixel)), "mimeType": "image/png"})
        return {"index": len(self.images) - 1}

    def material(self, color, roughness, metallic=0.0, normal=None, base=None):
        surface = {"baseColorFactor": [*color, 1], "roughnessFactor": roughness, "metallicFactor": metallic}
        if base:
            surface["baseColorTexture"] = base
        material = {"pbrMetallicRoughness": surface, "doubleSided": True}
        if normal:
            material["normalTexture"] = normal
        self.materials.append(material)
        self.meshes.append(([], [], [], []))
        return len(self.materials) - 1

    def quad(self, material, corner, a, b, across=1.0, up=1.0):
        """From a corner along a and b; the texture repeats `across` and `up` times."""
        places, normals, uvs, indices = self.meshes[material]
        n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        length = math.sqrt(sum(c * c for c in n))
        first = len(places) // 3
        for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
            places.extend(corner[k] + s * a[k] + t * b[k] for k in range(3))
            normals.extend(c / length for c in n)
            uvs.extend((s * across, t * up))
        indices.extend(first + k for k in (0, 1, 2, 0, 2, 3))

    def box(self, material, low, high):
        (x, y, z), (u, v, w) = low, (high[k] - low[k] for k in range(3))
        self.quad(material, (x, y, z + w), (u, 0, 0), (0, v, 0), u, v)
        self.quad(material, (x + u, y, z), (-u, 0, 0), (0, v, 0), u, v)
        self.quad(material, (x, y, z), (0, 0, w), (0, v, 0), w, v)
        self.quad(material, (x + u, y, z + w), (0, 0, -w), (0, v, 0), w, v)
        self.quad(material, (x, y + v, z + w), (u, 0, 0), (0, 0, -w), u, w)
        self.quad(material, (x, y, z), (u, 0, 0), (0, 0, w), u, w)

    def round(self, material, x, z, radius, low, high, sides=32):
        """The side of a standing cylinder."""
        places, normals, uvs, indices = self.meshes[material]
        first = len(places) // 3
        for k in range(sides + 1):
            angle = 2 * math.pi * k / sides
            c, s = math.cos(angle), math.sin(angle)
            for y in (low, high):
                places.extend((x + radius * c, y, z + radius * s))
                normals.extend((c, 0, s))
                uvs.extend((4 * radius * k / sides, y))
        for k in range(sides):
            at = first + 2 * k
            indices.extend((at, at + 1, at + 3, at, at + 3, at + 2))

    def arch(self, material, x, z, width, thick, spring, top, parts=16):
        """A wall along z from x - thick to x + thick above a half circle."""
        radius = width / 2
        for k in range(parts):
            a, b = math.pi * k / parts, math.pi * (k + 1) / parts
            z0, z1 = z - radius * math.cos(a), z - radius * math.cos(b)
            y0, y1 = spring + radius * math.sin(a), spring + radius * math.sin(b)
            low = min(y0, y1)
            for side in (x - thick, x + thick):
                self.quad(material, (side, low, z0), (0, 0, z1 - z0), (0, top - low, 0), z1 - z0, top - low)
            self.quad(material, (x - thick, y0, z0), (2 * thick, 0, 0), (0, y1 - y0, z1 - z0), 1, 0.2)

    def accessor(self, code, numbers, kind, width):
        data = array(code, numbers)
        entry = {"bufferView": self.view(data.tobytes()), "componentType": 5126 if code == "f" else 5125,
                 "type": kind, "count": len(data) // width}
        if kind == "VEC3":
            entry["min"] = [min(data[k::3]) for k in range(3)]
            entry["max"] = [max(data[k::3]) for k in range(3)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def write(self, path, eye, target, degrees):
        primitives = []
        for material, (places, normals, uvs, indices) in enumerate(self.meshes):
            primitives.append({"material": material, "indices": self.accessor("I", indices, "SCALAR", 1),
                               "attributes": {"POSITION": self.accessor("f", places, "VEC3", 3),
                                              "NORMAL": self.accessor("f", normals, "VEC3", 3),
                                              "TEXCOORD_0": self.accessor("f", uvs, "VEC2", 2)}})
        back = unit([eye[k] - target[k] for k in range(3)])
        right = unit([back[2], 0, -back[0]])
        up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
              back[0] * right[1] - back[1] * right[0]]
        document = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"mesh": 0}, {"camera": 0, "matrix": [*right, 0, *up, 0, *back, 0, *eye, 1]}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": math.radians(degrees), "znear": 0.1}}],
            "meshes": [{"primitives": primitives}], "materials": self.materials, "images": self.images,
            "textures": [{"source": k} for k in range(len(self.images))],
            "accessors": self.accessors, "bufferViews": self.views,
            "buffers": [{"byteLength": len(self.blob)}]}
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        self.blob.extend(b"\0" * (-len(self.blob) % 4))
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(self.blob)) +
                         struct.pack("<I4s", len(text), b"JSON") + text +
                         struct.pack("<I4s", len(self.blob), b"BIN\0") + self.blob)


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def floor(path):
    s = Scene()
    tiles = s.material((0.6, 0.55, 0.5), 0.3, 1.0, normal=s.texture(256, normals_of(waves)))
    s.quad(tiles, (-6, 0, 6), (12, 0, 0), (0, 0, -12), 6, 6)
    walls = [s.material(c, 0.8) for c in ((0.75, 0.25, 0.2), (0.2, 0.35, 0.7), (0.75, 0.7, 0.6))]
    s.quad(walls[0], (-4, 0, 3), (0, 0, -7), (0, 3, 0))
    s.quad(walls[1], (4, 0, -4), (0, 0, 7), (0, 3, 0))
    pale = s.material((0.9, 0.85, 0.7), 0.8)
    for k in range(8):
        s.quad(pale if k % 2 else walls[2], (-4 + k, 0, -4), (1, 0, 0), (0, 3, 0))
    for k, color in enumerate(((0.8, 0.6, 0.1), (0.1, 0.6, 0.3), (0.7, 0.1, 0.4), (0.1, 0.5, 0.7))):
        x, height = -2.6 + 1.7 * k, 0.6 + 0.45 * k
        s.box(s.material(color, 0.6), (x - 0.4, 0, -2.2 - 0.4 * (k % 2)), (x + 0.4, height, -1.4 - 0.4 * (k % 2)))
    s.round(s.material((0.9, 0.9, 0.9), 0.7), -1.2, 0.6, 0.35, 0, 1.3)
    s.quad(s.material((0.95, 0.95, 0.9), 0.6), (-0.6, 1.9, -3.95), (1.6, 0, 0), (0, 0.8, 0))
    s.write(path, (0.6, 1.9, 5.4), (0, 0.55, -1), 50)


def arcade(path):
    s = Scene()
    stone = s.texture(256, normals_of(bricks))

    def stripes(u, v):
        shade = 0.55 + 0.2 * (math.floor(4 * v) % 2) + 0.08 * math.sin(40 * u) * math.sin(23 * v + 5 * u)
        return shade, 0.9 * shade, 0.75 * shade

    def checks(u, v):
        shade = 0.7 if (math.floor(2 * u) + math.floor(2 * v)) % 2 else 0.35
        return shade, 0.95 * shade, 0.85 * shade
    ground = s.material((1, 1, 1), 0.3, normal=stone, base=s.texture(128, checks))
    wall = s.material((1, 1, 1), 0.7, normal=stone, base=s.texture(128, stripes))
    column = s.material((0.75, 0.7, 0.62), 0.5)
    s.quad(ground, (-5, 0, 14), (10, 0, 0), (0, 0, -28), 10, 28)
    for side in (-1, 1):
        s.quad(wall, (side * 5, 0, 14 * side), (0, 0, -28 * side), (0, 7, 0), 28, 7)
        s.quad(wall, (side * 5, 4.6, -14), (-side * 2.7, 0, 0), (0, 0, 28), 3, 28)
        for k in range(-4, 5):
            z = 3.0 * k
            s.box(column, (side * 2.5 - 0.4, 0, z - 0.4), (side * 2.5 + 0.4, 0.35, z + 0.4))
            s.round(column, side * 2.5, z, 0.28, 0.35, 2.6)
            s.box(column, (side * 2.5 - 0.38, 2.6, z - 0.38), (side * 2.5 + 0.38, 2.85, z + 0.38))
            s.arch(wall, side * 2.5, z + 1.5, 2.24, 0.2, 2.85, 4.6)
            s.box(wall, (side * 2.5 - 0.2, 2.85, z - 0.38), (side * 2.5 + 0.2, 4.6, z + 0.38))
        s.quad(wall, (side * 2.3, 4.6, 14 * side), (0, 0, -28 * side), (0, 2.4, 0), 28, 2.4)
    for z in (-14, 14):
        s.quad(wall, (5 if z > 0 else -5, 0, z), (-10 if z > 0 else 10, 0, 0), (0, 7, 0), 10, 7)
    cloths = [s.material(c, 0.9) for c in ((0.65, 0.08, 0.06), (0.08, 0.3, 0.1), (0.08, 0.12, 0.5))]
    for k in range(-3, 4):
        for side in (-1, 1):
            x, z = side * 2.25, 3.0 * k + 1.0
            for part in range(6):
                x0, x1 = (x + 0.06 * math.sin(2.1 * p) for p in (part, part + 1))
                s.quad(cloths[(k + (side > 0)) % 3], (x0, 2.3, z + 0.16 * part), (x1 - x0, 0, 0.16), (0, 2.1, 0))
    s.write(path, (-0.9, 1.6, 10.5), (0.2, 1.1, 0), 55)


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__.strip())
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    floor(folder / "floor.glb")
    arcade(folder / "arcade.glb")


if __name__ == "__main__":
    main()
