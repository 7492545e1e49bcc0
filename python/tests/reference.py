"""The formulas (2.1), (2.2), (3.1) to (3.6), (3.11) and (3.12) once more, in NumPy, from the documentation."""

from __future__ import annotations

import numpy as np


def rays(camera, handedness):
    """The eye, and the direction through the centre of each pixel: height × width × 3."""
    eye = np.array(camera.eye)
    forward = np.array(camera.forward) / np.linalg.norm(camera.forward)
    top = np.array(camera.up or (0.0, 1.0, 0.0))
    up = top - np.dot(top, forward) * forward
    up /= np.linalg.norm(up)
    right = np.cross(up, forward) if handedness == "left" else np.cross(forward, up)
    width, height = camera.resolution
    x = camera.screen.x[0] + (np.arange(width) + 0.5) / width * (camera.screen.x[1] - camera.screen.x[0])
    y = camera.screen.y[1] - (np.arange(height) + 0.5) / height * (camera.screen.y[1] - camera.screen.y[0])
    ahead = camera.screen.distance * forward
    return eye, ahead + x[None, :, None] * right + y[:, None, None] * up


def trace(eye, directions, spheres):
    """The nearest hit of each ray: index of the sphere (−1: none), point, normal."""
    unit = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    nearest = np.full(directions.shape[:-1], np.inf)
    shape = np.full(directions.shape[:-1], -1)
    for index, (center, radius) in enumerate(spheres):
        to_center = np.array(center) - eye
        along = unit @ to_center
        across = np.linalg.norm(to_center - along[..., None] * unit, axis=-1)
        half = np.sqrt(np.maximum(radius**2 - across**2, 0.0))
        distance = along - half
        hit = (across < radius) & (distance > 0) & (distance < nearest)
        nearest[hit], shape[hit] = distance[hit], index
    seen = shape >= 0
    point = np.zeros(directions.shape)
    point[seen] = eye + nearest[seen][:, None] * unit[seen]
    normal = np.zeros(directions.shape)
    for index, (center, radius) in enumerate(spheres):
        normal[shape == index] = (point[shape == index] - np.array(center)) / radius
    return shape, point, normal


def lobe_constant(n):
    """c(n) of (3.6)."""
    return (n + 2) * (n + 4) / (8 * np.pi * (n + 2 ** (-n / 2)))


def brightness(normal, point, eye, lights, material, convention):
    """Irradiance and brightness at points (n × 3) by isotropic lights: pairs of position and intensity."""
    diffuse, specular, shininess = material
    to_eye = eye - point
    view = to_eye / np.linalg.norm(to_eye, axis=-1, keepdims=True)
    cos_o = np.maximum(np.sum(normal * view, axis=-1), 0.0)
    total, highlights, without_cosine = (np.zeros(len(point)) for _ in range(3))
    for position, intensity in lights:
        to_light = np.array(position) - point
        distance = np.linalg.norm(to_light, axis=-1)
        towards = to_light / distance[:, None]
        cos_i = np.maximum(np.sum(normal * towards, axis=-1), 0.0)
        irradiance = intensity * cos_i / distance**2
        half = towards + view
        half /= np.linalg.norm(half, axis=-1, keepdims=True)
        cos_h = np.maximum(np.sum(normal * half, axis=-1), 0.0)
        total += irradiance
        highlights += irradiance * cos_h**shininess
        without_cosine += (cos_i > 0) * intensity / distance**2 * cos_h**shininess
    seen = cos_o > 0
    by_convention = {
        "irradiance": total,
        "lambert": seen * diffuse * total,
        "lab": seen * (diffuse * cos_o * total + specular * highlights),
        "course": seen * (diffuse * total + specular * highlights),
        "course-pi": seen * (diffuse * total + specular * highlights) / np.pi,
        "radiance": seen * (diffuse / np.pi * total + specular * lobe_constant(shininess) * highlights),
        "blinn-phong": seen * (diffuse * total + specular * without_cosine),
        "blinn-phong-pi": seen * (diffuse * total + specular * without_cosine) / np.pi,
    }
    return total, by_convention[convention]
