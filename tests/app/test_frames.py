"""lobe render: several numbered pictures out of one call, and how it goes on after an interruption."""
import base64
import json
import math
import os
import re
import resource
import signal
import struct
import subprocess
import time
from pathlib import Path

from program import PROGRAM, LongTest, main, run

SMALL = LongTest.SMALL


class FramesTest(LongTest):
    def names(self):
        return sorted(os.listdir(self.folder))

    def frames(self, *arguments, name="a.exr"):
        """The bytes of the pictures, in order."""
        self.done("render", *SMALL, *arguments, "-o", self.path(name))
        stem, ending = os.path.splitext(name)
        return [path.read_bytes() for path in sorted(self.folder.glob(f"{stem}.*{ending}"))]


class OrbitTest(FramesTest):
    def test_frames(self):
        four = self.frames("--orbit", "4")
        self.assertEqual(self.names(), [f"a.000{i}.exr" for i in (1, 2, 3, 4)])
        self.assertEqual(len(set(four)), 4)
        self.assertEqual(four[0], self.render("one.exr"))
        self.assertEqual(four[::2], self.frames("--orbit", "2", name="b.exr"))

    def test_formats_and_statistics(self):
        lines = self.done("render", *SMALL, "--orbit", "2", "-o", self.path("a.b.png"), "--json")
        self.assertEqual([json.loads(line)["frame"] for line in lines.splitlines()], [1, 2])
        self.assertEqual(self.names(), ["a.b.0001.png", "a.b.0002.png"])

    def test_a_lens_keeps_its_focus(self):
        """All four pictures of a box that is closed at the back are focused where the first one is."""
        frames = self.frames("--orbit", "4", "--aperture", "0.05")
        focus = {line for frame in frames for line in frame.split(b"\n") if line.startswith(b"focus ")}
        self.assertEqual(len(focus), 1)

    def test_refused(self):
        for values in (["0"], ["-1"], ["x"], [""], ["100001"], ["1.5"]):
            self.rejected("render", *SMALL, "-o", self.path("a.exr"), f"--orbit={values[0]}",
                          where="--orbit")
        orbit = ["render", *SMALL, "--orbit", "2"]
        self.rejected(*orbit, "-o", self.path("a.png"), "--checkpoint", self.path("c"),
                      where="--checkpoint")
        self.rejected(*orbit, "--json", "--resume", self.path("c"), where="--resume")
        self.rejected(*orbit, "--json", "--reference", self.path("a.pfm"), where="--reference")
        self.rejected("render", *SMALL, "-o", self.path("a.exr"), "--aov", "motion", where="--aov")
        self.rejected(*orbit, "-o", self.path("a" * 5000 + ".exr"), status=(1, 2))
        self.assertEqual(self.names(), [])


def in_float(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def scene_with_camera():
    """glTF of a square around the origin; a camera at (1, 0.5, 5) looks along -Z."""
    corners = struct.pack("12f", -1, -1, 0.25, 1, -1, 0.25, 1, 1, -0.25, -1, 1, -0.25)
    data = corners + struct.pack("6H", 0, 1, 2, 0, 2, 3)
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"mesh": 0}, {"camera": 0, "translation": [1, 0.5, 5]}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," +
                         base64.b64encode(data).decode()}],
            "bufferViews": [{"buffer": 0, "byteLength": 48},
                            {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4,
                           "min": [-1, -1, -0.25], "max": [1, 1, 0.25]},
                          {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 6}]}


def look(angle, ahead):
    """That camera, turned; it looks at a point so far ahead."""
    sine, cosine = math.sin(angle), math.cos(angle)
    def turned(x, y, z):  # 0.0: no negative zero
        return [in_float(0.0 + (cosine * x + sine * z)), y, in_float(0.0 + (cosine * z - sine * x))]
    degrees = in_float(in_float(0.7) * in_float(180 / in_float(math.pi)))
    return {"position": turned(1, 0.5, 5), "target": turned(1, 0.5, 5 - ahead),
            "up": turned(0, 1, 0), "degrees": degrees}


class PathTest(FramesTest):
    def write(self, name, *cameras):
        frames = [{"camera": camera} for camera in cameras]
        (self.folder / name).write_text(json.dumps({"frames": frames}))
        return self.path(name)

    def test_every_view_of_a_turntable_is_that_of_its_camera(self):
        """Bit for bit, rendered alone."""
        (self.folder / "s.gltf").write_text(json.dumps(scene_with_camera()))
        ahead = in_float(1 + in_float(math.sqrt(26.25)))
        options = [self.path("s.gltf"), *SMALL[1:], "--aperture", "0.1", "--focus", "5"]
        self.done("render", *options, "--orbit", "5", "-o", self.path("a.exr"))
        for i in range(5):
            path = self.write("p.json", look(2 * math.pi * i / 5, ahead))
            self.done("render", *options, "--camera-path", path, "-o", self.path("p.exr"))
            self.assertEqual(self.bytes_of("p.0001.exr"), self.bytes_of(f"a.000{i + 1}.exr"), i)

    def test_focus(self):
        """That of the command, else of the file, else what each picture shows in its middle."""
        room = {"position": [0, 1, 3], "target": [0, 1, 0], "degrees": 40}
        path = self.write("p.json", room, {**room, "focus": 2}, {**room, "position": [0, 1, 2]})
        def focus_of(*options):
            frames = self.frames("--camera-path", path, "--aperture", "0.01", *options)
            return [re.search(rb"\nfocus (\S+)\n", frame)[1] for frame in frames]
        focus = focus_of()
        self.assertEqual(focus[1], b"2")
        self.assertAlmostEqual(float(focus[0]), float(focus[2]) + 1, 4)
        self.assertEqual(focus_of("--focus", "3"), [b"3"] * 3)

    def test_frames_of_another_program(self):
        """The cameras of a folder of frames are a path."""
        self.done("ssr", "cornell", "--size", "40x24", "--frames", "2", "--spp", "1", "-o",
                  self.path("ssr"), "--write-gbuffer", self.path("g"), "--min-smoothness", "0.4")
        self.frames("--camera-path", self.path("g/gbuffer.json"))
        self.render("one.exr")
        for name, is_like in (("a.0001.exr", True), ("a.0002.exr", False)):
            status = run("compare", self.path(name), self.path("one.exr"), "--metric", "rmse",
                         "--threshold", "0.01").returncode
            self.assertEqual(status, 0 if is_like else 3, name)

    def test_going_on(self):
        cameras = [{"position": [x, 1, 3], "target": [0, 1, 0], "degrees": 40} for x in (0, 0.1, 0.2)]
        long = ["--checkpoint", self.path("c"), "--resume", self.path("c")]
        first = self.frames("--camera-path", self.write("p.json", *cameras[:2]), *long)
        self.assertEqual(self.frames("--camera-path", self.write("p.json", *cameras), *long)[:2], first)
        self.rejected("render", *SMALL, "--camera-path", self.write("p.json", *cameras[1:]), *long,
                      "-o", self.path("a.exr"), where=self.path("a.0001.exr"))

    def test_refused(self):
        camera = {"position": [0, 1, 3], "target": [0, 1, 0], "degrees": 40}
        good = self.write("p.json", camera)
        out = ["-o", self.path("a.exr")]
        path = ["render", *SMALL, *out, "--camera-path"]
        self.rejected(*path, good, "--orbit", "2", where="--camera-path")
        self.rejected(*path, good, "--camera", "x", where="--camera-path")
        self.rejected(*path, self.path("none.json"), where=self.path("none.json"))
        self.rejected(*path, str(self.folder), where=str(self.folder) + ":1")
        self.rejected(*path, "", where="--camera-path")
        self.rejected(*path, self.write("b.json", camera, {}), where=self.path("b.json"))
        matrix = [[1, 0, 0, 0], [0, 1, 0, 1], [0, 0, 1, 3], [0, 0, 0, 1]]
        wide = self.write("w.json", camera, {"to_world": matrix, "tan": [1, 0.5]})
        self.assertIn(b"camera 2 is 2 times as wide", self.rejected(*path, wide, where=wide).stderr)
        self.assertFalse(list(self.folder.glob("a.*")))


class GoingOnTest(FramesTest):
    def setUp(self):
        super().setUp()
        self.long = ["--checkpoint", self.path("c"), "--resume", self.path("c")]

    def test_what_is_finished_stays(self):
        whole = self.frames("--orbit", "3", name="w.exr")
        self.assertEqual(self.frames("--orbit", "3", *self.long), whole)
        self.assertFalse([name for name in self.names() if name.startswith("c")])
        (self.folder / "a.0002.exr").write_bytes(whole[1][:-20])  # cut short
        before = [os.stat(self.path(f"a.000{i}.exr")).st_ino for i in (1, 3)]
        lines = self.done("render", *SMALL, "--orbit", "3", *self.long, "-o", self.path("a.exr"),
                          "--json").splitlines()
        self.assertEqual([json.loads(line).get("was_finished") for line in lines],
                         [True, None, True])
        self.assertEqual([os.stat(self.path(f"a.000{i}.exr")).st_ino for i in (1, 3)], before)
        self.assertEqual([self.bytes_of(f"a.000{i}.exr") for i in (1, 2, 3)], whole)

    def test_adaptive_pictures_are_finished_too(self):
        """Their pixels have unequal numbers of samples, but the same weight."""
        orbit = ["render", *SMALL[:3], "--spp", "64", "--adaptive", "--orbit", "2", *self.long, "-o",
                 self.path("a.exr"), "--json"]
        self.assertEqual(self.done(*orbit).count(b"was_finished"), 0)
        self.assertEqual(self.done(*orbit).count(b"was_finished"), 2)
        longer = ["96" if word == "64" else word for word in orbit]
        self.rejected(*longer, where=self.path("a.0001.exr"))

    def test_stopped_pictures_are_gone_on_with(self):
        """By time, then by kill -9 wherever it falls."""
        scene = ["render", "cornell", "--size", "64x36", "--spp", "128", "--orbit", "3",
                 "--aov", "motion,depth"]
        self.done(*scene, "-o", self.path("w.exr"))
        command = [*scene, "-o", self.path("a.exr"), *self.long]
        self.done(*command, "--time", "0.02")
        self.assertTrue(Path(self.path("c.0003")).exists())
        self.assertNotEqual(self.bytes_of("a.0001.exr"), self.bytes_of("w.0001.exr"))
        for kill_after in (0.3, 0.6):
            with subprocess.Popen([PROGRAM, *command, "--checkpoint-every", "0.05"]) as process:
                time.sleep(kill_after)
                process.send_signal(signal.SIGKILL)
                process.wait()
        self.done(*command)
        for i in (1, 2, 3):
            self.assertEqual(self.bytes_of(f"a.000{i}.exr"), self.bytes_of(f"w.000{i}.exr"))

    def test_motion_is_of_two_cameras(self):
        """A picture whose frame before was seen from elsewhere is another one."""
        cameras = [{"position": [x, 1, 3], "target": [0, 1, 0], "degrees": 40} for x in (0, 0.1, 0.2)]
        def write(*frames):
            (self.folder / "p.json").write_text(json.dumps({"frames": frames}))
            return self.path("p.json")
        def frame(camera, previous):
            return {"camera": camera, "previous_camera": previous}
        options = ["--aov", "motion", *self.long, "--camera-path"]
        self.frames(*options, write(frame(cameras[0], cameras[1])))
        result = self.rejected("render", *SMALL, *options, write(frame(cameras[0], cameras[2])),
                               "-o", self.path("a.exr"), where=self.path("a.0001.exr"))
        self.assertIn(b"its previous-camera is", result.stderr)

    def test_another_render_is_not_overwritten(self):
        first = self.frames("--orbit", "2", *self.long)
        for option, words in ((("--depth", "3"), b"its depth is 8, not 3;"),
                              (("--seed", "9"), b"its seed is 0, not 9;"),
                              (("--exposure", "1"), b"its exposure is none, not 1;"),
                              (("--aperture", "0.1"), b"its aperture is none, not 0.1"),
                              (("--camera", "none"), b"no camera")):
            result = self.rejected("render", *SMALL, "--orbit", "2", *self.long, *option, "-o",
                                   self.path("a.exr"))
            self.assertIn(words, result.stderr)
        self.assertEqual([self.bytes_of(f"a.000{i}.exr") for i in (1, 2)], first)
        self.rejected("render", *SMALL, "--orbit", "2", "-o", self.path("b.exr"), "--resume",
                      self.path("c"), where=self.path("c.0001"))

    def test_parts_join_picture_by_picture(self):
        orbit = ["--orbit", "2", "--aov", "motion"]
        whole = self.frames(*orbit, name="w.exr")
        self.assertTrue(all(b"motion.X" in picture for picture in whole))
        for part in ("1", "2"):
            parts = [*orbit, "--part", f"{part}/2"]
            self.frames(*parts, *self.long, name=f"{part}.exr")
            again = run("render", *SMALL, *parts, *self.long, "-o", self.path(f"{part}.exr"), "--json")
            self.assertEqual(again.stdout.count(b"was_finished"), 2)
        for i in (1, 2):
            self.done("merge", self.path(f"1.000{i}.exr"), self.path(f"2.000{i}.exr"), "-o",
                      self.path("m.exr"))
            self.assertEqual(self.bytes_of("m.exr"), whole[i - 1])

    def test_a_full_disk_for_checkpoints(self):
        """Pictures are smaller: they are all there, the failure is told."""
        whole = self.frames("--orbit", "2", name="w.exr")
        room = 2 * max(len(picture) for picture in whole)
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
        result = subprocess.run([PROGRAM, "render", *SMALL, "--orbit", "2", "-o", self.path("a.exr"),
                                 *self.long], capture_output=True, preexec_fn=limit)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr.count(b"rendering goes on"), 2)
        self.assertEqual([self.bytes_of(f"a.000{i}.exr") for i in (1, 2)], whole)

    def test_interrupt_ends_all(self):
        command = [PROGRAM, "render", "cornell", "--size", "96x54", "--spp", "16777216", "--orbit",
                   "3", "-o", self.path("a.exr"), "--progress", "json"]
        with subprocess.Popen(command, stderr=subprocess.PIPE) as process:
            while b'"frame 1/3"' not in process.stderr.readline():
                pass
            process.send_signal(signal.SIGINT)
            process.stderr.read()
            self.assertEqual(process.wait(timeout=60), 130)
        self.assertEqual(self.names(), ["a.0001.exr"])


if __name__ == "__main__":
    main()
