"""The command, which is that of the program."""

from __future__ import annotations

import subprocess
import sys

import pytest

import isophote as iso


def run(*arguments, **options):
    return subprocess.run([sys.executable, "-m", "isophote", *arguments], capture_output=True, text=True, **options)


def test_it_is_the_same_version():
    assert run("--version").stdout == f"isophote {iso.__version__}\n"


def test_it_renders_the_lab(tmp_path):
    done = run("render", cwd=tmp_path)
    assert done.returncode == 0
    assert "0.316677297547093" in done.stdout
    assert (tmp_path / "lab.png").exists()


@pytest.mark.parametrize(
    ("arguments", "code"),
    [(["--help"], 0), (["render", "--no-such-option"], 2), (["probe", "--at", "0,0,0"], 2), (["check", "missing.toml"], 3)],
)
def test_its_exit_codes_are_the_programs(arguments, code):
    assert run(*arguments).returncode == code


def test_whoever_reads_it_may_stop_reading():
    process = subprocess.Popen([sys.executable, "-m", "isophote", "schema"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.close()
    _, errors = process.communicate()
    assert process.returncode == 0
    assert errors == b""
