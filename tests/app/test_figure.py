"""lobe figure: every figure in every format, its numbers against closed forms, and errors."""
import math
import os
import resource
import signal
import struct
import subprocess
import tempfile
import time
import xml.etree.ElementTree
import zlib
from pathlib import Path

from program import ERROR_LINE, PROGRAM, ProgramTest, main

COLUMNS = {
    "bound": "alpha_x,alpha_y,ix,iy,phi_deg,projected,previous,bounded,optimal",
    "stretched": "curve,phi_deg,ox,oy,oz,across,upward",
    "visible-slopes-ggx": "axis,theta_deg,slope,density,drawn",
    "visible-slopes-beckmann": "axis,theta_deg,slope,density,drawn",
    "cz-fit": "u,z_fit,z_exact,cdf_error",
    "newton": "theta_deg,u,published,ours",
    "ellipsoid": "line,u1,u2,across,upward",
    "caps": "method,ox,oy,oz,leaves",
    "masking": "theta_deg,tilt_deg,g_toward,g_away,hit_probability",
    "hit-probability": "ndf,alpha_x,alpha_y,theta_deg,hit_probability",
    "rejections": "method,theta_deg,phi_deg,alpha_x,alpha_y,rejected",
    "variance": "method,theta_deg,phi_deg,alpha_x,alpha_y,variance",
    "furnace": "alpha,theta_deg,none,kulla_conty,turquin,kulla_conty_closed_form",
    "albedo": "mu,alpha,albedo,table_error,fit_error",
    "multiscatter": "alpha,theta_deg,one,kulla_conty,turquin,walk,walk_error",
    "normal-mapped": "model,reference,previous,unbiased,least_integral",
    "ssr-passes": "pass,red,green,blue",
}
# What keeps a figure of random draws short.
SHORT = {"rejections": ["--samples", "16"], "variance": ["--samples", "16"],
         "multiscatter": ["--samples", "20"], "normal-mapped": ["--spp", "1"],
         "ssr-passes": ["--spp", "1"],
         "visible-slopes-ggx": ["--samples", "100"], "visible-slopes-beckmann": ["--samples", "100"]}
# Seconds a run; its pictures are painted as those of normal-mapped are.
SLOW = {"ssr-passes"}


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def stretch(row):
    """i_z and the z of the stretched direction."""
    iz = math.sqrt(1 - row["ix"] ** 2 - row["iy"] ** 2)
    return iz, iz / math.hypot(row["alpha_x"] * row["ix"], row["alpha_y"] * row["iy"], iz)


class FigureTest(ProgramTest):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)

    def rows(self, name, *arguments):
        table = self.path / "t.csv"
        self.done("figure", name, "--csv", table, *arguments)
        head, *lines = table.read_text().splitlines()
        self.assertEqual(head, COLUMNS[name])
        rows = [dict(zip(head.split(","), map(number, line.split(",")))) for line in lines]
        self.assertTrue(rows and all(len(row) == len(head.split(",")) for row in rows))
        return rows

    def check_png(self, data, width):
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        at, pixels = 8, b""
        while at < len(data):
            length, kind = struct.unpack(">I4s", data[at:at + 8])
            body = data[at + 8:at + 8 + length]
            self.assertEqual(struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0],
                             zlib.crc32(kind + body))
            if kind == b"IHDR":
                self.assertEqual(struct.unpack(">I", body[:4])[0], width)
            pixels += body if kind == b"IDAT" else b""
            at += 12 + length
        self.assertEqual(kind, b"IEND")
        self.assertGreater(len(set(zlib.decompress(pixels))), 20)  # not one colour

    def check_pdf(self, data):
        self.assertTrue(data.startswith(b"%PDF-") and data.rstrip().endswith(b"%%EOF"))
        start = int(data[data.rindex(b"startxref") + 9:].split()[0])
        self.assertTrue(data[start:start + 4] == b"xref")

    def test_every_figure(self):
        names = [line.split()[0] for line in self.done("figure", "--list").decode().splitlines()]
        self.assertEqual(sorted(names), sorted(COLUMNS))
        for name in names:
            with self.subTest(name):
                svg, png, pdf = (self.path / f"{name}.{e}" for e in ("svg", "PNG", "pdf"))
                short = SHORT.get(name, [])
                table = self.path / "f.csv"
                self.done("figure", name, "-o", svg, "--csv", table, *short)
                if name not in SLOW:
                    self.done("figure", name, "-o", png, "--dpi", "36", "--theme", "dark", *short)
                    self.done("figure", name, "-o", pdf, *short)
                root = xml.etree.ElementTree.parse(svg).getroot()
                self.assertTrue(root.tag.endswith("svg"))
                width = float(root.get("width").removesuffix("pt"))
                self.assertIn(width, (240, 504))  # a column or a page
                self.assertGreater(sum(1 for e in root.iter() if e.tag.endswith("use")), 10)  # text
                self.assertEqual(table.read_text().splitlines()[0], COLUMNS[name])
                if name not in SLOW:
                    self.check_png(png.read_bytes(), width / 2)
                    self.check_pdf(pdf.read_bytes())

    def test_same_bits(self):
        """The same command gives the same file."""
        for name in ("stretched", "caps"):
            paths = [self.path / f"{k}.svg" for k in range(2)]
            for path in paths:
                self.done("figure", name, "-o", path)
            self.assertEqual(paths[0].read_bytes(), paths[1].read_bytes())

    # ---- numbers ---------------------------------------------------------------------------------

    def test_bound(self):
        rows = self.rows("bound", "--optimal")
        self.assertEqual(len(rows), 4 * 361)
        for row in rows:
            ax, ay, ix, iy = (row[k] for k in ("alpha_x", "alpha_y", "ix", "iy"))
            iz, z = stretch(row)
            phi = math.radians(row["phi_deg"])
            x, y = ix + math.cos(phi), iy + math.sin(phi)
            ratio = (x * x + y * y + iz * iz) / ((x / ax) ** 2 + (y / ay) ** 2 + iz * iz)
            self.assertAlmostEqual(row["projected"], (ratio - 1) * z, delta=1e-8)
            a = min(ax, ay, 1)
            s = 1 + math.hypot(ix, iy)
            k = (1 - a * a) * s * s / (s * s + a * a * iz * iz)
            self.assertAlmostEqual(row["previous"], -z, delta=1e-8)
            self.assertAlmostEqual(row["bounded"], -k * z, delta=1e-8)
            self.assertGreater(row["projected"], row["bounded"] - 1e-8)
            self.assertGreater(row["projected"], row["optimal"] - 1e-8)
        for first in range(0, len(rows), 361):  # the optimal cap touches what it holds
            gap = min(r["projected"] - r["optimal"] for r in rows[first:first + 361])
            self.assertLess(gap, 1e-3)

    def test_bound_parameters(self):
        rows = self.rows("bound", "--alpha", "0.5,1", "--wi", "0,3,4")
        self.assertEqual(len(rows), 361)
        self.assertEqual([rows[0][k] for k in ("alpha_x", "alpha_y", "ix", "iy")], [0.5, 1, 0, 0.6])

    def test_hit_probability(self):
        for row in self.rows("hit-probability"):
            theta, a = math.radians(row["theta_deg"]), row["alpha_x"]
            x, z = math.sin(theta), math.cos(theta)
            expected = 1
            if row["theta_deg"] > 90 and row["ndf"] == "ggx":
                ax = (a * x) ** 2
                expected = 1 + (math.sqrt(ax + 9 * z * z) - math.sqrt(ax + z * z)) / (2 * z)
            elif 90 < row["theta_deg"] < 180:
                u = z / (a * x)
                expected = 1 + ((math.exp(-9 * u * u) - math.exp(-u * u)) / (2 * math.sqrt(math.pi) * u)
                                + (3 * math.erf(3 * u) - math.erf(u)) / 2)
            elif row["theta_deg"] == 180:
                expected = 0
            self.assertAlmostEqual(row["hit_probability"], expected, delta=1e-9)

    def test_rejections(self):
        for row in self.rows("rejections", "--wi", "0,0,1", "--alpha", "1"):
            mu, a = math.cos(math.radians(row["theta_deg"])), row["alpha_x"]
            if row["alpha_y"] != a:
                continue
            rejected = a * a / (1 + a * a)  # at normal incidence
            if a == 1:
                rejected = mu / (1 + mu)
            expected = {"caps": (rejected, 1e-8), "bounded": (0, 1e-8), "optimal": (0, 1e-6),
                        "horizon": (0, 0)}.get(row["method"])
            if expected is None:  # all normals, counted by 32 x 32 draws
                self.assertEqual(row["method"], "ndf")
                expected = (rejected, 0.02 if row["theta_deg"] < 1 else 1)
            self.assertAlmostEqual(row["rejected"], expected[0], delta=expected[1], msg=row)

    def test_rejections_are_those_of_the_library(self):
        """docs/optimal-caps.md: alpha = (0.2, 0.8), theta = 40, phi = 45."""
        known = {"caps": 0.784, "bounded": 0.802, "optimal": 0.916}
        rows = self.rows("rejections", "--alpha", "0.2,0.8", "--samples", "1")
        for method, accepted in known.items():
            near = sorted((abs(r["theta_deg"] - 40), r["theta_deg"], r["rejected"]) for r in rows
                          if r["method"] == method and r["alpha_x"] == 0.2 and r["alpha_y"] == 0.8)
            (_, t0, r0), (_, t1, r1) = near[:2]
            at = r0 + (40 - t0) * (r1 - r0) / (t1 - t0)
            self.assertAlmostEqual(1 - at, accepted, delta=6e-4)

    def test_variance(self):
        """alpha = 1, normal incidence: E(w^2) - E(w)^2 of caps is 3 - 4 ln 2 - (1 - ln 2)^2."""
        rows = self.rows("variance", "--alpha", "1", "--wi", "0,0,1", "--samples", "100")
        at = {r["method"]: r["variance"] for r in rows if r["alpha_x"] == 1 and r["theta_deg"] < 1}
        expected = 3 - 4 * math.log(2) - (1 - math.log(2)) ** 2
        self.assertAlmostEqual(at["caps"], expected, delta=3e-3)
        self.assertLess(at["bounded"], 0.5 * at["caps"])
        self.assertLess(at["horizon"], 0.25 * at["bounded"])

    def test_furnace(self):
        for row in self.rows("furnace"):
            mu = math.cos(math.radians(row["theta_deg"]))
            if row["alpha"] == 1:
                self.assertAlmostEqual(row["none"], 1 - mu * math.log(1 + 1 / mu), delta=1e-6)
            self.assertAlmostEqual(row["kulla_conty"], 1, delta=3e-4)
            self.assertAlmostEqual(row["turquin"], 1, delta=5e-4)
            self.assertAlmostEqual(row["kulla_conty_closed_form"], 1, delta=1.5e-3)

    def test_albedo(self):
        """Against the reference of 0.68205 at alpha = 0.5, mu = 0.8; errors as lobe/albedo.h has them."""
        rows = self.rows("albedo")
        near = sorted(rows, key=lambda r: (r["mu"] - 0.8) ** 2 + (r["alpha"] - 0.5) ** 2)[:4]
        self.assertAlmostEqual(sum(r["albedo"] for r in near) / 4, 0.68205, delta=4e-3)
        self.assertLess(max(abs(r["table_error"]) for r in rows), 1.5e-4)
        self.assertLess(max(abs(r["fit_error"]) for r in rows), 1.1e-3)
        self.assertGreater(max(abs(r["fit_error"]) for r in rows), 5e-4)

    def test_multiscatter(self):
        """All scatterings are more than one, and near Kulla & Conty."""
        for row in self.rows("multiscatter", "--samples", "500"):
            self.assertGreater(row["walk"], row["one"] - 6 * row["walk_error"])
            self.assertLess(row["one"], row["kulla_conty"])
            self.assertLess(abs(row["walk"] - row["kulla_conty"]), 0.04 + 6 * row["walk_error"])

    def test_cz_fit(self):
        rows = self.rows("cz-fit")
        for row in rows:
            u, z = row["u"], row["z_exact"]
            if u < 0.99999:
                self.assertAlmostEqual(2 / math.pi * (math.atan(z) + z / (1 + z * z)), u, delta=1e-8)
            top = u * (0.46341 + u * (-0.73369 + u * 0.27385))
            bottom = 0.597999 + u * (-1 + u * (0.309420 + u * 0.093073))
            self.assertAlmostEqual(row["z_fit"], top / bottom, delta=1e-5 * (1 + top / bottom))
        self.assertAlmostEqual(max(abs(r["cdf_error"]) for r in rows), 1.08e-3, delta=1e-5)

    def test_newton(self):
        rows = self.rows("newton")
        self.assertLess(max(r["ours"] for r in rows), 1e-14)
        worst = max(rows, key=lambda r: r["published"])
        self.assertAlmostEqual(worst["published"], 2.9e-6, delta=5e-7)
        self.assertTrue(15 < worst["theta_deg"] < 35 and worst["u"] > 0.99, worst)

    def slopes(self, name, density):
        count = 20000
        rows = self.rows(name, "--samples", str(count))
        width = 10 / 48
        for row in rows:
            if row["theta_deg"] == 0:
                expected = density(row["slope"], 2 if row["axis"] == "x" else 1)
                self.assertAlmostEqual(row["density"], expected, delta=1e-3 * expected + 1e-6)
        # Bins with 20 or more draws expected; chi^2 beyond five standard deviations: p < 1e-6.
        bins = [(count * width * r["drawn"], count * width * r["density"]) for r in rows]
        bins = [(seen, wanted) for seen, wanted in bins if wanted > 20]
        # within a bin the density bends: some per cent at most
        chi = sum((seen - wanted) ** 2 / (wanted + (0.03 * wanted) ** 2) for seen, wanted in bins)
        self.assertGreater(len(bins), 200)
        self.assertLess(abs(chi - len(bins)), 5 * math.sqrt(2 * len(bins)))

    def test_visible_slopes(self):
        self.slopes("visible-slopes-ggx", lambda s, a: a * a / (2 * (a * a + s * s) ** 1.5))
        self.slopes("visible-slopes-beckmann",
                    lambda s, a: math.exp(-(s / a) ** 2) / (math.sqrt(math.pi) * a))

    def test_stretched(self):
        rows = self.rows("stretched")
        self.assertEqual({r["curve"] for r in rows},
                         {"horizon", "previous cap", "bounded cap", "optimal cap"})
        x, z = math.sin(math.radians(40)) / math.sqrt(2), math.cos(math.radians(40))
        previous = -z / math.hypot(0.2 * x, 0.8 * x, z)
        for row in rows:
            self.assertAlmostEqual(math.hypot(row["ox"], row["oy"], row["oz"]), 1, delta=1e-8)
            self.assertLess(math.hypot(row["across"], row["upward"]), 1 + 1e-8)
            if row["curve"] == "previous cap":
                self.assertAlmostEqual(row["oz"], previous, delta=1e-8)
            else:
                self.assertGreater(row["oz"], previous)

    def test_ellipsoid(self):
        """Draws fill what is seen of the hemisphere: a half disk and a half ellipse."""
        z = 1 / math.hypot(1, 0.5 * math.tan(math.radians(65)))
        rows = self.rows("ellipsoid")
        for row in rows:
            low = -z * math.sqrt(max(0, 1 - row["across"] ** 2))
            self.assertGreater(row["upward"], low - 1e-6)
            self.assertLess(math.hypot(row["across"], row["upward"]), 1 + 1e-6)
        self.assertAlmostEqual(min(r["upward"] for r in rows), -z, delta=1e-3)

    def test_caps(self):
        z = math.cos(math.radians(60)) / math.hypot(0.5 * math.sin(math.radians(60)), 0.5)
        for method in ("caps", "bounded"):
            rows = [r for r in self.rows("caps", "--samples", "4000") if r["method"] == method]
            share = sum(r["leaves"] for r in rows) / len(rows)
            known = {"caps": 0.8388, "bounded": 0.9466}[method]
            self.assertLess(abs(share - known), 5 * math.sqrt(known * (1 - known) / 4000) + 1e-4)
            self.assertGreater(min(r["oz"] for r in rows), -z)

    def test_masking(self):
        rows = self.rows("masking")
        self.assertEqual(len(rows), 5)
        for row in rows:
            for side, column in ((1, "g_toward"), (-1, "g_away")):
                theta, tilt = math.radians(row["theta_deg"]), math.radians(row["tilt_deg"])
                cosine = math.cos(theta - side * tilt)
                g = min(1, 2 * math.cos(tilt) * abs(math.cos(theta)) / cosine) if cosine > 0 else 0
                self.assertAlmostEqual(row[column], g, delta=1e-9)

    def test_normal_mapped(self):
        rows = self.rows("normal-mapped", "--spp", "2")
        self.assertEqual(len(rows), 4)
        for row in rows:
            self.assertLess(abs(row["unbiased"] / row["reference"] - 1), 0.06, row)
            self.assertGreater(row["previous"], 1.2 * row["reference"])
            self.assertLess(row["least_integral"], 0.1)

    def test_ssr_passes(self):
        """Resolving and accumulating keep the light, composing adds to it, and real rays see no other
        light in the mean than a quarter more or less."""
        rows = {row["pass"]: row for row in self.rows("ssr-passes", "--spp", "1")}
        self.assertEqual(list(rows), ["before", "reproject", "resolve", "accumulate", "composite",
                                      "fresnel", "real"])
        for channel in ("red", "green", "blue"):
            light = {name: row[channel] for name, row in rows.items()}
            self.assertLess(abs(light["accumulate"] / light["resolve"] - 1), 0.15, channel)
            self.assertLess(light["accumulate"], light["composite"])
            self.assertLess(light["fresnel"], light["composite"])
            self.assertLess(abs(light["fresnel"] / light["real"] - 1), 0.25, channel)

    # ---- errors ----------------------------------------------------------------------------------

    def test_bad_usage(self):
        for arguments, where in (
                (["nothing", "-o", "x.svg"], "nothing"), (["", "-o", "x.svg"], "''"),
                (["bound", "-o", "x.gif"], "x.gif"), (["bound", "-o", "svg"], "svg"),
                (["bound"], "-o"), (["-o", "x.svg"], "figure"),
                (["bound", "-o", "x.svg", "--spp", "3"], "--spp"),
                (["furnace", "-o", "x.svg", "--alpha", "1"], "--alpha"),
                (["bound", "-o", "x.svg", "--alpha", "0"], "--alpha"),
                (["bound", "-o", "x.svg", "--alpha", "nan"], "--alpha"),
                (["bound", "-o", "x.svg", "--alpha", "1,2,3"], "--alpha"),
                (["bound", "-o", "x.svg", "--wi", "1,0,-1"], "--wi"),
                (["bound", "-o", "x.svg", "--wi", "0,0,0"], "--wi"),
                (["caps", "-o", "x.svg", "--samples", "0"], "--samples"),
                (["caps", "-o", "x.svg", "--samples", "100000001"], "--samples"),
                (["normal-mapped", "-o", "x.svg", "--spp", "70000"], "--spp"),
                (["bound", "-o", "x.svg", "--dpi", "1"], "--dpi"),
                (["bound", "-o", "x.svg", "--theme", "blue"], "--theme"),
                (["bound", "-o", "x.svg", "--csv", "x.svg"], "--csv")):
            self.rejected("figure", *arguments, where=where)

    def test_unwritable(self):
        missing = self.path / "none" / "x.svg"
        self.rejected("figure", "bound", "-o", missing, status=(1,), where=missing)
        folder = self.path / "d.svg"
        folder.mkdir()
        self.rejected("figure", "bound", "-o", folder, status=(1,), where=folder)

    def test_full_disk(self):
        """One error line, the older file kept, nothing half made."""
        path = self.path / "x.svg"
        path.write_text("older")
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        result = subprocess.run([PROGRAM, "figure", "bound", "-o", path], capture_output=True,
                                preexec_fn=limit, timeout=60)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")
        self.assertEqual([p.name for p in self.path.iterdir()], ["x.svg"])
        self.assertEqual(path.read_text(), "older")
        if os.path.exists("/dev/full"):
            device = self.path / "full.svg"
            device.symlink_to("/dev/full")
            self.rejected("figure", "bound", "-o", device, status=(1,), where=device)

    def test_interrupt(self):
        for name in ("multiscatter", "variance", "visible-slopes-ggx"):
            child = subprocess.Popen([PROGRAM, "figure", name, "-o", self.path / "x.svg",
                                      "--samples", "100000000", "--progress", "json"],
                                     stderr=subprocess.PIPE)
            caught = Path(f"/proc/{child.pid}/status")
            while not int(caught.read_text().split("SigCgt:")[1].split()[0], 16) & 2:
                time.sleep(0.01)  # until the program catches SIGINT
            child.send_signal(signal.SIGINT)
            child.communicate(timeout=60)
            self.assertEqual(child.returncode, 130, name)
            self.assertEqual(list(self.path.iterdir()), [])


if __name__ == "__main__":
    main()
