"""Mitsuba 3 on scenes of any shapes, plain diffuse: its `direct` integrator, or a script of primary and shadow rays."""

import drjit as dr
import mitsuba as mi
import numpy as np


class SceneMitsuba:
    def __init__(self, variant, is_script):
        mi.set_variant(variant)
        mi.set_log_level(mi.LogLevel.Error)
        self.is_scalar, self.is_script = variant.startswith("scalar"), is_script

    def load(self, scene):
        self.size, self.lights, self.diffuse = scene["resolution"], scene["lights"], scene["diffuse"]
        (width, height), eye, count = self.size, scene["eye"], len(self.lights)
        ahead = [eye[0], eye[1], eye[2] - 1]
        description = {
            "type": "scene",
            "integrator": {"type": "direct", "emitter_samples": count, "bsdf_samples": 0},
            "sensor": {
                "type": "perspective",
                "fov": 2 * np.degrees(np.arctan(scene["half_window"][0])),
                "fov_axis": "x",
                "to_world": mi.ScalarTransform4f().look_at(origin=eye, target=ahead, up=[0, 1, 0]),
                # Samples without jitter all pick the same light.
                "sampler": {"type": "independent"} if count > 1 else {"type": "stratified", "jitter": False},
                "film": {
                    "type": "hdrfilm",
                    "width": width,
                    "height": height,
                    "pixel_format": "luminance",
                    "component_format": "float32",
                    "rfilter": {"type": "box"},
                },
            },
            "clay": {"type": "diffuse", "reflectance": self.diffuse},
        }
        if any(shape["kind"] == "ellipsoid" for shape in scene["shapes"]):
            ball = {"type": "sphere", "bsdf": {"type": "ref", "id": "clay"}}
            description["ball"] = {"type": "shapegroup", "ball": ball}
        for shape in scene["shapes"]:
            for part in _parts(shape, scene["folder"]):
                description[f"shape{len(description)}"] = part
        for index, (x, y, z, intensity) in enumerate(self.lights):
            description[f"light{index}"] = {"type": "point", "position": [x, y, z], "intensity": intensity}
        self.scene = mi.load_dict(description)

    def render(self):
        image = self._script() if self.is_script else mi.render(self.scene, spp=1)
        if not self.is_scalar:
            dr.eval(image)
            dr.sync_thread()
        return image

    def _script(self):
        """A ray through the middle of each pixel, then one from what it meets to each light."""
        width, height = self.size
        index = dr.arange(mi.UInt32, width * height)
        row = index // width
        middle = mi.Point2f((mi.Float(index - row * width) + 0.5) / width, (mi.Float(row) + 0.5) / height)
        ray, _ = self.scene.sensors()[0].sample_ray(0, 0, middle, mi.Point2f(0.5))
        si = self.scene.ray_intersect(ray)
        total = mi.Float(0)
        for x, y, z, intensity in self.lights:
            place = mi.Point3f(x, y, z)
            to_light = place - si.p
            squared = dr.squared_norm(to_light)
            cosine = dr.dot(si.sh_frame.n, to_light) * dr.rsqrt(squared)
            is_lit = si.is_valid() & (cosine > 0)
            is_blocked = self.scene.ray_test(si.spawn_ray_to(place), is_lit)
            total += dr.select(is_lit & ~is_blocked, intensity * cosine / squared, 0)
        return total * (self.diffuse / dr.pi)

    def brightness(self, image):
        width, height = self.size
        # Each of several samples of point lights counts in full in the direct integrator's sum, where it should count
        # as their mean.
        return np.array(image).reshape(height, width) / (1 if self.is_script else len(self.lights))

    def save(self, image, path):
        mi.Bitmap(self.brightness(image).astype(np.float32)[..., None]).write(path)


def _parts(shape, folder):
    """A shape as Mitsuba has it: its cylinders have no ends, its spheres cannot be stretched but in an instance."""
    transform, clay = mi.ScalarTransform4f, {"type": "ref", "id": "clay"}
    match shape["kind"]:
        case "mesh":
            # Without normals in the file it would make smooth ones.
            is_flat = shape["file"] == "flat.obj"
            yield {"type": "obj", "filename": f"{folder}/{shape['file']}", "face_normals": is_flat, "bsdf": clay}
        case "box":
            half = [side / 2 for side in shape["size"]]
            yield {"type": "cube", "to_world": transform().translate(shape["center"]).scale(half), "bsdf": clay}
        case "cylinder":
            start, end, radius = shape["from"], shape["to"], shape["radius"]
            yield {"type": "cylinder", "p0": start, "p1": end, "radius": radius, "bsdf": clay}
            for here, there in ((start, end), (end, start)):
                away = [2 * a - b for a, b in zip(here, there)]
                looking = transform().look_at(origin=here, target=away, up=[0, 0, 1])
                yield {"type": "disk", "to_world": looking.scale(radius), "bsdf": clay}
        case "sphere":
            yield {"type": "sphere", "center": shape["center"], "radius": shape["radius"], "bsdf": clay}
        case "ellipsoid":
            stretched = transform().translate(shape["center"]).scale(shape["radii"])
            yield {"type": "instance", "to_world": stretched, "shapegroup": {"type": "ref", "id": "ball"}}
        case "plane":
            above = [a + b for a, b in zip(shape["point"], shape["normal"])]
            looking = transform().look_at(origin=shape["point"], target=above, up=[0, 0, 1])
            yield {"type": "rectangle", "to_world": looking.scale(1e4), "bsdf": clay}
