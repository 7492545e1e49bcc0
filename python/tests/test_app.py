"""The app in a notebook, without the notebook."""

from __future__ import annotations

import gzip
import json

import pytest

import isophote as iso
from isophote import _isophote

PAGE = gzip.compress(b"<!doctype html><title>page</title>")


@pytest.fixture(autouse=True)
def _page(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_isophote, "app_page", lambda: PAGE)


def test_the_widget_hands_the_scene_over_and_takes_it_back():
    scene = iso.scenes.lab()
    widget = iso.app(scene)
    assert widget.page == PAGE
    assert widget.scene == scene
    changed = json.loads(widget.text)
    changed["light"][0]["intensity"] = 50
    widget.text = json.dumps(changed)
    assert widget.scene.lights[0].intensity == 50
    assert iso.probe(widget.scene).brightness[0] == pytest.approx(0.5 * iso.probe(scene).brightness[0], rel=1e-14)
    widget.scene = iso.scenes.two_lights()
    assert json.loads(widget.text)["title"] == iso.scenes.two_lights().title


def test_a_scene_that_reads_files_is_refused(tmp_path):
    (tmp_path / "a.obj").write_text("v 0 0 5\nv 1 0 5\nv 0 1 5\nf 1 2 3\n")
    scene = iso.scenes.lab().replace(shapes=[iso.Mesh(file="a.obj", material="clay")], probes=[], directory=tmp_path)
    with pytest.raises(iso.SceneError, match=r"this one reads a\.obj"):
        iso.app(scene)


def test_what_is_missing_is_said(monkeypatch):
    with pytest.raises(iso.Error, match="allowed: above 0"):
        iso.app(height=0)
    monkeypatch.setattr(_isophote, "app_page", lambda: None)
    with pytest.raises(iso.Error, match="make app"):
        iso.app()
