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
            self.assertEqual(row["ns_normal"] is not None, row["isa"] != "call")
            self.assertGreater(row["stream"], 0)
            self.assertEqual(row["listing"] is not None, row["precision"] == "f32")

    def test_dielectric(self):
        rows = self.bench("--only", "dielectric")["rows"]
        sets = list(dict.fromkeys(row["isa"] for row in rows))
        self.assertEqual(len(rows), 4 * len(sets))
        for row in rows:
            self.assertEqual((row["ndf"], row["masking"], row["method"]), ("ggx", "smith", "dielectric"))
            self.assertGreater(row["ns"], 0)
            self.assertIsNone(row["ns_normal"])
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


class BenchRenderTest(ProgramTest):
    SMALL = ("--size", "40x20", "--spp", "3", "--depth", "4")

    def bench(self, *arguments):
        return json.loads(self.done("bench", "render", "--json", "--rounds", "2", *self.SMALL, *arguments))["rows"]

    def test_rays_are_those_of_the_renderer(self):
        rows = self.bench("cornell", "gallery", "--threads", "2", "--seed", "5")
        self.assertEqual([row["scene"] for row in rows], ["cornell", "gallery"])
        for row in rows:
            rendered = json.loads(self.done("render", row["scene"], "--json", "--seed", "5", *self.SMALL))
            self.assertEqual(row["samples"], 40 * 20 * 3)
            self.assertEqual(row["camera_rays"], row["samples"])
            rays = row["camera_rays"] + row["bounce_rays"] + row["shadow_rays"]
            self.assertEqual(rays, rendered["rays"])
            self.assertAlmostEqual(row["rays_per_sample"], rays / row["samples"])
            self.assertEqual(row["threads"], 2)
            for key in ("samples_per_cpu_second", "rays_per_cpu_second", "raw_rays_per_cpu_second", "ratio",
                        "seconds", "raw_seconds"):
                self.assertGreater(row[key], 0, key)

    def test_rays_meet_what_they_met(self):
        """In a closed box with its lamp all that is seen is met, and about half of the shadow rays pass."""
        one, two = (self.bench("cornell", "--threads", n)[0] for n in "12")
        counts = ("samples", "camera_rays", "bounce_rays", "shadow_rays", "hits")
        self.assertEqual([one[c] for c in counts], [two[c] for c in counts])
        self.assertGreater(one["hits"], one["bounce_rays"])
        self.assertLess(one["hits"], one["camera_rays"] + one["bounce_rays"] + one["shadow_rays"])

    def test_table(self):
        lines = self.done("bench", "render", "furnace", "--rounds", "1", *self.SMALL).decode().splitlines()
        self.assertEqual(lines[0].split()[:2], ["scene", "threads"])
        self.assertEqual(lines[1].split()[:2], ["furnace", "1"])

    def test_errors(self):
        self.rejected("bench", "render", "no such scene", where="no such scene")
        self.rejected("bench", "render", "--rounds", "0", where="--rounds")
        self.rejected("bench", "render", "--rounds", "1001", where="--rounds")
        self.rejected("bench", "render", "--spp", "16777217", where="--spp")
        self.rejected("bench", "render", "cornell", "--camera", "none", where="cornell")


if __name__ == "__main__":
    main()
