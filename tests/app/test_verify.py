"""lobe verify: table, last line, status; and that it says the same every time."""
import json
import os
import signal
import subprocess

from program import PROGRAM, ProgramTest, main, run

WRONG = os.environ["LOBE_BUILD_DIR"] + "/examples/plugin/ggx_without_g1.so"
FEW = ["--only", "caps f32*theta=60", "--draws", "20000"]


class VerifyTest(ProgramTest):
    def test_table_and_summary(self):
        lines = self.done("verify", *FEW).decode().splitlines()
        self.assertGreater(len(lines), 10)
        self.assertEqual(lines[-1], f"{len(lines) - 1} passed, 0 failed")
        for line in lines[:-1]:
            self.assertRegex(line, r"^ok +caps f32 .*theta=60.* limit ")

    def test_threads_and_runs_agree(self):
        self.assertEqual(self.done("verify", *FEW, "--threads", "1"),
                         self.done("verify", *FEW, "--threads", "3"))

    def test_seed_decides(self):
        self.assertNotEqual(self.done("verify", *FEW, "--seed", "2"),
                            self.done("verify", *FEW, "--seed", "3"))

    def test_json(self):
        rows = [json.loads(line) for line in self.done("verify", *FEW, "--json").splitlines()]
        summary = rows.pop()
        self.assertEqual((summary["passed"], summary["failed"]), (len(rows), 0))
        self.assertEqual({row["passed"] for row in rows}, {True})
        self.assertIn("chi2", {row["test"] for row in rows})

    def test_dielectric(self):
        """From inside, near the critical angle: over the whole sphere, in both precisions."""
        case = ["--only", "dielectric*theta=138"]
        rows = [json.loads(line) for line in self.done("verify", *case, "--json").splitlines()]
        self.assertEqual((rows[-1]["passed"], rows.pop()["failed"]), (len(rows), 0))
        self.assertEqual({row["model"] for row in rows}, {"dielectric f32", "dielectric f64"})
        self.assertNotIn("support", {row["test"] for row in rows})
        state, report = "verify-dielectric.state", "verify-dielectric.html"
        for path in (state, report):
            self.addCleanup(lambda path=path: os.path.exists(path) and os.unlink(path))
        first = self.done("verify", *case, "--resume", state)
        self.assertEqual(self.done("verify", *case, "--resume", state), first)
        self.done("verify", "--only", "dielectric f64*theta=138", "--report", report)
        with open(report, encoding="utf-8") as page:
            self.assertIn("dielectric f64", page.read())

    def test_failure_is_status_3(self):
        wrong = run("verify", "--plugin", WRONG, "--only", "alpha_x=0.3*theta=75", "--failures")
        self.assertEqual((wrong.returncode, wrong.stderr), (3, b""))
        lines = wrong.stdout.decode().splitlines()
        self.assertRegex(lines[-1], r"^\d+ passed, [1-9]\d* failed$")
        self.assertTrue(all(line.startswith("FAILED ggx_without_g1") for line in lines[:-1]))

    def test_published_failures_are_set_apart(self):
        """Two million draws show the error of the published fit, and none of the exact inversion."""
        few = ["--draws", "2000000", "--failures"]
        case = " f32 alpha=0.1,1 theta=60"
        lines = self.done("verify", "--only", "slope-published" + case, *few).decode().splitlines()
        self.assertRegex(lines[0], r"^known +slope-published .* chi2 ")
        self.assertEqual(lines[-2], f"{len(lines) - 2} failed as documented")
        self.assertRegex(lines[-1], r"^\d+ passed, 0 failed$")
        self.assertEqual(len(self.done("verify", "--only", "slope" + case, *few).splitlines()), 1)

    def test_full_is_spread(self):
        """Without --only, full takes an even choice: every model, every configuration, bounded."""
        everything = self.done("verify", "--list").decode().splitlines()
        spread = self.done("verify", "--full", "--list").decode().splitlines()
        self.assertEqual(self.done("verify", "--full", "--list", "--only", "*").decode().splitlines(),
                         everything)
        self.assertLessEqual(len(spread), 500)
        self.assertGreaterEqual(len(spread), min(len(everything), 130))
        split = [(case[:case.index(" alpha")], case[case.index("alpha"):]) for case in spread]
        whole = [(case[:case.index(" alpha")], case[case.index("alpha"):]) for case in everything]
        self.assertEqual({model for model, _ in split}, {model for model, _ in whole})
        self.assertEqual({where for _, where in split}, {where for _, where in whole})

    def test_interrupt(self):
        """Ctrl-C prints what is done: whole rows, as many as the last line counts."""
        with subprocess.Popen([PROGRAM, "verify", "--draws", "1000000", "--only", "caps"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            lines = [process.stdout.readline()]
            process.send_signal(signal.SIGINT)
            lines += process.stdout.readlines()
            self.assertEqual((process.wait(timeout=60), process.stderr.read()), (130, b""))
        self.assertEqual(lines.pop(), b"%d passed, 0 failed\n" % len(lines))

    def test_list(self):
        cases = self.done("verify", "--list").decode().splitlines()
        self.assertEqual(len(cases), len(set(cases)))
        for method in ("ndf", "slope-published", "slope", "ellipsoid", "caps", "bounded", "optimal"):
            for precision in ("f32", "f64"):
                self.assertTrue(any(c.startswith(f"{method} {precision} ") for c in cases), method)
        for precision in ("f32", "f64"):
            glass = [c for c in cases if c.startswith(f"dielectric {precision} ")]
            for part in (" theta=0 ", " theta=180 ", "ior=0.75", "radiance", "importance", "thin"):
                self.assertTrue(any(part in c for c in glass), part)
        some = self.done("verify", "--list", "--only", "bounded").decode().splitlines()
        self.assertEqual(some, [case for case in cases if "bounded" in case])

    def test_bad_options(self):
        self.rejected("verify", "--only", "no such model")
        self.rejected("verify", "--list", "--only", "no such model", where="--only")
        self.rejected("verify", "--quick", "--full", where="--quick")
        self.rejected("verify", *FEW[:2], "--draws", "10")
        self.rejected("verify", "--threads", "100000", where="--threads")
        self.rejected("verify", "--seed", "x", where="--seed")


if __name__ == "__main__":
    main()
