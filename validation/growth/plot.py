"""Draws the curves that growth.py sends: {"label": [[spheres, ms], …], …} from standard input into a file."""

import json
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "isophote", "font.size": 11})
from matplotlib import pyplot

figure, axes = pyplot.subplots(figsize=(7, 4), layout="constrained")
for label, points in json.load(sys.stdin).items():
    axes.plot(*zip(*points), "o-", label=label)
axes.set_xscale("log")
axes.set_ylim(bottom=0)
axes.set_xlabel("spheres")
axes.set_ylabel("render, ms")
axes.grid(alpha=0.3)
axes.legend()
figure.savefig(sys.argv[1], metadata={"Date": None})
