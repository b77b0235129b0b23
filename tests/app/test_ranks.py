"""mpirun -n N lobe render: the same file for any N; a rank that dies leaves a checkpoint. Left out where the program has no
MPI or there is no mpirun."""
import json
import os
import shutil
import signal
import subprocess
import unittest
from pathlib import Path

from program import ERROR_LINE, PROGRAM, FolderTest, main

HAS_MPI = b"MPI: none" not in subprocess.run([PROGRAM, "--version"], capture_output=True).stdout
SMALL = ["gallery", "--size", "70x40", "--spp", "40", "--aov", "albedo,rejected"]
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
               # what the MPI library keeps until the end is no leak of ours
               "ASAN_OPTIONS": "detect_leaks=0"}


def mpirun(ranks, *arguments):
    return ["mpirun", "-n", str(ranks), PROGRAM, "render", *arguments, "--threads", "1"]


def ranks_under(parent):
    """Process ids of the ranks of an mpirun, by rank."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            environment = dict(entry.split(b"=", 1) for entry in
                               (folder / "environ").read_bytes().split(b"\0") if b"=" in entry)
            fields = (folder / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if int(fields[1]) == parent and b"OMPI_COMM_WORLD_RANK" in environment:
            found[int(environment[b"OMPI_COMM_WORLD_RANK"])] = int(folder.name)
    return found


@unittest.skipUnless(HAS_MPI and shutil.which("mpirun"), "no MPI")
class RanksTest(FolderTest):
    def together(self, ranks, *arguments):
        return subprocess.run(mpirun(ranks, *arguments), capture_output=True, env=ENVIRONMENT,
                              timeout=100)

    def test_same_file_for_any_number(self):
        self.done("render", *SMALL, "-o", self.path("one.exr"))
        for ranks in (1, 2, 3):
            result = self.together(ranks, *SMALL, "-o", self.path("a.exr"), "--json")
            self.assertEqual((result.returncode, result.stderr), (0, b""))
            self.assertEqual(json.loads(result.stdout)["samples"], 70 * 40 * 40)
            self.assertEqual(self.bytes_of("a.exr"),
                             self.bytes_of("one.exr"), ranks)

    def test_several_pictures(self):
        """What is finished is finished for all ranks, and so is what fails."""
        orbit = [*SMALL[:-1], "motion", "--orbit", "3", "-o"]
        long = ["--checkpoint", self.path("c"), "--resume", self.path("c")]
        self.done("render", *orbit, self.path("one.exr"))
        for lost in ((1, 2, 3), (2,)):
            for i in lost:
                Path(self.path(f"a.000{i}.exr")).unlink(missing_ok=True)
            self.assertEqual(self.together(2, *orbit, self.path("a.exr"), *long).returncode, 0)
            for i in (1, 2, 3):
                self.assertEqual(self.bytes_of(f"a.000{i}.exr"), self.bytes_of(f"one.000{i}.exr"))
        Path(self.path("b.0002.exr")).mkdir()
        result = self.together(2, *orbit, self.path("b.exr"))
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"b.0002.exr: cannot be written", result.stderr)

    def test_noise_ends_all(self):
        for how in ([], ["--adaptive"]):
            scene = ["gallery", "--size", "70x40", "--spp", "4096", "--noise", "0.12", *how]
            self.done("render", *scene, "-o", self.path("one.exr"))
            self.assertEqual(self.together(2, *scene, "-o", self.path("a.exr")).returncode, 0)
            self.assertEqual(self.bytes_of("a.exr"), self.bytes_of("one.exr"))

    def test_one_complaint(self):
        result = self.together(3, "no-such-scene", "--json")
        lines = [line for line in result.stderr.splitlines(keepends=True) if line.startswith(b"lobe:")]
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertRegex(lines[0], rb"\A" + ERROR_LINE.pattern + rb"\Z")
        self.assertEqual(result.returncode, 2)

    def test_dead_rank_leaves_a_checkpoint(self):
        scene = ["gallery", "--size", "70x40", "--spp", "3000"]
        command = mpirun(2, *scene, "--checkpoint", self.path("c"), "--checkpoint-every", "1000",
                         "--progress", "json")
        # time to save, on a machine that is busy
        environment = {**ENVIRONMENT, "OMPI_MCA_odls_base_sigkill_timeout": "5"}
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              env=environment) as process:
            for line in process.stderr:
                if line.startswith(b"{") and json.loads(line).get("samples", 0) > 0:
                    break
            os.kill(ranks_under(process.pid)[1], signal.SIGKILL)
            process.stderr.read()
            self.assertNotEqual(process.wait(timeout=60), 0)
        saved = json.loads(self.done("merge", self.path("c"), "-o", self.path("a.exr"), "--json"))
        self.assertGreater(saved["most_samples"], 0)
        self.done("render", *scene, "--time", "0.1", "--resume", self.path("c"), "--json")


if __name__ == "__main__":
    main()
