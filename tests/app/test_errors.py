"""Bad usage: status 2 and one line that names the option."""

from program import MODEL, ProgramTest, main

BAD_VALUES = {
    "--alpha": ["-1", "-0.1,0.3", "0.3,-0.1", "nan", "inf", "-inf", "", "a", "0.3,", ",0.3",
                "0.3,0.3,0.3", "1e999", "0x1p3", "0.3 ", " 0.3", "1e39", "9" * 5000],
    "--wi": ["0,0,0", "0,0", "0,0,0,1", "0,0,-1", "nan,0,1", "0,inf,1", "", "z", "0;0;1", "1e999,0,1"],
    "--floor": ["-0.1", "1.1", "nan", "inf", "x", "0,1", ""],
    "--geometric-normal": ["0,0,0", "1,0", "nan,0,1", "0,0,-1", ""],
    "--method": ["", "newton", "OPTIMAL", "optimal ", "best"],
    "--ndf": ["phong", ""],
    "--masking": ["v-cavity", ""],
    "--precision": ["f16", "32", ""],
    "--g2": ["none", ""],
    "--fresnel": ["", "2", "-0.1", "nan", "f82:", "f82:0.5", "f82:0.5,2", "dielectric:0",
                  "dielectric:1,2", "conductor:1", "conductor:0,1", "glass", "dielectric:"],
}
BAD_SAMPLE_VALUES = {
    "--count": ["0", "-1", "1.5", "1e3", "", "x", "1000000000000001", "99999999999999999999"],
    "--seed": ["-1", "0x10", "", "18446744073709551616", "1.0"],
    "--format": ["", "json", "CSV"],
    "--progress": ["", "yes"],
    "--random": [""],
}


class ErrorTest(ProgramTest):
    def test_command_line(self):
        self.rejected(where="command line")
        self.rejected("smaple", where="smaple")
        self.rejected("", where="''")
        self.rejected("-h")
        self.rejected("--nonsense")
        self.rejected("sample\n\x1b[31m")
        self.rejected("x" * 100000)

    def test_model_values(self):
        for command in ("sample", "eval"):
            for option, values in BAD_VALUES.items():
                required = [] if option in MODEL else MODEL
                if option in MODEL:
                    at = MODEL.index(option)
                    required = MODEL[:at] + MODEL[at + 2:]
                for value in values:
                    self.rejected(command, *required, option, value, where=option)

    def test_floor_goes_with_horizon(self):
        for command in ("sample", "eval"):
            self.rejected(command, *MODEL, "--method", "caps", "--floor", "0.1", where="--floor")
            self.rejected(command, *MODEL, "--ndf", "beckmann", "--floor", "0.1", where="--floor")
        self.rejected("render", "furnace", "--json", "--method", "bounded", "--floor", "0.1",
                      where="--floor")

    def test_sample_values(self):
        for option, values in BAD_SAMPLE_VALUES.items():
            for value in values:
                self.rejected("sample", *MODEL, f"{option}={value}", where=option)

    def test_required_options(self):
        for command in ("sample", "eval"):
            self.rejected(command, "--wi", "0,0,1", where="--alpha")
            self.rejected(command, "--alpha", "0.3", where="--wi")

    def test_shape(self):
        self.rejected("sample", *MODEL, "--count", where="--count")
        self.rejected("sample", *MODEL, "--count", "1", "--count", "1", where="--count")
        self.rejected("sample", *MODEL, "--json=1", where="--json")
        self.rejected("sample", *MODEL, "--json", "--format=csv", where="--json")
        self.rejected("sample", *MODEL, "more", where="more")
        self.rejected("sample", *MODEL, "--", "--count", where="--count")
        self.rejected("sample", *MODEL, "--" + "y" * 5000)

    def test_a_slip_is_understood(self):
        error = self.rejected("sample", *MODEL, "--cuont", "3", where="--cuont").stderr
        self.assertIn(b"did you mean --count?", error)
        self.assertIn(b"did you mean sample?", self.rejected("smaple").stderr)


if __name__ == "__main__":
    main()
