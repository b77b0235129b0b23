#!/usr/bin/env python3
"""stage.py FOLDER LIST FILE...: the files of the explorer in one folder, and LIST with their names.

Modules lose their comments and indentation on the way: the whole page has to stay small.
"""
import re
import shutil
import sys
from pathlib import Path

LIMIT = 600_000  # bytes of all files together


def without_comments(text):
    """A module without lines that are comments only, and without indentation."""
    text = re.sub(r"^\s*/\*(?:(?!\*/).)*\*/[ \t]*\n", "", text, flags=re.M | re.S)
    lines = (line.strip() for line in text.splitlines())
    return "\n".join(line for line in lines if line and not line.startswith("//")) + "\n"


def main():
    folder, listing, files = Path(sys.argv[1]), Path(sys.argv[2]), [Path(f) for f in sys.argv[3:]]
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for file in files:
        target = folder / file.name
        if file.suffix in (".js", ".css"):
            target.write_text(without_comments(file.read_text()))
        else:
            shutil.copyfile(file, target)
    total = sum(f.stat().st_size for f in folder.iterdir())
    if total > LIMIT:
        sys.exit(f"stage.py: the page has {total} bytes, more than {LIMIT}")
    listing.write_text("".join(f"{file.name}\n" for file in sorted(folder.iterdir())))
    print(f"explorer: {len(files)} files, {total} bytes")


if __name__ == "__main__":
    main()
