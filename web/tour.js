// The guided tour: seven steps, each a state and the view to look at.
import { $, say } from "./page.js";
import { DEFAULTS, format } from "./state.js";

const BASE = { ndf: "ggx", masking: "smith", nt: null, u: "random", n: 4096, seed: 1, show: "both", yaw: 55, pitch: 24, spp: 4 };
const STEPS = [
    ["What is a visible normal?", "view-sphere", { ax: 0.5, ay: 0.5, theta: 75, phi: 0, a: "ndf", b: "ellipsoid", show: "b", yaw: 70 },
        "A rough surface is made of tiny mirrors, the facets. From a grazing direction i one sees mostly those that face it: each counts by its visible area, the cosine ⟨i, m⟩, unless another one hides it. Their normals are the visible normals; reflect i about one and you have a sample o."],
    ["What happens without them", "view-numbers", { ax: 0.5, ay: 0.5, theta: 75, phi: 0, a: "ndf", b: "ellipsoid" },
        "A draws any facet (Walter et al. 2007), B visible ones (Heitz 2018). Both are right on average: the furnace agrees. But A draws facets that nobody sees, its weights vary wildly, and the error bar of its furnace is three times as long."],
    ["Stretched space", "view-stretched", { ax: 0.2, ay: 0.8, theta: 60, phi: 45, a: "ellipsoid", b: "caps", n: 2048 },
        "Scale space by 1/α and the facets of GGX become a plain hemisphere, whatever the roughness. There a visible normal is a point of a projected hemisphere; its reflections fill a cap around the normal, evenly (Dupuy & Benyoub 2023)."],
    ["A map from the square", "view-grid", { ax: 0.2, ay: 0.8, theta: 60, phi: 45, a: "ellipsoid", b: "caps", n: 1024, u: "sobol" },
        "A sampler bends the unit square onto directions. The less it tears and squeezes, the more of the evenness of good random numbers survives. Change the pattern and watch the dots. Grey lines end below the surface: those numbers are lost."],
    ["Bounded caps", "view-bound", { ax: 0.7, ay: 0.4, theta: 72, phi: 0, a: "caps", b: "bounded" },
        "Reflections that leave the surface stay above the exact bound. The previous cap ends at −î_z, whatever can leave; the bounded one (Eto & Tokuyoshi 2023) ends higher, at a height that no reflection of this surface passes. What a cap has below the bound is rejected."],
    ["The smallest cap", "view-stretched", { ax: 0.1, ay: 1, theta: 60, phi: 90, a: "bounded", b: "optimal", yaw: 60, pitch: 5 },
        "A cap need not stand upright. The smallest cap around the useful region leans: on this brushed surface it rejects 3 % of the draws, the bounded cap 18 %. The weights are more even for it: see the variance."],
    ["Nothing is rejected", "view-picture", { ax: 0.1, ay: 1, theta: 60, phi: 90, a: "caps", b: "horizon", spp: 4, split: 50 },
        "Horizon sampling draws from the useful region itself and follows the shadowing too: no sample is lost, and the weights are nearly equal. Drag the split: the same number of samples left and right. Then read the furnace again, and take the code with you."],
];

function place(card) {
    for (const lit of document.querySelectorAll(".card.lit")) lit.classList.remove("lit");
    if (!card) return;
    card.classList.add("lit");
    card.scrollIntoView({ block: "start" });
}

export function startTour(store) {
    let shown = -1;
    const go = (step) => store.set(step === 0 ? { tour: 0 } : { ...BASE, ...STEPS[step - 1][2], tour: step });
    const update = () => {
        const step = store.state.tour;
        if (step === shown) return;
        shown = step;
        $("tour").hidden = step === 0;
        if (step === 0) return place(null);
        const [title, view, , text] = STEPS[step - 1];
        say("tour-step", `Step ${step} of ${STEPS.length}`);
        say("tour-title", title);
        say("tour-text", text);
        $("tour-back").disabled = step === 1;
        say("tour-next", step === STEPS.length ? "Done" : "Next");
        place($(view));
        $("tour-title").focus({ preventScroll: true });
    };
    $("tour-start").addEventListener("click", () => go(1));
    $("tour-back").addEventListener("click", () => go(Math.max(1, store.state.tour - 1)));
    $("tour-next").addEventListener("click", () => go((store.state.tour + 1) % (STEPS.length + 1)));
    $("tour-end").addEventListener("click", () => {
        go(0);
        $("tour-start").focus();
    });
    $("tour").addEventListener("keydown", (event) => { if (event.key === "Escape") $("tour-end").click(); });
    store.listeners.push(update);
    // a link to a step that says nothing else shows the step's state
    const { tour } = store.state;
    if (tour > 0 && format(store.state) === format({ ...DEFAULTS, tour })) go(tour);
    update();
}
