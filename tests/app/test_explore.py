"""lobe explore: what it serves and to whom, hostile requests, ports, signals, and the page as files."""
import http.client
import os
import resource
import signal
import socket
import stat
import subprocess
import time
from pathlib import Path

from program import ERROR_LINE, PROGRAM, FolderTest, main, run

TYPES = {".html": "text/html; charset=utf-8", ".css": "text/css; charset=utf-8",
         ".js": "text/javascript; charset=utf-8", ".wasm": "application/wasm",
         ".gz": "application/gzip", ".svg": "image/svg+xml", ".png": "image/png", ".json": "application/json",
         ".webmanifest": "application/manifest+json", ".txt": "text/plain; charset=utf-8"}
HEADERS = {"X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer",
           "Cross-Origin-Opener-Policy": "same-origin",
           "Cross-Origin-Embedder-Policy": "require-corp",
           "Cross-Origin-Resource-Policy": "same-origin", "Cache-Control": "no-cache"}
POLICY = {"default-src": "'none'", "script-src": "'self' 'wasm-unsafe-eval'", "style-src": "'self'",
          "img-src": "'self' data: blob:", "font-src": "'self'", "connect-src": "'self'",
          "worker-src": "'self'", "manifest-src": "'self'", "base-uri": "'none'",
          "form-action": "'none'", "frame-ancestors": "'none'"}


def files_of(folder):
    return {p.relative_to(folder).as_posix(): p.read_bytes()
            for p in Path(folder).rglob("*") if p.is_file()}


class ServerTest(FolderTest):
    def start(self, *arguments, environment=None):
        """The program, waiting for requests; sets self.port."""
        program = subprocess.Popen([PROGRAM, "explore", *(arguments or ("--port", "0", "--no-open"))],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment)
        self.addCleanup(self.end, program)
        line = program.stdout.readline().decode()
        self.assertRegex(line, r"\Ahttp://127\.0\.0\.1:[0-9]+/\n\Z")
        self.port = int(line.split(":")[2].rstrip("/\n"))
        return program

    @staticmethod
    def end(program):
        program.kill()
        program.communicate()

    def stop(self, program, number=signal.SIGINT):
        """What it said on standard error."""
        program.send_signal(number)
        out, err = program.communicate(timeout=60)
        self.assertEqual((program.returncode, out), (130, b""))
        return err.decode()

    def ask(self, path, method="GET", **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.request(method, path, headers=headers)
        answer = connection.getresponse()
        body = answer.read()
        connection.close()
        return answer, body

    def ask_raw(self, request, is_all=False):
        """All bytes that come back until the server closes the connection; is_all: tells it that no
        more comes, so that it need not wait."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=60) as s:
            answer = b""
            try:
                s.sendall(request)
                if is_all:
                    s.shutdown(socket.SHUT_WR)
                while part := s.recv(65536):
                    answer += part
            except OSError:  # closed before all was said
                pass
            return answer

    def page(self):
        """The page's files by name."""
        folder = self.path("page")
        self.done("explore", "-o", folder)
        return files_of(folder)


class AnswerTest(ServerTest):
    def check_headers(self, answer):
        for name, value in HEADERS.items():
            self.assertEqual(answer.getheader(name), value)
        policy = dict(rule.split(" ", 1)
                      for rule in answer.getheader("Content-Security-Policy").split("; "))
        self.assertEqual(policy, POLICY)

    def test_files(self):
        page = self.page()
        self.assertIn("index.html", page)
        self.start()
        for name, content in page.items():
            for path in [f"/{name}", f"/{name}?v=1"] + ["/"] * (name == "index.html"):
                answer, body = self.ask(path)
                self.assertEqual((answer.status, body), (200, content), path)
                self.assertEqual(answer.getheader("Content-Type"), TYPES[Path(name).suffix])
                self.check_headers(answer)
                head, body = self.ask(path, "HEAD")
                self.assertEqual((head.status, body), (200, b""))
                self.assertEqual({**dict(head.getheaders()), "Date": ""},
                                 {**dict(answer.getheaders()), "Date": ""})

    def test_one_connection(self):
        """Several requests on one connection, as browsers make them."""
        page = self.page()
        self.start()
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.connect()
        here = connection.sock
        for path, content in (("/", page["index.html"]), ("/none", None), ("/", page["index.html"])):
            connection.request("GET", path)
            body = connection.getresponse().read()
            self.assertIs(connection.sock, here)
            self.assertTrue(content is None or body == content)
        connection.close()

    def test_paths(self):
        self.start()
        (self.folder / "secret").write_text("secret")
        for path in ("/none", "//", "//index.html", "/index.html/", "/./index.html", "/index%2ehtml",
                     "/..", "/../..", "/../../../../../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd",
                     "/..%2f..%2fetc%2fpasswd", "/..%5c..%5cetc", "/%00", "/index.html%00",
                     "/index.html%00.png", "//etc/passwd", f"/{self.folder}/secret",
                     f"//{self.folder}/secret", "/%", "/%zz", "/%c0%ae%c0%ae/", "/INDEX.HTML", "/\xe9",
                     "/index.html;x", "http://127.0.0.1/index.html", "*", "/proc/self/environ",
                     "/page.c", "/" + "a" * 8000, "/" + "../" * 2000):
            answer = self.ask_raw(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"
                                  .encode("latin-1"))
            self.assertRegex(answer, rb"\AHTTP/1\.1 4[0-9][0-9] ", path)
            self.assertNotIn(b"secret", answer)
            self.assertNotIn(b"root:", answer)
            if answer.startswith(b"HTTP/1.1 404"):
                self.assertIn(b"Content-Security-Policy: default-src 'none'", answer)

    def test_broken_requests(self):
        """Closed or answered with an error; the next one is served."""
        self.start()
        host = b"Host: localhost\r\n"
        for request in (b"\r\n\r\n", b"\0" * 1000 + b"\r\n\r\n", b"GET\r\n\r\n",
                        b"GET / HTTP/9.9\r\n\r\n",
                        b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n" + host + b"\r\n",
                        b"GET / HTTP/1.1\r\n" + b"X: " + b"a" * 100000 + b"\r\n\r\n",
                        b"GET / HTTP/1.1\r\n" + b"X: a\r\n" * 20000 + b"\r\n",
                        b"GET / HTTP/1.1\r\n\r\n", b"\x16\x03\x01\x02\x00" + b"\0" * 600,
                        b"GET / HTTP/1.1\r\n" + host + b"Content-Length: -1\r\n\r\n",
                        b"GET / HTTP/1.1\r\n" + host + b"Content-Length: 9" + b"9" * 40 + b"\r\n\r\n"):
            answer = self.ask_raw(request, is_all=True)
            self.assertRegex(answer, rb"\A(HTTP/1\.[01] [45]|\Z)", request[:40])
            self.assertEqual(self.ask("/")[0].status, 200)

    def test_nul(self):
        """A name ends there; what follows opens nothing."""
        page = self.page()
        self.start()
        answer = self.ask_raw(b"GET /\0/../secret HTTP/1.1\r\nHost: localhost\r\n\r\n", is_all=True)
        status, body = answer[9:12], answer.split(b"\r\n\r\n", 1)[1]
        self.assertTrue(status == b"400" or (status, body) == (b"200", page["index.html"]), answer)

    def test_methods(self):
        self.start()
        for method in ("POST", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "CONNECT", "get", "X"):
            answer, _ = self.ask("/", method)
            self.assertEqual((answer.status, answer.getheader("Allow")), (405, "GET, HEAD"), method)
            self.check_headers(answer)
        answer = self.ask_raw(b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 999999999\r\n\r\n")
        self.assertTrue(answer.startswith(b"HTTP/1.1 405"))  # and closed without reading it

    def test_body(self):
        """A GET with a body is answered; the body is not read as a request."""
        self.start()
        inner = b"GET /none HTTP/1.1\r\nHost: localhost\r\n\r\n"
        answer = self.ask_raw(b"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: %d\r\n\r\n"
                              % len(inner) + inner)
        self.assertEqual(answer.count(b"HTTP/1.1 "), 1)
        self.assertTrue(answer.startswith(b"HTTP/1.1 200"))

    def test_hosts(self):
        """A name that somebody gave this address gets nothing."""
        self.start()
        for host, status in (("localhost", 200), ("localhost:1234", 200), ("127.0.0.1", 200),
                             ("example.org", 421), ("localhost.example.org", 421), ("", 421),
                             ("127.0.0.1.example.org:80", 421), (f"[::1]:{self.port}", 421)):
            self.assertEqual(self.ask("/", Host=host)[0].status, status, host)

    def test_listener(self):
        """One socket listens, on 127.0.0.1."""
        program = self.start()
        own = set()
        for entry in Path(f"/proc/{program.pid}/fd").iterdir():
            target = os.readlink(entry)
            if target.startswith("socket:["):
                own.add(target[8:-1])
        rows = [line.split() for name in ("tcp", "tcp6", "udp", "udp6", "raw", "raw6")
                if Path(f"/proc/net/{name}").exists()
                for line in Path(f"/proc/net/{name}").read_text().splitlines()[1:]]
        # The address is written as the machine keeps a number.
        loopback = bytes([127, 0, 0, 1])
        expected = {loopback.hex().upper(), loopback[::-1].hex().upper()}
        found = [row[1].split(":") for row in rows if row[9] in own]
        self.assertEqual(len(found), 1)
        self.assertIn(found[0][0], expected)
        self.assertEqual(int(found[0][1], 16), self.port)

    def test_flood(self):
        """Silent and slow clients take no more than 64 places, and give them back."""
        program = self.start()
        clients = []
        for k in range(100):
            s = socket.create_connection(("127.0.0.1", self.port), timeout=60)
            self.addCleanup(s.close)
            clients.append(s)
            s.sendall((b"", b"GET", b"GET / HTTP/1.1\r\nHost: loc")[k % 3])
        files = lambda: len(list(Path(f"/proc/{program.pid}/fd").iterdir()))
        self.assertLessEqual(files(), 64 + 24)
        self.assertEqual(self.ask("/")[0].status, 200)  # after those before it were sent away
        self.assertEqual(clients[0].recv(1000), b"")
        self.assertLessEqual(files(), 64 + 24)
        self.stop(program)

    def test_many_requests(self):
        """Memory and files stay what they are."""
        # An instrumented build keeps what was freed; otherwise this says nothing.
        program = self.start(environment={**os.environ, "ASAN_OPTIONS": "quarantine_size_mb=1"})
        counted = lambda: (int(Path(f"/proc/{program.pid}/statm").read_text().split()[1]),
                           len(list(Path(f"/proc/{program.pid}/fd").iterdir())))
        for _ in range(100):
            self.ask("/")
        before = counted()
        for _ in range(400):
            self.ask("/")
            self.ask("/none", "PUT")
        after = counted()
        self.assertLess(after[0] - before[0], 256)  # pages of 4 kB
        self.assertLessEqual(after[1], before[1] + 2)


class RunTest(ServerTest):
    def test_taken(self):
        """The next port, and says so."""
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            s.listen()
            port = s.getsockname()[1]
            program = self.start("--port", str(port), "--no-open")
            self.assertTrue(port < self.port <= port + 32 or port + 32 > 65535)
            line = self.stop(program).splitlines()[0]
            self.assertEqual(line, f"lobe: --port: {port} is taken by another program; "
                                   f"serving on {self.port}")

    def test_last_port(self):
        with socket.socket() as s:
            s.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                s.bind(("127.0.0.1", 65535))
                s.listen()
            except OSError:  # somebody else has it: taken as well
                pass
            self.rejected("explore", "--port", "65535", "--no-open", status=(1,), where="port 65535")

    def test_free_port(self):
        """The one that was asked for, and nothing said about it."""
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            port = s.getsockname()[1]
        program = self.start("--port", str(port), "--no-open")
        if self.port == port:
            self.assertEqual(self.stop(program),
                             "Open the address in a browser; Ctrl-C ends it.\n")

    def test_signals(self):
        """Ends at once, also in the middle of answers, and leaves the port free."""
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            program = self.start()
            with socket.create_connection(("127.0.0.1", self.port), timeout=60) as s:
                s.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\nGET /")
                self.assertTrue(s.recv(1))
                if number == signal.SIGKILL:
                    self.end(program)
                else:
                    self.stop(program, number)
                port = self.port
                again = self.start("--port", str(port), "--no-open")
                self.assertEqual(self.port, port)
                self.stop(again)

    def test_closed_output(self):
        """Serves on when nobody reads what it prints."""
        program = self.start()
        program.stdout.close()
        program.stderr.close()
        self.assertEqual(self.ask("/")[0].status, 200)
        program.send_signal(signal.SIGINT)
        self.assertEqual(program.wait(timeout=60), 130)

    def browser(self, *arguments, **environment):
        """The addresses that a browser was opened with, and what was said."""
        opened = self.folder / "opened"
        tool = self.folder / "xdg-open"
        tool.write_text(f'#!/bin/sh\ntrap "" INT\necho "$@" >{opened}.part\nmv {opened}.part {opened}\n')
        tool.chmod(0o755)
        environment = {"PATH": f"{self.folder}:{os.environ['PATH']}", **environment}
        if "LSAN_OPTIONS" in os.environ:
            environment["LSAN_OPTIONS"] = os.environ["LSAN_OPTIONS"]
        program = self.start("--port", "0", *arguments, environment=environment)
        said = program.stderr.readline().decode()
        while said.startswith("Opening") and not opened.exists():
            time.sleep(0.01)
        self.stop(program)
        return opened.read_text() if opened.exists() else None, said

    def test_browser(self):
        asked, said = self.browser(DISPLAY=":9")
        self.assertEqual((asked, said), (f"http://127.0.0.1:{self.port}/\n",
                                         "Opening the browser; Ctrl-C ends it.\n"))

    def test_no_browser(self):
        for arguments, environment in ((["--no-open"], {"DISPLAY": ":9"}), ([], {}),
                                       ([], {"DISPLAY": ""})):
            self.assertEqual(self.browser(*arguments, **environment),
                             (None, "Open the address in a browser; Ctrl-C ends it.\n"))

    def test_bad_usage(self):
        for arguments, where in ((["--port", "65536"], "--port"), (["--port", "-1"], "--port"),
                                 (["--port", "http"], "--port"), (["--port", ""], "--port"),
                                 (["-o", ""], "-o"), (["x"], "x"), (["--host", "0.0.0.0"], "--host"),
                                 (["-o", "x", "--no-open"], "-o"), (["-o", "x", "--port", "1"], "-o")):
            self.rejected("explore", *arguments, where=where)


class WriteTest(ServerTest):
    def test_write(self):
        page = self.page()
        umask = os.umask(0o027)
        self.addCleanup(os.umask, umask)
        for name in ("a", "b/"):
            self.done("explore", "-o", self.path(name) + "/" * (name == "b/"))
            self.assertEqual(files_of(self.path(name)), page)
            self.assertEqual(stat.S_IMODE(os.stat(self.path(name)).st_mode), 0o750)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["a", "b", "page"])

    def test_empty_folder(self):
        (self.folder / "a").mkdir()
        self.done("explore", "-o", self.path("a"))
        self.assertIn("index.html", files_of(self.path("a")))

    def test_nothing_overwritten(self):
        (self.folder / "folder").mkdir()
        (self.folder / "folder" / "index.html").write_text("mine")
        (self.folder / "file").write_text("mine")
        (self.folder / "empty").mkdir()
        (self.folder / "link").symlink_to("empty")
        before = files_of(self.folder)
        for name in ("folder", "file", "link"):
            self.rejected("explore", "-o", self.path(name), where=self.path(name))
        self.assertEqual(files_of(self.folder), before)
        self.assertEqual(len(list(self.folder.iterdir())), 4)

    def test_unwritable(self):
        for name in ("none/x", "a" * 300, "b/" * 3000):
            self.rejected("explore", "-o", self.path(name), status=(1, 2))
        self.rejected("explore", "-o", "/proc/x", status=(1,), where="/proc/x")
        self.rejected("explore", "-o", "/", status=(1, 2), where="/")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_full_disk(self):
        """One error line and nothing left, wherever the space ends."""
        page = self.page()
        sizes = sorted({len(content) for content in page.values()})
        for limit in {0, max(sizes[0] - 1, 0), sizes[len(sizes) // 2] - 1, sizes[-1] - 1}:
            def shrink():
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
            result = subprocess.run([PROGRAM, "explore", "-o", self.path("x")], timeout=60,
                                    stderr=subprocess.PIPE, preexec_fn=shrink)
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, rb"\A" + ERROR_LINE.pattern + rb"\Z")
            self.assertEqual([p.name for p in self.folder.iterdir()], ["page"])

    def test_two_at_once(self):
        """One of them makes the folder, the other refuses."""
        page = self.page()
        runs = [subprocess.Popen([PROGRAM, "explore", "-o", self.path("x")], stderr=subprocess.PIPE)
                for _ in range(4)]
        for program in runs:
            program.communicate(timeout=60)
        self.assertEqual(sorted(program.returncode for program in runs), [0, 2, 2, 2])
        self.assertEqual(files_of(self.path("x")), page)
        self.assertEqual(len(list(self.folder.iterdir())), 2)


if __name__ == "__main__":
    main()
