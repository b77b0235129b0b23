"""lobe albedo: closed forms, the methods against each other, the furnace, and bad input."""
import json
import math

from program import ProgramTest, main, table

COLUMNS = "mu,e,e_avg,f_avg,f_ms,furnace"


class AlbedoTest(ProgramTest):
    def rows(self, *arguments):
        return table(self.done("albedo", *arguments))

    def test_columns_and_rows(self):
        lines = self.done("albedo", "--alpha", "0.3").decode().splitlines()
        self.assertEqual(lines[0], COLUMNS)
        self.assertEqual([float(line.split(",")[0]) for line in lines[1:]],
                         [k / 10 for k in range(1, 11)])

    def test_roughness_one_in_closed_form(self):
        for row in self.rows("--alpha", "1", "--mu", "0.001,0.3,1"):
            mu = row["mu"]
            self.assertAlmostEqual(row["e"], 1 - mu * math.log(1 + 1 / mu), delta=1e-8)
            self.assertAlmostEqual(row["e_avg"], 4 / 3 * (1 - math.log(2)), delta=1e-8)
            self.assertEqual((row["f_avg"], row["furnace"]), (1, row["e"]))
        for row in self.rows("--alpha", "1", "--g2", "separable", "--mu", "0.4"):
            self.assertAlmostEqual(row["e"], 2 * (1 - math.log(2)) / 1.4, delta=1e-8)

    def test_methods_agree(self):
        for model in (["--alpha", "0.4"], ["--alpha", "0.4", "--g2", "separable"],
                      ["--alpha", "0.4", "--ndf", "beckmann"]):
            truth = self.rows(*model)
            for method, room in (("table", 1e-4), ("fit", 2e-3)):
                for row, true in zip(self.rows(*model, "--method", method), truth):
                    self.assertAlmostEqual(row["e"], true["e"], delta=room)
                    self.assertAlmostEqual(row["e_avg"], true["e_avg"], delta=room)

    def test_white_furnace(self):
        for compensation in ("kulla-conty", "turquin"):
            for method, room in (("quadrature", 1e-7), ("table", 1e-3), ("fit", 1e-2)):
                for alpha in ("0.001", "0.1", "1"):
                    for row in self.rows("--alpha", alpha, "--mu", "0.001,0.03,1", "--method", method,
                                         "--multiscatter", compensation):
                        self.assertAlmostEqual(row["furnace"], 1, delta=room)
        for row in self.rows("--alpha", "0.8", "--multiscatter", "walk", "--walks", "1000"):
            self.assertEqual(row["furnace"], 1)

    def test_fresnel(self):
        """F multiplies what is scattered once; Hill's colour of the rest."""
        row, = self.rows("--alpha", "0.5", "--mu", "0.5", "--fresnel", "0.5", "--multiscatter",
                         "kulla-conty")
        f = 0.5 + 0.5 / 21
        self.assertAlmostEqual(row["f_avg"], f, delta=1e-12)
        f_ms = f * f * row["e_avg"] / (1 - f * (1 - row["e_avg"]))
        self.assertAlmostEqual(row["f_ms"], f_ms, delta=1e-12)
        bare, = self.rows("--alpha", "0.5", "--mu", "0.5", "--fresnel", "0.5")
        self.assertAlmostEqual(row["furnace"], bare["furnace"] + f_ms * (1 - row["e"]), delta=1e-9)

    def test_wavelengths(self):
        gold = ["conductor:0.17,3.4", "conductor:0.42,2.35", "conductor:1.37,1.77"]
        rows = self.rows("--alpha", "0.3", "--mu", "0.2,0.9", "--fresnel", "/".join(gold))
        alone = [self.rows("--alpha", "0.3", "--mu", "0.2,0.9", "--fresnel", one) for one in gold]
        self.assertEqual(rows, [alone[k][i] for i in range(2) for k in range(3)])

    def test_walks_are_what_is_approximated(self):
        """Both approximations are within a few percent of the walks, whose colour is reported."""
        for ndf in ("ggx", "beckmann"):
            model = ["--ndf", ndf, "--alpha", "0.4", "--mu", "0.5", "--fresnel", "0.5"]
            walked, = self.rows(*model, "--multiscatter", "walk", "--walks", "100000")
            for compensation in ("kulla-conty", "turquin"):
                row, = self.rows(*model, "--multiscatter", compensation)
                self.assertAlmostEqual(row["furnace"], walked["furnace"], delta=0.02)
            bare, = self.rows(*model)
            self.assertAlmostEqual(walked["furnace"],
                                   bare["furnace"] + walked["f_ms"] * (1 - walked["e"]), delta=1e-9)

    def test_walks_repeat(self):
        call = ["albedo", "--alpha", "0.5", "--mu", "0.5", "--fresnel", "0.3", "--multiscatter",
                "walk", "--walks", "5000"]
        self.assertEqual(self.done(*call, "--seed", "2"), self.done(*call, "--seed", "2"))
        self.assertNotEqual(self.done(*call, "--seed", "2"), self.done(*call, "--seed", "3"))

    def test_one_direction(self):
        row, = self.rows("--alpha", "0.3,0.6", "--wi", "0,3,4")
        self.assertAlmostEqual(row["mu"], 0.8)
        other, = self.rows("--alpha", "0.6,0.3", "--mu", "0.8")
        self.assertAlmostEqual(row["e"], other["e"], delta=1e-6)

    def test_geometric_surface(self):
        """Less leaves; as much as is drawn."""
        model = ["--alpha", "0.3,0.6", "--wi", "0.6,0,0.8", "--fresnel", "0.04"]
        plane = ["--geometric-normal", "0.3,0.2,1"]
        (whole,), (cut,) = self.rows(*model), self.rows(*model, *plane)
        self.assertLess(cut["e"], whole["e"] - 0.02)
        self.assertEqual(cut["e_avg"], whole["e_avg"])
        for method in ("caps", "horizon"):
            drawn, = self.rows(*model, *plane, "--method", method)
            self.assertAlmostEqual(drawn["e"], cut["e"], delta=0.008)
            self.assertAlmostEqual(drawn["furnace"], cut["furnace"], delta=0.0004)

    def test_draws_are_those_of_sample(self):
        model = ["--alpha", "0.3,0.6", "--wi", "0.6,0,0.8", "--method", "horizon", "--floor", "0.5"]
        row, = self.rows(*model, "--samples", "5000", "--seed", "3")
        draws = table(self.done("sample", *model, "--count", "5000", "--seed", "3", "--precision",
                                "f64"))
        self.assertAlmostEqual(row["e"], sum(d["weight"] for d in draws) / 5000, delta=1e-12)

    def test_shadowing_followed_needs_fewer_draws(self):
        """Floor 0 against caps: some hundred times less variance, so a tenth of the error."""
        model, samples = ["--alpha", "0.5"], ["--samples", "20000"]
        true = self.rows(*model)
        errors = [sum(abs(row["e"] - exact["e"])
                      for row, exact in zip(self.rows(*model, *method, *samples), true))
                  for method in (["--method", "caps"], ["--method", "horizon", "--floor", "0"])]
        self.assertLess(errors[1], errors[0] / 3)

    def test_json(self):
        lines = self.done("albedo", "--alpha", "0.3", "--json").decode().splitlines()
        self.assertEqual([json.loads(line) for line in lines], self.rows("--alpha", "0.3"))

    def test_mirror(self):
        for method in ("quadrature", "table"):
            row, = self.rows("--alpha", "0", "--mu", "0.5", "--method", method, "--fresnel", "0.2",
                             "--multiscatter", "kulla-conty")
            self.assertEqual((row["e"], row["e_avg"]), (1, 1))
            self.assertAlmostEqual(row["furnace"], 0.2 + 0.8 / 32)

    def test_errors(self):
        self.rejected("albedo", where="--alpha")
        for bad in ("0", "-0.5", "1.1", "nan", "", "0.5,", "0.5,2", ",".join(["0.5"] * 257)):
            self.rejected("albedo", "--alpha", "0.3", "--mu", bad, where="--mu")
        for bad in ("-1", "nan", "inf", "1,2,3", ""):
            self.rejected("albedo", "--alpha", bad, where="--alpha")
        self.rejected("albedo", "--alpha", "1e300", where="--alpha")
        self.rejected("albedo", "--alpha", "0.3", "--wi", "1,0,-1", where="--wi")
        self.rejected("albedo", "--alpha", "0.3", "--wi", "1,0,0", where="--wi")
        self.rejected("albedo", "--alpha", "0.3", "--wi", "0,0,1", "--mu", "1", where="--wi")
        self.rejected("albedo", "--alpha", "0.3,0.4", "--method", "fit", where="--method")
        self.rejected("albedo", "--alpha", "1.5", "--method", "fit", where="--method")
        self.rejected("albedo", "--alpha", "2.5", "--method", "table", where="--method")
        for model in (["--g2", "separable"], ["--masking", "vcavity"]):
            self.rejected("albedo", "--alpha", "0.3", *model, "--multiscatter", "walk",
                          where="--multiscatter")
        self.rejected("albedo", "--alpha", "0.3", "--masking", "vcavity", "--method", "fit",
                      where="--method")
        for bad in ("0", "1000000001", "-1", "x"):
            self.rejected("albedo", "--alpha", "0.3", "--walks", bad, where="--walks")
        for bad in ("2", "conductor:1", "0.5/", "/", "/".join(["0.5"] * 17), "x" * 200):
            self.rejected("albedo", "--alpha", "0.3", "--fresnel", bad, where="--fresnel")
        self.rejected("albedo", "--alpha", "0.3", "--json", "--format", "csv", where="--json")
        self.rejected("albedo", "--alpha", "0.3", "--method", "guess", where="--method")
        self.rejected("albedo", "--alpha", "0.3", "--method", "newton", where="--method")
        for bad in ("0", "1000000001"):
            self.rejected("albedo", "--alpha", "0.3", "--method", "caps", "--samples", bad,
                          where="--samples")
        self.rejected("albedo", "--alpha", "0.3", "--samples", "10", where="--samples")
        for method in ("quadrature", "caps"):
            self.rejected("albedo", "--alpha", "0.3", "--method", method, "--floor", "0",
                          where="--floor")
        plane = ["--geometric-normal", "0.1,0,1"]
        self.rejected("albedo", "--alpha", "0.3", "--geometric-normal=-1,0,0.1", "--mu", "0.5",
                      where="--geometric-normal")
        self.rejected("albedo", "--alpha", "0.3", *plane, "--method", "table",
                      where="--geometric-normal")
        self.rejected("albedo", "--alpha", "0.3", *plane, "--multiscatter", "turquin",
                      where="--multiscatter")
        self.rejected("albedo", "--alpha", "0.3", *plane, "--bsdf", "dielectric", "--fresnel",
                      "dielectric:1.5", where="--geometric-normal")


if __name__ == "__main__":
    main()
