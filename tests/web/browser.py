"""The program serving its page, and Debian's chromium looking at it."""
import os
import re
import signal
import subprocess
import time
from pathlib import Path

from playwright.sync_api import sync_playwright

PROGRAM = os.environ["LOBE_PROGRAM"]
CHROMIUM = os.environ.get("LOBE_CHROMIUM", "/usr/bin/chromium")
PICTURES = Path(os.environ["LOBE_BUILD_DIR"]) / "web-pictures"
PATIENCE = 120_000  # ms; a busy machine is no failure

PHONE = {"viewport": {"width": 390, "height": 844}, "device_scale_factor": 2, "has_touch": True,
         "is_mobile": True}
DESKTOP = {"viewport": {"width": 1280, "height": 900}}
LARGE = {"viewport": {"width": 3840, "height": 2160}}

# Reports what the content security policy refused.
WATCH = """addEventListener("securitypolicyviolation", (event) =>
    console.error(`policy: ${event.violatedDirective} ${event.blockedURI}`));"""


# Keeps what each canvas was told to draw since it was cleared, as a hash: drawn(id). How the browser smooths the edges
# of curves is its own affair, and depends on whether it paints by the processor or not.
RECORD = """const hashes = new WeakMap(), context = CanvasRenderingContext2D.prototype;
const mix = (hash, codes) => {
    for (const code of codes) hash = Math.imul(hash ^ code, 16777619);
    return hash;
};
const textOf = (x) => x instanceof HTMLCanvasElement ? String(hashes.get(x)) : String(x);
for (const [name, { value }] of Object.entries(Object.getOwnPropertyDescriptors(context)))
    if (typeof value === "function" && name !== "constructor")
        context[name] = function (...list) {
            const isWhole = name === "clearRect" || name === "putImageData";
            const before = isWhole ? 0 : hashes.get(this.canvas) ?? 0;
            const text = [name, this.fillStyle, this.strokeStyle, this.globalAlpha, ...list.map(textOf)].join();
            const hash = mix(before, [...text].map((c) => c.codePointAt(0)));
            hashes.set(this.canvas, name === "putImageData" ? mix(hash, list[0].data) : hash);
            return value.apply(this, list);
        };
window.drawn = (id) => hashes.get(document.getElementById(id)) ?? null;"""


class Served:
    """`lobe explore` on a free port."""

    def __enter__(self):
        self.program = subprocess.Popen([PROGRAM, "explore", "--port", "0", "--no-open"],
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.address = self.program.stdout.readline().decode().strip()
        if not self.address:
            raise RuntimeError(f"lobe explore does not start: {self.program.wait(60)}")
        return self

    def __exit__(self, *_):
        self.program.send_signal(signal.SIGINT)
        self.program.communicate(timeout=60)
        if self.program.returncode != 130:
            raise RuntimeError(f"lobe explore ended by itself: {self.program.returncode}")


SOFTWARE_GL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")


class Chromium:
    def __init__(self, graphics=SOFTWARE_GL):
        self.graphics = graphics

    def __enter__(self):
        self.playwright = sync_playwright().start()
        self.browser = self.playwright.chromium.launch(
            executable_path=CHROMIUM,
            args=[*self.graphics, "--enable-blink-features=ForceEagerMeasureMemory"])
        return self.browser

    def __exit__(self, *_):
        self.browser.close()
        self.playwright.stop()


def watch(page, origin):
    """The list of what goes wrong on the page, as it grows."""
    wrong = []
    page.on("console", lambda m: wrong.append(m.text) if m.type == "error" else None)
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.on("requestfailed", lambda r: wrong.append(f"failed: {r.url}"))
    page.on("response", lambda r: wrong.append(f"{r.status}: {r.url}") if r.status >= 400 else None)
    page.on("request", lambda r: wrong.append(f"elsewhere: {r.url}")
            if not re.match(rf"{re.escape(origin)}|data:|blob:", r.url) else None)
    return wrong


def wait(page, condition, argument=None):
    """Until the script, a function or an expression, says yes. (Playwright's own waiting is by eval, which the
    page's policy refuses.)"""
    end = time.monotonic() + PATIENCE / 1000
    while not page.evaluate(condition, argument):
        if time.monotonic() > end:
            raise TimeoutError(f"{condition} ({argument})")
        page.wait_for_timeout(20)


def two_frames(page):
    """What has changed is drawn after the first, and seen after the second."""
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def wait_until_ready(page):
    """Until everything is loaded and what can be seen is drawn."""
    page.wait_for_load_state("networkidle")
    wait(page, "document.getElementById('version').textContent !== ''")
    two_frames(page)
