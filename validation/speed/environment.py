"""Gets the other programs from their ordinary packages into a scratch folder. Nothing is installed in the system."""

import os
import platform
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

PYTHON_PACKAGES = ("numpy", "numba", "drjit", "mitsuba", "pyradiance", "embreex", "trimesh")
DEBIAN_PACKAGES = ("povray", "libllvm19")


@dataclass
class Environment:
    """The scratch folder, and what could not be had, by package, with the reason."""

    folder: Path
    missing: dict[str, str] = field(default_factory=dict)

    @property
    def python(self) -> Path:
        return self.folder / "python" / "bin" / "python"

    @property
    def debian(self) -> Path:
        return self.folder / "debian"

    @property
    def libraries(self) -> Path:
        return self.debian / "usr" / "lib" / f"{platform.machine()}-linux-gnu"

    @property
    def povray(self) -> Path:
        return self.debian / "usr" / "bin" / "povray"

    @property
    def llvm(self) -> Path | None:
        """Dr.Jit needs LLVM 19: it refuses 14, and crashes with 15 and 16 on some kernels."""
        return next(iter(sorted(self.libraries.glob("libLLVM*.so.19*"))), None)

    def variables(self) -> dict[str, str]:
        """The environment of every worker: caches of compiled kernels go to the scratch folder too."""
        home = self.folder / "home"
        home.mkdir(parents=True, exist_ok=True)
        return {
            **os.environ,
            "HOME": str(home),
            "NUMBA_CACHE_DIR": str(self.folder / "numba-cache"),
            "DRJIT_LIBLLVM_PATH": str(self.llvm or ""),
            "SPEED_POVRAY": str(self.povray),
            "SPEED_POVRAY_LIBRARIES": f"{self.libraries}:{self.libraries / 'pulseaudio'}",
        }

    def versions(self) -> dict[str, str]:
        """Package and version of everything that is there."""
        found: dict[str, str] = {}
        if self.python.exists():
            found["python"] = platform.python_version()
            for line in _output([self.python, "-m", "pip", "list", "--format=freeze"]).splitlines():
                name, _, version = line.partition("==")
                if name in (*PYTHON_PACKAGES, "llvmlite"):
                    found[name] = version
        for archive in sorted((self.folder / "debs").glob("*.deb")):
            name, version, _ = archive.name.split("_", 2)
            if name in DEBIAN_PACKAGES:
                found[name] = version.replace("%3a", ":")
        return found


def prepare(folder: Path) -> Environment:
    """Installs what is not there yet; what cannot be installed is noted, and the comparison goes on without it."""
    environment = Environment(folder)
    folder.mkdir(parents=True, exist_ok=True)
    if not environment.python.exists():
        failure = _failure([sys.executable, "-m", "venv", folder / "python"])
        if failure:
            shutil.rmtree(folder / "python", ignore_errors=True)
            environment.missing.update(dict.fromkeys(PYTHON_PACKAGES, f"no virtual environment: {failure}"))
    if environment.python.exists():
        present = environment.versions()
        for package in (name for name in PYTHON_PACKAGES if name not in present):
            pip = [environment.python, "-m", "pip", "--disable-pip-version-check", "install", "--quiet", package]
            if failure := _failure(pip):
                environment.missing[package] = f"pip: {failure}"
    for package in DEBIAN_PACKAGES:
        if failure := _unpack_debian(environment, package):
            environment.missing[package] = failure
    return environment


def _unpack_debian(environment: Environment, package: str) -> str | None:
    """Fetches a Debian package, and those it needs that the system lacks, and unpacks them beside each other."""
    mark = environment.folder / f"{package}.ready"
    if mark.exists():
        return None
    if not shutil.which("apt-get"):
        return "not a Debian system: no apt-get"
    debs = environment.folder / "debs"
    debs.mkdir(exist_ok=True)
    plan = ["apt-get", "install", "--print-uris", "-qq", "-y", "--no-install-recommends", "-o", "Debug::NoLocking=1"]
    # Each line: 'address' name_version_architecture.deb size hash
    names = [line.split()[1].split("_")[0] for line in _output([*plan, package]).splitlines() if line.startswith("'")]
    if failure := _failure(["apt-get", "download", "-qq", *(names or [package])], cwd=debs):
        return f"apt-get download: {failure}"
    for archive in debs.glob("*.deb"):
        if failure := _failure(["dpkg", "-x", archive, environment.debian]):
            return f"dpkg -x {archive.name}: {failure}"
    mark.touch()
    return None


def _failure(command: list, cwd: Path | None = None) -> str | None:
    """The last line that a failed command says; None when it did not fail."""
    done = subprocess.run([str(part) for part in command], cwd=cwd, capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return None
    said = (done.stderr or done.stdout).strip().splitlines()
    return said[-1] if said else f"exit code {done.returncode}"


def _output(command: list) -> str:
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else ""
