"""Pictures of spheres in a pipe, seen from the side (-x, z to the right, y up), as arrays of pixels.

A lit disc is worked out once for each size and stamped for each particle, the farthest first; colours by a value
between 0 and 1 in 256 steps, dark violet over green to yellow (tools/picture). Twice as fine as the picture that is wanted:
whoever shows it scales it down, which smooths the edges.
"""

import numpy as np
from picture import colour

FINER = 2
PAPER, PIPE, EDGE = (255, 255, 255), (236, 238, 239), (70, 76, 84)
COLOURS = np.array([[int(colour(k / 255)[i : i + 2], 16) for i in (1, 3, 5)] for k in range(256)], dtype=np.float32)


class Disc:
    """The pixels of a sphere around its centre, and how bright they are."""

    def __init__(self, r):
        reach = int(np.ceil(r))
        y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1].astype(np.float32)
        inside = x**2 + y**2 <= r**2
        self.dy, self.dx = y[inside].astype(int), x[inside].astype(int)
        facing = np.sqrt(np.maximum(0, 1 - (self.dx**2 + self.dy**2) / r**2))  # towards the eye
        light = 0.45 + 0.55 * np.maximum(0, (-0.305 * self.dx - 0.609 * self.dy) / r + 0.732 * facing)
        self.light = (light * np.clip(0.35 + 0.65 * facing / 0.35, 0, 1)).astype(np.float32)[:, None]  # with a dark rim


class Painter:
    """pipe: diameter, length, whether its ends are joined (m); radius: of all particles or of each (m); width: of the pipe in
    pixels of the final picture."""

    MOST_DISCS = 64  # of more sizes, those that differ by less than a quarter of a pixel share one

    def __init__(self, diameter, length, periodic, radius, width, margin=10):
        self.scale = FINER * width / length
        self.diameter, self.length, self.periodic = diameter, length, periodic
        self.margin = FINER * margin
        self.columns, self.rows = round(length * self.scale), round(diameter * self.scale)
        self.reach = float(np.max(radius))
        pixels = np.atleast_1d(radius) * self.scale
        if len(np.unique(pixels)) > self.MOST_DISCS:
            pixels = np.maximum(np.rint(4 * pixels) / 4, 0.25)
        self.sizes, self.disc_of = np.unique(pixels, return_inverse=True)
        self.discs = [Disc(r) for r in self.sizes]
        self.blank = self.background()

    def background(self):
        image = np.empty((self.rows + 2 * self.margin, self.columns + 2 * self.margin, 3), np.uint8)
        image[:] = PAPER
        m = self.margin
        image[m - 2 : m + self.rows + 2, m - 2 : m + self.columns + 2] = EDGE
        image[m : m + self.rows, m : m + self.columns] = PIPE
        return image

    def images(self, position):
        """Numbers of particles, and z: those across the joined ends twice."""
        numbers, z = np.arange(len(position)), position[:, 2]
        if not self.periodic:
            return numbers, z
        z = np.mod(z, self.length)
        low, high = numbers[z < self.reach], numbers[z > self.length - self.reach]
        return np.concatenate([numbers, low, high]), np.concatenate([z, z[low] + self.length, z[high] - self.length])

    def nearest_discs(self, radius):
        """For particles that come and go: of those in a picture."""
        between = (self.sizes[1:] + self.sizes[:-1]) / 2
        return np.searchsorted(between, np.asarray(radius) * self.scale)

    def paint(self, position, shares, radius=None):
        """position: particles x 3 (m); shares: 0 to 1, what each is coloured by; radius: of each, where they are not those of the
        beginning."""
        disc_of = self.disc_of if radius is None else self.nearest_discs(radius)
        image = self.blank.copy()
        view = image[self.margin : self.margin + self.rows, self.margin : self.margin + self.columns]
        numbers, z = self.images(position)
        order = np.argsort(-position[numbers, 0], kind="stable")
        column = np.rint(z[order] * self.scale).astype(int)
        row = np.rint((self.diameter / 2 - position[numbers[order], 1]) * self.scale).astype(int)
        tint = COLOURS[np.clip(shares[numbers[order]] * 255, 0, 255).astype(int)]
        for number, c, r, rgb in zip(numbers[order], column, row, tint):
            disc = self.discs[disc_of[number] if len(disc_of) > 1 else 0]
            rows, columns = r + disc.dy, c + disc.dx
            seen = (rows >= 0) & (rows < self.rows) & (columns >= 0) & (columns < self.columns)
            view[rows[seen], columns[seen]] = (disc.light[seen] * rgb).astype(np.uint8)
        return image
