"""What tests share."""

from __future__ import annotations

import os
from pathlib import Path

os.environ.setdefault("MPLBACKEND", "agg")

import hypothesis
import pytest

import isophote as iso

REPOSITORY = Path(__file__).parents[2]
SCENES = sorted((REPOSITORY / "scenes").glob("*.toml"))

# Other work on the machine must not make a test fail; the same examples every time.
hypothesis.settings.register_profile("isophote", deadline=None, derandomize=True, max_examples=60)
hypothesis.settings.load_profile("isophote")


@pytest.fixture
def lab() -> iso.Scene:
    return iso.scenes.lab()


@pytest.fixture
def lab_map(lab: iso.Scene) -> iso.Map:
    return iso.render(lab, channels="all")


@pytest.fixture
def slow() -> iso.Scene:
    """A scene that takes long to render: many lights, on a sphere that fills the picture."""
    camera = iso.Camera(
        eye=(0, 0, 0),
        forward=(0, 0, 1),
        screen=iso.Screen(distance=5, x=(-0.5, 0.5), y=(-0.5, 0.5)),
        resolution=(4096, 4096),
    )
    return iso.Scene(
        length="m",
        camera=camera,
        materials={"clay": iso.Material(diffuse=0.7, specular=0.3, shininess=21.5)},
        shapes=[iso.Sphere(center=(0, 0, 5), radius=1, material="clay")],
        lights=[iso.PointLight(position=(0.001 * i, 5, -10), intensity=1) for i in range(5000)],
    )
