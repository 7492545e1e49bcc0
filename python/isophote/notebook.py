"""The app in a notebook: a scene with its fields, picture and values, in a frame."""

from __future__ import annotations

import json
from typing import Any

from . import _isophote
from .errors import Error, SceneError
from .scene import Scene, SceneOrPath, scene_of

__all__ = ["app"]

# The page is handed over as bytes and opened in a frame of its own. Scenes go to and fro as messages.
_FRONT_END = """
async function render({ model, el }) {
  const packed = new Blob([model.get('page')]).stream().pipeThrough(new DecompressionStream('gzip'));
  const page = await new Response(packed).text();
  const frame = document.createElement('iframe');
  frame.title = 'Isophote';
  frame.style.cssText = `width: 100%; height: ${model.get('height')}px; border: 1px solid #8888`;
  frame.src = URL.createObjectURL(new Blob([page], { type: 'text/html' }));
  let said = null;
  const say = () => {
    said = model.get('text');
    frame.contentWindow?.postMessage({ isophote: 'scene', scene: JSON.parse(said) }, '*');
  };
  const hear = (event) => {
    if (event.source !== frame.contentWindow) return;
    if (event.data?.isophote === 'ready') say();
    if (event.data?.isophote === 'changed') {
      said = JSON.stringify(event.data.scene);
      model.set('text', said);
      model.save_changes();
    }
  };
  const change = () => { if (model.get('text') !== said) say(); };
  window.addEventListener('message', hear);
  model.on('change:text', change);
  el.append(frame);
  return () => {
    window.removeEventListener('message', hear);
    model.off('change:text', change);
    URL.revokeObjectURL(frame.src);
  };
}
export default { render };
"""


def app(scene: SceneOrPath | None = None, *, height: int = 760) -> Any:
    """Shows the app in a notebook, with a scene or the lab's.

    The widget's attribute `scene` is the scene as it stands there: change it in the frame and take it from here, or set it
    and see it there. Outside notebooks, the command ``isophote app`` opens the same page in a browser.

    Args:
        scene: A `Scene`, or the path of a scene file. Its shapes must be in the scene itself: a page in a browser reads no
            files.
        height: Of the frame, in px; above 0.

    Raises:
        Error: The package `anywidget` is missing, or this package was built without the page.
        SceneError: The scene reads files.
    """
    if height <= 0:
        raise Error(f"height is {height}; allowed: above 0")
    if scene is None:
        from .scenes import lab

        scene = lab()
    return _widget()(_text(scene_of(scene)), height)


def _text(scene: Scene) -> str:
    written = scene.to_dict()
    for kind in ("mesh", "spheres"):
        for shape in written.get(kind, []):
            if "file" in shape:
                raise SceneError(
                    f"the app shows scenes whose shapes are in the scene itself; this one reads {shape['file']}"
                )
    return json.dumps(written)


def _page() -> bytes:
    page = _isophote.app_page()
    if page is None:
        raise Error("this package was built without the app: run `make app` in its source, then install it again")
    return page


def _widget() -> Any:
    """The class of the widget, made when it is first needed: the package works without anywidget."""
    global _class
    if _class is not None:
        return _class
    try:
        import anywidget
        import traitlets
    except ImportError as error:
        raise Error("the app in a notebook needs the package anywidget: pip install 'isophote[app]'") from error

    class App(anywidget.AnyWidget):
        _esm = _FRONT_END
        page = traitlets.Bytes().tag(sync=True)
        height = traitlets.Int().tag(sync=True)
        text = traitlets.Unicode().tag(sync=True)

        def __init__(self, text: str, height: int) -> None:
            super().__init__(page=_page(), text=text, height=height)

        @property
        def scene(self) -> Scene:
            """The scene as it stands in the frame."""
            return Scene.from_json(self.text, name="the app's scene")

        @scene.setter
        def scene(self, scene: SceneOrPath) -> None:
            self.text = _text(scene_of(scene))

    _class = App
    return App


_class: Any = None
