"""The page in a browser: every control, drag, keys, links, sizes, themes, accessibility, and what it must not do."""
import functools
import http.server
import json
import os
import random
import re
import subprocess
import tempfile
import threading
import time
import unittest

from axe_playwright_python.sync_playwright import Axe

from browser import (DESKTOP, LARGE, PATIENCE, PHONE, PICTURES, PROGRAM, RECORD, WATCH, Chromium, Served, two_frames,
                     wait, wait_until_ready, watch)

# What each range, number, list and box does to the address: (value to give, what the address then says).
CONTROLS = {
    "alpha-x": ("500", r"ax=0\.158"), "alpha-x-value": ("0.7", r"ax=0\.7"),
    "alpha-y": ("200", r"ay=0\.0302"), "alpha-y-value": ("2.5", r"ay=2\.5"),
    "theta": ("30", r"theta=30"), "theta-value": ("123.4", r"theta=123\.4"),
    "phi": ("-90", r"phi=-90"), "phi-value": ("12.5", r"phi=12\.5"),
    "ndf": ("beckmann", r"ndf=beckmann"), "masking": ("vcavity", r"masking=vcavity"),
    "method-a": ("ellipsoid", r"a=ellipsoid"), "method-b": ("bounded", r"b=bounded"),
    "samples": ("8", r"n=256"), "pattern": ("sobol", r"u=sobol"), "spp": ("16", r"spp=16"),
    "split": ("25", r"split=25"),
}
BUTTONS = {"seed": r"seed=2", "show-a": r"show=a", "show-b": r"show=b", "code-b": r"code=b",
           "code-glsl": r"lang=glsl", "code-hlsl": r"lang=hlsl", "theme": r"theme=dark",
           "tour-start": r"tour=1"}
# Tested by name elsewhere in this file.
ELSEWHERE = {"direction", "link-alpha", "normal", "normal-theta", "normal-phi", "show-both", "code-a",
             "code-c", "copy", "to-code", "tour-back", "tour-next", "tour-end", "code"}
BAD_HASHES = ("#", "#ax", "#ax=", "#ax=nan", "#ax=-1", "#ax=1e400", "#theta=Infinity", "#n=0", "#n=1e9",
              "#ndf=%00", "#a=nothing&b=constructor", "#__proto__=1", "#tour=99", "#<img src=x onerror=alert(1)>",
              "#" + "x=1&" * 5000, "#masking=vcavity&a=caps&b=newton", "#nt=999&np=x", "#%E0%A4%A",
              "#seed=99999999999999999999", "#theta=180", "#theta=90&ax=0.001&ay=2.5&nt=85")


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        PICTURES.mkdir(exist_ok=True)
        cls.served = cls.enterClassContext(Served())
        cls.chromium = cls.enterClassContext(Chromium())

    def open(self, hash="", address=None, script=None, **options):
        """A page of its own; when the test ends nothing must have gone wrong on it."""
        address = address or self.served.address
        context = self.chromium.new_context(**(options or DESKTOP))
        self.addCleanup(context.close)
        context.add_init_script(WATCH + (script or ""))
        page = context.new_page()
        page.set_default_timeout(PATIENCE)
        wrong = watch(page, address)
        self.addCleanup(lambda: self.assertEqual(wrong, []))
        page.goto(address + hash)
        wait_until_ready(page)
        wait(page, "document.getElementById('noise').textContent !== ''")  # the slowest of all
        return page

    def expect_hash(self, page, pattern):
        wait(page, "p => new RegExp(`(^#|&)${p}(&|$)`).test(location.hash)", pattern)

    @staticmethod
    def state(page):
        """What the controls show."""
        return page.evaluate("""() => Object.fromEntries([...document.querySelectorAll("input, select")]
            .map((e) => [e.id, e.type === "checkbox" ? e.checked : e.value]).concat(
            [...document.querySelectorAll("[aria-pressed]")].map((e) => [e.id, e.ariaPressed])))""")

    @staticmethod
    def give(page, id, value):
        """As a hand does: value, then the events."""
        page.evaluate("""([id, value]) => {
            const e = document.getElementById(id);
            e.value = value;
            e.dispatchEvent(new Event("input", { bubbles: true }));
            e.dispatchEvent(new Event("change", { bubbles: true }));
        }""", [id, value])

    @staticmethod
    def see_numbers(page):
        """Views are drawn once they are seen."""
        page.locator("#numbers").scroll_into_view_if_needed()
        wait(page, "document.getElementById('rejected-b').textContent.includes('±')")

    def check_no_nan(self, page):
        """In no text but the code, which speaks of it."""
        text = page.evaluate("[...document.querySelectorAll('main .card:not(#view-code)')].map((e) => e.innerText).join()")
        self.assertNotRegex(text, r"NaN|undefined|Infinity")

    # ---- looks -----------------------------------------------------------------------------------

    def check_fits(self, page, name):
        inside = page.evaluate("[document.documentElement.scrollWidth, innerWidth]")
        self.assertLessEqual(inside[0], inside[1], f"{name}: scrolls sideways")

    def check_drawn(self, page, name):
        """No canvas of one colour."""
        for id in page.evaluate("[...document.querySelectorAll('canvas')].map((c) => c.id)"):
            page.evaluate("id => document.getElementById(id).scrollIntoView({ block: 'center' })", id)
            two_frames(page)
            picture = page.locator(f"#{id}").screenshot()
            self.assertGreater(len(picture), 1500, f"{name}: {id} is empty")
        page.evaluate("scrollTo(0, 0)")

    def check_axe(self, page, name):
        found = [f"{v['id']} ({v['impact']}): {v['help']}: {v['nodes'][0]['target']}"
                 for v in Axe().run(page).response["violations"] if v["impact"] in ("serious", "critical")]
        self.assertEqual(found, [], name)

    def test_sizes_and_themes(self):
        for name, options in (("phone", PHONE), ("desktop", DESKTOP)):
            for theme in ("light", "dark"):
                with self.subTest(f"{name} {theme}"):
                    page = self.open(**options, color_scheme=theme)
                    self.check_fits(page, name)
                    self.check_drawn(page, name)
                    page.screenshot(path=PICTURES / f"{name}-{theme}.png", full_page=True, scale="css")
                    self.check_axe(page, f"{name} {theme}")
                    red, green, blue = map(int, re.findall(r"\d+", page.evaluate(
                        "getComputedStyle(document.body).backgroundColor"))[:3])
                    self.assertEqual(max(red, green, blue) < 80, theme == "dark")

    def test_large(self):
        page = self.open(**LARGE)
        self.check_fits(page, "large")
        page.screenshot(path=PICTURES / "large.png")

    def test_narrow_and_enlarged(self):
        """320 pixels are what is left of 1280 at four times the size."""
        page = self.open(viewport={"width": 320, "height": 640})
        self.check_fits(page, "narrow")

    # ---- controls --------------------------------------------------------------------------------

    def test_all_controls_are_tested(self):
        page = self.open()
        ids = page.evaluate("""[...document.querySelectorAll("input, select, button, textarea, [tabindex='0']")]
            .map((e) => e.id)""")
        self.assertEqual(sorted(ids), sorted({*CONTROLS, *BUTTONS, *ELSEWHERE}))

    def test_values(self):
        page = self.open()
        for id, (value, pattern) in CONTROLS.items():
            with self.subTest(id):
                page.evaluate("location.hash = ''")
                wait(page, "document.getElementById('theta').value === '60'")
                self.give(page, id, value)
                self.expect_hash(page, pattern)
                shown = self.state(page)[id]
                is_number = re.fullmatch(r"[-0-9.]+", value)
                self.assertEqual(float(shown) if is_number else shown, float(value) if is_number else value)

    def test_buttons(self):
        page = self.open()
        for id, pattern in BUTTONS.items():
            with self.subTest(id):
                page.evaluate("location.hash = ''")
                wait(page, "document.getElementById('tour').hidden")
                page.locator(f"#{id}").click()
                self.expect_hash(page, pattern)
        page.evaluate("location.hash = '#show=a&code=b&lang=glsl'")
        for id, other in (("show-both", "show-a"), ("code-a", "code-b"), ("code-c", "code-glsl")):
            wait(page, "id => document.getElementById(id).ariaPressed === 'true'", other)
            page.locator(f"#{id}").click()
            wait(page, "id => document.getElementById(id).ariaPressed === 'true'", id)

    def test_boxes(self):
        page = self.open()
        page.locator("#link-alpha").check()
        self.expect_hash(page, r"ay=0\.2")
        self.give(page, "alpha-y", "1000")
        self.expect_hash(page, r"ax=2\.5")
        self.assertTrue(page.locator("#normal-theta").is_hidden())
        page.locator("#normal").check()
        self.expect_hash(page, "nt=25")
        for id, pattern in (("normal-theta", "nt=40"), ("normal-phi", "np=40")):
            self.give(page, id, "40")
            self.expect_hash(page, pattern)
        page.locator("#normal").uncheck()
        wait(page, "!location.hash.includes('nt=')")

    def test_numbers(self):
        """What the page says of rejected draws is what `lobe sample` draws; a wrong number in a field
        keeps the last right one."""
        page = self.open("#ax=0.1&ay=1&theta=60&phi=0&a=caps&b=optimal&n=65536&u=random&nt=")
        self.see_numbers(page)
        for id, method in (("rejected-a", "caps"), ("rejected-b", "optimal")):
            lines = subprocess.run([PROGRAM, "sample", "--alpha", "0.1,1", "--wi", "0.8660254,0,0.5", "--method", method,
                                    "--count", "65536"], capture_output=True, timeout=60).stdout.splitlines()[1:]
            share = sum(line.endswith(b",0") for line in lines) / 65536
            value = float(re.match(r"[0-9.]+", page.locator(f"#{id}").inner_text())[0])
            # two times 65,536 draws: five standard errors
            self.assertAlmostEqual(value, share, delta=5 * (2 * share * (1 - share) / 65536) ** 0.5, msg=method)
        before = self.state(page)
        page.locator("#theta-value").fill("")
        page.keyboard.press("Tab")
        self.assertEqual(self.state(page)["theta"], before["theta"])
        self.give(page, "alpha-x-value", "1000")
        self.expect_hash(page, r"ax=2\.5")

    def test_combinations(self):
        """Every distribution, masking and pair of methods that the lists offer, from above and behind."""
        page = self.open("#n=64&spp=1&theta=100&nt=30")
        for ndf in ("ggx", "beckmann"):
            for masking in ("smith", "vcavity"):
                self.give(page, "ndf", ndf)
                self.give(page, "masking", masking)
                names = page.evaluate("[...document.getElementById('method-a').options].map((o) => o.value)")
                self.assertGreater(len(names), 1)
                for name in names:
                    self.give(page, "method-a", name)
                    self.give(page, "method-b", name)
                    page.evaluate("() => new Promise((done) => requestAnimationFrame(done))")
                    shown = self.state(page)
                    self.assertEqual([shown[k] for k in ("ndf", "masking", "method-a", "method-b")],
                                     [ndf, masking, name, name])
                    self.check_no_nan(page)

    # ---- hands -----------------------------------------------------------------------------------

    @staticmethod
    def centre(page, id):
        box = page.locator(f"#{id}").bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def test_drag(self):
        page = self.open("#yaw=0&pitch=0")
        x, y = self.centre(page, "direction")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 30, y + 40, steps=4)
        page.mouse.up()
        self.expect_hash(page, r"theta=[0-9.]+")
        found = self.centre(page, "direction")
        self.assertLess(max(abs(found[0] - x - 30), abs(found[1] - y - 40)), 4)
        x, y = self.centre(page, "sphere")
        page.mouse.move(x + 120, y - 100)
        page.mouse.down()
        page.mouse.move(x + 60, y - 60, steps=4)
        page.mouse.up()
        self.expect_hash(page, r"yaw=-?[0-9.]+")
        self.assertIn("pitch", page.evaluate("location.hash"))
        self.assertNotEqual(self.centre(page, "direction"), found)
        page.locator("#picture").scroll_into_view_if_needed()
        box = page.locator("#picture").bounding_box()
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 50)
        page.mouse.down()
        page.mouse.move(box["x"] + box["width"] * 0.8, box["y"] + 50, steps=4)
        page.mouse.up()
        self.expect_hash(page, r"split=(79|80|81)")

    def test_touch(self):
        """A finger on the direction drags it, and the page stays where it is; beside the sphere it scrolls."""
        page = self.open("#yaw=0&pitch=0", **PHONE)
        hand = page.context.new_cdp_session(page)

        def drag(x, y, dx, dy):
            for kind, step in [("touchStart", 0), *(("touchMove", k / 5) for k in range(1, 6)), ("touchEnd", None)]:
                points = [] if step is None else [{"x": x + dx * step, "y": y + dy * step}]
                hand.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        page.locator("#direction").scroll_into_view_if_needed()
        x, y = self.centre(page, "direction")
        top = page.evaluate("scrollY")
        drag(x, y, 20, 30)
        self.expect_hash(page, r"theta=[0-9.]+")
        found = self.centre(page, "direction")
        self.assertLess(max(abs(found[0] - x - 20), abs(found[1] - y - 30)), 4)
        x, y = self.centre(page, "sphere")
        drag(x + 60, y - 60, -50, 20)
        self.expect_hash(page, r"yaw=-?[0-9.]+")
        self.assertEqual(page.evaluate("scrollY"), top)

    def test_keys(self):
        page = self.open("#theta=60&phi=10")
        page.locator("#direction").focus()
        for keys, pattern in ((["ArrowUp"], "theta=59"), (["Shift+ArrowDown"], "theta=69"),
                              (["ArrowRight", "ArrowRight"], "phi=12"), (["Shift+ArrowLeft"], "phi=2"),
                              (["Home"], "theta=0"), (["End"], "theta=180"), (["ArrowDown"], "theta=180")):
            for key in keys:
                page.keyboard.press(key)
            self.expect_hash(page, pattern)
        self.assertEqual(page.locator("#direction").get_attribute("aria-valuenow"), "180")

    def test_tab(self):
        """The tab key reaches everything that can be seen, once, and shows where it is."""
        page = self.open("#nt=20")
        wanted = set(page.evaluate("""[...document.querySelectorAll("a[href], input, select, button, [tabindex='0']")]
            .filter((e) => e.checkVisibility() && !e.disabled).map((e) => e.id || e.className)"""))
        reached = []
        for _ in range(2 * len(wanted)):
            page.keyboard.press("Tab")
            id, is_shown = page.evaluate("""() => { const e = document.activeElement, s = getComputedStyle(e);
                return [e.id || e.className, s.outlineStyle !== "none" || s.boxShadow !== "none"]; }""")
            if not id or id in reached:
                break
            self.assertTrue(is_shown, f"{id}: no sign of the focus")
            reached.append(id)
        self.assertEqual(set(reached), wanted)

    # ---- links -----------------------------------------------------------------------------------

    def test_links(self):
        """A link shows what its maker saw: controls and pictures."""
        rng = random.Random(9)
        page = self.open()
        for k in range(8):
            for id in rng.sample(sorted(CONTROLS), 4):
                if "method" not in id:
                    self.give(page, id, CONTROLS[id][0])
            self.give(page, "theta", str(rng.randrange(180)))
            page.wait_for_timeout(300)  # the address is written when things calm down
            page.locator("#split").scroll_into_view_if_needed()
            hash = page.evaluate("location.hash")
            other = self.open(hash) if k == 0 else other
            if k:
                other.evaluate("hash => { location.hash = hash; }", hash)
                wait(other, "v => document.getElementById('theta').value === v", self.state(page)["theta"])
            other.locator("#split").scroll_into_view_if_needed()
            wait(other, "v => document.getElementById('split').value === v", self.state(page)["split"])
            first, second = self.state(page), self.state(other)
            first.pop("link-alpha"), second.pop("link-alpha")  # a way to move, not a state
            self.assertEqual(first, second, hash)
            other.wait_for_timeout(300)
            self.assertEqual(other.evaluate("location.hash"), hash)

    def test_same_picture(self):
        """The same address, the same drawing; another seed, another."""
        hash = "#ax=0.3&ay=0.6&theta=70&n=1024&seed={}&u=sobol"
        first, second, other = [self.open(hash.format(seed), script=RECORD) for seed in (5, 5, 6)]
        for id in ("grid", "histogram", "stretched", "picture"):
            end = time.monotonic() + PATIENCE / 1000
            while True:  # a busy machine may be late with any of them
                hashes = [self.drawn(page, id) for page in (first, second, other)]
                if hashes[0] == hashes[1] or time.monotonic() > end:
                    break
            self.assertEqual(hashes[0], hashes[1], id)
            self.assertNotEqual(hashes[0], hashes[2], id)

    def drawn(self, page, id):
        """What a canvas was told to draw, once that has stayed the same for a second."""
        page.evaluate("id => document.getElementById(id).scrollIntoView()", id)
        wait(page, "id => drawn(id) !== null", id)
        hash, since = None, time.monotonic()
        while time.monotonic() - since < 1:
            two_frames(page)
            if (now := page.evaluate("id => drawn(id)", id)) != hash:
                hash, since = now, time.monotonic()
        return hash

    def test_bad_links(self):
        page = self.open()
        for k, hash in enumerate(BAD_HASHES):
            with self.subTest(hash[:40]):
                if k % 8 == 7:  # a new page reads the address by the same text
                    page = self.open(hash)
                else:
                    page.evaluate("hash => { location.hash = hash; }", hash)
                    two_frames(page)
                shown = self.state(page)
                self.assertTrue(0.001 <= float(shown["alpha-x-value"]) <= 2.5, shown)
                self.assertTrue(0 <= float(shown["theta-value"]) <= 180, shown)
                self.assertTrue(shown["method-a"] and shown["method-b"] and shown["ndf"], shown)
                self.assertNotIn("did not start", page.locator("#status").inner_text())
                self.check_no_nan(page)

    # ---- the rest --------------------------------------------------------------------------------

    def test_tour(self):
        page = self.open(reduced_motion="reduce", **DESKTOP)
        page.locator("#tour-start").click()
        titles = []
        for step in range(1, 8):
            wait(page, "s => document.getElementById('tour-step').textContent.startsWith(`Step ${s} `)", step)
            titles.append(page.locator("#tour-title").inner_text())
            self.assertEqual(page.evaluate("document.activeElement.id"), "tour-title")
            lit = page.locator(".card.lit")
            self.assertEqual(lit.count(), 1)
            self.assertTrue(page.evaluate("""() => { const r = document.querySelector(".card.lit").getBoundingClientRect();
                return r.bottom > 0 && r.top < innerHeight; }"""))
            page.screenshot(path=PICTURES / f"tour-{step}.png")
            if step == 7:
                self.check_axe(page, "tour")
            page.locator("#tour-next").click()
        self.assertEqual(len(set(titles)), 7)
        wait(page, "document.getElementById('tour').hidden")
        page.locator("#tour-start").click()
        page.locator("#tour-next").click()
        self.expect_hash(page, "tour=2")
        page.locator("#tour-back").click()
        self.expect_hash(page, "tour=1")
        self.assertTrue(page.locator("#tour-back").is_disabled())
        page.keyboard.press("Escape") if page.evaluate("document.activeElement.closest('#tour') !== null") \
            else page.locator("#tour-end").click()
        wait(page, "document.getElementById('tour').hidden")

    def test_code(self):
        """What is copied is what is shown; the C of it compiles."""
        page = self.open(permissions=["clipboard-read", "clipboard-write"], **DESKTOP)
        page.locator("#to-code").click()
        seen = set()
        for language in ("hlsl", "glsl", "c"):
            page.locator(f"#code-{language}").click()
            wait(page, "l => document.getElementById('code').dataset.key?.endsWith(`.${l}`)", language)
            page.locator("#copy").click()
            wait(page, "document.getElementById('copy').textContent === 'Copied'")
            text = page.evaluate("navigator.clipboard.readText()")
            self.assertEqual(text, page.evaluate("document.getElementById('code').textContent"))
            self.assertGreater(len(text), 2000)
            seen.add(text)
            wait(page, "document.getElementById('copy').textContent === 'Copy'")
        self.assertEqual(len(seen), 3)
        with tempfile.NamedTemporaryFile("w", suffix=".c") as file:
            file.write(text)
            file.flush()
            result = subprocess.run(["gcc", "-std=c11", "-Wall", "-fsyntax-only", file.name], capture_output=True,
                                    timeout=60)
            self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_without_webgl(self):
        page = self.open(script="""const get = HTMLCanvasElement.prototype.getContext;
            HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
                return kind === "webgl2" ? null : get.call(this, kind, ...rest); };""")
        self.assertIn("WebGL2", page.locator("#sphere-note").inner_text())
        self.see_numbers(page)

    def test_without_vectors(self):
        """The same numbers by the scalar library."""
        script = "WebAssembly.validate = () => false;"
        texts = []
        for page in (self.open(), self.open(script=script)):
            self.see_numbers(page)
            wait(page, "document.getElementById('furnace-exact').textContent.length > 2")
            page.locator("#histogram").scroll_into_view_if_needed()
            wait(page, "document.getElementById('chi-b').textContent.includes('p')")
            texts.append([page.locator(f"#{id}").inner_text()
                          for id in ("rejected-a", "furnace-a", "variance-b", "chi-a", "chi-b")])
        self.assertIn("without vectors", page.locator("footer").inner_text())
        self.assertEqual(texts[0], texts[1])

    def test_as_files(self):
        """The folder that -o writes works below any path of any file server."""
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(f"{folder}/deep")
            subprocess.run([PROGRAM, "explore", "-o", f"{folder}/deep/page"], check=True, timeout=60)

            class Quiet(http.server.SimpleHTTPRequestHandler):
                def log_message(self, *_):
                    pass

            with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder)) as server:
                threading.Thread(target=server.serve_forever, daemon=True).start()
                page = self.open(address=f"http://127.0.0.1:{server.server_port}/deep/page/")
                self.see_numbers(page)
                server.shutdown()

    def test_memory(self):
        """1,000 changes leave nothing behind."""
        page = self.open("#n=256&spp=1", viewport={"width": 480, "height": 320})
        probe = page.context.new_cdp_session(page)
        probe.send("Performance.enable")

        def counted():
            for _ in range(2):
                probe.send("HeapProfiler.collectGarbage")
            metrics = {m["name"]: m["value"] for m in probe.send("Performance.getMetrics")["metrics"]}
            whole = page.evaluate("performance.measureUserAgentSpecificMemory().then((m) => m.bytes)")
            return metrics["JSHeapUsedSize"], metrics["Nodes"], metrics["JSEventListeners"], whole

        def change(count):
            page.evaluate("""async (count) => {
                const ids = ["alpha-x", "alpha-y", "theta", "phi", "split"], methods = ["caps", "optimal", "horizon"];
                for (let k = 0; k < count; ++k) {
                    const e = document.getElementById(ids[k % ids.length]);
                    e.value = Number(e.min) + (Number(e.max) - Number(e.min)) * (k * 0.618 % 1);
                    e.dispatchEvent(new Event("input", { bubbles: true }));
                    if (k % 10 === 0) {
                        const m = document.getElementById("method-a");
                        m.value = methods[k / 10 % methods.length];
                        m.dispatchEvent(new Event("change", { bubbles: true }));
                    }
                    await new Promise((done) => requestAnimationFrame(done));
                }
            }""", count)
            page.wait_for_timeout(500)

        change(100)
        before = counted()
        change(1000)
        after = counted()
        print("memory:", json.dumps({"before": before, "after": after}))
        self.assertLess(after[0] - before[0], 500_000)
        self.assertLess(after[1] - before[1], 50)
        self.assertEqual(after[2], before[2])
        self.assertLess(after[3] - before[3], 1_500_000)


if __name__ == "__main__":
    unittest.main()
