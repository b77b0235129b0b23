#!/usr/bin/env python3
"""dropin.py LANGUAGE KERNEL... [--title TEXT]: one file with everything that the kernels need.
dropin.py pass FILE... [--define NAME=TEXT]...: shader texts of the tree, one after the other and after what they
include, with the kernel's own words: a compute shader of GLSL 4.50.
dropin.py hlsl-pass FILE... [--define NAME=TEXT]...: the same in HLSL, its buffers and its thread too.

LANGUAGE is c, glsl or hlsl. What comes out is single precision in plain text of the language: no
macros of the kernel language are left but its constants, and every name begins with `lobe_` (macros:
LOBE_), so it can be pasted into somebody else's program. Written to standard output.
"""
import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
KERNEL = ROOT / "kernel"
BINDING = {"c": ["c_f32.h", "c.h"], "glsl": ["glsl.h", "shader.h"], "hlsl": ["hlsl.h", "shader.h"]}
INCLUDE = re.compile(r'^#include "([^"]+)"\n', re.M)


def in_order(names):
    """The kernel files that these need, each after what it includes."""
    order = []

    def visit(name):
        if name in order:
            return
        for inner in INCLUDE.findall((KERNEL / name).read_text()):
            visit(inner)
        order.append(name)

    for name in names:
        visit(name)
    return order


def without_guard(text):
    """A file without its include guard and its includes."""
    text = re.sub(r"^#ifndef (\w+_H)\n#define \1\n", "", text, flags=re.M)
    text = re.sub(r"\n#endif\n\Z", "\n", text)
    return re.sub(r'^#include [<"].*\n', "", text, flags=re.M)


def settle(text):
    """Decides the conditions that the precision decides."""
    out, stack = [], []
    for line in text.splitlines():
        word = line.strip()
        if word.startswith("#if K_IS_F64"):
            stack.append(["decided", False])
        elif word.startswith("#if"):
            stack.append(["kept", True])
            out.append(line)
        elif word.startswith("#else") and stack[-1][0] == "decided":
            stack[-1][1] = not stack[-1][1]
        elif word.startswith("#endif") and stack:
            kind, _ = stack.pop()
            if kind == "kept":
                out.append(line)
        elif all(shown for _, shown in stack):
            out.append(line)
    return "\n".join(out) + "\n"


def binding(language):
    """What the language calls the words of the kernel language."""
    text = "".join(without_guard((KERNEL / "bind" / name).read_text()) for name in BINDING[language])
    text = re.sub(r"^/\*.*?\*/\n", "", text, count=2, flags=re.S)
    text = re.sub(r"^#pragma.*\n", "", text, flags=re.M)
    text = re.sub(r"^#ifndef K_FN\n(#define K_FN.*)\n#endif\n", r"\1\n", text, flags=re.M)
    # words that are written out below
    text = re.sub(r"^#define (real|kint|R\(x\)|K_INT\(x\)|K_IS_F64|K_FN|K_STRUCT\(name\))"
                  r"(.*\\\n)*.*\n", "", text, flags=re.M)
    text = re.sub(r"^typedef (float real|int32_t kint);\n", "", text, flags=re.M)
    return re.sub(r"^/\*[^/]*\*/\n(?=\n)", "", text, flags=re.M)


def plain(text, language):
    """The kernel language in the words of another."""
    suffix = "f" if language == "c" else ""
    text = re.sub(r"\bR\(([^()]*)\)", lambda m: m[1] + suffix, text)
    text = re.sub(r"\bK_INT\(([^()]*)\)", r"\1", text)
    text = re.sub(r"\bK_IS_F64\b", "0", text)
    text = re.sub(r"\breal\b", "float", text)
    text = re.sub(r"\bkint\b", "int32_t" if language == "c" else "int", text)
    text = re.sub(r"\bK_FN ", "static inline " if language == "c" else "", text)
    form = r"typedef struct \1 \1;\nstruct \1" if language == "c" else r"struct \1"
    return re.sub(r"\bK_STRUCT\((\w+)\)", form, text)


def in_code(text, change):
    """The text with its code changed and its comments left alone."""
    parts = re.split(r"(/\*.*?\*/)", text, flags=re.S)
    return "".join(part if part.startswith("/*") else change(part) for part in parts)


BUFFER = re.compile(r"^layout\(std430, binding = (\d+)\) (readonly |writeonly |)buffer (\w+) \{\n"
                    r"    (\w+) (\w+)(\[\])?;(.*)\n\};", re.M)
THREAD = {r"^layout\(local_size_x = (\d+), local_size_y = (\d+)\) in;":
          r"#define SSR_THREADS [numthreads(\1, \2, 1)]\nstatic uint3 ssr_thread;",
          r"\bgl_GlobalInvocationID\b": "ssr_thread",
          r"^void main\(\) \{": "SSR_THREADS void main(uint3 thread : SV_DispatchThreadID) {\n"
                              "    ssr_thread = thread;"}


def in_hlsl(text, single):
    """A text of ssr/shaders in HLSL: buffers keep their numbers, as t where they are read only and else as u. `single`
    gathers the buffers that hold one thing, by its name."""
    def declared(match):
        number, access, block, kind, name, many, about = match.groups()
        form = ("StructuredBuffer", "t") if access == "readonly " else ("RWStructuredBuffer", "u")
        if not many:
            single[name] = f"{block}[0]"
        return f"{form[0]}<{kind}> {name if many else block} : register({form[1]}{number});{about}"

    text = BUFFER.sub(declared, text)
    for form, word in THREAD.items():
        text = re.sub(form, word, text, flags=re.M)
    for name, element in single.items():
        text = in_code(text, lambda code, form=rf"(?<![.\w]){name}\b", word=element: re.sub(form, word, code))
    return text


def flattened(paths, defines, language):
    """Files of the tree after what they include, each once, without guards; GLSL 4.50, or HLSL."""
    seen, single = set(), {}

    def whole(path):
        if path in seen:
            return ""
        seen.add(path)

        def included(name):
            beside = path.parent / name
            return whole((beside if beside.is_file() else ROOT / name).resolve())

        text = re.sub(r"^#ifndef (\w+_H)\n#define \1\n", "", path.read_text(), flags=re.M)
        parts = INCLUDE.split(re.sub(r"\n#endif\n\Z", "\n", text))
        if language == "hlsl":
            parts[1::2] = [name.replace("bind/glsl.h", "bind/hlsl.h") for name in parts[1::2]]
        for i in range(1, len(parts), 2):
            parts[i] = included(parts[i])
        if language == "hlsl" and path.parent.name == "shaders":
            parts[0::2] = [in_hlsl(part, single) for part in parts[0::2]]
        return "".join(parts)

    words = "".join(f"#define {name} {text}\n" for name, text in defines)
    text = words + "\n".join(whole((ROOT / path).resolve()) for path in paths)
    text = re.sub(r"^#ifdef GL_ES\n.*?\n#endif\n", "", text, flags=re.M | re.S)
    return ("#version 450\n" if language == "glsl" else "") + re.sub(r"\n{3,}", "\n\n", settle(text))


def defined(text):
    """Names that the text defines: functions, structures, macros."""
    functions = re.findall(r"^(?:static inline )?\w+ (\w+)\(", text, re.M)
    structures = re.findall(r"^struct (\w+)", text, re.M)
    macros = re.findall(r"^#define (\w+)", text, re.M)
    return set(functions) | set(structures), set(macros)


def prefixed(text):
    names, macros = defined(text)

    def rename(match):
        word = match[0]
        if word in macros:
            return "LOBE_" + word
        return "lobe_" + word if word in names else word

    # comments keep the kernel's names: they speak of the mathematics
    return in_code(text, lambda code: re.sub(r"\b[A-Za-z_]\w*\b", rename, code))


INLINE = """/* Always: a state passed by value costs more than what is computed with it. */
#define LOBE_INLINE static inline __attribute__((always_inline))

"""

USE = """ *
 *     {v3} wi = lobe_v3_of(x, y, z);                                  // unit
 *     {options} o = lobe_facet_options_of(false, false);
 *     {base} g = lobe_{family}_base_of(wi, alpha_x, alpha_y, o);      // once a shading point
 *     {state} s = lobe_{kernel}_prepare(g);
 *     {draw} d = lobe_{kernel}_draw(s, u1, u2, u3);                   // d.pdf = 0: rejected, black
 *     float p = lobe_{kernel}_pdf(s, lobe_{family}_pair_of_wo(g, wo)); // at a wo that leaves
"""


def family_of(kernel):
    """The distribution and masking that a kernel samples: lib/models.h names them."""
    return kernel.split("_")[0] + ("_vcavity" if "_vcavity" in kernel else "")


C_GUARD = ("#ifndef LOBE_DROPIN_H\n#define LOBE_DROPIN_H\n\n#include <stdbool.h>\n"
           "#include <stdint.h>\n#include <string.h>\n\n" + INLINE, "\n#endif\n")


def use(kernel, family):
    """Five lines that show how to call a kernel."""
    return USE.format(v3="lobe_v3", options="lobe_facet_options", base=f"lobe_{family}_base",
                      state=f"lobe_{kernel}", draw="lobe_facet_draw", family=family, kernel=kernel)


def head(title, kernel, family):
    """The comment that a file begins with."""
    version = re.search(r'"([^"]+)"', (ROOT / "include/lobe/version.h").read_text())[1]
    return (f"/* {title}.\n *\n * Generated by lobe {version} (tools/dropin.py) from its kernels; MIT "
            "licence. Single precision.\n * Local frame, z = shading normal; wi toward the viewer, wo "
            "the reflected direction, both away\n * from the surface; alpha = perceptual roughness "
            "squared; u in [0, 1).\n" + use(kernel, family) + " */\n")


def single_file(language, kernels, title):
    """The text of the file."""
    text = binding(language)
    for name in in_order([kernel + ".h" for kernel in kernels]):
        text += "\n" + without_guard((KERNEL / name).read_text())
    text = prefixed(plain(settle(text), language))
    text = re.sub(r"\n{3,}", "\n\n", text).strip() + "\n"
    before, after = "", ""
    if language == "c":
        text = re.sub("^static inline ", "LOBE_INLINE ", text, flags=re.M)
        before, after = C_GUARD
    return head(title, kernels[0], family_of(kernels[0])) + before + text + after


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("language", choices=[*sorted(BINDING), "pass", "hlsl-pass"])
    parser.add_argument("kernels", nargs="+", metavar="KERNEL", help="as ggx_bounded; of pass: files of the tree")
    parser.add_argument("--define", action="append", default=[], metavar="NAME=TEXT",
                        help="words before the files of pass")
    parser.add_argument("--title", default="", help="first line of the file's comment")
    arguments = parser.parse_args()
    if arguments.language.endswith("pass"):
        defines = [definition.split("=", 1) for definition in arguments.define]
        language = "hlsl" if arguments.language == "hlsl-pass" else "glsl"
        sys.stdout.write(flattened(arguments.kernels, defines, language))
        return
    title = arguments.title or " ".join(arguments.kernels)
    sys.stdout.write(single_file(arguments.language, arguments.kernels, title))


if __name__ == "__main__":
    main()
