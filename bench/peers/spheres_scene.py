#!/usr/bin/env python3
"""spheres_scene.py BUNNY.obj ENVIRONMENT DIR: a scene that this renderer and Mitsuba express exactly.

Nine spheres, rough metals and diffuse ones, and a mesh of metal in a row of light from everywhere: about
250,000 triangles. Metals have F = 1, the diffuse surfaces no coat (KHR_materials_specular, factor 0).
Writes DIR/spheres.glb for `lobe`, DIR/*.ply and DIR/spheres.xml for Mitsuba, and names the environment
in the latter. Needs numpy.
"""
import argparse
import json
import math
import shutil
import struct
from pathlib import Path

import numpy

STEPS = 100  # of a sphere, both ways round: 2 STEPS (STEPS - 1) triangles
EYE, TARGET, DEGREES = (0.0, 2.4, 7.5), (0.0, 0.75, 0.0), 36.0
WIDTH, HEIGHT, DEPTH = 640, 360, 8
ROUGHNESS = (0.35, 0.5, 0.65, 0.8, 0.95)  # of the metal spheres, perceptual
GREYS = (0.8, 0.5, 0.3, 0.65)  # of the diffuse ones


def unit(vectors):
    return vectors / numpy.linalg.norm(vectors, axis=1, keepdims=True)


def sphere(centre, radius):
    polar, azimuth = numpy.meshgrid(numpy.linspace(0, math.pi, STEPS + 1),
                                    numpy.linspace(0, 2 * math.pi, STEPS + 1), indexing="ij")
    normals = numpy.stack([numpy.sin(polar) * numpy.cos(azimuth), numpy.cos(polar),
                           -numpy.sin(polar) * numpy.sin(azimuth)], axis=-1).reshape(-1, 3)
    triangles = []
    for i in range(STEPS):
        for k in range(STEPS):
            a, b = i * (STEPS + 1) + k, (i + 1) * (STEPS + 1) + k
            if i < STEPS - 1:
                triangles.append((a, b, b + 1))
            if i > 0:
                triangles.append((a, b + 1, a + 1))
    return normals * radius + centre, normals, numpy.array(triangles)


def mesh(path, height, centre):
    """The positions and triangles of an OBJ file, scaled, standing at `centre`, with smooth normals."""
    rows = [line.split() for line in path.read_text().splitlines()]
    places = numpy.array([[float(x) for x in r[1:4]] for r in rows if r and r[0] == "v"])
    triangles = numpy.array([[int(x.split("/")[0]) - 1 for x in r[1:4]] for r in rows
                             if r and r[0] == "f"])
    low, high = places.min(axis=0), places.max(axis=0)
    places = (places - [(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2]) * height / (high[1] - low[1])
    corners = places[triangles]
    faces = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = numpy.full(places.shape, 1e-20)
    for k in range(3):
        numpy.add.at(normals, triangles[:, k], faces)
    return places + centre, unit(normals), triangles


def floor(size):
    places = numpy.array([[-size, 0, size], [size, 0, size], [size, 0, -size], [-size, 0, -size]])
    return places, numpy.tile([0.0, 1.0, 0.0], (4, 1)), numpy.array([[0, 1, 2], [0, 2, 3]])


def shapes(bunny):
    """(name, roughness of a metal or None, grey, mesh) of everything."""
    yield "floor", None, 0.4, floor(30.0)
    for i in range(5):
        yield f"metal{i}", ROUGHNESS[i], 1.0, sphere((-2.6 + 1.3 * i, 0.55, -0.9), 0.55)
    for i in range(4):
        yield f"matte{i}", None, GREYS[i], sphere((-2.4 + 1.6 * i, 0.4, 1.4), 0.4)
    yield "bunny", 0.6, 1.0, mesh(bunny, 1.5, (0.0, 0.0, 0.3))


def material(roughness, grey):
    pbr = {"baseColorFactor": [grey, grey, grey, 1.0], "metallicFactor": 0.0 if roughness is None else 1.0,
           "roughnessFactor": 1.0 if roughness is None else roughness}
    bare = {"KHR_materials_specular": {"specularFactor": 0.0}}
    return {"pbrMetallicRoughness": pbr} | ({"extensions": bare} if roughness is None else {})


def write_glb(parts, path):
    data = bytearray()
    model = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
             "materials": [], "accessors": [], "bufferViews": [], "extensionsUsed": ["KHR_materials_specular"]}

    def accessor(array, kind, component):
        model["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        data.extend(array.tobytes())
        entry = {"bufferView": len(model["bufferViews"]) - 1, "componentType": component,
                 "count": len(array), "type": kind}
        if kind == "VEC3":
            entry |= {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
        model["accessors"].append(entry)
        return len(model["accessors"]) - 1

    for i, (_, roughness, grey, (places, normals, triangles)) in enumerate(parts):
        model["materials"].append(material(roughness, grey))
        attributes = {"POSITION": accessor(places.astype("<f4"), "VEC3", 5126),
                      "NORMAL": accessor(normals.astype("<f4"), "VEC3", 5126)}
        indices = accessor(triangles.astype("<u4").reshape(-1), "SCALAR", 5125)
        model["meshes"].append({"primitives": [{"attributes": attributes, "indices": indices, "material": i}]})
        model["nodes"].append({"mesh": i})
        model["scenes"][0]["nodes"].append(i)
    model["cameras"] = [{"type": "perspective", "perspective": {"yfov": math.radians(DEGREES), "znear": 0.01}}]
    tilt = math.atan2(EYE[1] - TARGET[1], EYE[2] - TARGET[2])
    model["nodes"].append({"camera": 0, "translation": EYE, "rotation": [-math.sin(tilt / 2), 0, 0, math.cos(tilt / 2)]})
    model["scenes"][0]["nodes"].append(len(model["nodes"]) - 1)
    model["buffers"] = [{"byteLength": len(data)}]
    text = json.dumps(model).encode()
    text += b" " * (-len(text) % 4)
    data.extend(b"\0" * (-len(data) % 4))
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data))
                     + struct.pack("<II", len(text), 0x4E4F534A) + text
                     + struct.pack("<II", len(data), 0x004E4942) + bytes(data))


def write_ply(places, normals, triangles, path):
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(places)}\n" + "".join(f"property float {n}\n" for n in ("x", "y", "z", "nx", "ny", "nz"))
              + f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    faces = numpy.zeros(len(triangles), dtype=[("n", "u1"), ("i", "<i4", 3)])
    faces["n"], faces["i"] = 3, triangles
    path.write_bytes(header.encode() + numpy.hstack([places, normals]).astype("<f4").tobytes() + faces.tobytes())


def bsdf(roughness, grey):
    if roughness is None:
        return f'<bsdf type="diffuse"><rgb name="reflectance" value="{grey}"/></bsdf>'
    return ('<bsdf type="roughconductor"><string name="material" value="none"/><string name="distribution" '
            f'value="ggx"/><float name="alpha" value="{roughness ** 2}"/></bsdf>')


def write_mitsuba(parts, environment, folder):
    """Mitsuba has a direction of a panorama a quarter of a turn on: it is turned back."""
    eye, target = (", ".join(map(str, v)) for v in (EYE, TARGET))
    text = [f'<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="{DEPTH + 1}"/>'
            '<integer name="rr_depth" value="5"/></integrator>',
            f'<sensor type="perspective"><float name="fov" value="{DEGREES}"/><string name="fov_axis" value="y"/>'
            f'<transform name="to_world"><lookat origin="{eye}" target="{target}" up="0, 1, 0"/></transform>'
            f'<film type="hdrfilm"><integer name="width" value="{WIDTH}"/><integer name="height" value="{HEIGHT}"/>'
            '<rfilter type="box"/></film><sampler type="independent"/></sensor>',
            f'<emitter type="envmap"><string name="filename" value="{environment.name}"/>'
            '<transform name="to_world"><rotate y="1" angle="90"/></transform></emitter>']
    for name, roughness, grey, (places, normals, triangles) in parts:
        write_ply(places, normals, triangles, folder / f"{name}.ply")
        surface = bsdf(roughness, grey)
        if roughness is not None:
            surface = f'<bsdf type="twosided">{surface}</bsdf>'
        text.append(f'<shape type="ply"><string name="filename" value="{name}.ply"/>{surface}</shape>')
    (folder / "spheres.xml").write_text("\n".join(text) + "\n</scene>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bunny", type=Path)
    parser.add_argument("environment", type=Path)
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    parts = list(shapes(arguments.bunny))
    shutil.copy(arguments.environment, arguments.folder)
    write_glb(parts, arguments.folder / "spheres.glb")
    write_mitsuba(parts, arguments.environment, arguments.folder)
    print(f"{arguments.folder}: {sum(len(p[3][2]) for p in parts)} triangles")


if __name__ == "__main__":
    main()
