"""Numba, tuned for this very scene: what somebody gets out of it who knows the machine.

Over the expert's program: nothing is traced outside the silhouette, whose ends are solved for in each row; n is a
constant of the compiled kernel, a chain of multiplications; the loop over the pixels of a row is the inner one, without
branches, so that the compiler turns it into vector instructions; single precision puts twice as many into one.
"""

from math import sqrt

import numpy as np
from numba import njit, prange

import files


def kernel(number, shininess):
    """The kernel for a number type and an n. A Python float in its loops would turn single precision into double."""
    if shininess % 2:
        raise ValueError(f"n is {shininess}: this kernel is for even n")
    chain, zero, one, two = shininess // 2, number(0), number(1), number(2)

    @njit(fastmath=True, inline="always")
    def term(x, y, z, t, inverse, cx, cy, cz, inverse_radius, sx, sy, sz, intensity, kd, ks):
        px, py, pz = x * t, y * t, z * t
        nx, ny, nz = (px - cx) * inverse_radius, (py - cy) * inverse_radius, (pz - cz) * inverse_radius
        cos_o = -(nx * x + ny * y + nz * z) * inverse
        lx, ly, lz = sx - px, sy - py, sz - pz
        nearness_squared = one / (lx * lx + ly * ly + lz * lz)
        nearness = sqrt(nearness_squared)
        cos_i = max((nx * lx + ny * ly + nz * lz) * nearness, zero)
        # ‖L + V‖² = 2 + 2 L·V, so H needs no components, and its square no root.
        along = cos_i + cos_o
        lobe = (along * along / (two - two * (lx * x + ly * y + lz * z) * (nearness * inverse))) ** chain
        return intensity * cos_i * nearness_squared * (kd * cos_o + ks * lobe)

    @njit(parallel=True, fastmath=True, cache=True)
    def render(image, half_x, half_y, distance, center, radius, diffuse, specular, lights):
        height, width = image.shape
        beyond = center[0] ** 2 + center[1] ** 2 + center[2] ** 2 - radius**2
        quadratic = center[0] ** 2 - beyond
        cx, cy, cz, z = number(center[0]), number(center[1]), number(center[2]), number(distance)
        kd, ks, inverse_radius = number(diffuse), number(specular), number(1 / radius)
        left, pitch = number((1.0 / width - 1) * half_x), number(2 * half_x / width)
        for row in prange(height):
            line = image[row]
            # disc(x) = quadratic x² + 2 linear x + constant, and first and last are its roots, in double precision:
            # their product keeps the digits at the limb that the difference would lose in single precision.
            y64 = (1 - 2 * (row + 0.5) / height) * half_y
            along = y64 * center[1] + distance * center[2]
            linear, constant = center[0] * along, along**2 - (y64**2 + distance**2) * beyond
            discriminant = linear**2 - quadratic * constant
            begin = end = 0
            first = last = 0.0
            if discriminant > 0:
                first = (-linear + sqrt(discriminant)) / quadratic
                last = (-linear - sqrt(discriminant)) / quadratic
                begin = min(max(int(np.ceil((first / half_x + 1) * width / 2 - 0.5)), 0), width)
                end = min(max(int(np.floor((last / half_x + 1) * width / 2 - 0.5)) + 1, begin), width)
            line[:begin] = zero
            line[end:] = zero
            y, along32, rest = number(y64), number(along), number(y64**2 + distance**2)
            xa, xb, q = number(first), number(last), number(-quadratic)
            if lights.shape[0] == 1:
                sx, sy, sz, intensity = lights[0, 0], lights[0, 1], lights[0, 2], lights[0, 3]
                for column in range(begin, end):
                    x = left + number(column) * pitch
                    squared = x * x + rest
                    t = (x * cx + along32 - sqrt(max((x - xa) * (xb - x) * q, zero))) / squared
                    inverse = one / sqrt(squared)
                    line[column] = term(
                        x, y, z, t, inverse, cx, cy, cz, inverse_radius, sx, sy, sz, intensity, kd, ks
                    )
                continue
            ts, inverses = np.empty(width, image.dtype), np.empty(width, image.dtype)
            for column in range(begin, end):
                x = left + number(column) * pitch
                squared = x * x + rest
                ts[column] = (x * cx + along32 - sqrt(max((x - xa) * (xb - x) * q, zero))) / squared
                inverses[column] = one / sqrt(squared)
                line[column] = zero
            for light in range(lights.shape[0]):
                sx, sy, sz, intensity = lights[light, 0], lights[light, 1], lights[light, 2], lights[light, 3]
                for column in range(begin, end):
                    x = left + number(column) * pitch
                    line[column] += term(
                        x, y, z, ts[column], inverses[column], cx, cy, cz, inverse_radius, sx, sy, sz, intensity, kd, ks
                    )

    return render


class TunedNumba:
    """`number` is np.float64 or np.float32. With `reuse`, every image is written into the memory of the one before."""

    def __init__(self, number, reuse=False):
        self.number, self.reuse = number, reuse

    def load(self, scene):
        (width, height), (half_x, half_y) = scene["resolution"], scene["half_window"]
        material = (scene["diffuse"], scene["specular"])
        window = (half_x, half_y, scene["screen_distance"])
        lights = np.array(scene["lights"], self.number)
        self.kernel = kernel(self.number, scene["shininess"])
        self.arguments = (*window, tuple(scene["center"]), scene["radius"], *material, lights)
        self.shape = (height, width)
        self.kept = np.empty(self.shape, self.number)

    def render(self):
        image = self.kept if self.reuse else np.empty(self.shape, self.number)
        self.kernel(image, *self.arguments)
        return image

    def brightness(self, image):
        return image

    def save(self, image, path):
        files.save(image, path)
