#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Length and bounds of a program's feed moves as LinuxCNC's own interpreter reads it, in mm.

This is how the numbers in gcode_real_files_test.cpp and gcode_compensation_test.cpp were made, with Debian's
linuxcnc-uspace 2.9.0~pre1 and its python3-module `gcode`:

    rs274_path.py PROGRAM [-d] [TOOL:DIAMETER_MM ...]

-d lists every move. The interpreter crashes on G43 and M6 without a machine: delete those words first.
"""
import math
import os
import sys
import tempfile

sys.path.insert(0, "/usr/lib/python3/dist-packages")
import gcode  # noqa: E402
from rs274.interpret import Translated  # noqa: E402

MM = 25.4  # the module counts in inches
PLANES = {1: (0, 1, 2), 2: (1, 2, 0), 3: (2, 0, 1)}  # XY, YZ, XZ: first, second and normal axis
STEPS = 720  # per turn, for the bounds of arcs


class Canon(Translated):
    """Collects moves: (kind, line, start, end, length, points for the bounds)."""

    def __init__(self, tools):
        self.at, self.moves, self.line, self.plane, self.tools = (0.0, 0.0, 0.0), [], 0, 1, tools
        self.parameter_file = os.path.join(tempfile.mkdtemp(), "rs274.var")
        open(self.parameter_file, "w").close()

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *args: None

    def set_xy_rotation(self, degrees):
        self.rotation_xy = degrees
        self.rotation_cos, self.rotation_sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))

    def next_line(self, state):
        self.line = state.sequence_number

    def set_plane(self, plane):
        self.plane = plane

    def get_tool(self, number):
        diameter = self.tools.get(number, 0.0) / MM
        return (number,) + (0.0,) * 9 + (diameter, 0.0, 0.0, 0)

    def get_external_angular_units(self):
        return 1.0

    def get_external_length_units(self):
        return 1 / MM

    def get_axis_mask(self):
        return 7

    def get_block_delete(self):
        return True

    def check_abort(self):
        return False

    def add(self, kind, end, length, points):
        self.moves.append((kind, self.line, self.at, end, length, [self.at] + points))
        self.at = end

    def straight_traverse_translated(self, x, y, z, *rest):
        self.add("rapid", (x, y, z), math.dist(self.at, (x, y, z)), [(x, y, z)])

    def straight_feed_translated(self, x, y, z, *rest):
        self.add("line", (x, y, z), math.dist(self.at, (x, y, z)), [(x, y, z)])

    def arc_feed(self, u1, v1, cu, cv, turns, w1, *rest):
        axes = PLANES[self.plane]

        def place(u, v, w):
            p = [0.0, 0.0, 0.0]
            p[axes[0]], p[axes[1]], p[axes[2]] = u, v, w
            return self.rotate_and_translate(*p, 0, 0, 0, 0, 0, 0)[:3]

        start = self.untranslated(self.at)
        u0, v0, w0 = (start[axis] for axis in axes)
        radius, angle = math.hypot(u0 - cu, v0 - cv), math.atan2(v0 - cv, u0 - cu)
        turn = math.atan2(v1 - cv, u1 - cu) - angle
        if turns > 0:
            while turn <= 1e-12:
                turn += 2 * math.pi
            turn += 2 * math.pi * (turns - 1)
        else:
            while turn >= -1e-12:
                turn -= 2 * math.pi
            turn += 2 * math.pi * (turns + 1)
        n = STEPS * max(1, math.ceil(abs(turn) / (2 * math.pi)))
        points = [
            place(cu + radius * math.cos(angle + turn * i / n), cv + radius * math.sin(angle + turn * i / n),
                  w0 + (w1 - w0) * i / n)
            for i in range(n)
        ]
        end = place(u1, v1, w1)
        self.add("arc", end, math.hypot(radius * turn, w1 - w0), points + [end])

    def untranslated(self, p):
        x, y, z = p[0] - self.g5x_offset_x, p[1] - self.g5x_offset_y, p[2] - self.g5x_offset_z
        if self.rotation_xy:
            c, s = self.rotation_cos, self.rotation_sin
            x, y = x * c + y * s, y * c - x * s
        return x - self.g92_offset_x, y - self.g92_offset_y, z - self.g92_offset_z


def main():
    arguments = [a for a in sys.argv[1:] if a != "-d"]
    tools = {int(n): float(d) for n, d in (a.split(":") for a in arguments[1:])}
    canon = Canon(tools)
    result, line = gcode.parse(arguments[0], canon, "G21", "")[:2]
    if result > gcode.MIN_ERROR:
        print("refused at line", line, gcode.strerror(result))
        return 2
    feed, count, low, high = 0.0, 0, [math.inf] * 3, [-math.inf] * 3
    for kind, line, start, end, length, points in canon.moves:
        if "-d" in sys.argv:
            print(kind, line, *("%.6f" % (MM * v) for v in end), "%.6f" % (MM * length))
        if kind == "rapid" or length == 0:
            continue
        feed, count = feed + MM * length, count + 1
        for p in points:
            low = [min(a, MM * b) for a, b in zip(low, p)]
            high = [max(a, MM * b) for a, b in zip(high, p)]
    print("feed moves %d mm %.7f bounds" % (count, feed), *("%.6f" % v for v in low + high))
    return 0


if __name__ == "__main__":
    sys.exit(main())
