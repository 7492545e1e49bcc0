"""Mitsuba 3. One light: its own direct integrator, one sample through the middle of each pixel. More lights: Mitsuba's
integrators pick a light at random for each sample; in the LLVM variant an integrator of our own sums over all of them."""

import drjit as dr
import mitsuba as mi
import numpy as np

import files


def make_plugins() -> None:
    """Both classes exist only once a variant is chosen."""

    class BlinnPhong(mi.BSDF):
        """(3.3): k_d cosθ_o + k_s (N·H)ⁿ, times cosθ_i as Mitsuba wants it. For point lights, so nothing is sampled."""

        def __init__(self, properties):
            mi.BSDF.__init__(self, properties)
            self.diffuse, self.specular = properties["diffuse"], properties["specular"]
            # A whole power is a chain of multiplications.
            half = properties["shininess"] / 2
            self.half_shininess = int(half) if half.is_integer() else half
            flags = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
            self.m_components, self.m_flags = [flags], flags

        def eval(self, context, si, wo, active):
            cos_o, cos_i = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
            half_squared = 2 + 2 * dr.dot(si.wi, wo)
            lobe = dr.power(dr.square(cos_i + cos_o) / half_squared, self.half_shininess)
            value = (self.diffuse * cos_o + self.specular * lobe) * cos_i
            return mi.Spectrum(dr.select((cos_i > 0) & (cos_o > 0) & active, value, 0))

        def pdf(self, context, si, wo, active):
            return mi.Float(0)

        def eval_pdf(self, context, si, wo, active):
            return self.eval(context, si, wo, active), mi.Float(0)

        def sample(self, context, si, sample1, sample2, active):
            return dr.zeros(mi.BSDFSample3f), mi.Spectrum(0)

    class AllLights(mi.SamplingIntegrator):
        """The sum over all lights: the number that picks a light runs through them. Without shadows, as the formula."""

        def sample(self, scene, sampler, ray, medium=None, active=True):
            si = scene.ray_intersect(ray, active)
            bsdf, context, count = si.bsdf(ray), mi.BSDFContext(), len(scene.emitters())

            def add(index, total):
                pick = mi.Point2f((mi.Float(index) + 0.5) / count, 0.5)
                sample, weight = scene.sample_emitter_direction(si, pick, False, True)
                return index + 1, total + weight * bsdf.eval(context, si, si.to_local(sample.d), True) / count

            _, total = dr.while_loop(
                state=(mi.UInt32(0), mi.Spectrum(0)), cond=lambda index, _: (index < count) & si.is_valid(), body=add
            )
            return total, si.is_valid(), []

    mi.register_bsdf("blinn_phong", BlinnPhong)
    mi.register_integrator("all_lights", AllLights)


class Mitsuba:
    def __init__(self, variant, is_blinn):
        mi.set_variant(variant)
        mi.set_log_level(mi.LogLevel.Error)
        self.is_scalar, self.is_blinn = variant.startswith("scalar"), is_blinn
        if not self.is_scalar:
            make_plugins()

    def load(self, scene):
        (width, height), (half_x, half_y) = scene["resolution"], scene["half_window"]
        count = len(scene["lights"])
        transform = mi.ScalarTransform4f
        # Mitsuba's images are mirrored against the lab's.
        looking = transform().look_at(origin=[0, 0, 0], target=[0, 0, 1], up=[0, 1, 0])
        exact = count > 1 and not self.is_scalar
        # Samples without jitter all pick the same light, so that a sum by chance needs jitter, inside the pixel too.
        sampler = {"type": "stratified", "jitter": False} if exact or count == 1 else {"type": "independent"}
        direct = {"type": "direct", "emitter_samples": count, "bsdf_samples": 0}
        description = {
            "type": "scene",
            "integrator": {"type": "all_lights"} if exact else direct,
            "sensor": {
                "type": "perspective",
                "fov": 2 * np.degrees(np.arctan(half_x / scene["screen_distance"])),
                "fov_axis": "x",
                "to_world": looking @ transform().scale([-1, 1, 1]),
                "sampler": {**sampler, "sample_count": 1},
                "film": {
                    "type": "hdrfilm",
                    "width": width,
                    "height": height,
                    "pixel_format": "luminance",
                    "component_format": "float32",
                    "rfilter": {"type": "box"},
                },
            },
            "ball": {
                "type": "sphere",
                "center": scene["center"],
                "radius": scene["radius"],
                "bsdf": self._material(scene),
            },
        }
        for index, (x, y, z, intensity) in enumerate(scene["lights"]):
            description[f"light{index}"] = {"type": "point", "position": [x, y, z], "intensity": intensity}
        self.scene = mi.load_dict(description)
        # Each of several samples of point lights counts in full in the direct integrator's sum, where it should count
        # as their mean: the image comes out so many times too bright.
        # A diffuse surface of Mitsuba sends out k_d/π E; (3.2) is without π.
        self.scale = (1 if self.is_blinn else np.pi) / (1 if exact else count)

    def _material(self, scene):
        if self.is_blinn:
            return {"type": "blinn_phong", **{key: scene[key] for key in ("diffuse", "specular", "shininess")}}
        return {"type": "diffuse", "reflectance": scene["diffuse"]}

    def render(self):
        image = mi.render(self.scene, spp=1)
        if not self.is_scalar:
            dr.eval(image)
            dr.sync_thread()
        return image

    def brightness(self, image):
        return np.array(image)[:, :, 0] * self.scale

    def save(self, image, path):
        if path.endswith(".png"):
            files.save(self.brightness(image), path)
        else:
            mi.Bitmap(image).write(path)
