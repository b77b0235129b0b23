#!/usr/bin/env python3
"""files.py: the drop-in file of every model in every language, as tools/dropin.py writes it: JSON."""
import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["LOBE_SOURCE_DIR"]) / "web"))
import kernels  # noqa: E402

files = {}
for kernel in kernels.models():
    for language in kernels.dropin.BINDING:
        files[f"{language} {kernel}"] = kernels.dropin.single_file(language, [kernel], kernel)
json.dump(files, sys.stdout)
