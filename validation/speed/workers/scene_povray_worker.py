"""POV-Ray on scenes of any shapes, plain diffuse."""

import math

import files
from povray_worker import FADE_DISTANCE, PovRay


class ScenePovRay(PovRay):
    def load(self, scene):
        self.size, (half_x, half_y) = scene["resolution"], scene["half_window"]
        # A picture of 16 bits holds any value: no light is nearer than a metre to anything that is seen.
        self.scale = 1 / sum(light[3] * scene["diffuse"] for light in scene["lights"])
        parts = [
            "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n",
            f"#default {{ pigment {{ rgb 1 }} finish {{ ambient 0 emission 0 diffuse {scene['diffuse']} }} }}\n",
            f"camera {{ location {_vector(scene['eye'])} direction <0,0,-1> ",
            f"right <{2 * half_x},0,0> up <0,{2 * half_y},0> }}\n",
        ]
        for x, y, z, intensity in scene["lights"]:
            color = self.scale * intensity / (2 * FADE_DISTANCE**2)
            parts.append(f"light_source {{ <{x},{y},{z}> rgb {color} fade_distance {FADE_DISTANCE} fade_power 2 }}\n")
        parts.extend(_shape_text(shape, scene["folder"]) for shape in scene["shapes"])
        (self.folder / "scene.pov").write_text("".join(parts))

    def command(self, image):
        """What it says is kept: the seconds that it took for the picture itself."""
        return super().command(image).replace("2> /dev/null", "2>&1 | grep -a 'Trace Time' >&2")

    def brightness(self, image):
        return super().brightness(image) / math.pi  # it reflects k_d E, where (3.6) has k_d/π E


def _shape_text(shape, folder):
    match shape["kind"]:
        case "mesh":
            return _mesh_text(*files.read_obj(f"{folder}/{shape['file']}"))
        case "box":
            low, high = ([c + sign * s / 2 for c, s in zip(shape["center"], shape["size"])] for sign in (-1, 1))
            return f"box {{ {_vector(low)}, {_vector(high)} }}\n"
        case "cylinder":
            return f"cylinder {{ {_vector(shape['from'])}, {_vector(shape['to'])}, {shape['radius']} }}\n"
        case "sphere":
            return f"sphere {{ {_vector(shape['center'])}, {shape['radius']} }}\n"
        case "ellipsoid":
            return f"sphere {{ 0, 1 scale {_vector(shape['radii'])} translate {_vector(shape['center'])} }}\n"
        case "plane":
            distance = sum(a * b for a, b in zip(shape["point"], shape["normal"]))
            return f"plane {{ {_vector(shape['normal'])}, {distance} }}\n"


def _mesh_text(vertices, normals, triangles):
    listed = lambda name, rows: f"{name} {{ {len(rows)}, {', '.join(map(_vector, rows.tolist()))} }}\n"
    smooth = "" if normals is None else listed("normal_vectors", normals)
    return f"mesh2 {{ {listed('vertex_vectors', vertices)}{smooth}{listed('face_indices', triangles)} }}\n"


def _vector(numbers):
    return "<" + ",".join(map(str, numbers)) + ">"
