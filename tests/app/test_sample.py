"""lobe sample: reproducible draws, the same in every format, and consistent with lobe eval."""
import json
import math
import struct

from program import MODEL, ProgramTest, main, table

COLUMNS = ["mx", "my", "mz", "ox", "oy", "oz", "pdf_m", "pdf_o", "weight"]
METHODS = ["ndf", "slope-published", "slope", "ellipsoid", "caps", "bounded", "optimal"]
BELOW = ["--alpha", "0.4,0.2", "--wi", "0.5,0.3,-0.4"]


def f32(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


class SampleTest(ProgramTest):
    def test_header_and_count(self):
        lines = self.done("sample", *MODEL, "--count", "7").decode().splitlines()
        self.assertEqual(lines[0].split(","), COLUMNS)
        self.assertEqual(len(lines), 8)

    def test_seed_decides(self):
        one, again, other = (self.done("sample", *MODEL, "--count", "500", "--seed", seed)
                             for seed in ("1", "1", "18446744073709551615"))
        self.assertEqual(one, again)
        self.assertNotEqual(one, other)

    def test_longer_run_starts_alike(self):
        self.assertTrue(self.done("sample", *MODEL, "--count", "900").startswith(
            self.done("sample", *MODEL, "--count", "300")))

    def test_formats_agree(self):
        for precision in ("f32", "f64"):
            arguments = ["sample", *MODEL, "--count", "2000", "--precision", precision]
            rows = [[row[name] for name in COLUMNS] for row in table(self.done(*arguments))]
            binary = self.done(*arguments, "--format", "f32le")
            self.assertEqual(binary, b"".join(struct.pack("<9f", *row) for row in rows))
            lines = self.done(*arguments, "--format", "ndjson").decode().splitlines()
            self.assertEqual([list(json.loads(line).values()) for line in lines], rows)
            self.assertEqual(self.done(*arguments, "--json").decode().splitlines(), lines)

    def test_text_gives_back_every_bit(self):
        """f32le is the arithmetic's own bits; rounding the shortest decimals must give them."""
        for alpha in ("0", "0.001", "0.05", "1", "30"):
            arguments = ["sample", "--alpha", alpha, "--wi", "0.99,0,0.01", "--count", "3000"]
            text = table(self.done(*arguments))
            bits = struct.iter_unpack("<9f", self.done(*arguments, "--format", "f32le"))
            for row, numbers in zip(text, bits, strict=True):
                self.assertEqual([f32(row[name]) for name in COLUMNS], list(numbers))

    def test_draws_are_unit_and_kept(self):
        for method in METHODS:
            for model in (MODEL, BELOW):
                wi = [float(number) for number in model[3].split(",")]
                unit = [number / math.hypot(*wi) for number in wi]
                rows = table(self.done("sample", *model, "--method", method, "--count", "2000"))
                self.assertEqual(len(rows), 2000)
                for row in rows:
                    for vector in ("m", "o"):
                        length = math.hypot(*(row[vector + axis] for axis in "xyz"))
                        self.assertAlmostEqual(length, 1, delta=4e-6)
                    faces = 0 < sum(i * row[m] for i, m in zip(unit, ("mx", "my", "mz")))
                    accepted = row["oz"] > 0 and (faces or method != "ndf")
                    self.assertEqual((row["pdf_o"] > 0, row["weight"] > 0), (accepted, accepted))

    def test_eval_agrees(self):
        """eval reads the directions that sample wrote: same density, f cos = weight pdf."""
        for method in METHODS:
            for precision, bound in (("f32", 2e-3), ("f64", 1e-9)):
                model = [*MODEL, "--method", method, "--precision", precision]
                drawn = table(self.done("sample", *model, "--count", "400"))
                rows = "".join(f"{r['ox']!r} {r['oy']!r} {r['oz']!r}\n" for r in drawn)
                for row, e in zip(drawn, table(self.done("eval", *model, stdin=rows.encode())),
                                  strict=True):
                    self.assertAlmostEqual(e["ox"], row["ox"], delta=1e-6)
                    if row["oz"] < 1e-3:
                        continue
                    self.assertAlmostEqual(e["pdf_o"], row["pdf_o"], delta=bound * row["pdf_o"])
                    self.assertAlmostEqual(e["pdf_m"], row["pdf_m"], delta=bound * row["pdf_m"])
                    value = row["weight"] * row["pdf_o"]
                    self.assertAlmostEqual(e["f_cos"], value, delta=bound * value)

    def test_fresnel_multiplies_the_weight(self):
        plain = table(self.done("sample", *MODEL, "--count", "50"))
        for row, coloured in zip(plain, table(self.done("sample", *MODEL, "--count", "50",
                                                        "--fresnel", "0.25")), strict=True):
            cosine = 0.6 * row["mx"] + 0.8 * row["mz"]
            schlick = 0.25 + 0.75 * (1 - cosine) ** 5
            self.assertAlmostEqual(coloured["weight"], row["weight"] * schlick, delta=1e-5)

    def test_methods_differ(self):
        """The rejected share of a grazing rough model falls from ndf over ellipsoid to optimal."""
        shares = []
        for method in ("ndf", "ellipsoid", "optimal"):
            rows = table(self.done("sample", "--alpha", "0.1,1", "--wi", "0.61237,0.61237,0.5",
                                   "--method", method, "--count", "4000"))
            shares.append(sum(row["pdf_o"] == 0 for row in rows) / len(rows))
        # Closed forms 0.366, 0.220, 0.044; five standard deviations of 4000 draws are 0.038.
        for share, known in zip(shares, (0.366, 0.220, 0.044), strict=True):
            self.assertAlmostEqual(share, known, delta=0.039)


class RandomTest(ProgramTest):
    def test_rows_of_random_numbers(self):
        out = table(self.done("sample", *MODEL, "--random", "-",
                              stdin=b"u1,u2,u3\n0.25,0.5,0.125\n\n0.25 0.5\r\n\t0.75 , 0 \n0 0.999"))
        self.assertEqual(len(out), 4)
        self.assertEqual(out[0], out[1])  # no method of this version reads u3
        self.assertNotEqual(out[1], out[2])

    def test_count_stops_early(self):
        self.assertEqual(len(table(self.done("sample", *MODEL, "--random", "-", "--count", "2",
                                             stdin=b"0 0\n0 .5\n.5 0\n"))), 2)

    def test_empty_input_gives_no_rows(self):
        self.assertEqual(table(self.done("sample", *MODEL, "--random", "-")), [])

    def test_too_few_rows(self):
        self.rejected("sample", *MODEL, "--random", "-", "--count", "3", stdin=b"0 0\n0 0\n",
                      where="standard input")

    def test_bad_rows(self):
        for row in (b"1 0", b"-0.1 0", b"nan 0", b"0", b"0 0 0 0", b"0;0", b"inf 0", b"a b",
                    b"0 1e999", b"0x0 0", b"0 0\0", b"0," * 50000):
            self.rejected("sample", *MODEL, "--random", "-", stdin=b"0.5 0.5\n" + row + b"\n",
                          where="standard input:2")

    def test_missing_file(self):
        self.rejected("sample", *MODEL, "--random", "/no/such/file", where="/no/such/file")
        self.rejected("sample", *MODEL, "--random", "/", status=(1, 2), where="/")


if __name__ == "__main__":
    main()
