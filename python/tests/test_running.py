"""Long work: Ctrl-C, threads, forks, panics."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import REPOSITORY

import isophote as iso

posix = pytest.mark.skipif(os.name != "posix", reason="signals and forks as on POSIX")


@posix
@pytest.mark.parametrize("work", ["render", "probe", "sweep"])
def test_ctrl_c_ends_long_work(slow, work):
    sent = []

    def press():
        time.sleep(0.3)
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    directions = np.random.default_rng(2).normal(size=(2_000_000, 3))
    points = directions / np.linalg.norm(directions, axis=1, keepdims=True) + [0, 0, 5]
    jobs = {
        "render": lambda: iso.render(slow),
        "probe": lambda: iso.probe(slow, at=points),
        "sweep": lambda: iso.sweep(slow, {"material.clay.diffuse": np.linspace(0.1, 0.9, 50)}),
    }
    thread = threading.Thread(target=press)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        jobs[work]()
    waited = time.perf_counter() - sent[0]
    thread.join()
    # The work itself takes minutes; the bound is for machines that do other things at the same time.
    assert waited < 5
    # And everything works on.
    assert iso.render(iso.scenes.lab()).max() > 0


def _long_work():
    """Calls that take minutes: many lights, and many points."""
    lab = iso.scenes.lab()
    lights = [iso.PointLight(position=(5, 5, -10 - number), intensity=1) for number in range(20_000)]
    grid = iso.Grid(name="floor", center=(0, -2, 5), u=(2, 0, 0), v=(0, 0, 2), points=(1000, 1000), side="back")
    scene = lab.replace(lights=lights, probes=(), grids=[grid], areas=[iso.Area(name="all", at=(0, 0), size=(2, 2))])
    lines = iso.render(lab, size=(4096, 3072))
    return {
        "grid": lambda: iso.grid(scene),
        "surface": lambda: iso.surface(scene, size=(2000, 1000)),
        "section": lambda: iso.section(scene, between=((-1, 0), (1, 0)), samples=10_000_000),
        "areas": lambda: iso.areas(scene),
        "isophotes": lambda: lines.isophotes(np.linspace(0.01, 0.38, 1000)),
    }


@posix
@pytest.mark.parametrize("work", ["grid", "surface", "section", "areas", "isophotes"])
def test_interrupted_work_does_not_go_on_unseen(work):
    """These calls ended at once, as they should, but what they had begun was computed to its end in the background."""
    job = _long_work()[work]
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        job()
    timer.join()
    deadline, idle = time.monotonic() + 10, False
    while not idle and time.monotonic() < deadline:
        before = time.process_time()
        time.sleep(0.5)
        # Far less than a busy machine leaves to the work.
        idle = time.process_time() - before < 0.01
    assert idle, "the processor is still at work"


def test_other_threads_run_meanwhile(slow):
    """The interpreter's lock is released: this thread counts while another one renders."""
    done = threading.Event()

    def stop(_done, _total):
        if done.is_set():
            raise InterruptedError

    with ThreadPoolExecutor(1) as pool:
        rendering = pool.submit(iso.render, slow, threads=1, progress=stop)
        count, until = 0, time.perf_counter() + 0.3
        while time.perf_counter() < until:
            count += 1
        assert not rendering.done()
        done.set()
        with pytest.raises(InterruptedError):
            rendering.result()
    assert count > 1000


def test_progress_is_heard_and_may_stop_the_work(slow):
    heard = []

    def listen(done, total):
        heard.append((done, total))
        if len(heard) == 3:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        iso.render(slow, progress=listen)
    assert [total for _, total in heard] == [4096 * 4096] * 3
    assert [done for done, _ in heard] == sorted(done for done, _ in heard)
    last = []
    iso.render(iso.scenes.lab(), progress=lambda done, total: last.append((done, total)))
    assert last[-1] == (480_000, 480_000)
    iso.render(iso.scenes.lab(), progress=True)
    with pytest.raises(TypeError, match="progress"):
        iso.render(iso.scenes.lab(), progress=3)


def test_many_threads_render_at_once(lab):
    lights = [(5 * np.cos(angle), 5 * np.sin(angle), -10) for angle in np.linspace(0, 6, 24)]
    scenes = [lab.set({"light.lamp.position": light}) for light in lights]
    alone = [iso.render(scene, size=(160, 120))["brightness"] for scene in scenes]
    with ThreadPoolExecutor(8) as pool:
        together = list(pool.map(lambda scene: iso.render(scene, size=(160, 120))["brightness"], scenes))
    for one, other in zip(alone, together):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("threads", [1, 2, 3, 7])
def test_threads_never_change_a_bit(threads):
    scene = iso.scenes.two_lights()
    expected = iso.render(scene, channels="all")
    found = iso.render(scene, channels="all", threads=threads)
    for channel in expected:
        assert found[channel].tobytes() == expected[channel].tobytes()


def _everything():
    scene = iso.scenes.lab()
    # A tree over so many is built by several threads.
    cloud = iso.Scene.from_file(REPOSITORY / "scenes" / "spheres.toml")
    return [
        iso.render(scene).max(),
        iso.render(cloud, size=(80, 60)).max(),
        iso.surface(scene, size=(36, 18)).max(),
        float(iso.probe(scene).brightness[0]),
    ]


def _in_child(connection):
    connection.send(_everything())
    connection.close()


@posix
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning", "ignore::isophote.SceneWarning")
def test_a_forked_process_has_threads_of_its_own(lab):
    expected = _everything()
    context = multiprocessing.get_context("fork")
    mine, theirs = context.Pipe()
    child = context.Process(target=_in_child, args=(theirs,))
    child.start()
    try:
        assert mine.poll(60), "the forked process waits for threads that it does not have"
        assert mine.recv() == expected
    finally:
        child.join(5)
        child.kill()


def test_a_panic_is_an_exception_with_its_message(capfd):
    with pytest.raises(iso.InternalError, match="so many; this is a fault of Isophote"):
        iso._isophote.panic_on_purpose("so many")
    assert issubclass(iso.InternalError, iso.RenderError)
    assert "so many" in capfd.readouterr().err
    assert iso.render(iso.scenes.lab()).max() > 0


def test_the_bare_formula_leaves_the_programs_warnings_alone(lab):
    before = list(warnings.filters)
    with ThreadPoolExecutor(8) as pool:
        for _ in pool.map(
            lambda _: iso.brightness([0, 0, -1], [0, 0, 4], lab.lights, lab.materials["clay"], "lab"), range(200)
        ):
            pass
    assert list(warnings.filters) == before
