"""--bsdf dielectric in sample, eval and albedo: both sides, energy, and what does not go with it."""
import json
import math

from program import ProgramTest, main, table

GLASS = ["--bsdf", "dielectric", "--fresnel", "dielectric:1.5"]
OUTSIDE = [*GLASS, "--alpha", "0.3,0.6", "--wi", "0.6,0,0.8"]
INSIDE = [*GLASS, "--alpha", "0.3,0.6", "--wi", "0.4,0.1,-0.9"]
COLUMNS = "mu,r,t,energy,furnace,all_r,all_t"


def fresnel(cosine, eta):
    """Exact, unpolarised; eta: the far side's index over the near one's."""
    squared = 1 - (1 - cosine * cosine) / (eta * eta)
    if squared <= 0:
        return 1
    t = math.sqrt(squared)
    s = (cosine - eta * t) / (cosine + eta * t)
    p = (eta * cosine - t) / (eta * cosine + t)
    return (s * s + p * p) / 2


class DielectricTest(ProgramTest):
    def test_draws_go_both_ways(self):
        for model, side in ((OUTSIDE, 1), (INSIDE, -1)):
            rows = table(self.done("sample", *model, "--count", "4000", "--precision", "f64"))
            reflected = [row for row in rows if row["pdf_o"] > 0 and row["oz"] * side > 0]
            passed = [row for row in rows if row["pdf_o"] > 0 and row["oz"] * side < 0]
            self.assertGreater(len(reflected), 100)
            self.assertGreater(len(passed), 2000)
            for row in rows:
                self.assertGreater(row["mz"] * side, 0)
                self.assertEqual(row["pdf_o"] > 0, row["weight"] > 0)
            # From outside no draw is lost.
            self.assertEqual(len(reflected) + len(passed) < len(rows), side < 0)

    def test_refraction_is_snells(self):
        for model, index in ((OUTSIDE, 1.5), (INSIDE, 1 / 1.5)):
            numbers = [float(x) for x in model[-1].split(",")]
            wi = [x / math.hypot(*numbers) for x in numbers]
            for row in table(self.done("sample", *model, "--count", "500", "--precision", "f64")):
                if row["oz"] * wi[2] > 0 or row["pdf_o"] == 0:
                    continue
                m, o = ([row[v + axis] for axis in "xyz"] for v in "mo")
                for k in range(3):
                    i, j = (k + 1) % 3, (k + 2) % 3
                    here = wi[i] * m[j] - wi[j] * m[i]
                    there = o[i] * m[j] - o[j] * m[i]
                    self.assertAlmostEqual(here + index * there, 0, delta=1e-12)

    def test_eval_agrees(self):
        for model in (OUTSIDE, INSIDE):
            for transport in ("radiance", "importance"):
                call = [*model, "--precision", "f64", "--transport", transport]
                drawn = [row for row in table(self.done("sample", *call, "--count", "300"))
                         if row["pdf_o"] > 0]
                rows = "".join(f"{r['ox']!r} {r['oy']!r} {r['oz']!r}\n" for r in drawn)
                for row, e in zip(drawn, table(self.done("eval", *call, stdin=rows.encode())),
                                  strict=True):
                    self.assertAlmostEqual(e["pdf_o"], row["pdf_o"], delta=1e-7 * row["pdf_o"])
                    self.assertAlmostEqual(e["pdf_m"], row["pdf_m"], delta=1e-7 * row["pdf_m"])
                    value = row["weight"] * row["pdf_o"]
                    self.assertAlmostEqual(e["f_cos"], value, delta=1e-7 * value)

    def test_reflection_is_that_of_the_facets(self):
        """Upward, D, G and f cos are those of --bsdf reflection with the same Fresnel."""
        for wi in ("0.6,0,0.8", "0.6,0.3,0.1"):
            model = ["--alpha", "0.3,0.6", "--wi", wi, "--fresnel", "dielectric:1.5", "--precision",
                     "f64", "--method", "caps", "--wo", "-0.3,0.2,0.6"]
            plain, = table(self.done("eval", *model))
            both, = table(self.done("eval", *model, "--bsdf", "dielectric"))
            for name in ("d", "g1_i", "g1_o", "g2", "pdf_m", "f_cos"):
                self.assertAlmostEqual(both[name], plain[name], delta=1e-12 * plain[name], msg=name)

    def test_transport_is_reciprocal(self):
        """f(i,o)/n_o^2 = f(o,i)/n_i^2 for importance; radiance shrinks by the square of the index."""
        there, back = "0.6,0,0.8", "-0.3,0.1,-0.9"
        f = {}
        for transport in ("radiance", "importance"):
            for wi, wo in ((there, back), (back, there)):
                row, = table(self.done("eval", *GLASS, "--alpha", "0.4", "--wi", wi, "--wo", wo,
                                       "--precision", "f64", "--transport", transport))
                f[transport, wi] = row["f_cos"] / abs(row["oz"])
        self.assertGreater(f["importance", there], 0)
        self.assertAlmostEqual(f["importance", there] / 2.25, f["importance", back], delta=1e-9)
        self.assertAlmostEqual(f["radiance", there] * 2.25, f["radiance", back], delta=1e-9)
        self.assertAlmostEqual(f["radiance", there] * 2.25, f["importance", there], delta=1e-9)

    def test_mean_weight_is_the_albedo(self):
        for wi, mu in (("0.8,0,0.6", "0.6"), ("0.8,0,-0.6", "-0.6"), ("0.1,0,-1", None)):
            model = [*GLASS, "--alpha", "0.5"]
            where = ["--mu", mu] if mu else ["--wi", wi]
            row, = table(self.done("albedo", *model, *where))
            side = math.copysign(1, row["mu"])
            draws = table(self.done("sample", *model, "--wi", wi, "--count", "20000", "--seed", "3"))
            for name, sign in (("r", side), ("t", -side)):
                weights = [d["weight"] if d["oz"] * sign > 0 else 0 for d in draws]
                mean = sum(weights) / len(weights)
                error = math.sqrt(sum((w - mean) ** 2 for w in weights)) / len(weights)
                self.assertAlmostEqual(mean, row[name], delta=5 * error, msg=(wi, name))

    def test_smooth_surface_in_closed_form(self):
        rows = table(self.done("albedo", *GLASS, "--alpha", "0", "--mu", "1,0.3,-0.9,-0.5"))
        for row in rows:
            eta = 1.5 if row["mu"] > 0 else 1 / 1.5
            f = fresnel(abs(row["mu"]), eta)
            self.assertAlmostEqual(row["r"], f, delta=1e-10)
            self.assertAlmostEqual(row["t"], (1 - f) / (eta * eta), delta=1e-10)
            self.assertAlmostEqual(row["energy"], 1, delta=1e-10)
        self.assertEqual(rows[3]["t"], 0)  # beyond the critical angle

    def test_furnace(self):
        for index in ("1.33", "1.5", "2.4"):
            for row in table(self.done("albedo", "--bsdf", "dielectric", "--fresnel",
                                       "dielectric:" + index, "--alpha", "0.7", "--mu",
                                       "1,0.5,0.1,-0.1,-0.5,-1", "--multiscatter", "turquin")):
                self.assertLess(row["energy"], 0.99)
                self.assertAlmostEqual(row["furnace"], 1, delta=0.01)

    def test_importance_keeps_the_sum(self):
        for row in table(self.done("albedo", *GLASS, "--alpha", "0.2", "--mu", "0.7,-0.7",
                                   "--transport", "importance")):
            self.assertAlmostEqual(row["r"] + row["t"], row["energy"], delta=1e-10)
            self.assertEqual(row["energy"], row["furnace"])

    def test_walks(self):
        """All scatterings: no light is lost, and both sides get more than of one scattering. The shares of
        the walks repeat, and from outside compensation is near them."""
        call = ["albedo", *GLASS, "--alpha", "0.8", "--mu", "0.9,0.4,-0.4,-0.9", "--transport",
                "importance"]
        walk = [*call, "--multiscatter", "walk", "--walks", "40000", "--seed", "5"]
        rows = table(self.done(*walk))
        self.assertEqual(rows, table(self.done(*walk)))
        for row, made_up in zip(rows, table(self.done(*call, "--multiscatter", "turquin")),
                                strict=True):
            error = 5 * math.sqrt(0.25 / 40000)
            self.assertAlmostEqual(row["furnace"], 1, delta=1e-12)
            self.assertAlmostEqual(row["all_r"] + row["all_t"], 1, delta=1e-12)
            self.assertGreater(row["all_r"], row["r"] - error)
            self.assertGreater(row["all_t"], row["t"] - error)
            if row["mu"] > 0:
                self.assertAlmostEqual(row["all_r"], made_up["all_r"], delta=0.02 + error)
        scaled, = table(self.done(*walk[:7], "--mu", "0.4", "--multiscatter", "walk", "--walks",
                                  "40000", "--seed", "5"))
        self.assertAlmostEqual(scaled["all_t"] * 2.25, rows[1]["all_t"], delta=1e-9)

    def test_columns_and_json(self):
        call = ["albedo", *GLASS, "--alpha", "0.2", "--mu", "0.5,-0.5"]
        text = self.done(*call)
        self.assertEqual(text.decode().splitlines()[0], COLUMNS)
        self.assertEqual([json.loads(line) for line in self.done(*call, "--json").splitlines()],
                         table(text))

    def test_contradictions(self):
        glass, model = ["--bsdf", "dielectric"], ["--alpha", "0.3", "--wi", "0,0,1"]
        for command in ("sample", "eval"):
            for fresnel_law in ([], ["--fresnel", "0.04"], ["--fresnel", "conductor:1.5,0"]):
                self.rejected(command, *model, *glass, *fresnel_law, where="--fresnel")
            self.rejected(command, *model, *GLASS, "--method", "bounded", where="--method")
            self.rejected(command, *model, *GLASS, "--geometric-normal", "0,0,1",
                          where="--geometric-normal")
            self.rejected(command, *model, *GLASS, "--floor", "0.5", where="--floor")
            self.rejected(command, *model, *GLASS, "--ndf", "beckmann")
            self.rejected(command, *model, *GLASS, "--masking", "vcavity")
            self.rejected(command, *model, "--transport", "importance", where="--transport")
            self.rejected(command, *model, "--bsdf", "metal", where="--bsdf")
            self.rejected(command, *GLASS, "--alpha", "1e300", "--wi", "0,0,1", where="--alpha")
        self.rejected("eval", *model, *GLASS, "--measure", "normal", where="--measure")
        self.rejected("eval", *model, *GLASS, "--normalization", "previous", where="--normalization")
        albedo = ["albedo", "--alpha", "0.3"]
        for law in ([], ["--fresnel", "0.04"], ["--fresnel", "dielectric:1.5/dielectric:1.6"]):
            self.rejected(*albedo, *glass, *law, where="--fresnel")
        for method in ("table", "fit", "walk"):
            self.rejected(*albedo, *GLASS, "--method", method, where="--method")
        self.rejected(*albedo, *GLASS, "--multiscatter", "kulla-conty", where="--multiscatter")
        self.rejected(*albedo, *GLASS, "--multiscatter", "walk", "--g2", "separable",
                      where="--multiscatter")
        self.rejected(*albedo, *GLASS, "--walks", "0", where="--walks")
        self.rejected(*albedo, "--transport", "radiance", where="--transport")
        self.rejected(*albedo, "--mu", "-0.5", where="--mu")
        self.rejected("albedo", *GLASS, "--alpha", "1e300", where="--alpha")


if __name__ == "__main__":
    main()
