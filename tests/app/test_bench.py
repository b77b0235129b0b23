"""lobe bench: every row, its fields, and what they must satisfy. No test of the times themselves."""
import json

from program import ProgramTest, main


class BenchTest(ProgramTest):
    def bench(self, *arguments):
        return json.loads(self.done("bench", "--quick", "--json", *arguments))

    def test_rows(self):
        report = self.bench("--only", "smith bounded")
        self.assertTrue(report["cpu"])
        self.assertEqual(report["threads"], 1)
        sets = list(dict.fromkeys(row["isa"] for row in report["rows"]))
        self.assertEqual(sets[:2], ["call", "scalar"])
        kinds = [(row["isa"], row["precision"], row["prepared"]) for row in report["rows"]]
        self.assertEqual(kinds, [(i, p, s) for i in sets for p in ("f32", "f64")
                                 for s in ("shared", "each")])
        for row in report["rows"]:
            self.assertEqual((row["ndf"], row["masking"], row["method"]), ("ggx", "smith", "bounded"))
            self.assertGreater(row["ns"], 0)
            self.assertGreater(row["ns_pdf"], 0)
            self.assertGreater(row["stream"], 0)
            self.assertEqual(row["listing"] is not None, row["precision"] == "f32")

    def test_dielectric(self):
        rows = self.bench("--only", "dielectric")["rows"]
        sets = list(dict.fromkeys(row["isa"] for row in rows))
        self.assertEqual(len(rows), 4 * len(sets))
        for row in rows:
            self.assertEqual((row["ndf"], row["masking"], row["method"]), ("ggx", "smith", "dielectric"))
            self.assertGreater(row["ns"], 0)
            self.assertIsNone(row["listing"])

    def test_table(self):
        lines = self.done("bench", "--quick", "--only", "caps call f64 each").decode().splitlines()
        self.assertEqual(lines[0].split()[:3], ["ndf", "masking", "method"])
        self.assertEqual(lines[1].split()[:4], ["ggx", "smith", "caps", "call"])

    def test_page(self):
        page = self.done("bench", "--quick", "--html", "--only", "smith bounded call").decode()
        self.assertTrue(page.startswith("<!doctype html>"))
        self.assertTrue(page.endswith("</html>\n"))
        self.assertEqual(page.count("class=row"), 4)
        self.assertNotIn("src=", page)
        self.assertNotIn("href=", page)

    def test_above_a_geometric_surface(self):
        """No batch prepares for every row there."""
        rows = self.bench("--only", "ggx * horizon * f32", "--floor", "0.5", "--geometric-normal",
                          "0.3,0,1")["rows"]
        each = [row["isa"] for row in rows if row["prepared"] == "each"]
        self.assertEqual(each, ["call"])
        self.assertGreater(len(rows), 2)

    def test_errors(self):
        self.rejected("bench", "--json", "--html", where="--html")
        self.rejected("bench", "--floor", "2", where="--floor")
        self.rejected("bench", "--geometric-normal", "0,0,0", where="--geometric-normal")
        self.rejected("bench", "--only", "no such row", where="--only")
        self.rejected("bench", "--only", "", where="--only")
        self.rejected("bench", "file", where="file")


if __name__ == "__main__":
    main()
