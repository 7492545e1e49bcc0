"""Radiance on scenes of meshes, boxes and cylinders, plain diffuse; it has no ellipsoids and no infinite planes."""

import math

import numpy as np

from radiance_worker import LAMP_RADIUS, PROGRAMS, Radiance


class SceneRadiance(Radiance):
    def load(self, scene):
        self.size, eye, half_window = scene["resolution"], scene["eye"], scene["half_window"]
        diffuse = scene["diffuse"]
        parts = [f"void plastic clay\n0\n0\n5 {diffuse} {diffuse} {diffuse} 0 0\n"]
        for index, shape in enumerate(scene["shapes"]):
            parts.append(_shape_text(shape, f"shape{index}"))
        for index, (x, y, z, intensity) in enumerate(scene["lights"]):
            radiance = intensity / (math.pi * LAMP_RADIUS**2)
            parts.append(f"void light lamp{index}\n0\n0\n3 {radiance} {radiance} {radiance}\n")
            parts.append(f"lamp{index} sphere bulb{index}\n0\n0\n4 {x} {y} {z} {LAMP_RADIUS}\n")
        (self.folder / "scene.rad").write_text("".join(parts))
        across, up = (2 * math.degrees(math.atan(half)) for half in half_window)
        self.view = f"-vtv -vp {eye[0]} {eye[1]} {eye[2]} -vd 0 0 -1 -vu 0 1 0 -vh {across} -vv {up} -pa 0"
        self.meshes = "".join(
            f"{PROGRAMS}/obj2mesh {scene['folder']}/{shape['file']} {shape['file']}.rtm && "
            for shape in scene["shapes"]
            if shape["kind"] == "mesh"
        )

    def render(self):
        self._run(["sh", "-c", self.command("image.hdr")])
        return self.folder / "image.hdr"

    def brightness(self, image):
        width, height = self.size
        values = self._run([PROGRAMS / "pvalue", "-h", "-H", "-df", image])
        return np.frombuffer(values, np.float32).reshape(height, width, 3)[:, :, 0]

    def command(self, image):
        """From its own text to its own picture. It says how long the picture itself took."""
        width, height = self.size
        size = f"-x {width} -y {height}"
        return (
            f"cd {self.folder} && export RAYPATH=.:{PROGRAMS.parent / 'lib'} && "
            f"{self.meshes}{PROGRAMS}/oconv scene.rad > scene.oct && start=$(date +%s%N) && "
            f"{PROGRAMS}/vwrays -ff {self.view} {size} | "
            f"{PROGRAMS}/rtrace -ffc {size} {' '.join(self.options)} scene.oct > {image} && "
            'echo "Trace Time: $((($(date +%s%N) - start) / 1000)) microseconds" >&2'
        )


def _shape_text(shape, name):
    match shape["kind"]:
        case "mesh":
            return f"clay mesh {name}\n1 {shape['file']}.rtm\n0\n0\n"
        case "box":
            corners = [
                [c + (s if index >> axis & 1 else -s) / 2 for axis, (c, s) in enumerate(zip(shape["center"], shape["size"]))]
                for index in range(8)
            ]
            sides = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))
            return "".join(
                f"clay polygon {name}.{number}\n0\n0\n12 {_numbers(*(corners[corner] for corner in side))}\n"
                for number, side in enumerate(sides)
            )
        case "cylinder":
            start, end, radius = shape["from"], shape["to"], shape["radius"]
            along, back = ([s * (b - a) for a, b in zip(start, end)] for s in (1, -1))
            return (
                f"clay cylinder {name}\n0\n0\n7 {_numbers(start, end)} {radius}\n"
                f"clay ring {name}.from\n0\n0\n8 {_numbers(start, back)} 0 {radius}\n"
                f"clay ring {name}.to\n0\n0\n8 {_numbers(end, along)} 0 {radius}\n"
            )
    raise ValueError(f"Radiance has no such shape: {shape['kind']}")


def _numbers(*points):
    return " ".join(str(number) for point in points for number in point)
