#!/usr/bin/env python3
"""check_includes.py [ROOT]: fail on an #include that the rooms do not allow.

The rule: a room may include its own files, system headers, and what stands beside its name below. A room
inside another one (ssr/passes: shaders; render/rows: vectors) may be included by that one, and goes by its own row.
include/, kernel/ and lib/ depend on no external library and not on <math.h>; of them a kernel file
outside kernel/bind/ includes no system header at all, for the binding does.
"""
import re
import sys
from pathlib import Path

MAY_INCLUDE = {
    "include": set(),
    "kernel": set(),
    "lib": {"include", "kernel"},
    "verify": {"include"},
    "metrics": {"include"},
    "exr": set(),
    "render": {"include", "exr"},
    "render/rows": {"kernel", "render"},
    "ssr": {"include", "exr"},
    "ssr/passes": {"kernel"},
    "ssr/shaders": {"kernel", "ssr/passes"},
    "app": {"include"},
    "bindings": {"include"},
    "examples": {"include"},
    "bench": {"include"},
    "figure": {"include"},
    "explore": {"include"},
    "tests": None,  # everything
}
FREESTANDING = {"float.h", "limits.h", "stdbool.h", "stddef.h", "stdint.h"}
SYSTEM_HEADERS = {  # of the rooms that are choosy
    "include": FREESTANDING | {"signal.h"},  # sig_atomic_t
    "kernel": FREESTANDING | {"string.h"},  # memcpy, in the bindings
    "ssr/passes": set(),
    "ssr/shaders": set(),
    "lib": FREESTANDING | {"assert.h", "stdatomic.h", "stdlib.h", "string.h", "immintrin.h", "arm_neon.h"},
}
SUFFIXES = {".c", ".cpp", ".h", ".inc", ".glsl", ".hlsl", ".comp", ".cu"}
INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<([^>]+)>|(\S.*))')


def resolve(root, path, name):
    """The file of the tree that the include names, or None for one from outside."""
    for base in (path.parent, root / "include", root / "kernel", root):
        candidate = (base / name).resolve()
        if candidate.is_file() and candidate.is_relative_to(root):
            return candidate.relative_to(root)
    return None


def room_of(path):
    """The innermost room of a path of the tree."""
    rooms = [room for room in MAY_INCLUDE if path.is_relative_to(room)]
    return max(rooms, key=len, default=path.parts[0])


def complaint(root, path, room, name, quoted):
    """What is wrong with this include, or None."""
    target = resolve(root, path, name)
    if target is not None:
        other = room_of(target)
        allowed = MAY_INCLUDE[room]
        if allowed is None or other in allowed or Path(other).is_relative_to(room):
            return None
        return f"{room}/ may not include {other}/"
    if quoted:
        return "no such file in the tree"
    if room == "kernel" and path.parent.name != "bind":
        return "a kernel includes no system header; the binding does"
    if name not in SYSTEM_HEADERS.get(room, {name}):
        return f"{room}/ may not include <{name}>"
    return None


def check(root):
    """Number of files read, and the list of complaints."""
    count, errors = 0, []
    for room in MAY_INCLUDE:
        for path in sorted((root / room).rglob("*")):
            if path.suffix not in SUFFIXES or not path.is_file():
                continue
            if room_of(path.relative_to(root)) != room:
                continue
            count += 1
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                if not match or match[3]:  # an include through a macro names what -D gives
                    continue
                why = complaint(root, path, room, match[1] or match[2], match[1] is not None)
                if why:
                    errors.append(f"{path.relative_to(root)}:{number}: {line.strip()}: {why}")
    return count, errors


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    count, errors = check(root)
    for error in errors:
        print(error)
    print(f"includes: {count} files, {len(errors)} forbidden")
    return 1 if errors or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
