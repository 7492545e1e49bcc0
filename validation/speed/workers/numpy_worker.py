"""NumPy, vectorised: every step over all pixels that see the sphere; one pass a light."""

import numpy as np

import files


class NumPy:
    def load(self, scene):
        self.scene = scene
        self.lights = np.array(scene["lights"])

    def render(self):
        scene = self.scene
        (width, height), (half_x, half_y) = scene["resolution"], scene["half_window"]
        center = np.array(scene["center"])
        x = (2 * (np.arange(width) + 0.5) / width - 1) * half_x
        y = (1 - 2 * (np.arange(height) + 0.5) / height) * half_y
        distance = scene["screen_distance"]
        squared = x**2 + (y**2 + distance**2)[:, None]
        along = x * center[0] + (y * center[1] + distance * center[2])[:, None]
        discriminant = along**2 - squared * (center @ center - scene["radius"] ** 2)
        row, column = np.nonzero(discriminant > 0)

        squared, along = squared[row, column], along[row, column]
        t = (along - np.sqrt(discriminant[row, column])) / squared
        ray = np.stack([x[column], y[row], np.full(len(row), distance)])
        point = ray * t
        normal = (point - center[:, None]) / scene["radius"]
        view = ray / -np.sqrt(squared)
        image = np.zeros((height, width))
        image[row, column] = self._shade(point, normal, view)
        return image

    def _shade(self, point, normal, view):
        scene = self.scene
        cos_o = np.einsum("ij,ij->j", normal, view)
        brightness = np.zeros_like(cos_o)
        for *position, intensity in self.lights:
            to_light = np.array(position)[:, None] - point
            squared = np.einsum("ij,ij->j", to_light, to_light)
            to_light /= np.sqrt(squared)
            cos_i = np.maximum(np.einsum("ij,ij->j", normal, to_light), 0)
            half = to_light + view
            cos_h = np.einsum("ij,ij->j", normal, half) / np.sqrt(np.einsum("ij,ij->j", half, half))
            lobe = np.maximum(cos_h, 0) ** scene["shininess"]
            factor = scene["diffuse"] * cos_o + scene["specular"] * lobe
            brightness += intensity * cos_i / squared * factor
        return brightness

    def brightness(self, image):
        return image

    def save(self, image, path):
        files.save(image, path)
