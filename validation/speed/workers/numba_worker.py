"""Numba, as an expert writes it: compiled, both threads, relaxed arithmetic, one loop over the pixels, general n."""

from math import sqrt

import numpy as np
from numba import njit, prange

import files


@njit(parallel=True, fastmath=True, cache=True)
def render(width, height, half_x, half_y, distance, center, radius, diffuse, specular, shininess, lights):
    image = np.zeros((height, width))
    cx, cy, cz = center
    beyond = cx * cx + cy * cy + cz * cz - radius * radius
    for row in prange(height):
        y = (1 - 2 * (row + 0.5) / height) * half_y
        for column in range(width):
            x = (2 * (column + 0.5) / width - 1) * half_x
            squared = x * x + y * y + distance * distance
            along = x * cx + y * cy + distance * cz
            discriminant = along * along - squared * beyond
            if discriminant <= 0:
                continue
            t = (along - sqrt(discriminant)) / squared
            px, py, pz = x * t, y * t, distance * t
            nx, ny, nz = (px - cx) / radius, (py - cy) / radius, (pz - cz) / radius
            scale = -1 / sqrt(squared)
            vx, vy, vz = x * scale, y * scale, distance * scale
            cos_o = nx * vx + ny * vy + nz * vz
            total = 0.0
            for light in range(lights.shape[0]):
                lx, ly, lz = lights[light, 0] - px, lights[light, 1] - py, lights[light, 2] - pz
                inverse_squared = 1 / (lx * lx + ly * ly + lz * lz)
                inverse = sqrt(inverse_squared)
                cos_i = (nx * lx + ny * ly + nz * lz) * inverse
                if cos_i <= 0:
                    continue
                # ‖L + V‖² = 2 + 2 L·V, so H needs no components.
                half_squared = 2 + 2 * (lx * vx + ly * vy + lz * vz) * inverse
                cos_h = (cos_i + cos_o) / sqrt(half_squared)
                factor = diffuse * cos_o + specular * cos_h**shininess
                total += lights[light, 3] * cos_i * inverse_squared * factor
            image[row, column] = total
    return image


class Numba:
    def load(self, scene):
        (width, height), (half_x, half_y) = scene["resolution"], scene["half_window"]
        material = (scene["diffuse"], scene["specular"], float(scene["shininess"]))
        window = (width, height, half_x, half_y, scene["screen_distance"])
        self.arguments = (*window, tuple(scene["center"]), scene["radius"], *material, np.array(scene["lights"]))

    def render(self):
        return render(*self.arguments)

    def brightness(self, image):
        return image

    def save(self, image, path):
        files.save(image, path)
