"""Radiance: `rtrace`, with a BRTDfunc that is formula (3.3). A point light is a small sphere of radiance I/(π r²)."""

import math
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pyradiance

PROGRAMS = Path(pyradiance.__file__).parent / "bin"
LAMP_RADIUS = 1e-3
# Exact sums over the lights, no random numbers anywhere, no interreflection; lamps are not seen.
OPTIONS = "-w- -ab 0 -dt 0 -dc 1 -dj 0 -dv-"

# D is the direction of the ray, from the eye; l the direction to the light.
FORMULA = """
along(lx,ly,lz) : Nx*(lx-Dx) + Ny*(ly-Dy) + Nz*(lz-Dz);
length2(lx,ly,lz) : (lx-Dx)*(lx-Dx) + (ly-Dy)*(ly-Dy) + (lz-Dz)*(lz-Dz);
cosine2(lx,ly,lz) : along(lx,ly,lz)*along(lx,ly,lz) / length2(lx,ly,lz);
brdf(lx,ly,lz,omega) = arg(10)*Rdot + arg(11)*cosine2(lx,ly,lz)^(arg(12)/2);
"""


def scene_text(scene, formula_file):
    """The scene as Radiance reads it."""
    x, y, z = scene["center"]
    material = f"{scene['diffuse']} {scene['specular']} {scene['shininess']}"
    parts = [
        f"void BRTDfunc clay\n10 0 0 0 0 0 0 brdf brdf brdf {formula_file}\n0\n12 0 0 0 0 0 0 0 0 0 {material}\n",
        f"clay sphere ball\n0\n0\n4 {x} {y} {z} {scene['radius']}\n",
    ]
    for index, (x, y, z, intensity) in enumerate(scene["lights"]):
        radiance = intensity / (math.pi * LAMP_RADIUS**2)
        parts.append(f"void light lamp{index}\n0\n0\n3 {radiance} {radiance} {radiance}\n")
        parts.append(f"lamp{index} sphere bulb{index}\n0\n0\n4 {x} {y} {z} {LAMP_RADIUS}\n")
    return "".join(parts)


def write_scene(scene, folder):
    (folder / "lab.cal").write_text(FORMULA)
    (folder / "scene.rad").write_text(scene_text(scene, "lab.cal"))


class Radiance:
    """Everything is ready before the time counts but the process itself: it has no way to stay between two images."""

    def __init__(self, processes):
        self.options = [*OPTIONS.split(), "-n", str(processes)]
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)

    def load(self, scene):
        self.scene, self.size = scene, scene["resolution"]
        width, height = self.size
        half_x, half_y = scene["half_window"]
        write_scene(scene, self.folder)
        octree = self._run([PROGRAMS / "oconv", "scene.rad"])
        (self.folder / "scene.oct").write_bytes(octree)
        rays = np.zeros((height, width, 6), np.float32)
        rays[..., 3] = (2 * (np.arange(width) + 0.5) / width - 1) * half_x
        rays[..., 4] = ((1 - 2 * (np.arange(height) + 0.5) / height) * half_y)[:, None]
        rays[..., 5] = scene["screen_distance"]
        rays.tofile(self.folder / "rays")

    def _run(self, command, **streams):
        environment = {**os.environ, "RAYPATH": f"{self.folder}:{PROGRAMS.parent / 'lib'}"}
        done = subprocess.run(
            [str(part) for part in command], cwd=self.folder, env=environment, stdout=subprocess.PIPE, check=True, **streams
        )
        return done.stdout

    def render(self):
        with open(self.folder / "rays", "rb") as rays:
            return self._run([PROGRAMS / "rtrace", "-h", *self.options, "-fff", "-ov", "scene.oct"], stdin=rays)

    def brightness(self, image):
        width, height = self.size
        return np.frombuffer(image, np.float32).reshape(height, width, 3)[:, :, 0]

    def command(self, image):
        """Its own pipe for a picture; the picture is mirrored against the lab's, which costs the same."""
        (width, height), distance = self.size, self.scene["screen_distance"]
        across, up = (2 * math.degrees(math.atan(half / distance)) for half in self.scene["half_window"])
        view = f"-vtv -vp 0 0 0 -vd 0 0 1 -vu 0 1 0 -vh {across} -vv {up} -pa 0 -x {width} -y {height}"
        return (
            f"cd {self.folder} && export RAYPATH={self.folder}:{PROGRAMS.parent / 'lib'} && "
            f"{PROGRAMS}/oconv scene.rad > cold.oct && {PROGRAMS}/vwrays -ff {view} | "
            f"{PROGRAMS}/rtrace -ffc -x {width} -y {height} {' '.join(self.options)} cold.oct > {image}"
        )
