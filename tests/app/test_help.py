"""--help and --version: every command has a page, and every option it names is one it takes."""
import os
import re
import subprocess
from pathlib import Path

from program import PROGRAM, ProgramTest, main

COMMAND = re.compile(r"^  ([a-z]+) ", re.M)
OPTION = re.compile(r"^  (--[a-z0-9-]+)(?: ([A-Z][^ ]*))?(?:  |$)", re.M)


class HelpTest(ProgramTest):
    def commands(self):
        page = self.done("--help").decode()
        return COMMAND.findall(page.split("Commands\n")[1].split("\n\n")[0])

    def test_version_is_that_of_the_header(self):
        header = Path(os.environ["LOBE_SOURCE_DIR"], "include/lobe/version.h").read_text()
        version = re.search(r'VERSION_STRING "([^"]+)"', header).group(1)
        self.assertEqual(self.done("--version").decode().splitlines()[0], f"lobe {version}")

    def test_version_tells_the_instruction_set(self):
        def line(**environment):
            run = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True,
                                 env={**os.environ, **environment})
            return run.stdout.splitlines()[1]
        used, known = re.fullmatch(r"vectors: (\S+), of (.+)", line(LOBE_ISA="")).groups()
        self.assertEqual(used, known.split()[-1])
        self.assertEqual(line(LOBE_ISA="scalar"), f"vectors: scalar, of {known}")

    def test_commands(self):
        self.assertLessEqual({"sample", "eval", "verify"}, set(self.commands()))

    def test_every_page_is_complete(self):
        for command in self.commands():
            page = self.done(command, "--help").decode()
            self.assertTrue(page.startswith(f"Usage: lobe {command} "))
            self.assertIn("\nExample\n  ", page)
            self.assertLessEqual(max(map(len, page.splitlines())), 100, command)
            self.assertNotRegex(page, r"(?m) $", command)

    def test_every_option_is_taken(self):
        """An option without its value, or with one it has not, is known: the complaint differs."""
        for command in self.commands():
            options = dict(OPTION.findall(self.done(command, "--help").decode()))
            self.assertGreaterEqual(len(options), 3)
            self.assertEqual(options.pop("--help"), "")
            for option, argument in options.items():
                wrong = [option] if argument else [option + "=value"]
                error = self.rejected(command, *wrong, where=option).stderr
                self.assertIn(b"value", error, option)
            unknown = self.rejected(command, "--no-such-option", where="--no-such-option").stderr
            self.assertIn(b"unknown option", unknown)


if __name__ == "__main__":
    main()
