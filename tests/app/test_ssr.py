"""lobe ssr from outside: files, statistics, errors. tests/ssr proves the passes themselves."""
import base64
import json
import os
import re
import signal
import struct
import subprocess
import tempfile
import time
import zlib
from pathlib import Path
from unittest import mock

from program import PROGRAM, ProgramTest, main, run

SMALL = ["--size", "48x27", "--spp", "1", "--frames", "2"]
ROUGH = ["--min-smoothness", "0", "--smoothness-fade-start", "0"]
BAD_VALUES = {
    "--size": ["", "64", "0x10", "32769x1", "axb"],
    "--frames": ["0", "10001", "x"],
    "--camera-path": ["around", ""],
    "--camera": ["nobody"],
    "--frame-time": ["nan", "", "now"],
    "--frame-rate": ["0", "-1", "nan", "1e7"],
    "--animation": ["", "Walk"],
    "--spp": ["0", "16777217"],
    "--roughness": ["-0.1", "1.1", "nan"],
    "--anisotropy": ["-1.1", "1.1", "nan"],
    "--threads": ["0", "1025"],
    "--backend": ["cuda", ""],
    "--mode": ["ggx"],
    "--method": ["newton", "vcavity", "ndf", "best"],
    "--bias": ["1", "-1"],
    "--max-iterations": ["0", "1000001"],
    "--thickness": ["2", "thick"],
    "--resolve": ["5x5"],
    "--edge-fade": ["-1"],
    "--min-smoothness": ["0.95"],
    "--accumulation": ["1.5"],
    "--compare": ["", "newton", "bounded,", "best", ",".join(12 * ["caps"])],
    "--truth-rays": ["0", "8"],
}


def numbers_of(value):
    """All of them, in order."""
    return [x for part in value for x in numbers_of(part)] if isinstance(value, list) else [value]


class SsrTest(ProgramTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def ssr(self, *arguments, name="out"):
        """What stats.json holds."""
        folder = self.folder / name
        self.assertEqual(self.done("ssr", "gallery", "-o", str(folder), *SMALL, *arguments), b"")
        return json.loads((folder / "stats.json").read_text())

    def test_writes_frames_and_statistics(self):
        stats = self.ssr(*ROUGH)
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()},
                         {"stats.json", "frame-0000.exr", "frame-0000.png", "frame-0001.exr",
                          "frame-0001.png", "preview.png"})
        self.assertEqual((self.folder / "out/frame-0001.exr").read_bytes()[:4], b"\x76\x2f\x31\x01")
        self.assertEqual((self.folder / "out/frame-0001.png").read_bytes()[:4], b"\x89PNG")
        frames = stats.pop("frames")
        self.assertRegex(stats.pop("device"), "^processor" if stats["backend"] == "cpu" else ".")
        self.assertIn(stats.pop("backend"), ["cpu", "gl"])
        self.assertEqual(stats, {"width": 48, "height": 27, "mode": "vndf", "method": "bounded",
                                 "resolve": "confidence"})
        self.assertEqual([frame["frame"] for frame in frames], [0, 1])
        for frame in frames:
            self.assertEqual(set(frame), {"frame", "rays", "rejected", "hit_rate",
                                          "steps_per_ray", "ms"})
            self.assertEqual(set(frame["ms"]), {"pyramid", "trace", "reproject", "resolve",
                                                "accumulate", "composite"})
            self.assertGreater(frame["rays"], 48 * 27 / 4)
            self.assertTrue(0 < frame["hit_rate"] < 1)

    def test_without_a_driver_the_processor_runs_and_gl_says_why(self):
        """No driver, and one that is too old; a build without OpenGL says so in both."""
        for variables in ({"__EGL_VENDOR_LIBRARY_FILENAMES": "/dev/null"},
                          {"MESA_GL_VERSION_OVERRIDE": "4.3", "LIBGL_ALWAYS_SOFTWARE": "1",
                           "__EGL_VENDOR_LIBRARY_DIRS": "/usr/share/glvnd/egl_vendor.d"}):
            with mock.patch.dict(os.environ, variables):
                stats = self.ssr(*ROUGH)
                self.assertEqual(stats["backend"], "cpu")
                self.assertRegex(stats["device"], r"^processor \(OpenGL: .*\)$")
                result = run("ssr", "gallery", "-o", str(self.folder / "gl"), *SMALL,
                             "--backend", "gl")
                self.assertEqual((result.returncode, result.stdout), (1, b""))
                self.assertRegex(result.stderr.decode(), r"\Alobe: OpenGL: .*; .*--backend cpu.*\n\Z")

    def test_judges_by_real_rays_and_keeps_them(self):
        first = self.ssr(*ROUGH, "--truth", "--truth-rays", "4")
        truth = (self.folder / "out/truth-0001.exr").read_bytes()
        written = os.stat(self.folder / "out/truth-0001.exr").st_mtime_ns
        second = self.ssr(*ROUGH, "--truth", "--truth-rays", "4")
        self.assertEqual(os.stat(self.folder / "out/truth-0001.exr").st_mtime_ns, written)
        for a, b in zip(first["frames"], second["frames"]):
            self.assertEqual(set(a["truth"]), {"relmse", "relmse_onscreen", "flip", "temporal",
                                               "false_hits", "false_misses", "hit_distance"})
            self.assertEqual(a["truth"]["temporal"] is None, a["frame"] == 0)
            self.assertTrue(0 < a["truth"]["hit_distance"] < 3)
            self.assertTrue(0 < a["truth"]["flip"] < 0.5)
            self.assertEqual(a["truth"], b["truth"])
        self.ssr(*ROUGH, "--truth", "--truth-rays", "4", "--seed", "9")
        self.assertNotEqual((self.folder / "out/truth-0001.exr").read_bytes(), truth)

    def test_compares_on_one_page(self):
        stats = self.ssr(*ROUGH, "--truth", "--truth-rays", "4", "--compare", "bounded,hdrp,ndf")
        self.assertEqual([one["name"] for one in stats["compared"]], ["bounded", "hdrp", "ndf"])
        same, hdrp, ndf = (one["frames"] for one in stats["compared"])
        for a, b in zip(stats["frames"], same):
            self.assertEqual(a["truth"], b["truth"])
        self.assertNotEqual(hdrp[1]["truth"], same[1]["truth"])
        self.assertGreater(ndf[1]["rejected"], same[1]["rejected"])
        page = (self.folder / "out/report.html").read_text()
        self.assertFalse(re.search(r'(src|href)="(?!data:)', page))
        self.assertEqual(page.count("data:image/jpeg"), 2 * (1 + 4 * 3))
        for name in ("bounded", "hdrp", "ndf", "frame 1", "--truth-rays 4"):
            self.assertIn(name, page)

    def test_preview_is_an_animated_png(self):
        self.ssr(*ROUGH)
        data, at, number, kinds = (self.folder / "out/preview.png").read_bytes(), 8, 0, []
        while at < len(data):
            size, kind = struct.unpack_from(">I4s", data, at)
            body = data[at + 8:at + 8 + size]
            self.assertEqual(zlib.crc32(kind + body),
                             struct.unpack_from(">I", data, at + 8 + size)[0])
            if kind in (b"fcTL", b"fdAT"):
                self.assertEqual(struct.unpack_from(">I", body)[0], number)
                number += 1
            if kind == b"acTL":
                self.assertEqual(struct.unpack(">II", body), (2, 0))
            if kind in (b"IDAT", b"fdAT"):
                pixels = zlib.decompress(body[4 if kind == b"fdAT" else 0:])
                self.assertEqual(len(pixels), 27 * (3 * 48 + 1))
            kinds.append(kind)
            at += size + 12
        self.assertEqual(kinds, [b"IHDR", b"acTL", b"fcTL", b"IDAT", b"fcTL", b"fdAT",
                                 b"IEND"])

    def test_pictures_do_not_depend_on_threads(self):
        for threads in ("1", "3"):
            self.ssr(*ROUGH, "--threads", threads, name=threads)
        for picture in ("frame-0000.exr", "frame-0001.exr"):
            self.assertEqual((self.folder / "1" / picture).read_bytes(),
                             (self.folder / "3" / picture).read_bytes())

    def test_says_if_nothing_is_smooth_enough(self):
        result = run("ssr", "cornell", "-o", str(self.folder / "matte"), *SMALL)
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, rb"\Alobe: --min-smoothness: [ -~]+; [ -~]+\n\Z")

    def test_default_reflects_smooth_surfaces_only(self):
        self.assertLess(self.ssr()["frames"][0]["rays"],
                        self.ssr(*ROUGH, name="rough")["frames"][0]["rays"] / 4)

    def test_modes_methods_and_resolves(self):
        for arguments, method in ((["--mode", "mirror", "--resolve", "approx"], "mirror"),
                                  (["--mode", "ndf", "--resolve", "neighbourhood"], "ndf"),
                                  (["--method", "slope", "--resolve", "own"], "slope"),
                                  (["--method", "horizon", "--as-hdrp", "--linear"], "horizon")):
            stats = self.ssr(*arguments, *ROUGH, "--no-sky")
            self.assertEqual(stats["method"], method)

    def test_a_written_folder_gives_the_same_bits(self):
        folder = str(self.folder / "gbuffer")
        stats = self.ssr(*ROUGH, "--write-gbuffer", folder)
        self.assertEqual({path.name for path in Path(folder).iterdir()},
                         {"gbuffer.json", "environment.exr", "gbuffer-0000.exr", "gbuffer-0001.exr"})
        self.done("ssr", folder, "-o", str(self.folder / "again"), *ROUGH)
        again = json.loads((self.folder / "again/stats.json").read_text())
        for key in ("width", "height", "method"):
            self.assertEqual(stats[key], again[key])
        for picture in ("frame-0000.exr", "frame-0001.exr"):
            self.assertEqual((self.folder / "out" / picture).read_bytes(),
                             (self.folder / "again" / picture).read_bytes())
        for option in ("--size=8x8", "--truth", "--spp=1", "--camera-path=still", "--roughness=0",
                       "--anisotropy=0", "--write-gbuffer=x"):
            self.rejected("ssr", folder, "-o", str(self.folder / "again"), option,
                          where=option.split("=")[0])
        self.rejected("ssr", folder, "-o", str(self.folder / "again"), "--frames", "3",
                      where="--frames")
        (self.folder / "gbuffer/gbuffer-0001.exr").unlink()
        self.rejected("ssr", folder, "-o", str(self.folder / "again"))

    def test_a_path_of_cameras(self):
        """The cameras that were written are a path to the same frames; those of the past count too."""
        folder = str(self.folder / "gbuffer")
        self.ssr(*ROUGH, "--write-gbuffer", folder)
        path = self.folder / "gbuffer/gbuffer.json"
        again = str(self.folder / "again gbuffer")
        stats = json.loads(self.done("ssr", "gallery", "-o", str(self.folder / "b"), *SMALL[:4], *ROUGH,
                                     "--camera-path", str(path), "--write-gbuffer", again, "--json"))
        self.assertEqual(len(stats["frames"]), 2)
        first, second = json.loads(path.read_text()), json.loads(Path(again, "gbuffer.json").read_text())
        for a, b in zip(first["frames"], second["frames"]):
            for name in ("camera", "previous_camera"):
                for key in ("tan", "near", "far"):
                    for x, y in zip(*(numbers_of(c[name][key]) for c in (a, b))):
                        self.assertAlmostEqual(x, y, delta=1e-5 * abs(x))
                for x, y in zip(*(numbers_of(c[name]["to_world"]) for c in (a, b))):
                    self.assertAlmostEqual(x, y, 5)
        stats = json.loads(self.done("ssr", "gallery", "-o", str(self.folder / "b"), *SMALL[:4], *ROUGH,
                                     "--camera-path", str(path), "--frames", "1", "--json"))
        self.assertEqual(len(stats["frames"]), 1)
        options = ["ssr", "gallery", "-o", str(self.folder / "c"), *ROUGH, "--camera-path", str(path)]
        self.rejected(*options, "--frames", "3", where="--frames")
        self.rejected(*options, "--camera", "x", where="--camera-path")
        self.rejected(*options, "--size", "48x48", where=str(path))
        path.write_text("{}")
        self.rejected(*options, where=str(path))

    def test_a_folder_of_something_else(self):
        self.rejected("ssr", str(self.folder), "-o", str(self.folder / "out"))
        self.rejected("ssr", "gallery", "-o", str(self.folder / "x"), "--write-gbuffer",
                      str(self.folder / "x"), where="--write-gbuffer")

    def moving(self):
        """A mirror that goes to the right by 1 in a second."""
        numbers = struct.pack("<9f2f6f", -1, -1, -3, 1, -1, -3, 0, 1, -3, 0, 1, 0, 0, 0, 1, 0, 0)
        views = [(0, 36), (36, 8), (44, 24)]
        path = self.folder / "moving.gltf"
        path.write_text(json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"mesh": 0}, {"camera": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"roughnessFactor": 0}}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
            "animations": [{"name": "go", "channels": [
                {"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                "samplers": [{"input": 1, "output": 2}]}],
            "accessors": [{"bufferView": i, "componentType": 5126, "type": "SCALAR" if i == 1 else "VEC3",
                           "count": 3 if i == 0 else 2} for i in range(3)],
            "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in views],
            "buffers": [{"byteLength": len(numbers), "uri": "data:application/octet-stream;base64,"
                         + base64.b64encode(numbers).decode()}]}))
        return str(path)

    def test_objects_in_motion(self):
        """Each frame shows its moment; the frames that were written give the same bits; a kept truth knows its moment."""
        scene, folder = self.moving(), self.folder / "out"
        options = ["-o", str(folder), "--size", "48x27", "--spp", "1", "--frames", "3", "--camera-path", "still",
                   "--accumulation", "0"]
        timed = [*options, "--frame-time", "0.25", "--frame-rate", "4"]
        buffer = str(self.folder / "gbuffer")
        self.done("ssr", scene, *timed, "--truth", "--truth-rays", "1", "--write-gbuffer", buffer)
        frames = [(folder / f"frame-000{i}.exr").read_bytes() for i in range(3)]
        pictures = [(folder / f"frame-000{i}.png").read_bytes() for i in range(3)]
        self.assertEqual(len(set(pictures)), 3)
        self.assertIn(b"motion.Z", Path(buffer, "gbuffer-0001.exr").read_bytes())
        self.done("ssr", scene, *timed)
        self.done("ssr", buffer, "-o", str(self.folder / "again"), "--accumulation", "0")
        for i in range(3):
            self.assertEqual((folder / f"frame-000{i}.exr").read_bytes(),
                             (self.folder / f"again/frame-000{i}.exr").read_bytes())
        kept = (folder / "truth-0001.exr").read_bytes()
        self.done("ssr", scene, *timed, "--truth", "--truth-rays", "1")
        self.assertEqual([(folder / f"frame-000{i}.exr").read_bytes() for i in range(3)], frames)
        self.done("ssr", scene, *options, "--frame-time", "0.5", "--frame-rate", "4", "--animation", "go",
                  "--truth", "--truth-rays", "1")
        self.assertEqual((folder / "frame-0000.png").read_bytes(), pictures[1])
        self.assertNotEqual((folder / "truth-0001.exr").read_bytes(), kept)
        result = run("ssr", scene, *options)
        self.assertRegex(result.stderr, rb"is animated; [ -~]*--frame-time")
        self.rejected("ssr", scene, *options, "--frame-rate", "4", where="--frame-rate")
        self.rejected("ssr", scene, *options, "--animation", "go", where="--animation")
        self.rejected("ssr", scene, *timed, "--animation", "stay", where=scene)
        self.rejected("ssr", scene, *options, "--frame-time", "0", "--frame-rate", "0", where="--frame-rate")
        self.rejected("ssr", buffer, *options[:2], "--frame-time", "0", where="--frame-time")

    def test_one_pixel(self):
        folder = str(self.folder / "one")
        self.done("ssr", "cornell", "-o", folder, "--size", "1x1", "--frames", "1", *ROUGH,
                  "--truth", "--truth-rays", "1")

    def test_bad_usage(self):
        folder = str(self.folder / "none")
        self.rejected("ssr", where="ssr")
        self.rejected("ssr", "gallery", where="-o")
        self.rejected("ssr", "no-such-scene", "-o", folder)
        for option, values in BAD_VALUES.items():
            for value in values:
                self.rejected("ssr", "gallery", "-o", folder, *(
                    [] if option in SMALL else SMALL), f"{option}={value}")
        self.rejected("ssr", "gallery", "-o", folder, "--mode", "mirror", "--method", "caps",
                      where="--method")
        self.rejected("ssr", "gallery", "-o", folder, "--method", "slope", "--bias", "0.2",
                      where="--bias")
        self.assertFalse(os.path.exists(folder))

    def test_a_folder_that_cannot_be(self):
        (self.folder / "file").write_text("")
        self.rejected("ssr", "gallery", "-o", str(self.folder / "file"), *SMALL, status=(1,))
        self.rejected("ssr", "gallery", "-o", str(self.folder / "a/b"), *SMALL, status=(1,))

    def test_an_interrupt_keeps_what_is_finished(self):
        folder = self.folder / "cut"
        process = subprocess.Popen([PROGRAM, "ssr", "gallery", "-o", str(folder), "--size",
                                    "96x54", "--spp", "4", "--frames", "10000"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        deadline = time.monotonic() + 50
        while not (folder / "frame-0001.png").exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=50)
        self.assertEqual((process.returncode, out, err), (130, b"", b""))
        frames = json.loads((folder / "stats.json").read_text())["frames"]
        self.assertGreaterEqual(len(frames), 2)
        self.assertFalse([path for path in folder.iterdir() if path.suffix == ".part"])


if __name__ == "__main__":
    main()
