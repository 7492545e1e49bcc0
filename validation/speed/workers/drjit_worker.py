"""Dr.Jit alone, in double precision: the formula in a few lines, compiled by LLVM for all pixels at once."""

import drjit as dr
import numpy as np
from drjit.llvm import Array3f64, Float64, UInt32

import files


def brightness(columns, rows, scene, lights):
    """The image as one array. `lights` holds x, y, z and the intensity of each light, one after the other."""
    (width, height), (half_x, half_y) = scene["resolution"], scene["half_window"]
    center = Array3f64(*scene["center"])
    ray = Array3f64(
        (2 * (Float64(columns) + 0.5) / width - 1) * half_x,
        (1 - 2 * (Float64(rows) + 0.5) / height) * half_y,
        scene["screen_distance"],
    )
    squared, along = dr.squared_norm(ray), dr.dot(ray, center)
    discriminant = along * along - squared * (dr.squared_norm(center) - scene["radius"] ** 2)
    is_hit = discriminant > 0
    point = ray * ((along - dr.sqrt(discriminant)) / squared)
    normal = (point - center) / scene["radius"]
    view = -ray * dr.rsqrt(squared)
    cos_o = dr.dot(normal, view)

    def term(light):
        place = light * 4
        take = lambda offset: dr.gather(Float64, lights, place + offset, is_hit)
        to_light = Array3f64(take(0), take(1), take(2)) - point
        inverse_squared = dr.rcp(dr.squared_norm(to_light))
        direction = to_light * dr.sqrt(inverse_squared)
        cos_i = dr.maximum(dr.dot(normal, direction), 0)
        # ‖L + V‖² = 2 + 2 L·V; a whole power is a chain of multiplications.
        cos_h_squared = dr.square(cos_i + cos_o) / (2 + 2 * dr.dot(direction, view))
        lobe = dr.power(cos_h_squared, scene["shininess"] // 2)
        return take(3) * cos_i * inverse_squared * (scene["diffuse"] * cos_o + scene["specular"] * lobe)

    count = len(scene["lights"])
    if count == 1:
        return dr.select(is_hit, term(UInt32(0)), 0)
    # A loop in the kernel; lanes without a hit take no part in it.
    _, total = dr.while_loop(
        state=(UInt32(0), Float64(0)),
        cond=lambda light, total: (light < count) & is_hit,
        body=lambda light, total: (light + 1, total + term(light)),
    )
    return total


class DrJit:
    def load(self, scene):
        self.width, self.height = scene["resolution"]
        self.lights = Float64(np.array(scene["lights"], np.float64).ravel())
        self.index = dr.arange(UInt32, self.width * self.height)
        dr.make_opaque(self.lights, self.index)

        # Frozen, the kernel is started again without being traced in Python again.
        @dr.freeze
        def image(index, lights):
            row = index // self.width
            return brightness(index - row * self.width, row, scene, lights)

        self.image = image

    def render(self):
        image = self.image(self.index, self.lights)
        dr.eval(image)
        dr.sync_thread()
        return image

    def brightness(self, image):
        return np.array(image).reshape(self.height, self.width)

    def save(self, image, path):
        files.save(self.brightness(image), path)
