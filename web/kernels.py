#!/usr/bin/env python3
"""kernels.py FILE.gz: what dropin.js needs to write the drop-in file of every model in lobe/methods.h.

Each kernel file once, in the kernel language, with the words that each language binds: all drop-in files
together would have twenty times as many bytes.
"""
import gzip
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))
import dropin  # noqa: E402


def piece(name):
    source = (dropin.KERNEL / name).read_text()
    needs = [Path(inner).stem for inner in dropin.INCLUDE.findall(source)]
    return {"needs": needs, "text": dropin.settle(dropin.without_guard(source))}


def models():
    """The kernels of LOBE_MODELS."""
    text = (dropin.ROOT / "include/lobe/methods.h").read_text()
    return re.findall(r"^    X\([A-Z]+, [A-Z]+, [A-Z_]+, (\w+)\)", text, re.M)


def main():
    target = Path(sys.argv[1])
    files = dropin.in_order([name + ".h" for name in models()])
    pieces = {
        "head": dropin.head("@KERNEL@", "@KERNEL@", "@FAMILY@"),
        "guard": list(dropin.C_GUARD),
        "bindings": {language: dropin.settle(dropin.binding(language)) for language in dropin.BINDING},
        "kernels": {Path(name).stem: piece(name) for name in files},
    }
    packed = json.dumps(pieces, ensure_ascii=False, separators=(",", ":")).encode()
    target.write_bytes(gzip.compress(packed, 9, mtime=0))


if __name__ == "__main__":
    main()
