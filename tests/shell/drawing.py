# SPDX-License-Identifier: LGPL-3.0-or-later
"""SVG plots of `rubato plot`, read back: curves as numbers, by the numbers that stand at the axes."""

import math
import xml.etree.ElementTree as xml

SVG = "{http://www.w3.org/2000/svg}"
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")


def _title(element):
    return (element.findtext(f"{SVG}title") or "").strip()


def _groups(element, name):
    return [group for group in element.findall(f"{SVG}g") if group.get("class") == name]


def _factor(label):
    """1e-3 of "t [time]  ×10⁻³", or of "×10⁻³" alone."""
    return 10.0 ** int(label.split("×10")[1].translate(RAISED)) if "×10" in label else 1.0


class Axis:
    """`place`: "x" or "y". Straight line through two ticks, on which all others are."""

    def __init__(self, group, place):
        texts = group.findall(f"{SVG}text")
        lines = group.findall(f"{SVG}line")
        self.label = texts[-1].text
        factor = math.prod(_factor(text.text) for text in texts[len(lines) :])
        numbers = [float(text.text.replace("−", "-")) * factor for text in texts[: len(lines)]]
        pixels = [float(line.get(f"{place}1")) for line in lines]
        assert len(numbers) == len(pixels) >= 2
        self.unit = (numbers[-1] - numbers[0]) / (pixels[-1] - pixels[0])
        self.zero = numbers[0] - self.unit * pixels[0]
        for number, pixel in zip(numbers, pixels):
            assert abs(self.value(pixel) - number) < 0.01 * abs(self.unit)
        self.ticks = numbers

    def value(self, pixel):
        return self.zero + self.unit * float(pixel)


class Curve:
    def __init__(self, group, x, y):
        self.label = _title(group)
        lines = group.findall(f"{SVG}polyline")
        self.style = [(line.get("stroke"), line.get("stroke-dasharray")) for line in lines]
        places = [point.split(",") for line in lines for point in line.get("points").split()]
        circles = group.findall(f"{SVG}circle")
        self.rings = bool(circles) and circles[0].get("fill") == "none"
        places += [(circle.get("cx"), circle.get("cy")) for circle in circles]
        self.points = [(x.value(a), y.value(b)) for a, b in places]


class Panel:
    def __init__(self, group, x):
        self.label = _title(group)
        self.x = x
        self.y = Axis(_groups(group, "y-axis")[0], "y")
        self.curves = [Curve(curve, x, self.y) for curve in _groups(group, "curve")]
        self.legend = [text.text for text in _groups(group, "legend")[0].findall(f"{SVG}text")]

    def curve(self, label):
        (found,) = [curve for curve in self.curves if curve.label == label]
        return found

    def expect(self, label, x, y):
        """The curve has these points, to a hundredth of a pixel."""
        points = self.curve(label).points
        assert len(points) == len(x) == len(y), (len(points), len(x), len(y))
        for (found_x, found_y), wanted_x, wanted_y in zip(points, x, y):
            assert abs(found_x - wanted_x) < 0.01 * abs(self.x.unit), (label, found_x, wanted_x)
            assert abs(found_y - wanted_y) < 0.01 * abs(self.y.unit), (label, found_y, wanted_y)


class Figure:
    def __init__(self, path):
        root = xml.parse(path).getroot()
        assert root.tag == f"{SVG}svg"
        self.root = root
        self.title = _title(root)
        self.size = int(root.get("width")), int(root.get("height"))
        groups = _groups(root, "panel")
        if groups:
            x = Axis(_groups(groups[-1], "x-axis")[0], "x")  # the lowest panel has the numbers
            self.panels = [Panel(group, x) for group in groups]
        self.texts = [text.text for text in root.iter(f"{SVG}text")]

    def group(self, name):
        (found,) = _groups(self.root, name)
        return found
