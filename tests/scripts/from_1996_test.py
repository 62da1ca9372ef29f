#!/usr/bin/env python3
"""Every file or folder of the tree that docs/from-1996.md names exists. A name may leave out .hpp or hold a *."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOP = "config|databuffer|display|docs|examples|inputmonitor|lib|model|scripts|shm|statemachine|tests|tools"
text = (ROOT / "docs/from-1996.md").read_text(encoding="utf-8")
names = sorted(set(re.findall(rf"(?<![\w/])((?:{TOP})/[\w./*-]*[\w*/])", text)))
missing = [name for name in names if not any(any(ROOT.glob(name.rstrip("/") + end)) for end in ("", ".hpp"))]
print(f"docs/from-1996.md: {len(names)} names", *(f"missing: {name}" for name in missing), sep="\n")
sys.exit(1 if missing or len(names) < 50 else 0)
