"""A folder of results made up for the tests of what reads one (tools/python/), and a test case that has such a folder."""

import sys
import unittest
from importlib.util import find_spec
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools" / "python"))

import line_folder  # noqa: E402
from fixdem import FixdemError, Run  # noqa: E402
from with_folder import WithFolder  # noqa: E402

LINE = line_folder.Line(duration=1.0)
FRAME = line_folder.particles(LINE)[3][1]
CONTACTS = [(0, 7, (0.0, 0.1, 0.2), (0.0, 0.2, 0.2), (0.0, 3.0, 4.0)), (7, -1, (0.1, 0.0, 0.3), (0.1, -0.1, 0.3), (1.0, 0.0, 0.0))]
needs_numpy = unittest.skipUnless(find_spec("numpy"), "this Python has no NumPy")


def list_of(name, times):
    sets = "".join(f'<DataSet timestep="{time}" part="0" file="{name}s/{name}_{k:06}.vtp"/>' for k, time in enumerate(times))
    return f'<?xml version="1.0"?>\n<VTKFile type="Collection"><Collection>{sets}</Collection></VTKFile>'


class WithRun(WithFolder):
    def refuses(self, action, *words):
        with self.assertRaises(FixdemError) as said:
            action()
        for word in words:
            self.assertIn(str(word), str(said.exception))

    def file(self, name, data):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(data)
        return path

    def line(self, frames=True):
        return Run(line_folder.write_line(self.folder / "run", LINE, frames=frames))

    def with_contacts(self, **how):
        for k in range(3):
            self.file(f"contacts/contact_{k:06}.vtp", line_folder.contact_bytes(CONTACTS[:k], 100 * k, **how))
        self.write("contacts.pvd", list_of("contact", (0, 0.1, 0.2)))
        return Run(self.folder)
