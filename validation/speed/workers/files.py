"""Files for the programs that have no writers or readers of their own."""

import struct
import zlib

import numpy as np


def save(image: np.ndarray, path: str) -> None:
    """As PNG, 8 bits, the maximum white, as our own command does it; under any other name as a NumPy array of 32 bits."""
    if not path.endswith(".png"):
        np.save(path, np.asarray(image, np.float32))
        return
    grey = (image * (255 / image.max()) + 0.5).astype(np.uint8)
    rows = np.zeros((grey.shape[0], grey.shape[1] + 1), np.uint8)  # each row begins with its filter, 0
    rows[:, 1:] = grey
    header = struct.pack(">IIBBBBB", grey.shape[1], grey.shape[0], 8, 0, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(rows, 6)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


def read_obj(path: str) -> tuple[np.ndarray, np.ndarray | None, np.ndarray]:
    """Vertices, normals if there are any, and triangles; a vertex and its normal have the same number."""
    rows: dict[str, list[list[str]]] = {"v": [], "vn": [], "f": []}
    with open(path) as file:
        for line in file:
            kind, *words = line.split()
            rows[kind].append(words)
    triangles = np.array([[int(word.split("/")[0]) - 1 for word in words] for words in rows["f"]])
    return np.array(rows["v"], float), np.array(rows["vn"], float) if rows["vn"] else None, triangles
