"""Random bytes as rows and as option values: done or one clear line, nothing else."""
import random

from program import ERROR_LINE, MODEL, ProgramTest, main, run

PIECES = [b"0", b"1", b"-", b"+", b".", b"e", b"E", b"5", b"9", b",", b" ", b"\t", b"\r", b"\n",
          b"\n", b"0.5 ", b"0.25,", b"1e-320 ", b"1e308 ", b"-1e308,", b"nan", b"inf", b"0x1p-3",
          b"ox,oy,oz", b"\xff", b"\xc3\xa9", b"\0", b"u1,u2", b"#", b"999999999999999999999 "]
NUMBERS = [b"0", b"1 ", b".5 ", b"0.25,", b" 1e-3 ", b"0 0\n", b"0.1,0.2\n", b" ", b"\n", b"0 0 1\n"]
OPTIONS = ["--alpha", "--wi", "--wo", "--method", "--precision", "--fresnel", "--g2", "--count",
           "--seed", "--format", "--measure", "--random", "--progress", "--json", "--only",
           "--draws", "--threads", "--list", "--help", "--ndf", "--masking", "--"]
VALUES = ["0", "1", "-1", "0.3", "0.3,0.5", "0,0,1", "0.6,0,-0.8", "1e-30,0,1e-30", "1e30", "nan",
          "inf", "f32", "f64", "csv", "ndjson", "f32le", "normal", "optimal", "caps", "0.04",
          "f82:0.5,0.5", "dielectric:1.5", "conductor:0.2,3", "none", "%s%n", "\x01", "é", "1" * 40,
          "never", "-", "/dev/null", "[", "*", "../", "", "4", "1000"]


class FuzzTest(ProgramTest):
    def assert_clean(self, result, case):
        self.assertIn(result.returncode, (0, 1, 2), (case, result.stderr))
        expected = rb"\A\Z" if result.returncode == 0 else rb"\A" + ERROR_LINE.pattern + rb"\Z"
        self.assertRegex(result.stderr, expected, case)

    def test_rows(self):
        generator = random.Random(20250101)
        accepted = 0
        for case in range(600):
            pieces = PIECES if case % 2 else NUMBERS
            text = b"".join(generator.choices(pieces, k=generator.randrange(1, 60)))
            if case % 7 == 0:
                text = generator.randbytes(generator.randrange(0, 3000))
            if case % 3:
                result = run("eval", *MODEL, "--measure", generator.choice(["direction", "normal"]),
                             stdin=text)
            else:
                result = run("sample", *MODEL, "--random", "-", stdin=text)
            self.assert_clean(result, text)
            accepted += len(result.stdout.splitlines()) > 1
        self.assertGreater(accepted, 20)  # not all of it is rejected at the first byte

    def test_numbers_never_become_nan(self):
        """Rows of extreme, but finite numbers, 20 000 of them: every result is finite."""
        generator = random.Random(7)
        for alpha in ("0", "1e-30", "1e-4", "0.5", "1,1e-6", "1e10"):
            for wi in ("0,0,1", "1,0,0", "1,0,1e-20", "0.7,0.1,-0.7", "0,1e-3,-1"):
                rows = "".join(
                    " ".join(repr(generator.choice((-1, 1)) * 10 ** generator.uniform(-300, 300))
                             for _ in range(3)) + "\n" for _ in range(340))
                for precision in ("f32", "f64"):
                    for measure in ("direction", "normal"):
                        out = self.done("eval", "--alpha", alpha, "--wi", wi, "--precision",
                                        precision, "--measure", measure, stdin=rows.encode())
                        self.assertEqual(out.count(b"\n"), 341)
                        self.assertNotIn(b"nan", out)

    def test_options(self):
        generator = random.Random(20250102)
        for _ in range(1200):
            command = generator.choice(["sample", "eval", "eval", "sample", "verify"])
            words = [] if command == "verify" or generator.random() < 0.3 else list(MODEL)
            if command == "verify":
                words = ["--list"]
            for _ in range(generator.randrange(1, 4)):
                option, value = generator.choice(OPTIONS), generator.choice(VALUES)
                words += generator.choice([[option, value], [option + "=" + value], [option]])
            self.assert_clean(run(command, *words, stdin=b"0 0 1\n0.1 0.2 0.3\n"), words)


if __name__ == "__main__":
    main()
