#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Draws a 2D run of rubato: the deformed mesh at one instant, coloured by von Mises stress, the widest gap enlarged,
and the history of the probe `tip`.

    draw_beams.py RUN_FOLDER INSTANT PICTURE.png

Reads what rubato wrote (fields.pvd, its .vtu file of the instant, probes.csv) and nothing else.
Needs Debian's python3-matplotlib and python3-numpy.
"""
import csv
import sys
import xml.etree.ElementTree as xml
import zlib
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

MEGAPASCAL = 1e6
MILLISECOND = 1e-3
MILLIMETRE = 1e-3
VTK_QUAD = 9
NUMBER_TYPES = {"Float64": "<f8", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}


def uncompressed(data):
    """Of an array in pieces: their number, the size of one, that of the last (0: as the others), each compressed."""
    pieces, _, _ = np.frombuffer(data[:24], "<u8")
    start = 24 + 8 * int(pieces)
    content = b""
    for size in np.frombuffer(data[24:start], "<u8"):
        content += zlib.decompress(data[start:start + int(size)])
        start += int(size)
    return content


def read_vtu(path):
    """Arrays of a .vtu file with raw appended data that zlib has compressed, by name."""
    head, separator, tail = path.read_bytes().partition(b'<AppendedData encoding="raw">')
    if not separator:
        sys.exit(f"{path}: found no raw appended data")
    data = tail[tail.index(b"_") + 1:]
    arrays = {}
    for array in xml.fromstring(head + b"</VTKFile>").iter("DataArray"):
        values = np.frombuffer(uncompressed(data[int(array.get("offset")):]), NUMBER_TYPES[array.get("type")])
        components = int(array.get("NumberOfComponents", 1))
        arrays[array.get("Name")] = values.reshape(-1, components) if components > 1 else values
    return arrays


def file_of_instant(folder, instant):
    entries = xml.parse(folder / "fields.pvd").getroot().iter("DataSet")
    nearest = min(entries, key=lambda entry: abs(float(entry.get("timestep")) - instant))
    return folder / nearest.get("file"), float(nearest.get("timestep"))


def quadrangles(arrays):
    if not np.all(arrays["types"] == VTK_QUAD):
        sys.exit("expected a mesh of QUAD4 only")
    return arrays["connectivity"].reshape(-1, 4)


def outline(quads):
    """Edges that belong to one cell only."""
    edges = np.sort(quads[:, [[0, 1], [1, 2], [2, 3], [3, 0]]].reshape(-1, 2), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    return unique[count == 1]


def draw_body(axes, place, quads, stress, largest):
    triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    colours = axes.tripcolor(place[:, 0], place[:, 1], triangles, stress, shading="gouraud", cmap="turbo",
                             vmin=0, vmax=largest, rasterized=True)
    axes.add_collection(PolyCollection(place[quads], facecolors="none", edgecolors="#00000030", linewidths=0.3))
    axes.add_collection(LineCollection(place[outline(quads)], colors="black", linewidths=0.8))
    axes.set_aspect("equal")
    return colours


def draw_gap(axes, body, arrays, largest):
    place, quads, stress = body
    gap = arrays["contact_gap"]
    widest = int(np.argmax(gap))
    half_width = 10 * gap[widest]
    zoom = axes.inset_axes([0.72, 0.745, 0.27, 0.25])
    draw_body(zoom, place, quads, stress, largest)
    centre = place[widest] + [0, gap[widest] / 2]
    zoom.set_xlim(centre[0] - half_width, centre[0] + half_width)
    zoom.set_ylim(centre[1] - half_width / 2, centre[1] + half_width / 2)
    zoom.set_xticks([])
    zoom.set_yticks([])
    zoom.set_title(f"between the beams: {gap[widest] / MILLIMETRE:.2f} mm", fontsize=10)
    axes.indicate_inset_zoom(zoom, edgecolor="black", alpha=0.9)


def draw_history(axes, folder, instant):
    with open(folder / "probes.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    t = np.array([float(row["t"]) for row in rows])
    y = np.array([float(row["tip.y"]) for row in rows])
    plot = axes.inset_axes([0.085, 0.10, 0.34, 0.26])
    plot.plot(t / MILLISECOND, y, color="#1f4e79", linewidth=1.6)
    plot.plot(instant / MILLISECOND, np.interp(instant, t, y), "o", color="#c00000", markersize=6)
    plot.set_xlabel("t [ms]", fontsize=9)
    plot.set_ylabel("tip.y [m]", fontsize=9)
    plot.tick_params(labelsize=8)
    plot.grid(color="#d0d0d0", linewidth=0.5)
    for side in ("top", "right"):
        plot.spines[side].set_visible(False)


def main(folder, instant, picture):
    path, instant = file_of_instant(folder, instant)
    arrays = read_vtu(path)
    rest = arrays["Points"][:, :2]
    place = rest + arrays["displacement"][:, :2]
    quads = quadrangles(arrays)
    stress = arrays["von_mises"] / MEGAPASCAL
    # The node that carries the load has a stress without a limit; it must not take all the colours.
    largest = 100 * np.ceil(np.percentile(stress, 99.5) / 100)

    figure, axes = plt.subplots(figsize=(11, 5.3), dpi=100)
    axes.add_collection(LineCollection(rest[outline(quads)], colors="#909090", linewidths=0.8, linestyles="dashed"))
    colours = draw_body(axes, place, quads, stress, largest)
    axes.set_xlim(-0.015, 1.045)
    axes.set_ylim(-0.31, 0.20)
    axes.axis("off")
    axes.set_title(f"Two beams rubbing, t = {instant / MILLISECOND:.3g} ms, displacements at scale 1", fontsize=12, loc="left", y=0.88)
    figure.colorbar(colours, ax=axes, fraction=0.02, pad=0.01, extend="max", label="von Mises stress [MPa]")
    draw_gap(axes, (place, quads, stress), arrays, largest)
    draw_history(axes, folder, instant)
    figure.savefig(picture, bbox_inches="tight", pad_inches=0.08)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), float(sys.argv[2]), sys.argv[3])
