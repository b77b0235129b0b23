// A drop-in file of a kernel: what tools/dropin.py writes, from the same pieces (kernels.py).

/** The kernels that these need, each after what it includes. */
function inOrder(kernels, name, order = []) {
    for (const inner of kernels[name].needs) inOrder(kernels, inner, order);
    if (!order.includes(name)) order.push(name);
    return order;
}

/** The kernel language in the words of another. */
function plain(text, language) {
    const c = language === "c";
    return text
        .replace(/\bR\(([^()]*)\)/g, c ? "$1f" : "$1")
        .replace(/\bK_INT\(([^()]*)\)/g, "$1")
        .replace(/\bK_IS_F64\b/g, "0")
        .replace(/\breal\b/g, "float")
        .replace(/\bkint\b/g, c ? "int32_t" : "int")
        .replace(/\bK_FN /g, c ? "static inline " : "")
        .replace(/\bK_STRUCT\((\w+)\)/g, c ? "typedef struct $1 $1;\nstruct $1" : "struct $1");
}

/** Every name that the text defines begins with lobe_ or LOBE_. Comments speak of the mathematics. */
function prefixed(text) {
    const all = (pattern) => Array.from(text.matchAll(pattern), (match) => match[1]);
    const macros = new Set(all(/^#define (\w+)/gm));
    const names = new Set([...all(/^(?:static inline )?\w+ (\w+)\(/gm), ...all(/^struct (\w+)/gm)]);
    return text.split(/(\/\*[^]*?\*\/)/).map((part) => part.startsWith("/*") ? part
        : part.replace(/\b[A-Za-z_]\w*\b/g, (word) => macros.has(word) ? `LOBE_${word}` : names.has(word) ? `lobe_${word}` : word)).join("");
}

/** The distribution and masking that a kernel samples. */
const family = (kernel) => kernel.split("_")[0] + (kernel.includes("_vcavity") ? "_vcavity" : "");

export function assemble(pieces, language, kernel) {
    let text = pieces.bindings[language];
    for (const name of inOrder(pieces.kernels, kernel)) text += `\n${pieces.kernels[name].text}`;
    text = prefixed(plain(text, language)).replace(/\n{3,}/g, "\n\n").trim() + "\n";
    const head = pieces.head.replaceAll("@KERNEL@", kernel).replaceAll("@FAMILY@", family(kernel));
    if (language !== "c") return head + text;
    return head + pieces.guard[0] + text.replace(/^static inline /gm, "LOBE_INLINE ") + pieces.guard[1];
}
