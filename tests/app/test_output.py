"""Where standard output goes wrong: a closed pipe ends quietly, a full disk is an error."""
import os
import signal
import subprocess
import time

from program import ERROR_LINE, MODEL, PROGRAM, ProgramTest, main

ENDLESS = [PROGRAM, "sample", *MODEL, "--count", "1000000000000"]


class OutputTest(ProgramTest):
    def test_closed_pipe(self):
        with subprocess.Popen(ENDLESS, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            self.assertTrue(process.stdout.readline().startswith(b"mx,"))
            process.stdout.close()
            self.assertEqual(process.wait(timeout=30), 0)
            self.assertEqual(process.stderr.read(), b"")

    def test_full_disk(self):
        for command in (ENDLESS, [PROGRAM, "--help"], [PROGRAM, "--version"],
                        [PROGRAM, "eval", *MODEL, "--wo", "0,0,1"],
                        [PROGRAM, "verify", "--list"]):
            with open("/dev/full", "wb") as full:
                result = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, timeout=30)
            self.assertEqual(result.returncode, 1, command)
            self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")

    def test_closed_standard_output(self):
        result = subprocess.run(["sh", "-c", '"$0" --version >&-', PROGRAM], capture_output=True,
                                timeout=30)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")

    def test_closed_standard_input(self):
        result = subprocess.run(["sh", "-c", '"$0" "$@" <&-', PROGRAM, "eval", *MODEL],
                                capture_output=True, timeout=30)
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_interrupt(self):
        """Ctrl-C leaves whole rows and status 130."""
        with subprocess.Popen(ENDLESS, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            process.stdout.read(1000)
            process.send_signal(signal.SIGINT)
            rest = process.stdout.read()
            self.assertEqual(process.wait(timeout=30), 130)
            self.assertTrue(rest.endswith(b"\n"))
            self.assertEqual(rest.splitlines()[-1].count(b","), 8)

    def test_interrupt_while_waiting_for_input(self):
        with subprocess.Popen([PROGRAM, "eval", *MODEL], stdin=subprocess.PIPE,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            process.stdin.write(b"0 0 1\n")
            process.stdin.flush()
            header, row = process.stdout.readline(), process.stdout.readline()
            self.assertTrue(header.startswith(b"ox,") and row.startswith(b"0,0,1,"))
            time.sleep(0.2)  # until it waits in read()
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=30), 130)

    def test_memory_does_not_grow(self):
        """Rows stream: a million of them leave the peak where one had it, but for noise."""
        def peak(count):
            process = subprocess.Popen([PROGRAM, "sample", *MODEL, "--format", "f32le", "--count",
                                        str(count)], stdout=subprocess.DEVNULL)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self.assertEqual(process.returncode, 0)
            return usage.ru_maxrss
        self.assertLess(peak(1000000), peak(1) + 4096)

    def test_progress(self):
        """Nothing on a pipe; lines of JSON, or a bar that is removed, when asked for."""
        arguments = ["sample", *MODEL, "--count", "3000000", "--format", "f32le", "--progress"]
        for mode, pattern in (("auto", rb"\A\Z"), ("never", rb"\A\Z"),
                              ("json", rb'\A(\{"progress":"sample",[^\n]+\}\n)*\Z'),
                              ("always", rb"\A(\r\x1b\[Ksample \[[#.]+\][^\r\n]+)*\r\x1b\[K\Z")):
            result = subprocess.run([PROGRAM, *arguments, mode], stdout=subprocess.DEVNULL,
                                    stderr=subprocess.PIPE, timeout=60)
            self.assertEqual(result.returncode, 0)
            self.assertRegex(result.stderr, pattern)


if __name__ == "__main__":
    main()
