"""The machine and the programs, described for the head of the report."""

import os
import platform
import subprocess
from pathlib import Path


def description() -> dict[str, str]:
    """What somebody needs to know who compares the figures with those of another machine."""
    return {
        "processor": _processor(),
        "cores": str(os.cpu_count()),
        "memory": _memory(),
        "system": f"{_system()}, Linux {_kernel()}" if platform.system() == "Linux" else platform.platform(),
    }


def load() -> float:
    """How many processes wanted to run in the last minute: above 0 at the start, others are at work too."""
    return os.getloadavg()[0]


def _processor() -> str:
    return _value(Path("/proc/cpuinfo"), "model name") or platform.processor() or "unknown"


def _memory() -> str:
    kilobytes = _value(Path("/proc/meminfo"), "MemTotal")
    return f"{int(kilobytes.split()[0]) / 2**20:.0f} GiB" if kilobytes else "unknown"


def _kernel() -> str:
    """Its version, without what its makers append."""
    return ".".join(platform.release().split("-")[0].split(".")[:2])


def _system() -> str:
    return (_value(Path("/etc/os-release"), "PRETTY_NAME", separator="=") or platform.system()).strip('"')


def _value(path: Path, key: str, separator: str = ":") -> str | None:
    if not path.exists():
        return None
    for line in path.read_text().splitlines():
        name, _, value = line.partition(separator)
        if name.strip() == key:
            return value.strip()
    return None


def rustc() -> str:
    return subprocess.run(["rustc", "--version"], capture_output=True, text=True, check=True).stdout.strip()
