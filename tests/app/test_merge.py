"""lobe merge: parts and seeds of lobe render."""
import array
import random

from program import ERROR_LINE, LongTest, main, run

SMALL = LongTest.SMALL


class MergeTest(LongTest):
    def merge(self, name, *sources):
        self.done("merge", *map(self.path, sources), "-o", self.path(name))
        return self.bytes_of(name)

    def test_parts_are_the_whole(self):
        """As pictures, as checkpoints, mixed, in any order, and gone on with."""
        aov = ("--aov", "albedo,normal,depth,rejected,vndf-integral")
        whole = self.render("whole.exr", *aov)
        for k in (1, 2, 3):
            self.render(f"{k}.exr", *aov, "--part", f"{k}/3", "--checkpoint", self.path(f"{k}"))
        for sources in (("1.exr", "2.exr", "3.exr"), ("3", "1", "2"), ("2", "3.exr", "1")):
            self.assertEqual(self.merge("a.exr", *sources), whole, sources)
        self.merge("some.checkpoint", "3", "1")
        self.assertEqual(self.render("b.exr", *aov, "--resume", self.path("some.checkpoint")), whole)
        self.assertNotEqual(self.merge("c.exr", "1.exr", "2.exr"), whole)
        self.assertIn(b"samples.Y", self.bytes_of("c.exr"))
        self.assertEqual(self.merge("d.exr", "c.exr", "3.exr"), whole)

    def test_more_parts_than_tiles(self):
        whole = self.render("whole.exr")
        for k in range(1, 9):  # 6 tiles
            self.done("render", *SMALL, "--part", f"{k}/8", "--checkpoint", self.path(f"{k}"))
        self.assertEqual(self.merge("a.exr", *map(str, range(1, 9))), whole)

    def means(self, name):
        """The numbers of a little-endian .pfm."""
        numbers = array.array("f")
        numbers.frombytes(self.bytes_of(name).split(b"\n", 3)[3])
        return numbers

    def test_seeds_are_averaged_by_samples(self):
        """The mean of 20 and 60 samples; checkpoints keep the sums."""
        for name, seed, spp in (("a", "1", "20"), ("b", "2", "60")):
            self.done("render", *SMALL[:3], "--spp", spp, "--seed", seed, "-o",
                      self.path(name + ".pfm"), "--checkpoint", self.path(name))
        self.merge("m.pfm", "a", "b")
        a, b, m = (self.means(name + ".pfm") for name in "abm")
        self.assertEqual(len(m), 40 * 24 * 3)
        for x, y, z in zip(a, b, m):
            self.assertAlmostEqual((x + 3 * y) / 4, z, delta=1e-6 * (1 + z))
        self.merge("n.pfm", "b", "a")
        self.assertEqual(self.bytes_of("m.pfm"), self.bytes_of("n.pfm"))

    def test_adaptive_seeds(self):
        """Averaged by the samples that were asked for, not by those that the noise took; as pictures and checkpoints."""
        scene = [*SMALL[:3], "--adaptive"]
        for name, seed, spp in (("a", "1", "64"), ("b", "2", "192")):
            self.done("render", *scene, "--spp", spp, "--seed", seed, "-o",
                      self.path(name + ".exr"), "--checkpoint", self.path(name))
            self.done("merge", self.path(name), "-o", self.path(name + ".pfm"))
        self.assertIn(b"weights.Y", self.bytes_of("a.exr"))
        self.merge("m.pfm", "a", "b")
        a, b, m = (self.means(name + ".pfm") for name in "abm")
        for x, y, z in zip(a, b, m):
            self.assertAlmostEqual((x + 3 * y) / 4, z, delta=1e-6 * (1 + z))
        self.merge("n.pfm", "b.exr", "a.exr")
        for x, y in zip(m, self.means("n.pfm")):
            self.assertAlmostEqual(x, y, delta=1e-3 * (1 + x))  # of halves
        self.merge("one.checkpoint", "a")
        self.assertEqual(self.bytes_of("one.checkpoint")[3000:-16], self.bytes_of("a")[3000:-16])
        self.merge("two.checkpoint", "a", "b")
        self.render("even.exr", "--seed", "3")
        self.rejected("render", *scene, "--spp", "64", "--json", "--resume",
                      self.path("two.checkpoint"))
        error = self.rejected("merge", self.path("a"), self.path("even.exr"), "-o",
                              self.path("x.exr")).stderr
        self.assertIn(b"its adaptive is none, that of", error)

    def test_refused(self):
        one = self.render("1.exr", "--checkpoint", self.path("1"))
        self.render("2.exr", "--seed", "2")
        self.render("deep.exr", "--seed", "3", "--depth", "3")
        self.render("bright.exr", "--seed", "4", "--exposure", "1")
        self.render("part.exr", "--part", "1/2")
        self.done("render", *SMALL[:1], "--size", "41x24", "--seed", "5", "-o", self.path("wide.exr"))
        self.done("render", "gallery", *SMALL[1:], "--seed", "6", "-o", self.path("other.exr"))
        self.done("render", *SMALL[:3], "--spp", "8", "--part", "2/2", "-o", self.path("8.exr"))
        self.render("plain.pfm")
        self.merge("12.exr", "1.exr", "2.exr")
        for names, what in ((("1.exr", "1.exr"), "seed 0"), (("1", "1.exr"), "seed 0"),
                            (("12.exr", "2.exr"), "seed 2"), (("1.exr", "part.exr"), "seed 0"),
                            (("1.exr", "deep.exr"), "its depth is 3"), (("part.exr", "8.exr"), "spp 8"),
                            (("1.exr", "bright.exr"), "its exposure is 1"),
                            (("1.exr", "wide.exr"), "its size is 41x24"),
                            (("1.exr", "other.exr"), "its triangles is"),
                            (("1.exr", "plain.pfm"), "not a checkpoint"), (("none",), "")):
            paths = [self.path(name) for name in names]
            error = self.rejected("merge", *paths, "-o", self.path("x.exr"), where=paths[-1]).stderr
            self.assertIn(what.encode(), error)
        self.rejected("merge", self.path("1.exr"), "-o", self.path("x.checkpoint"))
        self.rejected("merge", "-o", self.path("x.exr"), where="merge")
        self.rejected("merge", self.path("1.exr"), where="-o")
        self.rejected("merge", self.path("1.exr"), "-o", self.path("x.jpg"))
        self.assertFalse((self.folder / "x.exr").exists())
        self.assertEqual(self.bytes_of("1.exr"), one)

    def test_broken_pictures(self):
        """Cut or changed anywhere: refused in one line, or a picture; never a crash."""
        good = self.render("good.exr", "--aov", "rejected")
        generator = random.Random(7)
        for case in range(30):
            bad = bytearray(good[:generator.randrange(len(good))] if case % 2 else good)
            for _ in range(generator.randrange(1, 4)):
                bad[generator.randrange(min(len(bad), 1500))] = generator.randrange(256) if bad else 0
            (self.folder / "bad.exr").write_bytes(bad)
            result = run("merge", self.path("bad.exr"), "-o", self.path("x.exr"))
            self.assertIn(result.returncode, (0, 1, 2), case)
            if result.returncode:
                self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z", case)


if __name__ == "__main__":
    main()
