"""lobe render from outside: pictures, statistics, errors. tests/render proves the tracer itself."""
import base64
import json
import os
import random
import re
import resource
import signal
import struct
import subprocess
import tempfile
import time
from pathlib import Path

from program import ERROR_LINE, PROGRAM, ProgramTest, main, run

SMALL = ["--size", "32x18", "--spp", "2"]
MAGIC = {".exr": b"\x76\x2f\x31\x01", ".png": b"\x89PNG", ".hdr": b"#?RADIANCE",
         ".pfm": b"PF\n32 18\n"}
TRIANGLE = "mtllib t.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"

BAD_VALUES = {
    "--size": ["", "64", "0x10", "10x0", "-1x5", "64x36x2", "64X36", "32769x1",
               "99999999999x1", "axb"],
    "--spp": ["0", "-1", "1.5", "", "16777217"],
    "--time": ["-1", "nan", "inf", "", "1s"],
    "--depth": ["-1", "1000001", "x"],
    "--seed": ["-1", "18446744073709551616"],
    "--threads": ["0", "1025", "-2"],
    "--exposure": ["nan", "1000", "up"],
    "--env-rotate": ["nan", "1e9", ""],
    "--aperture": ["", "-1", "nan", "f/0", "f/", "f/-2", "f2", "1,2", "wide", "1e16"],
    "--focus": ["", "0", "-1", "nan", "inf", "near", "1e16"],
    "--frame-time": ["nan", "", "now"],
    "--animation": ["", "Walk"],
    "--aov": ["", "albedo,", "colour", ",normal", "a" * 100],
    "--material": ["1,1,1,1", "1,1,1,1,2", "-1,0,0,0,0", "gold", ""],
    "--method": ["best", ""],
    "--metal": ["", "goldd", "Gold", "schlick,", "f82", "f82:", "f82:2,0,0", "f82:0,0,-0.1", "f82:nan,0,0",
                "f82:1,1", "f82:1,1,1,1", "conductor:", "conductor:1,1,1,1,1", "conductor:0,1,1,1,1,1",
                "conductor:1,1,1,-1,1,1", "conductor:1,1,1,1,1,inf", "conductor:1,1,1,1,1,1e9",
                "conductor:1,1,1,1,1,1,1", "conductor:1 1 1 1 1 1", "x" * 5000],
    "--heuristic": ["veach", ""],
    "--g2": ["x"],
    "--normalization": ["x"],
    "--progress": ["x"],
}


class RenderTest(ProgramTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def path(self, name, content=None):
        path = self.folder / name
        if content is not None:
            path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return str(path)

    def render(self, name, *arguments, scene="gallery"):
        """The bytes of the picture."""
        self.done("render", scene, *SMALL, "-o", self.path(name), *arguments)
        return (self.folder / name).read_bytes()

    def statistics(self, *arguments, scene="gallery"):
        return json.loads(self.done("render", scene, *SMALL, "--json", *arguments))


class PictureTest(RenderTest):
    def test_formats(self):
        for ending, magic in MAGIC.items():
            self.assertTrue(self.render("a" + ending).startswith(magic), ending)

    def test_built_in_scenes(self):
        names = [line.split()[0] for line in
                 self.done("render", "--list-scenes").decode().splitlines()]
        lines = self.done("render", "--list-scenes", "--json").splitlines()
        self.assertEqual([json.loads(line)["name"] for line in lines], names)
        self.assertLessEqual({"gallery", "furnace", "brushed", "normal-mapped", "cornell"}, set(names))
        pictures = {self.render("a.pfm", scene=name) for name in names}
        self.assertEqual(len(pictures), len(names))

    def test_seed_decides_and_threads_do_not(self):
        one = self.render("a.pfm", "--threads", "1", "--seed", "5")
        self.assertTrue(one == self.render("b.pfm", "--threads", "3", "--seed", "5"))
        self.assertFalse(one == self.render("c.pfm", "--seed", "6"))
        walk = ("--multiscatter", "walk")
        self.assertTrue(self.render("a.pfm", "--threads", "1", *walk) ==
                        self.render("b.pfm", "--threads", "3", *walk))

    def test_every_option_changes_the_picture(self):
        """A wall whose shading normals face away often, and a scene with a lamp."""
        panorama = self.path("panorama.pfm")
        self.done("render", "gallery", *SMALL, "-o", panorama)
        for scene, *option in (("normal-mapped", "--normalization", "previous"),
                               ("normal-mapped", "--g2", "separable"), ("gallery", "--depth", "1"),
                               ("gallery", "--method", "ndf"), ("gallery", "--spp", "3"),
                               ("gallery", "--heuristic", "power"), ("gallery", "--env", panorama),
                               ("gallery", "--exposure", "0.5"),
                               ("gallery", "--aperture", "0.1"),
                               ("gallery", "--aperture", "f/0.05"),
                               ("gallery", "--aperture", "0.1", "--focus", "5"),
                               ("gallery", "--multiscatter", "kulla-conty"),
                               ("gallery", "--multiscatter", "turquin"),
                               ("gallery", "--multiscatter", "walk"),
                               ("gallery", "--metal", "f82:0.8,0.7,0.6"),
                               ("gallery", "--metal", "conductor:0.2,2,1.5,3.6,3.1,2"),
                               ("gallery", "--metal", "gold")):
            pictures = set()
            for extra in ([], option):
                samples = [] if "--spp" in extra else ["--spp", "2"]
                self.done("render", scene, "--size", "32x18", *samples, *extra, "-o",
                          self.path("a.pfm"))
                pictures.add(Path(self.path("a.pfm")).read_bytes())
            self.assertEqual(len(pictures), 2, option)

    def test_metals(self):
        """Schlick is the default; a metal is its numbers; the names that an error offers are those of --help."""
        self.assertEqual(self.render("a.exr"), self.render("b.exr", "--metal", "schlick"))
        gold = self.render("a.exr", "--metal", "gold")
        self.assertEqual(gold, self.render("b.exr", "--metal",
                                           "conductor:0.156,0.424,1.383,3.602,2.472,1.915"))
        self.assertIn(b"metal conductor:0.156", gold)
        offered = run("render", "gallery", *SMALL, "--json", "--metal", "x").stderr.decode()
        names = re.findall(r"[a-z]{4,}", offered.split("KB")[-1])
        self.assertEqual(len(names), 8)
        text = " ".join(self.done("render", "--help").decode().split())
        self.assertIn(", ".join(names), text)
        self.assertEqual(len({self.render("a.pfm", "--metal", name) for name in names}), 8)

    def test_pictures_of_other_metals_are_not_joined(self):
        self.render("a.exr", "--metal", "gold")
        self.render("b.exr", "--metal", "silver", "--seed", "2")
        self.rejected("merge", self.path("a.exr"), self.path("b.exr"), "-o", self.path("c.exr"))

    def test_environment_turns(self):
        panorama = self.path("panorama.pfm")
        self.done("render", "gallery", *SMALL, "-o", panorama)
        pictures = {self.render("a.pfm", "--env", panorama),
                    self.render("b.pfm", "--env", panorama, "--env-rotate", "90")}
        self.assertEqual(len(pictures), 2)

    def test_material_and_ground_of_a_file(self):
        triangle = self.path("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        pictures = {self.render("a.pfm", *options, scene=triangle) for options in
                    ([], ["--material", "1,0.1,0.1,1,0.3"], ["--ground"])}
        self.assertEqual(len(pictures), 3)

    def test_channels(self):
        picture = self.render("a.exr", "--aov", "rejected,albedo")
        for channel, is_there in ((b"albedo.R", True), (b"rejected.Y", True), (b"depth.Z", False)):
            self.assertEqual(channel in picture, is_there, channel)

    def test_time_limit_ends_it(self):
        statistics = json.loads(self.done(
            "render", "gallery", "--size", "64x36", "--spp", "16777216", "--time", "0.3", "--json"))
        self.assertGreater(statistics["samples"], 0)
        self.assertLess(statistics["spp"], 16777216)


class StatisticsTest(RenderTest):
    def test_json(self):
        statistics = self.statistics("--method", "caps")
        self.assertEqual((statistics["scene"], statistics["method"]), ("gallery", "caps"))
        self.assertEqual((statistics["width"], statistics["height"], statistics["spp"]), (32, 18, 2))
        self.assertEqual(statistics["samples"], 32 * 18 * 2)
        self.assertEqual(statistics["rejected_share"], statistics["rejected"] / statistics["draws"])

    def test_rejected_share_falls(self):
        shares = [self.statistics("--method", method)["rejected_share"]
                  for method in ("ndf", "caps", "optimal")]
        self.assertGreater(shares[0], shares[1])
        self.assertGreater(shares[1], shares[2])

    def test_reference(self):
        self.render("a.pfm")
        same = self.statistics("--reference", self.path("a.pfm"))["error"]
        self.assertEqual((same["rmse"], same["relmse"], same["largest"]), (0, 0, 0))
        other = self.statistics("--reference", self.path("a.pfm"), "--seed", "9")["error"]
        self.assertGreater(other["rmse"], 0)
        line = self.done("render", "gallery", *SMALL, "--reference", self.path("a.pfm"))
        self.assertTrue(line.startswith(b"rmse 0, "))

    def test_names_are_quoted(self):
        """A scene whose name is no UTF-8 and holds a quote still gives JSON, also as progress."""
        name = os.fsencode(self.folder) + b'/a\xff".obj'
        Path(os.fsdecode(name)).write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        result = run("render", name, *SMALL, "--json", "--progress", "json")
        self.assertEqual(result.returncode, 0)
        self.assertTrue(json.loads(result.stdout)["scene"].endswith('/a?".obj'))
        for line in result.stderr.splitlines():
            self.assertIn(json.loads(line)["progress"], ("build", "render"))


class InterruptTest(RenderTest):
    def test_interrupt_saves_the_picture(self):
        picture = self.path("a.exr")
        command = [PROGRAM, "render", "gallery", "--size", "96x54", "--spp", "16777216", "-o",
                   picture, "--progress", "json"]
        with subprocess.Popen(command, stderr=subprocess.PIPE) as process:
            while b'"render"' not in process.stderr.readline():
                pass  # the tree, if it takes a while
            process.send_signal(signal.SIGINT)
            process.stderr.read()
            self.assertEqual(process.wait(timeout=60), 130)
        self.assertTrue(Path(picture).read_bytes().startswith(MAGIC[".exr"]))
        self.assertEqual(os.listdir(self.folder), ["a.exr"])

    def test_nothing_done_is_nothing_saved(self):
        """An interrupt while a large scene is read leaves an older picture alone."""
        picture = self.path("a.pfm", "old")
        side = range(400)
        rows = [f"v {x} {y} 0" for y in side for x in side]
        rows += [f"f {i} {i + 1} {i + 401} {i + 400}" for i in range(1, 400 * 399) if i % 400]
        scene = self.path("grid.obj", "\n".join(rows))
        with subprocess.Popen([PROGRAM, "render", scene, *SMALL, "-o", picture]) as process:
            time.sleep(0.15)
            process.send_signal(signal.SIGINT)
            self.assertIn(process.wait(timeout=60), (130, -signal.SIGINT))
        self.assertEqual(Path(picture).read_bytes(), b"old")


class ErrorTest(RenderTest):
    def test_values(self):
        for option, values in BAD_VALUES.items():
            for value in values:
                self.rejected("render", "gallery", "-o", self.path("a.exr"), f"{option}={value}",
                              where=option)

    def test_usage(self):
        self.rejected("render", where="render")
        self.rejected("render", "gallery", where="-o")
        self.rejected("render", "gallery", "cornell", where="cornell")
        self.rejected("render", "gallery", *SMALL, "-o", self.path("a.jpg"))
        self.rejected("render", "gallery", *SMALL, "-o", self.path("a"))
        self.rejected("render", "gallery", *SMALL, "-o", self.path("a.png"), "--aov", "depth",
                      where="--aov")
        self.rejected("render", "gallery", *SMALL, "--json", "--aov", "depth", where="--aov")
        self.rejected("render", "gallery", *SMALL, "--json", "--camera", "none")
        self.rejected("render", "gallery", *SMALL, "--json", "--focus", "2", where="--focus")
        self.rejected("render", "gallery", *SMALL, "--json", "--multiscatter", "walk", "--g2",
                      "separable")
        self.assertEqual(os.listdir(self.folder), [])

    def test_input(self):
        text = self.path("t.txt", "no picture")
        for arguments in (["no-such-scene"], [text], [str(self.folder)], [""],
                          ["gallery", "--env", text], ["gallery", "--env", "/no/such.exr"],
                          ["gallery", "--reference", text], ["gallery", "--reference", "/no.exr"]):
            self.rejected("render", *arguments, *SMALL, "--json")

    def test_reference_of_another_size(self):
        self.render("a.pfm")
        self.rejected("render", "gallery", "--size", "33x18", "--reference", self.path("a.pfm"),
                      where=self.path("a.pfm"))

    def test_no_place_is_found_before_the_work(self):
        """At 16 million samples a pixel the answer would never come after it."""
        (self.folder / "d.png").mkdir()
        for name in ("d.png", "no/such/folder/a.png"):
            self.rejected("render", "gallery", "--spp", "16777216", "-o", self.path(name),
                          status=(1,), where=self.path(name))

    def test_full_disk(self):
        """A file of the same name stays what it was, and nothing lies beside it."""
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            # smaller than any of the pictures, with room for what an OpenMP runtime shares
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        for ending in MAGIC:
            picture = self.path("a" + ending, "old")
            result = subprocess.run([PROGRAM, "render", "gallery", "--size", "64x36", "--spp", "1",
                                     "-o", picture], capture_output=True, preexec_fn=limit)
            self.assertEqual(result.returncode, 1, ending)
            self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")
            self.assertEqual(Path(picture).read_text(), "old")
        self.assertEqual(len(os.listdir(self.folder)), len(MAGIC))

    def test_full_standard_output(self):
        with open("/dev/full", "wb") as full:
            result = subprocess.run([PROGRAM, "render", "gallery", *SMALL, "--json"], stdout=full,
                                    stderr=subprocess.PIPE, timeout=60)
        self.assertEqual(result.returncode, 1)

    def test_missing_texture(self):
        self.path("t.mtl", "newmtl m\nmap_Kd nowhere.png\n")
        triangle = self.path("t.obj", TRIANGLE)
        result = run("render", triangle, *SMALL, "-o", self.path("a.png"))
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")
        self.assertIn(b"nowhere.png", result.stderr)
        self.rejected("render", triangle, *SMALL, "-o", self.path("b.png"), "--strict")
        self.assertFalse(os.path.exists(self.path("b.png")))


class GltfTest(RenderTest):
    """A triangle in an external buffer whose colour is a texture beside the file."""
    POSITIONS = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0)

    def triangle(self, buffer, picture, **more):
        self.path("t.gltf", json.dumps({
            "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
            "materials": [{"extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": {
                "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0}}}],
            "textures": [{"source": 0}], "images": [{"uri": picture}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": buffer}], **more}))
        return str(self.folder / "t.gltf")

    def test_files_beside(self):
        """Names are URIs, with blanks as %20 and a plus as itself; data may stand in the name."""
        self.path("a+b c.bin", self.POSITIONS)
        red, green = b"P6 1 1 255 \xff\0\0", b"P6 1 1 255 \0\xff\0"
        self.path("red+ picture.ppm", red)
        data = "data:application/octet-stream;base64,"
        pictures = {self.render("a.pfm", scene=self.triangle(buffer, picture)) for buffer, picture in (
            ("a+b%20c.bin", "red+%20picture.ppm"),
            (data + base64.b64encode(self.POSITIONS).decode(), "red+%20picture.ppm"),
            ("a%2Bb%20c.bin", "data:image/png;base64," + base64.b64encode(red).decode()))}
        self.assertEqual(len(pictures), 1)
        self.path("red+ picture.ppm", green)
        pictures.add(self.render("a.pfm", scene=self.triangle("a+b%20c.bin", "red+%20picture.ppm")))
        self.assertEqual(len(pictures), 2)

    def test_missing_files(self):
        """A missing picture is named once and shown, a missing buffer is an error."""
        self.path("a.bin", self.POSITIONS)
        scene = self.triangle("a.bin", "nowhere.png")
        result = run("render", scene, *SMALL, "-o", self.path("a.png"))
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")
        self.assertIn(b"nowhere.png", result.stderr)
        self.rejected("render", scene, *SMALL, "--json", "--strict", where=scene)
        self.rejected("render", self.triangle("b.bin", "a.bin"), *SMALL, "--json", where=scene)
        self.path("a.bin", self.POSITIONS[:35])
        self.rejected("render", self.triangle("a.bin", "a.bin"), *SMALL, "--json", where=scene)
        self.rejected("render", self.triangle("/dev/zero", "a.bin"), *SMALL, "--json", where=scene)

    def test_extensions(self):
        self.path("a.bin", self.POSITIONS)
        self.path("a.ppm", "P6 1 1 255 abc")
        used = ["KHR_materials_unlit", "KHR_materials_sheen"]
        scene = self.triangle("a.bin", "a.ppm", extensionsUsed=used)
        result = run("render", scene, *SMALL, "--json")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")
        self.assertIn(b"KHR_materials_sheen", result.stderr)
        self.rejected("render", scene, *SMALL, "--json", "--strict", where=scene)
        self.rejected("render", self.triangle("a.bin", "a.ppm", extensionsRequired=used), *SMALL,
                      "--json", where=scene)


class FuzzTest(RenderTest):
    def broken(self, generator, good):
        """Random bytes, or a good file cut short, or with some bytes replaced."""
        kind = generator.randrange(3)
        if kind == 0:
            return generator.randbytes(generator.randrange(0, 400))
        if kind == 1:
            return good[:generator.randrange(len(good))]
        changed = bytearray(good)
        for _ in range(generator.randrange(1, 8)):
            changed[generator.randrange(len(changed))] = generator.randrange(256)
        return bytes(changed)

    def assert_clean(self, result, case):
        """Done, perhaps with warnings, or an error in the last line."""
        self.assertIn(result.returncode, (0, 1, 2), (case, result.stderr))
        lines = result.stderr.splitlines(keepends=True)
        self.assertTrue(all(ERROR_LINE.fullmatch(line) for line in lines), (case, result.stderr))
        self.assertTrue(result.returncode == 0 or lines, case)

    def test_scenes_and_pictures(self):
        generator = random.Random(20250103)
        tiny = ["--size", "4x3", "--spp", "1", "--json"]
        scene = TRIANGLE.encode()
        pictures = {ending: self.render("good" + ending) for ending in (".exr", ".pfm", ".hdr")}
        for case in range(90):
            if case % 2:
                bad = self.path("bad.obj", self.broken(generator, scene))
                result = run("render", bad, *tiny)
            else:
                ending = generator.choice(list(pictures))
                bad = self.path("bad" + ending, self.broken(generator, pictures[ending]))
                result = run("render", "furnace", "--env", bad, *tiny)
            self.assert_clean(result, (case, Path(bad).read_bytes()))


if __name__ == "__main__":
    main()
