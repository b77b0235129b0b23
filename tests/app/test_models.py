"""Every distribution, masking and method that go together, in every command; and those that do not."""
import itertools
import json

from program import MODEL, ProgramTest, main

EXIST = {
    ("ggx", "smith"): ["ndf", "slope-published", "slope", "ellipsoid", "caps", "bounded", "optimal",
                       "horizon-mirror", "horizon-exact", "horizon-uniform", "horizon"],
    ("beckmann", "smith"): ["ndf", "slope", "newton-published", "newton", "horizon"],
    ("ggx", "vcavity"): ["ndf", "vcavity", "vcavity-valid"],
    ("beckmann", "vcavity"): ["ndf", "vcavity", "vcavity-valid"],
}
METHODS = sorted(set(itertools.chain(*EXIST.values())))


def surface(ndf, masking):
    return ["--ndf", ndf, "--masking", masking]


class ModelsTest(ProgramTest):
    def combinations(self):
        for (ndf, masking), methods in EXIST.items():
            for method in methods:
                yield [*surface(ndf, masking), "--method", method]

    def test_sample_and_eval(self):
        for options in self.combinations():
            for precision in ("f32", "f64"):
                model = [*MODEL, *options, "--precision", precision]
                draws = self.done("sample", *model, "--count", "20", "--format", "ndjson")
                rows = [json.loads(line) for line in draws.decode().splitlines()]
                self.assertEqual(len(rows), 20)
                kept = [row for row in rows if row["pdf_o"] > 0]
                self.assertGreater(len(kept), 5)
                text = "\n".join(f"{r['ox']!r} {r['oy']!r} {r['oz']!r}" for r in kept)
                lines = self.done("eval", *model, stdin=text.encode()).decode().splitlines()
                self.assertEqual(len(lines), 1 + len(kept))
                for row, line in zip(kept, lines[1:]):
                    pdf, f_cos = (float(number) for number in line.split(",")[-2:])
                    self.assertAlmostEqual(pdf / row["pdf_o"], 1, delta=1e-2)
                    self.assertAlmostEqual(f_cos / pdf, row["weight"], delta=1e-2)

    def test_the_best_is_the_last(self):
        for (ndf, masking), methods in EXIST.items():
            best = self.done("sample", *MODEL, *surface(ndf, masking), "--count", "5")
            named = self.done("sample", *MODEL, *surface(ndf, masking), "--method", methods[-1],
                              "--count", "5")
            self.assertEqual(best, named)

    def test_verify_and_bench(self):
        everything = self.done("verify", "--list").decode()
        for (ndf, masking), methods in EXIST.items():
            name = " ".join(word for word in (ndf, masking) if word not in ("ggx", "smith"))
            for method in methods:
                for precision in ("f32", "f64"):
                    self.assertIn(f"\n{f'{name} {method}'.strip()} {precision} alpha=",
                                  "\n" + everything)
            only = f"{ndf} {masking} {methods[-1]} call f32 shared"
            rows = json.loads(self.done("bench", "--quick", "--json", "--only", only))["rows"]
            self.assertEqual([(r["ndf"], r["masking"], r["method"]) for r in rows],
                             [(ndf, masking, methods[-1])])

    def test_render(self):
        for options in self.combinations():
            self.done("render", "normal-mapped", "--size", "16x16", "--spp", "1", "--json", *options)
        for (ndf, masking), methods in EXIST.items():
            said = json.loads(self.done("render", "furnace", "--size", "8x8", "--spp", "1", "--json",
                                        *surface(ndf, masking)))
            usual = "by surface" if (ndf, masking) == ("ggx", "smith") else methods[-1]
            self.assertEqual(said["method"], usual)

    def test_others_are_refused(self):
        for (ndf, masking), methods in EXIST.items():
            for method in METHODS:
                if method in methods:
                    continue
                for command in (["sample", *MODEL], ["render", "furnace", "--json"]):
                    error = self.rejected(*command, *surface(ndf, masking), "--method", method,
                                          where="--method").stderr.decode()
                    self.assertTrue(error.endswith(f"; those that do are {', '.join(methods)}\n"),
                                    error)


if __name__ == "__main__":
    main()
