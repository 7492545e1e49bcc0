"""What the core says about scenes, in the words of Python: it speaks of the keys and tables of scene files."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

from ._part import Part
from ._paths import TABLES
from .errors import Problem, SceneError
from .lights import Light
from .materials import Material
from .shapes import Shape

Result = TypeVar("Result")


@dataclasses.dataclass(frozen=True)
class Named:
    """The parts of a scene that messages are about."""

    shapes: Sequence[Shape] = ()
    lights: Sequence[Light] = ()
    probes: Sequence[Part] = ()
    areas: Sequence[Part] = ()
    grids: Sequence[Part] = ()
    materials: Mapping[str, Material] = dataclasses.field(default_factory=dict)

    def checked(self, check: Callable[[], Result]) -> Result:
        """What the core makes of these parts. Its errors are in Python's words."""
        try:
            return check()
        except SceneError as error:
            problems = [self.of(problem) for problem in error.problems]
            if not problems:
                raise
            raise SceneError("\n".join(str(problem) for problem in problems), problems) from None

    def of(self, problem: Problem) -> Problem:
        """The problem in Python's words; its path stays one that ``Scene.set`` takes."""
        help = None if problem.help is None else self.text(problem.help)
        return dataclasses.replace(problem, message=self.text(problem.message), help=help)

    def text(self, text: str) -> str:
        """A message in Python's words."""
        for written, said in _PHRASES:
            text = re.sub(written, said, text)
        return re.sub(r"`([^`]+)`", lambda match: self._quoted(match[1]), text)

    def _quoted(self, quoted: str) -> str:
        item = re.fullmatch(r"(\w+)\[(\d+)\](.*)", quoted, re.DOTALL)
        if item and item[1] in TABLES:
            return self._item(item[1], int(item[2]), item[3])
        material = re.fullmatch(r"material\.(.+?)(\.(?:diffuse|specular|shininess))?", quoted, re.DOTALL)
        if material:
            return f"`materials[{material[1]!r}]{material[2] or ''}`"
        assigned = re.fullmatch(r"(\w+) = (.+)", quoted, re.DOTALL)
        if assigned is None:
            return f"`{quoted}`"
        if assigned[1] == "emission":
            return f"`{_EMISSIONS.get(assigned[2], assigned[2])}`"
        return f"`{assigned[1]}={_value(assigned[1], assigned[2])}`"

    def _item(self, table: str, number: int, rest: str) -> str:
        field, kind = TABLES[table]
        items: Sequence[Part] = getattr(self, field)
        of_kind = [index for index, item in enumerate(items) if isinstance(item, kind)]
        if number >= len(of_kind):
            return f"`{field}[{number}]{rest}`"
        item = items[of_kind[number]]
        keys = {f".{key}": f".{name}" for name, key in item._KEYS.items()}
        name = getattr(item, "name", None)
        about = type(item).__name__ if name is None else f"{type(item).__name__} {name!r}"
        return f"`{field}[{of_kind[number]}]{keys.get(rest, rest)}` ({about})"


_EMISSIONS = {
    '"isotropic"': "PointLight",
    '"lambertian"': "LambertianLight",
    '"spot"': "SpotLight",
    '"parallel"': "ParallelLight",
}
_PHRASES = (
    (r"write a table \[\[sphere\]\], \[\[box\]\] or of another shape", "give it some: shapes=[Sphere(…)]"),
    (r"write a table \[\[light\]\]", "give it one: lights=[PointLight(…)]"),
    (r"(write|and) a table \[material\.([^\]]+)\]", r"\1 materials={'\2': Material(…)}"),
    (r"tables \[\[(\w+)\]\]", r"parts of the kind \1"),
    (r", a path that starts at the scene file", ", a path that starts at the scene's directory"),
)


def _value(key: str, written: str) -> str:
    """A value of a scene file as Python's."""
    if written in ("true", "false"):
        return written.capitalize()
    table = re.fullmatch(r"\{ (.*) \}", written)
    if table:
        inner = re.sub(r"(\w+) = (\[[^\]]*\]|[^,]+)", lambda one: f"{one[1]}={_value(one[1], one[2])}", table[1])
        return f"{key.capitalize()}({inner})"
    return re.sub(r"^\[(.*)\]$", r"(\1)", written)
