// "Copy code": the drop-in file of a method, put together from the kernels.
import { $, pressed, say } from "./page.js";
import { assemble } from "./dropin.js";

let pieces = null;

/** The kernels, packed. */
async function load() {
    const response = await fetch(new URL("./kernels.gz", import.meta.url));
    if (!response.ok) throw new Error(`kernels.gz: ${response.status}`);
    let bytes = new Uint8Array(await response.arrayBuffer());
    if (bytes[0] === 0x1f && bytes[1] === 0x8b) // unless the server has unpacked it
        bytes = new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer());
    return JSON.parse(new TextDecoder().decode(bytes));
}

export function startCode(store, models) {
    const update = async () => {
        const { state } = store;
        for (const k of ["a", "b"]) pressed(`code-${k}`, state.code === k);
        for (const k of ["c", "glsl", "hlsl"]) pressed(`code-${k}`, state.lang === k);
        const kernel = models.kernelOf(state, state[state.code]);
        if ($("code").dataset.key === `${kernel}.${state.lang}`) return;
        const text = assemble(pieces, state.lang, kernel);
        $("code").dataset.key = `${kernel}.${state.lang}`;
        $("code").textContent = text;
        $("code").scrollTop = 0;
        say("code-note", `${kernel}: ${text.split("\n").length - 1} lines, the sampler and its density, made of the kernels that this page runs. MIT licence.`);
    };
    for (const k of ["a", "b"]) $(`code-${k}`).addEventListener("click", () => store.set({ code: k }));
    for (const k of ["c", "glsl", "hlsl"]) $(`code-${k}`).addEventListener("click", () => store.set({ lang: k }));
    $("to-code").addEventListener("click", () => {
        $("view-code").scrollIntoView({ block: "start" });
        $("code").focus({ preventScroll: true });
    });
    $("copy").addEventListener("click", copy);
    const begin = async () => {
        try {
            pieces = await load();
            await update();
            store.listeners.push(update);
        } catch (error) {
            say("code-note", `The code could not be loaded: ${error.message}`);
        }
    };
    const observer = new IntersectionObserver((entries) => {
        if (!entries.some((entry) => entry.isIntersecting)) return;
        observer.disconnect();
        begin();
    }, { rootMargin: "300px" });
    observer.observe($("view-code"));
}

async function copy() {
    const text = $("code").textContent;
    try {
        await navigator.clipboard.writeText(text);
    } catch {
        getSelection().selectAllChildren($("code")); // without permission: selected, ready to be copied
        if (!document.execCommand("copy")) return say("copy", "Selected: press Ctrl-C");
    }
    say("copy", "Copied");
    setTimeout(() => say("copy", "Copy"), 1500);
}
