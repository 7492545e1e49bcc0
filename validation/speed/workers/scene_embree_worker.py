"""Meshes of flat triangles by Embree: its bare rays (embreex, one thread), and a picture as trimesh and NumPy make it."""

import numpy as np
import trimesh
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

import files

# How far above the surface a shadow ray starts, in metres: several times the rounding of Embree's distances.
OFFSET = 1e-5


class MeshPicture:
    """trimesh searches with Embree, NumPy shades."""

    def load(self, scene):
        [shape] = scene["shapes"] if len(scene["shapes"]) == 1 else [{}]
        if shape.get("file") != "flat.obj":
            raise ValueError("flat meshes only")
        self.scene, self.size = scene, scene["resolution"]
        (width, height), (half_x, half_y) = self.size, scene["half_window"]
        self.path = f"{scene['folder']}/{shape['file']}"
        directions = np.full((height, width, 3), -1.0)
        directions[..., 0] = (2 * (np.arange(width) + 0.5) / width - 1) * half_x
        directions[..., 1] = ((1 - 2 * (np.arange(height) + 0.5) / height) * half_y)[:, None]
        self.directions = directions.reshape(-1, 3) / np.linalg.norm(directions, axis=2).reshape(-1, 1)
        self.origins = np.broadcast_to(np.array(scene["eye"]), self.directions.shape)
        self.prepare()

    def prepare(self):
        self.mesh = trimesh.load(self.path, process=False)
        self.mesh.ray.intersects_first([[0, 0, 9]], [[0, 0, 1]])  # builds its tree

    def first(self):
        return self.mesh.ray.intersects_first(self.origins, self.directions)

    def blocked(self, starts, along, distances):
        # No surface lies beyond a light.
        return self.mesh.ray.intersects_any(starts, along)

    def corner(self):
        return self.mesh.triangles[:, 0], self.mesh.face_normals

    def render(self):
        triangle = self.first()
        seen = np.flatnonzero(triangle >= 0)
        corners, normals = self.corner()
        corner, normal = corners[triangle[seen]], normals[triangle[seen]]
        eye, rays = np.array(self.scene["eye"]), self.directions[seen]
        distance = np.einsum("ij,ij->i", corner - eye, normal) / np.einsum("ij,ij->i", rays, normal)
        points = eye + distance[:, None] * rays
        total = np.zeros(len(seen))
        for x, y, z, intensity in self.scene["lights"]:
            to_light = np.array([x, y, z]) - points
            length = np.linalg.norm(to_light, axis=1)
            along = to_light / length[:, None]
            cosine = np.einsum("ij,ij->i", along, normal)
            lit = np.flatnonzero(cosine > 0)
            lit = lit[~self.blocked(points[lit] + OFFSET * normal[lit], along[lit], length[lit])]
            total[lit] += intensity * cosine[lit] / length[lit] ** 2
        image = np.zeros(len(self.directions))
        image[seen] = total * (self.scene["diffuse"] / np.pi)
        return image

    def brightness(self, image):
        return image.reshape(self.size[::-1])

    def save(self, image, path):
        files.save(self.brightness(image), path)


class BareRays(MeshPicture):
    """Embree alone: `render` is the search for what the rays meet, all in single precision and prepared before."""

    def __init__(self, part):
        self.part = part

    def prepare(self):
        vertices, _, triangles = files.read_obj(self.path)
        self.triangles = vertices[triangles]
        across, up = (self.triangles[:, corner] - self.triangles[:, 0] for corner in (1, 2))
        normals = np.cross(across, up)
        self.normals = normals / np.linalg.norm(normals, axis=1)[:, None]
        self.tree = EmbreeScene()
        self.built = TriangleMesh(self.tree, vertices.astype(np.float32), triangles.astype(np.int32))
        self.rays = self.origins.astype(np.float32), self.directions.astype(np.float32)
        self.shadow_rays = []
        self.image = super().render()  # which collects the shadow rays

    def corner(self):
        return self.triangles[:, 0], self.normals

    def first(self):
        return self.tree.run(*self.rays, query="INTERSECT")

    def blocked(self, starts, along, distances):
        rays = [array.astype(np.float32) for array in (starts, along, distances)]
        self.shadow_rays.append(rays)
        return self._is_blocked(*rays)

    def _is_blocked(self, starts, along, distances):
        return self.tree.run(starts, along, dists=distances, query="OCCLUDED") >= 0

    def render(self):
        if self.part == "primary":
            self.first()
        else:
            for rays in self.shadow_rays:
                self._is_blocked(*rays)
        return self.image
