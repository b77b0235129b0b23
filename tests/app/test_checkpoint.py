"""lobe render that is killed, runs out of disk, or stops early; lobe merge of seeds and parts.

LOBE_KILLS=N in the environment: so many kills instead of 10.
"""
import array
import json
import os
import random
import resource
import signal
import subprocess
import time

from program import ERROR_LINE, PROGRAM, FolderTest, main, run

KILLS = int(os.environ.get("LOBE_KILLS", "10"))
SMALL = ["gallery", "--size", "40x24", "--spp", "20"]


class LongTest(FolderTest):
    def render(self, name, *arguments):
        """The bytes of the picture."""
        self.done("render", *SMALL, "-o", self.path(name), *arguments)
        return self.bytes_of(name)

    def merge(self, name, *sources):
        self.done("merge", *map(self.path, sources), "-o", self.path(name))
        return self.bytes_of(name)


class KillTest(LongTest):
    def test_kill_at_any_moment(self):
        """Killed again and again, with other numbers of threads, the picture is the same file; a checkpoint is at all
        times whole or not there."""
        scene = ["gallery", "--size", "96x54", "--spp", "30", "--aov", "albedo,rejected"]
        start = time.monotonic()
        self.done("render", *scene, "-o", self.path("whole.exr"))
        longest = 1.5 * (time.monotonic() - start)
        generator = random.Random(20251125)
        kills = went_on = 0
        command = [PROGRAM, "render", *scene, "-o", self.path("a.exr"), "--checkpoint",
                   self.path("c"), "--resume", self.path("c"), "--checkpoint-every", "0.05"]
        while kills < KILLS or not (self.folder / "a.exr").exists():
            is_last = kills >= KILLS
            went_on += (self.folder / "c").exists()
            with subprocess.Popen([*command, "--threads", str(generator.randint(1, 3))],
                                  stderr=subprocess.PIPE) as process:
                if not is_last:
                    time.sleep(generator.uniform(0.1, 1) * longest)
                    process.kill()
                self.assertEqual(process.stderr.read(), b"")
                status = process.wait(timeout=120)
            kills += status == -signal.SIGKILL
            if status == 0:
                self.assertEqual(self.bytes_of("a.exr"), self.bytes_of("whole.exr"))
                self.assertEqual(set(os.listdir(self.folder)), {"whole.exr", "a.exr", "c"})
                if kills < KILLS:
                    (self.folder / "a.exr").unlink()
                    (self.folder / "c").unlink()
            elif (self.folder / "c").exists():
                self.done("merge", self.path("c"), "-o", self.path("b.exr"))
                (self.folder / "b.exr").unlink()
        self.assertGreaterEqual(went_on, 1)

    def test_interrupt_saves_a_checkpoint(self):
        """Status 130, and the same bits later."""
        scene = ["gallery", "--size", "96x54", "--spp", "60"]
        self.done("render", *scene, "-o", self.path("whole.exr"))
        with subprocess.Popen([PROGRAM, "render", *scene, "--checkpoint", self.path("c"),
                               "--progress", "json"], stderr=subprocess.PIPE) as process:
            process.stderr.readline()
            process.send_signal(signal.SIGINT)
            process.stderr.read()
            self.assertEqual(process.wait(timeout=60), 130)
        self.done("render", *scene, "--resume", self.path("c"), "-o", self.path("a.exr"))
        self.assertEqual(self.bytes_of("a.exr"), self.bytes_of("whole.exr"))

    def test_full_disk(self):
        """Said, the picture goes on, and the checkpoint before is kept."""
        self.render("whole.exr", "--checkpoint", self.path("c"), "--seed", "1")
        before = self.bytes_of("c")

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (32768, 32768))
        self.assertGreater(len(before), 32768)
        result = subprocess.run([PROGRAM, "render", *SMALL, "-o", self.path("a.exr"), "--checkpoint",
                                 self.path("c")], capture_output=True, preexec_fn=limit)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")
        self.assertIn(b"rendering goes on", result.stderr)
        self.assertEqual(self.bytes_of("c"), before)
        self.assertEqual(set(os.listdir(self.folder)), {"whole.exr", "a.exr", "c"})
        self.assertEqual(self.bytes_of("a.exr"), self.render("b.exr"))

    def test_refused(self):
        self.render("a.exr", "--checkpoint", self.path("c"))
        command = ["render", "--json", "--resume", self.path("c")]
        error = self.rejected(*command, *SMALL, "--depth", "3", where=self.path("c")).stderr
        self.assertIn(b"its depth is 8, not 3;", error)
        error = self.rejected(*command, "cornell", *SMALL[1:]).stderr
        self.assertIn(b"its triangles is", error)
        error = self.rejected(*command, *SMALL, "--env-rotate", "10", "--env", self.path("a.exr"))
        self.assertIn(b"its environment is", error.stderr)
        (self.folder / "foreign").write_text("a letter")
        for name in ("foreign", "a.exr", "nothing", "."):
            self.rejected("render", *SMALL, "--json", "--resume", self.path(name))
        self.rejected("render", *SMALL, "--json", "--checkpoint", self.path("foreign"),
                      where=self.path("foreign"))
        self.assertEqual((self.folder / "foreign").read_text(), "a letter")
        self.rejected("render", *SMALL, "-o", self.path("b.exr"), "--checkpoint",
                      self.path("b.exr"), where="--checkpoint")
        self.rejected("render", *SMALL, "--checkpoint", "/no/such/folder/c", status=(1,))
        for option, values in (("--part", ["", "0/2", "3/2", "1", "1/2/3", "a/b", "1/1000001"]),
                               ("--noise", ["-1", "nan", ""]), ("--checkpoint-every", ["-1", "x"])):
            for value in values:
                self.rejected("render", *SMALL, "--json", f"{option}={value}", where=option)


class StopTest(LongTest):
    def test_noise_is_an_end_that_can_be_gone_on_to(self):
        scene = ["render", "gallery", "--size", "40x24", "--spp", "4096", "--noise", "0.1"]
        whole = json.loads(self.done(*scene, "--json", "-o", self.path("whole.exr")))
        self.assertLessEqual(whole["noise"], 0.1)
        self.assertLess(whole["spp"], 4096)
        self.done(*scene, "--time", "0.05", "--checkpoint", self.path("c"))
        for _ in range(2):  # the second time everything is there
            self.done(*scene, "--resume", self.path("c"), "--checkpoint", self.path("c"), "-o",
                      self.path("a.exr"))
            self.assertEqual(self.bytes_of("a.exr"), self.bytes_of("whole.exr"))

    def test_time_counts_this_run(self):
        """However much was done before."""
        scene = ["render", "gallery", "--size", "96x54", "--spp", "16777216", "--json",
                 "--checkpoint", self.path("c"), "--resume", self.path("c"), "--time", "0.3"]
        samples = [json.loads(self.done(*scene))["samples"] for _ in range(3)]
        self.assertGreater(samples[0], 0)
        self.assertLess(samples[0], samples[1])
        self.assertLess(samples[1], samples[2])


class MergeTest(LongTest):
    def test_parts_are_the_whole(self):
        """As pictures, as checkpoints, mixed, in any order, and gone on with."""
        aov = ("--aov", "albedo,normal,depth,rejected,vndf-integral")
        whole = self.render("whole.exr", *aov)
        for k in (1, 2, 3):
            self.render(f"{k}.exr", *aov, "--part", f"{k}/3", "--checkpoint", self.path(f"{k}"))
        for sources in (("1.exr", "2.exr", "3.exr"), ("3", "1", "2"), ("2", "3.exr", "1")):
            self.assertEqual(self.merge("a.exr", *sources), whole, sources)
        self.merge("some.checkpoint", "3", "1")
        self.assertEqual(self.render("b.exr", *aov, "--resume", self.path("some.checkpoint")), whole)
        self.assertNotEqual(self.merge("c.exr", "1.exr", "2.exr"), whole)
        self.assertIn(b"samples.Y", self.bytes_of("c.exr"))
        self.assertEqual(self.merge("d.exr", "c.exr", "3.exr"), whole)

    def test_more_parts_than_tiles(self):
        whole = self.render("whole.exr")
        for k in range(1, 9):  # 6 tiles
            self.done("render", *SMALL, "--part", f"{k}/8", "--checkpoint", self.path(f"{k}"))
        self.assertEqual(self.merge("a.exr", *map(str, range(1, 9))), whole)

    def means(self, name):
        """The numbers of a little-endian .pfm."""
        numbers = array.array("f")
        numbers.frombytes(self.bytes_of(name).split(b"\n", 3)[3])
        return numbers

    def test_seeds_are_averaged_by_samples(self):
        """The mean of 20 and 60 samples; checkpoints keep the sums."""
        for name, seed, spp in (("a", "1", "20"), ("b", "2", "60")):
            self.done("render", *SMALL[:3], "--spp", spp, "--seed", seed, "-o",
                      self.path(name + ".pfm"), "--checkpoint", self.path(name))
        self.merge("m.pfm", "a", "b")
        a, b, m = (self.means(name + ".pfm") for name in "abm")
        self.assertEqual(len(m), 40 * 24 * 3)
        for x, y, z in zip(a, b, m):
            self.assertAlmostEqual((x + 3 * y) / 4, z, delta=1e-6 * (1 + z))
        self.merge("n.pfm", "b", "a")
        self.assertEqual(self.bytes_of("m.pfm"), self.bytes_of("n.pfm"))

    def test_refused(self):
        one = self.render("1.exr", "--checkpoint", self.path("1"))
        self.render("2.exr", "--seed", "2")
        self.render("deep.exr", "--seed", "3", "--depth", "3")
        self.render("bright.exr", "--seed", "4", "--exposure", "1")
        self.render("part.exr", "--part", "1/2")
        self.done("render", *SMALL[:1], "--size", "41x24", "--seed", "5", "-o", self.path("wide.exr"))
        self.done("render", "cornell", *SMALL[1:], "--seed", "6", "-o", self.path("other.exr"))
        self.done("render", *SMALL[:3], "--spp", "8", "--part", "2/2", "-o", self.path("8.exr"))
        self.render("plain.pfm")
        self.merge("12.exr", "1.exr", "2.exr")
        for names, what in ((("1.exr", "1.exr"), "seed 0"), (("1", "1.exr"), "seed 0"),
                            (("12.exr", "2.exr"), "seed 2"), (("1.exr", "part.exr"), "seed 0"),
                            (("1.exr", "deep.exr"), "its depth is 3"), (("part.exr", "8.exr"), "spp 8"),
                            (("1.exr", "bright.exr"), "its exposure is 1"),
                            (("1.exr", "wide.exr"), "its size is 41x24"),
                            (("1.exr", "other.exr"), "its triangles is"),
                            (("1.exr", "plain.pfm"), "not a checkpoint"), (("none",), "")):
            paths = [self.path(name) for name in names]
            error = self.rejected("merge", *paths, "-o", self.path("x.exr"), where=paths[-1]).stderr
            self.assertIn(what.encode(), error)
        self.rejected("merge", self.path("1.exr"), "-o", self.path("x.checkpoint"))
        self.rejected("merge", "-o", self.path("x.exr"), where="merge")
        self.rejected("merge", self.path("1.exr"), where="-o")
        self.rejected("merge", self.path("1.exr"), "-o", self.path("x.jpg"))
        self.assertFalse((self.folder / "x.exr").exists())
        self.assertEqual(self.bytes_of("1.exr"), one)

    def test_broken_pictures(self):
        """Cut or changed anywhere: refused in one line, or a picture; never a crash."""
        good = self.render("good.exr", "--aov", "rejected")
        generator = random.Random(7)
        for case in range(60):
            bad = bytearray(good[:generator.randrange(len(good))] if case % 2 else good)
            for _ in range(generator.randrange(1, 4)):
                bad[generator.randrange(min(len(bad), 1500))] = generator.randrange(256) if bad else 0
            (self.folder / "bad.exr").write_bytes(bad)
            result = run("merge", self.path("bad.exr"), "-o", self.path("x.exr"))
            self.assertIn(result.returncode, (0, 1, 2), case)
            if result.returncode:
                self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z", case)


if __name__ == "__main__":
    main()
