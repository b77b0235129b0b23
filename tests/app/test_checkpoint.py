"""lobe render that is killed, runs out of disk, or stops early.

LOBE_KILLS=N in the environment: so many kills instead of 10.
"""
import json
import os
import random
import resource
import signal
import subprocess
import time

from program import ERROR_LINE, PROGRAM, LongTest, main

KILLS = int(os.environ.get("LOBE_KILLS", "10"))
SMALL = LongTest.SMALL


class KillTest(LongTest):
    def test_kill_at_any_moment(self):
        """Killed again and again, with other numbers of threads, the picture is the same file; a checkpoint is at all
        times whole or not there."""
        self.kill_often(KILLS, ["cornell", "--size", "64x36", "--spp", "60", "--aov",
                                "albedo,rejected"])

    def test_kill_of_an_adaptive_one(self):
        """With a plan to lose."""
        self.kill_often(KILLS // 2, ["cornell", "--size", "40x24", "--spp", "400", "--adaptive"])

    def kill_often(self, wanted, scene):
        start = time.monotonic()
        self.done("render", *scene, "-o", self.path("whole.exr"))
        longest = 1.5 * (time.monotonic() - start)
        generator = random.Random(20251125)
        kills = went_on = 0
        command = [PROGRAM, "render", *scene, "-o", self.path("a.exr"), "--checkpoint",
                   self.path("c"), "--resume", self.path("c"), "--checkpoint-every", "0.1"]
        while kills < wanted or not (self.folder / "a.exr").exists():
            is_last = kills >= wanted
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
                if kills < wanted:
                    (self.folder / "a.exr").unlink()
                    (self.folder / "c").unlink()
            elif (self.folder / "c").exists():
                self.done("merge", self.path("c"), "-o", self.path("b.exr"))
                (self.folder / "b.exr").unlink()
        self.assertGreaterEqual(went_on, 1)

    def test_interrupt_saves_a_checkpoint(self):
        """Status 130, and the same bits later."""
        scene = ["cornell", "--size", "96x54", "--spp", "30"]
        self.done("render", *scene, "-o", self.path("whole.exr"))
        with subprocess.Popen([PROGRAM, "render", *scene, "--checkpoint", self.path("c"),
                               "--progress", "json"], stderr=subprocess.PIPE) as process:
            while b'"render"' not in process.stderr.readline():
                pass  # the tree, if it takes a while
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
        error = self.rejected(*command, "gallery", *SMALL[1:]).stderr
        self.assertIn(b"its triangles is", error)
        error = self.rejected(*command, *SMALL, "--env-rotate", "10", "--env", self.path("a.exr"))
        self.assertIn(b"its environment is", error.stderr)
        lens = ("--aperture", "0.1", "--focus", "2")
        error = self.rejected(*command, *SMALL, *lens, where=self.path("c")).stderr
        self.assertIn(b"its aperture is none, not 0.1", error)
        self.render("b.exr", "--checkpoint", self.path("l"), *lens)
        error = self.rejected("render", "--json", "--resume", self.path("l"), *SMALL).stderr
        self.assertIn(b"its aperture is 0.1", error)
        (self.folder / "foreign").write_text("a letter")
        for name in ("foreign", "a.exr", "nothing", "."):
            self.rejected("render", *SMALL, "--json", "--resume", self.path(name))
        self.rejected("render", *SMALL, "--json", "--checkpoint", self.path("foreign"),
                      where=self.path("foreign"))
        self.assertEqual((self.folder / "foreign").read_text(), "a letter")
        self.rejected("render", *SMALL, "-o", self.path("b.exr"), "--checkpoint",
                      self.path("b.exr"), where="--checkpoint")
        for more, where in ((("--spp", "63"), "--adaptive"), (("--part", "1/2"), "--adaptive")):
            self.rejected("render", *SMALL[:3], "--json", "--adaptive", *more, where=where)
        self.rejected("render", *SMALL, "--checkpoint", "/no/such/folder/c", status=(1,))
        for option, values in (("--part", ["", "0/2", "3/2", "1", "1/2/3", "a/b", "1/1000001"]),
                               ("--noise", ["-1", "nan", ""]), ("--checkpoint-every", ["-1", "x"])):
            for value in values:
                self.rejected("render", *SMALL, "--json", f"{option}={value}", where=option)


class StopTest(LongTest):
    def test_noise_is_an_end_that_can_be_gone_on_to(self):
        for how in ([], ["--adaptive"]):
            self.stop_early(["render", "cornell", "--size", "40x24", "--spp", "4096", "--noise", "0.2",
                             *how])

    def stop_early(self, scene):
        whole = json.loads(self.done(*scene, "--json", "-o", self.path("whole.exr")))
        self.assertLessEqual(whole["noise"], 0.2)
        self.assertLess(whole["spp"], 4096)
        self.done(*scene, "--time", "0.05", "--checkpoint", self.path("c"))
        for _ in range(2):  # the second time everything is there
            self.done(*scene, "--resume", self.path("c"), "--checkpoint", self.path("c"), "-o",
                      self.path("a.exr"))
            self.assertEqual(self.bytes_of("a.exr"), self.bytes_of("whole.exr"))

    def test_time_counts_this_run(self):
        """However much was done before."""
        scene = ["render", "cornell", "--size", "96x54", "--spp", "16777216", "--json",
                 "--checkpoint", self.path("c"), "--resume", self.path("c"), "--time", "0.3"]
        samples = [json.loads(self.done(*scene))["samples"] for _ in range(3)]
        self.assertGreater(samples[0], 0)
        self.assertLess(samples[0], samples[1])
        self.assertLess(samples[1], samples[2])


if __name__ == "__main__":
    main()
