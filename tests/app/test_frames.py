"""lobe render: several numbered pictures out of one call, and how it goes on after an interruption."""
import json
import os
import signal
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
        self.rejected(*orbit, "-o", self.path("a" * 5000 + ".exr"), status=(1, 2))
        self.assertEqual(self.names(), [])


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

    def test_stopped_pictures_are_gone_on_with(self):
        """By time, then by kill -9 wherever it falls."""
        scene = ["render", "cornell", "--size", "64x36", "--spp", "256", "--orbit", "3"]
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
        whole = self.frames("--orbit", "2", name="w.exr")
        for part in ("1", "2"):
            parts = ["--orbit", "2", "--part", f"{part}/2"]
            self.frames(*parts, *self.long, name=f"{part}.exr")
            again = run("render", *SMALL, *parts, *self.long, "-o", self.path(f"{part}.exr"), "--json")
            self.assertEqual(again.stdout.count(b"was_finished"), 2)
        for i in (1, 2):
            self.done("merge", self.path(f"1.000{i}.exr"), self.path(f"2.000{i}.exr"), "-o",
                      self.path("m.exr"))
            self.assertEqual(self.bytes_of("m.exr"), whole[i - 1])

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
