"""lobe compare from outside: the table, JSON, files, exit statuses, bad input, and that it tells the truth.
FLIP is held against its authors' program where that is installed (pip install flip-evaluator numpy)."""
import html.parser
import json
import math
import os
import re
import resource
import signal
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

from program import ERROR_LINE, PROGRAM, ProgramTest, main, run

try:
    import flip_evaluator
    import numpy
except ImportError:
    flip_evaluator = None

SMALL = ["--size", "32x18", "--seeds", "2", "--spp", "1,2"]


class CompareTest(ProgramTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def path(self, name):
        return str(self.folder / name)

    def picture(self, name, rgb, width=8, height=8):
        """A .pfm of this colour, or of these values."""
        values = rgb if len(rgb) > 3 else rgb * (width * height)
        (self.folder / name).write_bytes(b"PF\n%d %d\n-1.0\n" % (width, height)
                                         + struct.pack(f"<{len(values)}f", *values))
        return self.path(name)

    def compare(self, *arguments):
        return json.loads(self.done("compare", *arguments, "--json"))


class PicturesTest(CompareTest):
    def test_closed_forms(self):
        a, b = self.picture("a.pfm", [0.5, 0.5, 0.5]), self.picture("b.pfm", [0.25, 0.5, 1])
        result = self.compare(a, b)
        self.assertAlmostEqual(result["rmse"], math.sqrt((0.0625 + 0 + 0.25) / 3), places=12)
        self.assertAlmostEqual(result["relmse"], (0.0625 / 0.0725 + 0.25 / 1.01) / 3, places=12)
        self.assertTrue(0 < result["flip"] < 1 and 0 < result["flip_hdr"] < 1)

    def test_same_pictures(self):
        a = self.picture("a.pfm", [0.5, 0.25, 3])
        result = self.compare(a, a, "--threshold", "0")
        for metric in ("rmse", "relmse", "flip", "flip_hdr"):
            self.assertEqual(result[metric], 0)
        self.assertEqual(self.done("compare", a, a),
                         b"RMSE 0, relMSE 0, FLIP 0.000000, HDR-FLIP 0.000000\n")

    def test_threshold(self):
        a, b = self.picture("a.pfm", [0.5, 0.5, 0.5]), self.picture("b.pfm", [0.6, 0.5, 0.5])
        result = self.compare(a, b)
        for metric in ("rmse", "relmse", "flip", "flip-hdr"):
            value = result[metric.replace("-", "_")]
            for share, status in ((1.01, 0), (0.99, 3)):
                ran = run("compare", a, b, "--metric", metric, "--threshold", repr(share * value))
                self.assertEqual((ran.returncode, ran.stderr), (status, b""), metric)
        self.assertEqual(run("compare", a, b, "--threshold", "0").returncode, 3)

    def test_negative_values_are_values(self):
        a, b = self.picture("a.pfm", [-1, 0, 0]), self.picture("b.pfm", [0, 0, 0])
        self.assertAlmostEqual(self.compare(a, b)["rmse"], math.sqrt(1 / 3), places=12)

    def test_report(self):
        a, b = self.picture("a.pfm", [0.5, 0.5, 0.5]), self.picture("b.pfm", [0.6, 0.5, 0.5])
        self.compare(a, b, "-o", self.path("r"))
        self.assertEqual(sorted(os.listdir(self.path("r"))),
                         ["picture-flip.png", "picture-relative.png", "report.html"])

    def test_bad_pictures(self):
        good = self.picture("a.pfm", [0.5, 0.5, 0.5])
        text = self.path("t.exr")
        Path(text).write_text("no picture")
        for bad in (self.picture("b.pfm", [math.nan, 0, 0]), self.picture("c.pfm", [math.inf, 0, 0]),
                    self.picture("d.pfm", [1, 1, 1], 8, 9), text, "/no/such.exr", str(self.folder)):
            self.rejected("compare", good, bad, where=bad)
        self.rejected("compare", self.path("b.pfm"), good, where=self.path("b.pfm"))
        self.rejected("compare", good, self.path("d.pfm"), "--json", "-o", self.path("r"))
        self.assertFalse(os.path.exists(self.path("r")))

    def test_missing_channels(self):
        """The names of R and B changed in the header: no colour is left."""
        a = self.path("a.exr")
        self.done("render", "furnace", "--size", "8x8", "--spp", "1", "-o", a)
        self.compare(a, a)
        b = Path(self.path("b.exr"))
        b.write_bytes(Path(a).read_bytes().replace(b"B\0\1\0\0\0", b"A\0\1\0\0\0", 1)
                      .replace(b"R\0\1\0\0\0", b"S\0\1\0\0\0", 1))
        self.assertIn(b"no channels R, G and B", self.rejected("compare", str(b), a, where=str(b)).stderr)

    @unittest.skipUnless(flip_evaluator, "flip-evaluator is not installed")
    def test_flip_of_its_authors(self):
        for name, scene, spp in (("a", "gallery", "2"), ("b", "gallery", "64")):
            self.done("render", scene, "--size", "96x54", "--spp", spp, "-o", self.path(name + ".pfm"))
        result = self.compare(self.path("a.pfm"), self.path("b.pfm"))

        def read(name):
            data = Path(self.path(name)).read_bytes().split(b"\n", 3)[3]
            return numpy.frombuffer(data, "<f4").reshape(54, 96, 3)[::-1]

        def srgb(linear):
            c = numpy.clip(linear, 0, 1)
            return numpy.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055).astype("f4")
        a, b = read("a.pfm"), read("b.pfm")
        ldr = flip_evaluator.evaluate(srgb(b), srgb(a), "LDR", True, False)[1]
        hdr = flip_evaluator.evaluate(b.copy(), a.copy(), "HDR", False, False)[1]
        self.assertAlmostEqual(result["flip"], ldr, delta=1e-3)
        self.assertAlmostEqual(result["flip_hdr"], hdr, delta=1e-3)


class Tags(html.parser.HTMLParser):
    """Tags of a page, and what it would fetch."""
    def __init__(self):
        super().__init__()
        self.tags, self.sources = [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.sources += [value for name, value in attributes if name in ("src", "href")]


class SceneTest(CompareTest):
    def test_everything(self):
        result = self.compare("gallery", "--methods", "ellipsoid,horizon:floor=0.5", *SMALL, "-o",
                              self.path("r"))
        self.assertEqual([(r["method"], r["spp"], r["seeds"]) for r in result["rows"]],
                         [("ellipsoid", 1, 2), ("horizon:floor=0.5", 1, 2), ("ellipsoid", 2, 2),
                          ("horizon:floor=0.5", 2, 2)])
        for row in result["rows"]:
            for name in ("rmse", "rmse_error", "relmse", "relmse_error", "flip", "flip_error", "seconds",
                         "rays_per_second"):
                self.assertGreater(row[name], 0, name)
            self.assertTrue(0 <= row["rejected_share"] < 1)
        self.assertIn("horizon:floor=0.5", result["headline"])
        names = {f"{m}-{n}spp{e}" for m in ("ellipsoid", "horizon-floor-0.5") for n in (1, 2)
                 for e in (".exr", ".png", "-flip.png", "-relative.png")}
        self.assertEqual(set(os.listdir(self.path("r"))),
                         names | {"reference.exr", "reference.png", "report.html"})
        self.check_page(Path(self.path("r/report.html")).read_text(), pictures=4)

    def check_page(self, page, pictures):
        tags = Tags()
        tags.feed(page)
        self.assertTrue(all(source.startswith("data:image/") for source in tags.sources))
        self.assertGreaterEqual(len(tags.sources), 3 * pictures + 1)
        self.assertEqual(page.count("<figure class=chart>"), 2)
        for text in ("lobe compare gallery --methods ellipsoid,horizon:floor=0.5", "prefers-color-scheme:dark",
                     "@media print", "width=device-width", "On this scene"):
            self.assertIn(text, page)
        self.assertNotRegex(page, r"https?://|\bnan\b|\binf\b")

    def test_table(self):
        lines = self.done("compare", "furnace", "--methods", "ellipsoid,bounded", *SMALL, "-o",
                          self.path("r")).decode().splitlines()
        self.assertEqual(lines[0].split(), ["method", "samples", "RMSE", "relMSE", "FLIP", "HDR-FLIP",
                                            "rejected", "seconds", "Mrays/s"])
        self.assertEqual([line.split()[:2] for line in lines[1:5]],
                         [["ellipsoid", "1"], ["bounded", "1"], ["ellipsoid", "2"], ["bounded", "2"]])
        self.assertRegex(lines[-1], r"^On this scene ")

    def test_one_command_gives_one_result(self):
        """Threads and repetition change no number but the times."""
        def numbers(threads):
            rows = self.compare("gallery", "--methods", "caps,default", *SMALL, "--threads", threads,
                                "-o", self.path("r"))["rows"]
            return [{k: v for k, v in row.items() if "second" not in k} for row in rows]
        self.assertEqual(numbers("1"), numbers("2"))

    def test_equal_time(self):
        """The first method keeps its samples."""
        result = self.compare("gallery", "--methods", "ellipsoid,horizon-exact", "--size", "32x18",
                              "--seeds", "2", "--spp", "8,16", "--equal", "time", "-o", self.path("r"))
        self.assertEqual([r["spp"] for r in result["rows"] if r["method"] == "ellipsoid"], [8, 16])
        self.assertEqual(result["equal"], "time")
        self.assertRegex(result["headline"], "of the time")

    def test_reference_file(self):
        reference = self.path("t.pfm")
        self.done("render", "gallery", "--size", "32x18", "--spp", "32", "-o", reference)
        result = self.compare("gallery", "--methods", "caps", *SMALL, "--reference", reference, "-o",
                              self.path("r"))
        pair = self.compare(self.path("r/caps-2spp.exr"), reference)
        self.assertEqual(result["reference_noise"], 0)
        self.assertGreater(pair["rmse"], 0.2 * result["rows"][1]["rmse"])
        self.assertLess(pair["rmse"], 5 * result["rows"][1]["rmse"])

    def test_names_are_quoted(self):
        scene = self.folder / '<b>&".obj'
        scene.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        result = self.compare(str(scene), "--methods", "caps", *SMALL, "-o", self.path("r"))
        self.assertEqual(result["scene"], str(scene))
        page = Path(self.path("r/report.html")).read_text()
        self.assertIn("&lt;b&gt;&amp;&quot;.obj", page)
        self.assertNotIn("<b>&", page)


class TruthTest(CompareTest):
    """With five standard deviations a right method is called biased once in 3 million comparisons."""
    def methods(self, *names, scene="normal-mapped", spp="4,16", seeds="4", size="48x27"):
        result = self.compare(scene, "--methods", ",".join(names), "--size", size, "--spp", spp,
                              "--seeds", seeds, "--reference-spp", "256", "-o", self.path("r"))
        return {m["method"]: m for m in result["methods"]}, result

    def test_a_biased_method_is_a_floor(self):
        methods, result = self.methods("bounded", "ellipsoid", "ellipsoid:normalization=previous")
        biased = methods.pop("ellipsoid:normalization=previous")
        self.assertTrue(biased["is_biased"])
        last = [r for r in result["rows"] if r["method"] == biased["method"]][-1]
        self.assertLess(biased["floor"], 1.1 * last["relmse"])
        self.assertGreater(biased["floor"], 0.5 * last["relmse"])
        self.assertGreater(biased["slope"], methods["ellipsoid"]["slope"] + 0.2)
        for name, m in methods.items():
            self.assertFalse(m["is_biased"], name)
            self.assertLess(abs(m["floor_deviations"]), 5, name)
            self.assertLess(m["slope"], -0.8, name)
        self.assertNotIn("previous", result["headline"])

    def test_noise_of_the_reference_is_no_error(self):
        """A reference hardly better than the pictures gives the same errors as a good one."""
        errors = []
        for spp in ("16", "256"):
            result = self.compare("normal-mapped", "--methods", "caps", "--size", "48x27", "--spp", "16",
                                  "--seeds", "8", "--reference-spp", spp, "-o", self.path("r"))
            errors.append(result["rows"][0]["relmse"])
        # with its noise the first would be twice the second
        self.assertLess(abs(errors[0] / errors[1] - 1), 0.3)

    def test_a_better_method_is_told(self):
        methods, result = self.methods("ndf", "horizon-uniform")
        share, error = (methods["horizon-uniform"][k] for k in ("samples_share", "samples_share_error"))
        self.assertLess(share + 3 * error, 1)
        self.assertEqual(result["headline"],
                         f"On this scene horizon-uniform needs {100 * share:.0f} % of the samples of ndf")

    def test_the_same_method_is_not_told_apart(self):
        methods, result = self.methods("horizon", "horizon:floor=0.25", scene="brushed", spp="2,4")
        self.assertEqual(methods["horizon:floor=0.25"]["samples_share"], 1)
        self.assertIn("cannot be told apart", result["headline"])


class InterruptTest(CompareTest):
    def interrupt(self, *arguments, until):
        command = [PROGRAM, "compare", "gallery", "--size", "64x36", *arguments, "-o", self.path("r"),
                   "--progress", "json"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            for line in process.stderr:
                if json.loads(line)["fraction"] > until:
                    break
            process.send_signal(signal.SIGINT)
            output, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        return output

    def test_finished_pictures_are_kept(self):
        """The reference is little work; the first pictures are there long before the end."""
        output = self.interrupt("--methods", "caps,bounded", "--spp", "2", "--seeds", "64",
                                "--reference-spp", "2", "--json", until=0.3)
        result = json.loads(output)
        self.assertTrue(result["interrupted"])
        self.assertEqual({row["method"] for row in result["rows"]}, {"caps", "bounded"})
        self.assertTrue(all(0 < row["seeds"] < 64 for row in result["rows"]))
        self.assertIn("Interrupted", Path(self.path("r/report.html")).read_text())

    def test_no_report_without_a_reference(self):
        output = self.interrupt("--methods", "caps", "--spp", "1", "--reference-spp", "16777216", until=0)
        self.assertEqual((output, os.listdir(self.path("r"))), (b"", []))


class ErrorTest(CompareTest):
    def test_usage(self):
        a = self.picture("a.pfm", [0.5, 0.5, 0.5])
        out = ["-o", self.path("r")]
        methods = ["--methods", "caps"]
        self.rejected("compare", where="compare")
        self.rejected("compare", "gallery", *out, where="--methods")
        self.rejected("compare", "gallery", *methods, where="-o")
        self.rejected("compare", a, a, a, where=a)
        self.rejected("compare", a, a, *methods, where="--methods")
        self.rejected("compare", a, a, "--size", "8x8", where="--size")
        self.rejected("compare", "gallery", *methods, *out, "--threshold", "1", where="--threshold")
        self.rejected("compare", "gallery", *methods, *out, "--reference", a, "--reference-spp", "9",
                      where="--reference-spp")
        self.rejected("compare", "gallery", *methods, *out, *SMALL, "--reference", a, where=a)
        self.rejected("compare", "no-such-scene", *methods, *out, *SMALL)

    def test_values(self):
        for option, values in {
                "--methods": ["", "best", "caps,", ",caps", "caps,caps", "caps:floor=0.5", "horizon:floor=2",
                              "horizon:floor=", "horizon:x=1", "caps:normalization=none", ":", "caps:",
                              ",".join(f"horizon:floor=0.{k}" for k in range(13)), "a" * 100],
                "--spp": ["", "0", "1,", ",1", "1,1", "1.5", "16777217", ",".join("123456789abcd"), "-1"],
                "--seeds": ["0", "65", "x"], "--equal": ["x"], "--metric": ["x"],
                "--threshold": ["nan", "", "x"], "--reference-spp": ["0", "16777217"],
                "--size": ["0x1"], "--threads": ["0"]}.items():
            for value in values:
                methods = [] if option == "--methods" else ["--methods", "caps"]
                self.rejected("compare", "gallery", *methods, "-o", self.path("r"), f"{option}={value}",
                              where=option)
        self.rejected("compare", "gallery", "--methods", "newton", "-o", self.path("r"), where="--method")
        a = self.picture("a.pfm", [0.5, 0.5, 0.5])
        self.rejected("compare", a, a, "--threshold", "-1", where="--threshold")

    def test_no_place_is_found_before_the_work(self):
        (self.folder / "f").write_text("a file")
        for name in ("f", "no/such/folder"):
            self.rejected("compare", "gallery", "--methods", "caps", "--spp", "16777216", "-o",
                          self.path(name), status=(1,), where=self.path(name))

    def test_full_disk(self):
        """Files of an earlier run stay what they were, and nothing lies beside them."""
        (self.folder / "r").mkdir()
        (self.folder / "r/reference.exr").write_text("old")
        (self.folder / "r/report.html").write_text("old")

        def limit(size):
            def apply():
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
            return apply
        # too small for the first picture, and for the page alone
        for size in (4096, 20000):
            result = subprocess.run([PROGRAM, "compare", "gallery", "--methods", "caps", *SMALL, "-o",
                                     self.path("r")], capture_output=True, preexec_fn=limit(size))
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")
            self.assertEqual((self.folder / "r/report.html").read_text(), "old")
            self.assertFalse([n for n in os.listdir(self.path("r")) if n.endswith(".part")])
            self.assertEqual((self.folder / "r/reference.exr").read_bytes() == b"old", size == 4096)

    def test_full_standard_output(self):
        with open("/dev/full", "wb") as full:
            result = subprocess.run([PROGRAM, "compare", "gallery", "--methods", "caps", *SMALL, "-o",
                                     self.path("r")], stdout=full, stderr=subprocess.PIPE, timeout=60)
        self.assertEqual(result.returncode, 1)


if __name__ == "__main__":
    main()
