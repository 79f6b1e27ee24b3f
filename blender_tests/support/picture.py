# SPDX-License-Identifier: GPL-3.0-or-later
"""Picture: linear float RGBA pixels, and the averages that the comparisons are made of."""
from array import array

from . import exr


class Picture:
    """width x height pixels; `rgba` is array('f') of 4 values a pixel, row 0 at the bottom.

    `layers` holds whatever channels the file had, by their names ("ViewLayer.Depth.Z").
    """

    def __init__(self, width, height, rgba, layers=None):
        if len(rgba) != 4 * width * height:
            raise ValueError(f"{len(rgba)} floats for {width} x {height} RGBA pixels")
        self.width = width
        self.height = height
        self.rgba = rgba
        self.layers = layers or {}

    @classmethod
    def from_exr(cls, path, layer=None):
        """Load `path`; of a multilayer file the Combined pass of `layer` (default: the first)."""
        width, height, channels, _ = exr.read_channels(path)
        prefix = ""
        if "R" not in channels:
            names = [name[:-len("R")] for name in channels if name.endswith(".Combined.R")]
            prefix = f"{layer}.Combined." if layer else names[0]
        rgba = array("f", bytes(16 * width * height))
        for index, name in enumerate("RGB"):
            rgba[index::4] = channels[prefix + name]
        alpha = channels.get(prefix + "A")
        rgba[3::4] = alpha if alpha is not None else array("f", [1.0]) * (width * height)
        return cls(width, height, rgba, channels)

    def pixel(self, x, y):
        """The four channels of pixel (x, y), y counted from the bottom."""
        start = 4 * (y * self.width + x)
        return tuple(self.rgba[start:start + 4])

    def mean(self, x0=0, y0=0, x1=None, y1=None):
        """Mean (r, g, b, a) of the rectangle [x0, x1) x [y0, y1)."""
        x1 = self.width if x1 is None else x1
        y1 = self.height if y1 is None else y1
        sums = [0.0] * 4
        for y in range(y0, y1):
            row = self.rgba[4 * (y * self.width + x0):4 * (y * self.width + x1)]
            for channel in range(4):
                sums[channel] += sum(row[channel::4])
        return tuple(value / ((x1 - x0) * (y1 - y0)) for value in sums)

    def block_means(self, size):
        """Means of size x size blocks from the bottom left, as a list of (x0, y0, (r, g, b, a)).

        Blocks cut by the right or top edge are smaller.
        """
        return [(x, y, self.mean(x, y, min(x + size, self.width), min(y + size, self.height)))
                for y in range(0, self.height, size) for x in range(0, self.width, size)]

    def average_with(self, others):
        """The mean picture of this one and `others`, all of one size."""
        pictures = [self, *others]
        rgba = array("f", (sum(values) / len(pictures)
                           for values in zip(*(p.rgba for p in pictures))))
        return Picture(self.width, self.height, rgba)

    def difference(self, other, gain=1.0):
        """|self - other| * gain with alpha 1, for looking at."""
        rgba = array("f", (abs(a - b) * gain for a, b in zip(self.rgba, other.rgba)))
        rgba[3::4] = array("f", [1.0]) * (self.width * self.height)
        return Picture(self.width, self.height, rgba)
