#!/usr/bin/env python3
"""Prints a case of an open line with another seed, of its random start and of its feed.

Usage: with_seed.py CASE.toml SEED. The program's option --seed changes the start alone.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "peers"))
from derived_cases import with_value


def with_seed(text, seed):
    return with_value(with_value(text, "feed", "seed", seed), "start", "seed", seed)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    sys.stdout.write(with_seed(Path(sys.argv[1]).read_text(), int(sys.argv[2])))
