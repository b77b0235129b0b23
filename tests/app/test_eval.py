"""lobe eval: a row for each row, in order."""
import json
import math

from program import MODEL, ProgramTest, main, table

DIRECTION = "ox,oy,oz,d,g1_i,g1_o,g2,pdf_m,pdf_o,f_cos"
NORMAL = "mx,my,mz,d,g1_i,pdf_m,pdf_o"


class EvalTest(ProgramTest):
    def test_columns(self):
        self.assertEqual(self.done("eval", *MODEL).decode(), DIRECTION + "\n")
        self.assertEqual(self.done("eval", *MODEL, "--measure", "normal").decode(), NORMAL + "\n")

    def test_one_direction_is_one_row(self):
        self.assertEqual(self.done("eval", *MODEL, "--wo", "0,3,4"),
                         self.done("eval", *MODEL, stdin=b"0 3 4\n"))

    def test_own_output_is_input(self):
        """A table without the further columns reads back to the same rows."""
        first = self.done("eval", *MODEL, stdin=b"0 0 1\n0.3 0.2 5\n-1 1e-3 0.01\n")
        cut = b"".join(b",".join(line.split(b",")[:3]) + b"\n" for line in first.splitlines())
        self.assertEqual(self.done("eval", *MODEL, stdin=cut), first)

    def test_normal_incidence_in_closed_form(self):
        alpha = 0.3
        row = table(self.done("eval", "--alpha", str(alpha), "--wi", "0,0,1", "--wo", "0,0,1",
                              "--method", "ellipsoid", "--precision", "f64"))[0]
        d = 1 / (math.pi * alpha * alpha)
        for name, value in (("d", d), ("g1_i", 1), ("g1_o", 1), ("g2", 1), ("pdf_m", d),
                            ("pdf_o", d / 4), ("f_cos", d / 4)):
            self.assertAlmostEqual(row[name], value, delta=1e-13 * value, msg=name)

    def test_below_the_surface_is_zero(self):
        row = table(self.done("eval", *MODEL, "--wo", "0.6,0,-0.8"))[0]
        self.assertEqual((row["pdf_o"], row["f_cos"], row["g2"]), (0, 0, 0))

    def test_normalization(self):
        """From behind the surface the previous densities are not the unbiased ones; before, they are."""
        def densities(wi, name):
            return self.done("eval", "--alpha", "0.5", "--wi", wi, "--wo", "-0.5,0.1,0.6",
                             "--method", "ellipsoid", "--normalization", name)
        self.assertNotEqual(densities("0.6,0,-0.3", "unbiased"), densities("0.6,0,-0.3", "previous"))
        self.assertEqual(densities("0.6,0,0.3", "unbiased"), densities("0.6,0,0.3", "previous"))

    def test_json(self):
        rows = b"0 0 1\n1 2 3\n"
        lines = self.done("eval", *MODEL, "--json", stdin=rows).decode().splitlines()
        self.assertEqual([json.loads(line) for line in lines],
                         table(self.done("eval", *MODEL, stdin=rows)))

    def test_rows_before_a_bad_one_are_written(self):
        result = self.rejected("eval", *MODEL, stdin=b"0 0 1\n1 1 1\n0 0 0\n",
                               where="standard input:3")
        self.assertEqual(len(table(result.stdout)), 2)

    def test_bad_rows(self):
        for row in (b"0 0 0", b"1 2", b"1 2 3 4", b"x y z", b"nan 0 1", b"0 0 inf", b"\xff\xfe\n",
                    b"1 2 3\0", b"1,,2,3", b"ox,oy,oz"):
            self.rejected("eval", *MODEL, stdin=b"0 0 1\n" + row, where="standard input:2")

    def test_contradictions(self):
        self.rejected("eval", *MODEL, "--wo", "0,0,1", "--measure", "normal", where="--wo")
        self.rejected("eval", *MODEL, "--json", "--format", "csv", where="--json")


if __name__ == "__main__":
    main()
