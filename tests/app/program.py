"""Runs the program under test, and what every test asks of it."""
import csv
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["LOBE_PROGRAM"]
ERROR_LINE = re.compile(rb"lobe: [ -~]+: [ -~]+; [ -~]+\n")
MODEL = ["--alpha", "0.3,0.6", "--wi", "0.6,0,0.8"]


def run(*arguments, stdin=b"", timeout=60):
    return subprocess.run([PROGRAM, *arguments], input=stdin, capture_output=True, timeout=timeout)


def table(text):
    """The rows of a CSV text as dictionaries of floats."""
    return [{name: float(number) for name, number in row.items()}
            for row in csv.DictReader(text.decode().splitlines())]


class ProgramTest(unittest.TestCase):
    def done(self, *arguments, stdin=b""):
        """Standard output of a run that must succeed and say nothing else."""
        result = run(*arguments, stdin=stdin)
        self.assertEqual((result.returncode, result.stderr), (0, b""), arguments)
        return result.stdout

    def rejected(self, *arguments, stdin=b"", status=(2,), where=None):
        """A run that must end with one error line, which names `where`."""
        result = run(*arguments, stdin=stdin)
        self.assertIn(result.returncode, status, (arguments, result.stderr))
        self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z", arguments)
        if where is not None:
            self.assertTrue(result.stderr.startswith(f"lobe: {where}: ".encode()), result.stderr)
        return result


class FolderTest(ProgramTest):
    """With an empty folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def path(self, name):
        return str(self.folder / name)

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()


class LongTest(FolderTest):
    """Small renders that are kept as files."""
    SMALL = ["cornell", "--size", "40x24", "--spp", "20"]

    def render(self, name, *arguments):
        """The bytes of the picture."""
        self.done("render", *self.SMALL, "-o", self.path(name), *arguments)
        return self.bytes_of(name)


def main():
    unittest.main()
