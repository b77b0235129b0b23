"""lobe info: what it tells of a scene is what is in it."""
import base64
import json
import struct

from program import ERROR_LINE, FolderTest, main, run

POSITIONS = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0)
TIMES = struct.pack("<2f", 0, 1.5)
MOVES = struct.pack("<6f", 0, 0, 0, 0, 0, 2)
RED = "data:image/png;base64," + base64.b64encode(b"P6 1 1 255 \xff\0\0").decode()


def document():
    """Two nodes of one mesh, and one of everything else."""
    data = POSITIONS + TIMES + MOVES
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [1, 0, 0]},
                  {"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "meshes": [{"name": "leaf", "primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "cameras": [{"name": "eye", "type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
        "materials": [
            {"name": "green\x1b[31m", "alphaMode": "MASK",
             "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0},
             "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}},
            {"name": "lamp", "emissiveFactor": [1, 1, 1]}],
        "textures": [{"source": 0}], "images": [{"name": "leaf colour", "uri": RED}],
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_clearcoat", "KHR_materials_sheen"],
        "extensionsRequired": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "name": "sun", "spot": {}}]}},
        "animations": [{"name": "wave", "channels": [
            {"sampler": 0, "target": {"node": 0, "path": "translation"}}],
            "samplers": [{"input": 1, "output": 2, "interpolation": "STEP"}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
            {"bufferView": 1, "componentType": 5126, "type": "SCALAR", "count": 2, "min": [0],
             "max": [1.5]},
            {"bufferView": 2, "componentType": 5126, "type": "VEC3", "count": 2}],
        "bufferViews": [{"buffer": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": 8},
                        {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(data).decode()}]}


class InfoTest(FolderTest):
    def write(self, **more):
        path = self.path("t.gltf")
        with open(path, "w", encoding="ascii") as file:
            json.dump({**document(), **more}, file)
        return path

    def test_all_is_told(self):
        result = run("info", self.write(), "--frame-time", "2", "--json")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")
        self.assertIn(b"KHR_materials_sheen", result.stderr)
        info = json.loads(result.stdout)
        self.assertEqual((info["triangles"], info["placed_triangles"], info["instances"],
                          info["vertices"], info["warnings"]), (2, 2, 0, 6, 1))
        self.assertEqual((info["low"], info["high"]), ([-1, -1, 0], [2, 1, 2]))
        self.assertGreater(info["bytes"]["tree_peak"], 0)
        self.assertEqual(info["bytes"]["textures"], 3)
        self.assertEqual(info["meshes"], [{"name": "leaf", "triangles": 1, "uses": 2}])
        self.assertEqual(info["materials"], [
            {"name": "green?[31m", "triangles": 2,
             "about": "dielectric, clear coat, alpha mask, colour map"},
            {"name": "lamp", "triangles": 0, "about": "metal, emission"}])
        self.assertEqual(info["textures"], [
            {"name": "leaf colour", "width": 1, "height": 1, "about": "colour"}])
        self.assertEqual(info["lights"], [{"name": "sun", "about": "spot"}])
        self.assertEqual(info["cameras"], [{"name": "eye", "about": "57.3 degrees high"}])
        self.assertEqual(info["animations"], [
            {"name": "wave", "channels": 1, "seconds": 1.5, "about": "translation, steps"}])
        self.assertEqual(info["extensions"], [
            {"name": "KHR_lights_punctual", "about": "read, required"},
            {"name": "KHR_materials_clearcoat", "about": "read"},
            {"name": "KHR_materials_sheen", "about": "ignored"}])

    def test_text_tells_the_same(self):
        text = run("info", self.write(), "--most", "1").stdout.decode()
        for line in ("triangles   2 in memory", "meshes      1", "  leaf: 1 triangles, shown 2 times",
                     "materials   2", "  and 1 more", "  wave: 1.5 s, 1 channels, translation, steps",
                     "  KHR_lights_punctual: read, required"):
            self.assertIn(line, text.splitlines())
        self.assertNotIn("lamp", text)

    def test_scenes_without_files(self):
        info = json.loads(self.done("info", "cornell", "--json"))
        self.assertEqual(info["meshes"], [
            {"name": "cornell", "triangles": info["triangles"], "uses": 1}])
        self.assertEqual(info["emissive_triangles"], 2)
        self.assertEqual(sum(m["triangles"] for m in info["materials"]), info["triangles"])

    def test_strict(self):
        self.rejected("info", self.write(), "--frame-time", "2", "--strict", where=self.path("t.gltf"))
        used = document()["extensionsUsed"][:2]
        self.done("info", self.write(extensionsUsed=used), "--frame-time", "2", "--strict")
        self.rejected("info", self.write(extensionsUsed=used), "--strict")

    def test_errors(self):
        self.rejected("info", where="info")
        self.rejected("info", "nowhere.glb", where="nowhere.glb")
        self.rejected("info", "cornell", "--animation", "all", where="--animation")
        self.rejected("info", "cornell", "--most", "x", where="--most")


if __name__ == "__main__":
    main()
