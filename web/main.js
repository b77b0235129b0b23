// Starts the library, and ties controls, state and views together.
import { $, say } from "./page.js";
import { loadKernel } from "./kernel.js";
import { Models } from "./models.js";
import { Store } from "./state.js";
import { startControls } from "./controls.js";
import { startTheme } from "./theme.js";
import { Views } from "./views.js";
import { SphereView } from "./view_sphere.js";

const PATTERNS = ["random", "stratified", "sobol"];
const SCENE = ["ax", "ay", "theta", "phi", "nt", "np", "ndf", "masking", "a", "b"];
const DRAWS = [...SCENE, "n", "u", "seed"];

const any = (changed, keys) => keys.some((key) => changed.has(key));

function draw(kernel, models, { state }, numbersToo) {
    if (numbersToo) kernel.make_numbers(PATTERNS.indexOf(state.u), state.seed, state.n);
    const valid = ["a", "b"].map((k, method) => {
        const bits = kernel.prepare(method, ...models.scene(state, state[k]));
        kernel.draw(method, state.n);
        return bits;
    });
    say("status", !valid.every((bits) => bits & 1) ? "The surface is not seen from here: i lies below the geometric surface, or straight below."
        : valid.some((bits) => bits & 2) ? "A perfect mirror: its density is a point mass." : "");
}

/** The views beside the first picture: loaded and drawn after it. */
async function addViews(store, kernel, models, views) {
    const [{ StretchedView }, { BoundView }, { HistogramView }, { GridView }, { NumbersView }, { PictureView }, { Slow },
        { startCode }, { startTour }] = await Promise.all(["view_stretched", "view_bound", "view_histogram", "view_grid",
        "view_numbers", "view_picture", "slow", "code", "tour"].map((name) => import(`./${name}.js`)));
    const numbers = new NumbersView(store, kernel), histogram = new HistogramView(store, kernel);
    const picture = new PictureView(store, kernel.picture_side());
    views.add($("view-numbers"), numbers);
    views.add($("view-stretched"), new StretchedView(store, kernel, models));
    views.add($("view-bound"), new BoundView(store, kernel));
    views.add($("view-histogram"), histogram);
    views.add($("view-grid"), new GridView(store, kernel));
    views.add($("view-picture"), picture);
    const slow = new Slow(models, store, (data, fresh) => {
        if (data.kind === "integrals") {
            histogram.take(data.expected, fresh);
            numbers.take(data.albedo, fresh);
            views.touch("view-histogram", "view-numbers");
        } else if (data.kind === "rows") picture.take(data.first, data.count, data.rows);
        else if (data.kind === "noise") picture.noise(data.noise, data.spp);
    });
    slow.ask({ integrals: true, picture: true });
    store.listeners.push((changed) => {
        if (any(changed, SCENE)) {
            histogram.age();
            numbers.age();
            slow.ask({ integrals: true, picture: any(changed, ["ax", "ay", "ndf", "masking", "a", "b"]) });
        }
        if (any(changed, ["seed", "spp"])) slow.ask({ picture: true });
        if (changed.has("split")) views.touch("view-picture");
    });
    startCode(store, models);
    startTour(store);
    views.touch();
}

async function start() {
    const kernel = await loadKernel(import.meta.url), models = new Models(kernel);
    const store = new Store((state) => models.fix(state)), views = new Views();
    startTheme(store, () => views.touch());
    startControls(store, models);
    say("version", kernel.text(kernel.version()));
    say("build", kernel.file === "lobe-simd.wasm" ? " with vectors" : " without vectors");
    const sphere = new SphereView(store, kernel);
    let drawn = true, numbersDrawn = true, data = true;
    store.listeners.push((changed) => {
        if (any(changed, DRAWS)) drawn = data = true;
        if (any(changed, ["n", "u", "seed"])) numbersDrawn = true;
        if (any(changed, [...DRAWS, "theme"])) views.touch();
        else if (any(changed, ["show", "yaw", "pitch"])) views.touch("view-sphere", "view-stretched");
        if (changed.has("show")) views.touch("view-histogram");
    });
    views.before = () => {
        if (drawn) draw(kernel, models, store, numbersDrawn);
        drawn = numbersDrawn = false;
    };
    views.add($("view-sphere"), { canvas: sphere.canvas, draw() {
        if (data) sphere.data();
        data = false;
        sphere.draw();
    } });
    await new Promise((resolve) => { requestAnimationFrame(() => setTimeout(resolve, 0)); });
    await addViews(store, kernel, models, views);
}

start().catch((error) => {
    say("status", `The page did not start: ${error.message}`);
    throw error;
});
