"""How fast the page is: bytes, time to the first picture, and a trace of each view while phi changes every frame.

    LOBE_PROGRAM=build/gcc/lobe LOBE_BUILD_DIR=build/gcc tests/web/run.sh measure.py [SECONDS] [SAMPLES]

A report, not a test: what it says is of this machine. Without a graphics card Chromium's own painting is all there
is, so the frames of the plane views are measured with `--disable-gpu`, each in a window that shows little else: what
is left of a frame is then the page's work. The sphere's row says what WebGL costs a processor.
"""
import base64
import json
import statistics
import sys

from browser import Chromium, Served, wait, wait_until_ready

WINDOW = {"width": 1280, "height": 480}
VIEWS = ("sphere", "numbers", "stretched", "bound", "histogram", "grid", "picture")
SPIN = """async ([seconds]) => {
    const phi = document.getElementById("phi"), times = [], end = performance.now() + 1000 * seconds;
    for (let k = 0; performance.now() < end; ++k) {
        phi.value = k % 360 - 180;
        phi.dispatchEvent(new Event("input", { bubbles: true }));
        times.push(await new Promise((done) => requestAnimationFrame(done)));
    }
    return times;
}"""


def read_stream(probe, handle):
    text = ""
    while True:
        part = probe.send("IO.read", {"handle": handle})
        data = part["data"]
        text += base64.b64decode(data).decode() if part.get("base64Encoded") else data
        if part["eof"]:
            return json.loads(text)["traceEvents"]


def trace(page, action):
    """The events of Chromium's timeline while `action` runs, and its result."""
    probe = page.context.new_cdp_session(page)
    ended = []
    probe.on("Tracing.tracingComplete", lambda event: ended.append(event))
    probe.send("Tracing.start", {"transferMode": "ReturnAsStream", "traceConfig": {
        "includedCategories": ["devtools.timeline", "toplevel"]}})
    result = action()
    probe.send("Tracing.end")
    while not ended:
        page.wait_for_timeout(20)
    return read_stream(probe, ended[0]["stream"]), result


def frame_times(events):
    """Milliseconds of script in each animation frame, as the trace has them."""
    return [e["dur"] / 1000 for e in events if e["name"] == "FireAnimationFrame" and "dur" in e]


def measure_views(browser, address, seconds, samples):
    page = browser.new_context(viewport=WINDOW).new_page()
    page.goto(f"{address}#n={samples}&theta=60")
    wait_until_ready(page)
    print(f"each view with {samples} samples of each method, {seconds:g} s a view")
    print("view        frames/s   ms of script a frame: median   95 %   share below 16.7")
    for view in VIEWS:
        page.locator(f"#{view}").scroll_into_view_if_needed()
        page.wait_for_timeout(500)
        events, times = trace(page, lambda: page.evaluate(SPIN, [seconds]))
        spent = sorted(t for t in frame_times(events) if t > 0.05)
        rate = 1000 * (len(times) - 1) / (times[-1] - times[0])
        print(f"{view:<12}{rate:8.1f}{statistics.median(spent):31.2f}{spent[int(0.95 * len(spent))]:7.2f}"
              f"{sum(t < 16.7 for t in spent) / len(spent):11.3f}")


def measure_start(browser, address, slowdown):
    page = browser.new_context(viewport=WINDOW).new_page()
    page.context.new_cdp_session(page).send("Emulation.setCPUThrottlingRate", {"rate": slowdown})
    page.goto(address)
    wait(page, "document.getElementById('version').textContent !== ''")
    drawn = page.evaluate("new Promise((done) => requestAnimationFrame(() => setTimeout(() => done(performance.now()))))")
    paint = page.evaluate("performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? NaN")
    print(f"start, processor slowed down {slowdown} times: first paint {paint:.0f} ms, sphere drawn {drawn:.0f} ms")
    page.close()


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 5
    samples = int(sys.argv[2]) if len(sys.argv) > 2 else 10000
    with Served() as served, Chromium(["--disable-gpu"]) as browser:
        page = browser.new_context(viewport=WINDOW).new_page()
        sizes = {}  # the worker asks for the library again
        page.on("response", lambda r: sizes.update({r.url: len(r.body())}))
        page.goto(served.address)
        wait_until_ready(page)
        print(f"loaded: {len(sizes)} files, {sum(sizes.values())} bytes")
        page.close()
        for slowdown in (1, 4):
            measure_start(browser, served.address, slowdown)
        measure_views(browser, served.address, seconds, samples)


if __name__ == "__main__":
    main()
