"""POV-Ray, as plain Lambert (3.2): its highlight is (N·H)ⁿ without cosθ_i and cosθ_o, which is none of our formulas."""

import math
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np

# I/r² for every r that occurs: the fading 2/(1 + (r/ε)²) is 2ε²/r² beyond ε.
FADE_DISTANCE = 1e-4


def scene_text(scene, scale):
    """The scene as POV-Ray reads it: left-handed, as the lab's. `scale` keeps 16-bit pictures from clipping."""
    x, y, z = scene["center"]
    half_x, half_y = scene["half_window"]
    parts = [
        "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n",
        f"camera {{ location <0,0,0> direction <0,0,{scene['screen_distance']}> ",
        f"right <{2 * half_x},0,0> up <0,{2 * half_y},0> }}\n",
        f"sphere {{ <{x},{y},{z}>, {scene['radius']} pigment {{ rgb 1 }} ",
        f"finish {{ ambient 0 emission 0 diffuse {scene['diffuse']} }} }}\n",
    ]
    for x, y, z, intensity in scene["lights"]:
        color = scale * intensity / (2 * FADE_DISTANCE**2)
        parts.append(f"light_source {{ <{x},{y},{z}> rgb {color} shadowless ")
        parts.append(f"fade_distance {FADE_DISTANCE} fade_power 2 }}\n")
    return "".join(parts)


def bound(scene):
    """No value of the image is above this: every light straight above the point that is nearest to it."""
    nearest = lambda light: math.dist(light[:3], scene["center"]) - scene["radius"]
    return scene["diffuse"] * sum(light[3] / nearest(light) ** 2 for light in scene["lights"])


class PovRay:
    """Its time is that of the whole process: it has no way to stay between two images."""

    def __init__(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)

    def load(self, scene):
        self.size, self.scale = scene["resolution"], 1 / bound(scene)
        (self.folder / "scene.pov").write_text(scene_text(scene, self.scale))

    def render(self):
        subprocess.run(["sh", "-c", self.command("image.ppm")], stderr=subprocess.DEVNULL, check=True)
        return self.folder / "image.ppm"

    def command(self, image):
        width, height = self.size
        # Linear values, on two threads, no anti-aliasing, no window. Both of its formats for pictures have 16 bits here.
        kind = {"ppm": "+FP16", "png": "+FN16", "exr": "+FE"}[image.rsplit(".", 1)[1]]
        options = f"+W{width} +H{height} -A -D +WT2 {kind} File_Gamma=1.0 +O{image} +Iscene.pov"
        libraries, program = os.environ["SPEED_POVRAY_LIBRARIES"], os.environ["SPEED_POVRAY"]
        return f"cd {self.folder} && LD_LIBRARY_PATH={libraries} {program} {options} 2> /dev/null"

    def brightness(self, image):
        width, height = self.size
        data = image.read_bytes()
        values = np.frombuffer(data[-width * height * 6 :], ">u2").reshape(height, width, 3)
        return values[:, :, 0] / (65535 * self.scale)
