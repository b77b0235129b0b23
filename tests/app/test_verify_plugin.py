"""lobe verify --plugin and --report: right BSDFs pass, wrong ones fail, and one that crashes, loops for
ever, takes all memory or returns NaN fails without harm."""
import json
import os
import re
import tempfile
import time
from html.parser import HTMLParser
from pathlib import Path

from program import ProgramTest, main, run

BUILD = Path(os.environ["LOBE_BUILD_DIR"])
EXAMPLES = BUILD / "examples" / "plugin"
BAD = BUILD / "tests" / "plugins"
QUICK = ["--case-seconds", "2", "--only", "theta=[03]*"]


def example(name):
    return str(EXAMPLES / f"{name}.so")


def bad(name):
    return str(BAD / f"bad_{name}.so")


class FolderTest(ProgramTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name


class PluginTest(ProgramTest):
    def failed(self, path, *arguments):
        """The failed rows of a run that must end with status 3, as objects."""
        result = run("verify", "--plugin", path, "--json", *arguments)
        self.assertEqual(result.returncode, 3, result.stderr)
        rows = [json.loads(line) for line in result.stdout.splitlines()]
        summary = rows.pop()
        failed = [row for row in rows if not row["passed"]]
        self.assertEqual(len(failed), summary["failed"])
        return failed

    def test_right_examples_pass(self):
        for name in ("lambert", "ggx", "translucent"):
            if name == "translucent" and not os.path.exists(example(name)):
                continue  # no C++ compiler here
            with self.subTest(name):
                few = ["--plugin", example(name), "--draws", "30000"]
                last = self.done("verify", *few).decode().splitlines()[-1]
                self.assertRegex(last, r"^[1-9]\d+ passed, 0 failed$")

    def test_wrong_examples_fail(self):
        for name in ("ggx_without_jacobian", "ggx_without_g1"):
            with self.subTest(name):
                failed = self.failed(example(name), "--only", "alpha_x=0.3 ")
                self.assertEqual({row["test"] for row in failed}, {"chi2", "rejected", "furnace"})
                self.assertTrue(any("theta=75" in row["configuration"] for row in failed))

    def test_list(self):
        lines = self.done("verify", "--plugin", example("ggx"), "--list").decode().splitlines()
        self.assertEqual(len(lines), len(set(lines)))
        self.assertIn("ggx alpha_x=0.3 alpha_y=0.5 theta=60 phi=200", lines)
        some = self.done("verify", "--plugin", example("ggx"), "--list", "--only", "theta=88")
        self.assertEqual(some.decode().splitlines(), [x for x in lines if "theta=88" in x])

    def test_runs_agree(self):
        few = ["--plugin", example("ggx"), "--only", "theta=[36]0"]
        one = self.done("verify", *few, "--threads", "1")
        self.assertEqual(one, self.done("verify", *few, "--threads", "4"))

    def test_misbehaviour_is_reported(self):
        """The tests that ended before count; the end itself is a failed test."""
        causes = {"crash": "crashed", "abort": "crashed", "exit": "exited", "fork": "crashed",
                  "hang": "ran out of time"}
        for name, cause in causes.items():
            with self.subTest(name):
                failed = self.failed(bad(name), *QUICK)
                self.assertEqual({row["test"] for row in failed}, {"survival"})
                for row in failed:
                    self.assertIn(cause, row["detail"])
                    self.assertIn("draws", row["detail"])

    def test_memory_is_bounded(self):
        if "asan" in str(BUILD):
            return  # the sanitizer needs more address space than the limit
        failed = self.failed(bad("memory"), "--case-seconds", "10", "--only", "theta=0")
        self.assertEqual([row["test"] for row in failed], ["survival"])
        self.assertIn("crashed", failed[0]["detail"])

    def test_nan_is_reported(self):
        tests = {row["test"] for row in self.failed(bad("nan"), "--only", "theta=30")}
        self.assertTrue({"sound", "rejected"} <= tests, tests)
        tests = {row["test"] for row in self.failed(bad("nan_density"), "--only", "theta=30")}
        self.assertTrue({"chi2", "extreme"} <= tests, tests)

    def test_nothing_outlives_the_run(self):
        self.failed(bad("fork"), *QUICK)
        self.failed(bad("hang"), *QUICK)
        for process in Path("/proc").glob("[0-9]*/cmdline"):
            try:
                self.assertNotIn(str(BAD).encode(), process.read_bytes())
            except OSError:
                pass  # it ended meanwhile

    def test_plugins_that_are_none(self):
        for name in ("symbol", "version", "name", "function", "null", "start_crash"):
            with self.subTest(name):
                self.rejected("verify", "--plugin", bad(name), where="--plugin")
                self.rejected("verify", "--plugin", bad(name), "--list", where="--plugin")
        self.rejected("verify", "--plugin", "/nowhere.so", where="--plugin")
        self.rejected("verify", "--plugin", "", where="--plugin")
        self.rejected("verify", "--plugin", str(BUILD), where="--plugin")
        self.rejected("verify", "--plugin", __file__, where="--plugin")
        self.rejected("verify", "--plugin", example("ggx"), "--case-seconds", "0",
                      where="--case-seconds")
        self.rejected("verify", "--plugin", example("ggx"), "--only", "no such case")

    def test_time_limit_holds(self):
        begin = time.monotonic()
        self.failed(bad("spin"), "--only", "theta=0", "--case-seconds", "0.5")
        self.assertLess(time.monotonic() - begin, 60)


class Page(HTMLParser):
    """Tags with their attributes, and all text."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.text = [], ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data):
        self.text += data

    def count(self, tag):
        return sum(1 for name, _ in self.tags if name == tag)


class ReportTest(FolderTest):
    def page(self, status, *arguments):
        path = Path(self.folder) / "report.html"
        result = run("verify", "--report", str(path), *arguments)
        self.assertEqual((result.returncode, result.stderr), (status, b""))
        self.assertEqual([p.name for p in Path(self.folder).iterdir()], ["report.html"])
        return Page(path.read_text(encoding="utf-8"))

    def test_failed_cases_have_pictures(self):
        page = self.page(3, "--plugin", bad("nan"))
        self.assertIn("FAILED", page.text)
        self.assertGreaterEqual(page.count("img"), 3 * 3)
        self.assertEqual(page.count("img"), 3 * page.count("svg"))

    def test_chosen_cases_have_pictures(self):
        page = self.page(0, "--only", "bounded f32 alpha=0.3,0.3", "--draws", "50000")
        self.assertEqual((page.count("img"), page.count("svg")), (6, 2))
        self.assertIn("bounded f32", page.text)

    def test_right_models_need_none(self):
        self.assertEqual(self.page(0, "--plugin", example("lambert")).count("img"), 0)

    def test_page_needs_nothing_else(self):
        page = self.page(0, "--only", "caps f64 alpha=1,1 theta=60", "--draws", "50000")
        for tag, attributes in page.tags:
            self.assertNotIn(tag, ("script", "link", "iframe"))
            for name in ("src", "href"):
                self.assertTrue(attributes.get(name, "data:").startswith("data:image/png;base64,")
                                or name not in attributes)
        style = (Path(self.folder) / "report.html").read_text(encoding="utf-8")
        self.assertIsNone(re.search(r"https?://|url\(|@import", style))
        self.assertIn("prefers-color-scheme:dark", style)

    def test_what_cannot_be_written(self):
        few = ["--only", "caps f64 alpha=1,1 theta=60", "--draws", "1000"]
        result = run("verify", "--report", "/nowhere/report.html", *few)
        self.assertEqual((result.returncode, result.stdout), (1, b""))
        self.assertRegex(result.stderr, rb"^lobe: /nowhere/report.html: .*; .*\n$")
        self.rejected("verify", "--report", str(Path(self.folder) / "x.html"), "--only", "nothing")
        self.assertEqual(list(Path(self.folder).iterdir()), [])


class ResumeTest(FolderTest):
    FEW = ["--only", "caps f??*g2=separable", "--draws", "20000"]

    def test_resumed_table_is_the_whole_table(self):
        state = str(Path(self.folder) / "state")
        whole = self.done("verify", *self.FEW)
        self.assertEqual(self.done("verify", *self.FEW, "--resume", state), whole)
        self.assertEqual(self.done("verify", *self.FEW, "--resume", state), whole)

    def test_another_run_is_refused(self):
        state = str(Path(self.folder) / "state")
        self.done("verify", *self.FEW, "--resume", state)
        self.rejected("verify", *self.FEW, "--seed", "9", "--resume", state, where="--resume")
        Path(state).write_bytes(b"something else")
        self.rejected("verify", *self.FEW, "--resume", state, where="--resume")
        self.assertEqual(Path(state).read_bytes(), b"something else")


if __name__ == "__main__":
    main()
