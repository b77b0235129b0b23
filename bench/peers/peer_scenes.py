"""Small scenes that this renderer and Mitsuba 3 express exactly, as a .glb and as a dictionary.

All faces are flat, for the two treat shading normals differently near silhouettes. Metals have F = 1 (white by
Schlick's law) or the Fresnel reflectance of a conductor; diffuse surfaces have no coat. The panorama varies with
azimuth alone, for the two place its rows differently.
"""
import json
import math
import struct

import numpy

EYE, TARGET, DEGREES = (0.0, 1.6, 5.0), (0.0, 0.7, 0.0), 34.0
WIDTH, HEIGHT, DEPTH = 64, 48, 6
FINE, MARGIN = 8, 2  # parts of a pixel, and pixels around the picture: for our filter
GOLD = ((0.183, 0.421, 1.373), (3.424, 2.346, 1.770))


def diffuse(red, green, blue):
    return {"kind": "diffuse", "color": (red, green, blue)}


def metal(roughness, strength=0.0):
    """alpha is the square of the roughness across the direction of u; along it, it grows with the strength."""
    across = roughness ** 2
    return {"kind": "metal", "roughness": roughness, "strength": strength,
            "alpha": (across + (1 - across) * strength ** 2, across)}


def light(radiance):
    return {"kind": "light", "radiance": radiance}


def sphere(centre, radius, steps=24):
    """Triangles of a sphere, each with corners of its own."""
    def at(i, k):
        polar, azimuth = math.pi * i / steps, 2 * math.pi * k / steps
        return (math.sin(polar) * math.cos(azimuth), math.cos(polar), -math.sin(polar) * math.sin(azimuth))

    corners = []
    for i in range(steps):
        for k in range(steps):
            a, b, c, d = at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)
            corners += ([a, b, c] if i < steps - 1 else []) + ([a, c, d] if i > 0 else [])
    return {"shape": "mesh", "places": numpy.array(corners) * radius + centre}


def plate(centre, along, up, width, height):
    """A rectangle that faces along x up; u grows with `along`."""
    along, up = (numpy.array(v) / numpy.linalg.norm(v) for v in (along, up))
    return {"shape": "plate", "centre": numpy.array(centre), "u": along * width / 2, "v": up * height / 2}


FLOOR = (plate((0, 0, 0), (1, 0, 0), (0, 0, -1), 8, 8), diffuse(0.5, 0.5, 0.5))
PANEL = (plate((1.5, 3.2, 1.5), (1, 0, 0), (0, 0, 1), 1.2, 1.2), light(6.0))


def spheres(*materials):
    return [FLOOR, PANEL] + [(sphere((1.3 * i - 1.3, 0.6, 0), 0.6), m) for i, m in enumerate(materials)]


def plates(*materials):
    """Brushed in three directions."""
    turned = [FLOOR, PANEL]
    for i, m in enumerate(materials):
        angle = math.radians(60 * i + 15)
        x, y = numpy.array((1.0, 0, 0)), numpy.array((0, 0.8, -0.6))
        turned.append((plate((1.3 * i - 1.3, 0.7, 0), math.cos(angle) * x + math.sin(angle) * y,
                             math.cos(angle) * y - math.sin(angle) * x, 0.9, 0.9), m))
    return turned


# name: (parts, distribution, what metals reflect: None is everything)
SCENES = {
    "diffuse": (spheres(diffuse(0.8, 0.3, 0.2), diffuse(0.3, 0.8, 0.2), diffuse(0.7, 0.7, 0.7)), "ggx", None),
    "ggx": (spheres(metal(0.35), metal(0.6), metal(0.85)), "ggx", None),
    "ggx brushed": (plates(metal(0.3, 0.6), metal(0.5, 0.7), metal(0.4, 0.9)), "ggx", None),
    "ggx gold": (spheres(metal(0.35), metal(0.6), metal(0.85)), "ggx", GOLD),
    "beckmann": (spheres(metal(0.35), metal(0.6), metal(0.85)), "beckmann", None),
    "beckmann brushed": (plates(metal(0.3, 0.6), metal(0.5, 0.7), metal(0.4, 0.9)), "beckmann", None),
}


def write_panorama(path):
    """A row of 64 colours, smooth but for one bright place, twice: in PFM."""
    turn = 2 * math.pi * (numpy.arange(64) + 0.5) / 64
    row = numpy.stack([0.5 + 0.3 * numpy.cos(turn), 0.5 + 0.2 * numpy.sin(turn), 0.6 - 0.3 * numpy.cos(turn)], axis=-1)
    row += 6.0 * numpy.exp(-8 * (turn - 2.2) ** 2)[:, None]
    path.write_bytes(b"PF\n64 32\n-1.0\n" + numpy.tile(row, (32, 1, 1)).astype("<f4").tobytes())


# ---- glTF -----------------------------------------------------------------------------------------------

def gltf_material(m):
    bare = {"KHR_materials_specular": {"specularFactor": 0.0}}
    if m["kind"] == "light":
        bare["KHR_materials_emissive_strength"] = {"emissiveStrength": m["radiance"]}
        return {"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0.0},
                "emissiveFactor": [1, 1, 1], "extensions": bare}
    if m["kind"] == "diffuse":
        return {"pbrMetallicRoughness": {"baseColorFactor": [*m["color"], 1], "metallicFactor": 0.0}, "extensions": bare}
    material = {"pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": m["roughness"]}}
    if m["strength"]:
        material["extensions"] = {"KHR_materials_anisotropy": {"anisotropyStrength": m["strength"]}}
    return material


def gltf_corners(shape):
    """Positions, and texture coordinates or None, of triangles."""
    if shape["shape"] == "mesh":
        return shape["places"], None
    c, u, v = shape["centre"], shape["u"], shape["v"]
    order = [(-1, -1), (1, -1), (1, 1), (-1, -1), (1, 1), (-1, 1)]
    return (numpy.array([c + a * u + b * v for a, b in order]),
            numpy.array([((1 + a) / 2, (1 - b) / 2) for a, b in order]))


def write_glb(parts, path):
    data = bytearray()
    model = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(parts) + 1))}], "nodes": [],
             "meshes": [], "materials": [], "accessors": [], "bufferViews": [],
             "extensionsUsed": ["KHR_materials_specular", "KHR_materials_emissive_strength", "KHR_materials_anisotropy"]}

    def accessor(array, kind):
        array = array.astype("<f4")
        model["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        data.extend(array.tobytes())
        model["accessors"].append({"bufferView": len(model["bufferViews"]) - 1, "componentType": 5126, "type": kind,
                                   "count": len(array), "min": array.min(axis=0).tolist(),
                                   "max": array.max(axis=0).tolist()})
        return len(model["accessors"]) - 1

    for i, (shape, material) in enumerate(parts):
        places, uv = gltf_corners(shape)
        attributes = {"POSITION": accessor(places, "VEC3")}
        if uv is not None:
            attributes["TEXCOORD_0"] = accessor(uv, "VEC2")
        model["materials"].append(gltf_material(material))
        model["meshes"].append({"primitives": [{"attributes": attributes, "material": i}]})
        model["nodes"].append({"mesh": i})
    model["cameras"] = [{"type": "perspective", "perspective": {"yfov": math.radians(DEGREES), "znear": 0.01}}]
    tilt = math.atan2(EYE[1] - TARGET[1], EYE[2] - TARGET[2])
    model["nodes"].append({"camera": 0, "translation": EYE,
                           "rotation": [-math.sin(tilt / 2), 0, 0, math.cos(tilt / 2)]})
    model["buffers"] = [{"byteLength": len(data)}]
    text = json.dumps(model).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data))
                     + struct.pack("<II", len(text), 0x4E4F534A) + text
                     + struct.pack("<II", len(data), 0x004E4942) + bytes(data))


# ---- Mitsuba --------------------------------------------------------------------------------------------

def mitsuba_bsdf(m, distribution, conductor):
    if m["kind"] != "metal":
        color = m["color"] if m["kind"] == "diffuse" else (0, 0, 0)
        return {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(color)}}
    inner = {"type": "roughconductor", "distribution": distribution, "alpha_u": m["alpha"][0], "alpha_v": m["alpha"][1]}
    if conductor:
        inner |= {"eta": {"type": "rgb", "value": list(conductor[0])}, "k": {"type": "rgb", "value": list(conductor[1])}}
    else:
        inner["material"] = "none"
    return {"type": "twosided", "bsdf": inner}


def write_ply(places, path):
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(places)}\nproperty float x\nproperty float y\n"
              f"property float z\nelement face {len(places) // 3}\nproperty list uchar int vertex_indices\nend_header\n")
    faces = numpy.zeros(len(places) // 3, dtype=[("n", "u1"), ("i", "<i4", 3)])
    faces["n"], faces["i"] = 3, numpy.arange(len(places)).reshape(-1, 3)
    path.write_bytes(header.encode() + places.astype("<f4").tobytes() + faces.tobytes())


def filtered(picture):
    """The picture that our filter, a Blackman-Harris window 3 pixels wide, makes of parts of pixels."""
    t = 2 * math.pi * numpy.arange(3 * FINE + 1) / (3 * FINE)
    below = (0.35875 * t - 0.48829 * numpy.sin(t) + 0.14128 / 2 * numpy.sin(2 * t) - 0.01168 / 3 * numpy.sin(3 * t))
    weights = numpy.diff(below) / below[-1]
    first = FINE * (MARGIN - 1)

    def along(rows, count):
        return sum(w * rows[first + k:first + k + FINE * count:FINE] for k, w in enumerate(weights))

    return numpy.swapaxes(along(numpy.swapaxes(along(picture, HEIGHT), 0, 1), WIDTH), 0, 1)


def mitsuba_scene(mitsuba, name, panorama, folder):
    """Mitsuba has a direction of a panorama a quarter of a turn on: it is turned back. A path of n scatterings is one of
    n + 1 edges."""
    transform = mitsuba.ScalarTransform4f
    parts, distribution, conductor = SCENES[name]
    wide = math.degrees(2 * math.atan(math.tan(math.radians(DEGREES / 2)) * (HEIGHT + 2 * MARGIN) / HEIGHT))
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": DEPTH + 1, "rr_depth": 1000},
             "sensor": {"type": "perspective", "fov": wide, "fov_axis": "y",
                        "to_world": transform().look_at(origin=EYE, target=TARGET, up=(0, 1, 0)),
                        "film": {"type": "hdrfilm", "width": FINE * (WIDTH + 2 * MARGIN),
                                 "height": FINE * (HEIGHT + 2 * MARGIN), "rfilter": {"type": "box"}},
                        "sampler": {"type": "independent"}},
             "sky": {"type": "envmap", "filename": str(panorama), "to_world": transform().rotate((0, 1, 0), 90)}}
    for i, (shape, m) in enumerate(parts):
        surface = {"bsdf": mitsuba_bsdf(m, distribution, conductor)}
        if m["kind"] == "light":
            surface["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": [m["radiance"]] * 3}}
        if shape["shape"] == "mesh":
            write_ply(shape["places"], folder / f"{i}.ply")
            scene[f"part{i}"] = {"type": "ply", "filename": str(folder / f"{i}.ply"), "face_normals": True} | surface
        else:
            u, v, c = shape["u"], shape["v"], shape["centre"]
            matrix = numpy.eye(4)
            matrix[:3, 0], matrix[:3, 1], matrix[:3, 3] = u, v, c
            matrix[:3, 2] = numpy.cross(u, v) / numpy.linalg.norm(numpy.cross(u, v))
            scene[f"part{i}"] = {"type": "rectangle", "to_world": transform(matrix)} | surface
    return mitsuba.load_dict(scene)
