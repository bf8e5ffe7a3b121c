"""glyphs.py FONT: the output of `glyphs --exact FONT --all` against fontTools' StatisticsPen.

The pen draws the font as fontTools reads it, so this compares the outlines too. The pen computes
raw moments about the origin in double and then E[x^2] - E[x]^2; what it may lose there is bounded
a priori. With R the largest coordinate of an edge, c the sum of the absolute coefficients of a
formula of the pen, and k the most roundings that a term of it goes through, the moment of degree d
of a glyph of n edges is wrong by at most gamma(k + n) sum c R^(d+2), gamma(k) = k u/(1 - k u).
c and k are read off the pen's own code, by running it on numbers that count (class Term). Our
numbers, held against exact ones by glyphs.c, are better than that; the bounds here are twice the
pen's.
"""
import importlib.util
import math
import os
import sys

from fontTools.pens import momentsPen
from fontTools.pens.statisticsPen import StatisticsPen
from fontTools.ttLib import TTFont

U = 2.0 ** -53
SMALL = 1e-3  # the pen sets correlations and slants up to this to 0
MOMENTS = {"area": 0, "momentX": 1, "momentY": 1, "momentXX": 2, "momentXY": 2, "momentYY": 2}
STATISTICS = ("area", "meanX", "meanY", "varianceX", "varianceY", "stddevX", "stddevY",
              "covariance", "correlation", "slant")


class Term:
    """The sum of the terms of an expression, all positive, and its roundings."""

    def __init__(self, size, roundings):
        self.size, self.roundings = size, roundings

    def __add__(self, other):
        if not isinstance(other, Term):
            other = Term(abs(other), 0)
        return Term(self.size + other.size, max(self.roundings, other.roundings) + 1)

    def __mul__(self, other):
        if not isinstance(other, Term):
            other = Term(abs(other), 0)
        return Term(self.size * other.size, self.roundings + other.roundings + 1)

    def __truediv__(self, divisor):
        return Term(self.size / abs(divisor), self.roundings + 1)

    def __pow__(self, exponent):
        return Term(self.size ** exponent, (self.roundings + 1) * exponent)

    def __neg__(self):
        return self

    __radd__ = __sub__ = __rsub__ = __add__
    __rmul__ = __mul__


def formulas():
    """(c, k) of every moment, for lines, quads and cubics."""
    source = os.path.join(os.path.dirname(momentsPen.__file__), "momentsPen.py")
    spec = importlib.util.spec_from_file_location("interpreted", source)
    interpreted = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(interpreted)
    one = Term(1.0, 0)
    found = []
    for degree in (1, 2, 3):
        pen = interpreted.MomentsPen()
        pen.moveTo((one, one))
        (pen.lineTo, pen.qCurveTo, pen.curveTo)[degree - 1](*[(one, one)] * degree)
        found.append({name: (getattr(pen, name).size, getattr(pen, name).roundings)
                      for name in MOMENTS})
    return found


class BoundedPen(StatisticsPen):
    """Notes the degree and the largest coordinate of every edge."""

    def __init__(self, glyphs):
        super().__init__(glyphs)
        self.edges = []

    def note(self, *points):
        points += (self._getCurrentPoint(),)
        self.edges.append((len(points) - 1, max(max(abs(x), abs(y)) for x, y in points)))

    def _lineTo(self, *points):
        self.note(*points)
        super()._lineTo(*points)

    def _qCurveToOne(self, *points):
        self.note(*points)
        super()._qCurveToOne(*points)

    def _curveToOne(self, *points):
        self.note(*points)
        super()._curveToOne(*points)


def moment_bounds(pen, formula):
    """Of every moment, twice what the pen may be wrong by."""
    bounds = dict.fromkeys(MOMENTS, 0.0)
    for degree, reach in pen.edges:
        for name, order in MOMENTS.items():
            size, roundings = formula[degree - 1][name]
            k = roundings + len(pen.edges)
            bounds[name] += 2 * k * U / (1 - k * U) * size * reach ** (order + 2)
    return bounds


def root_bound(variance, bound):
    """Of the signed root: |a - b|/(|a|^1/2 + |b|^1/2) if the signs agree."""
    least = abs(variance) - bound
    return bound / math.sqrt(least) if least > 0 else math.sqrt(2 * bound)


def quotient_bound(quotient, bound, divisor, divisor_bound):
    """Of a/b, if |a' - a| <= bound and |b' - b| <= divisor_bound; infinite if b may be 0."""
    least = abs(divisor) - divisor_bound
    if not least > 0:
        return math.inf
    return (bound + abs(quotient) * divisor_bound) / least + 4 * U * abs(quotient)


def statistic_bounds(pen, e):
    """From the bounds of the moments, those of the statistics."""
    b = {"area": e["area"]}

    def mean(moment):
        return quotient_bound(getattr(pen, moment) / pen.area, e[moment], pen.area, e["area"])

    def second(moment, x, y):
        p, q, dp, dq = getattr(pen, x), getattr(pen, y), b[x], b[y]
        return mean(moment) + abs(p) * dq + abs(q) * dp + dp * dq + 4 * U * abs(p * q)

    b["meanX"], b["meanY"] = mean("momentX"), mean("momentY")
    b["varianceX"] = second("momentXX", "meanX", "meanX")
    b["varianceY"] = second("momentYY", "meanY", "meanY")
    b["covariance"] = second("momentXY", "meanX", "meanY")
    b["stddevX"] = root_bound(pen.varianceX, b["varianceX"]) + 4 * U * abs(pen.stddevX)
    b["stddevY"] = root_bound(pen.varianceY, b["varianceY"]) + 4 * U * abs(pen.stddevY)
    x, y, dx, dy = pen.stddevX, pen.stddevY, b["stddevX"], b["stddevY"]
    product = abs(x) * dy + abs(y) * dx + dx * dy + 4 * U * abs(x * y)
    b["correlation"] = quotient_bound(
        pen.covariance / (x * y) if x * y else math.nan, b["covariance"], x * y, product)
    b["slant"] = quotient_bound(
        pen.covariance / pen.varianceY if pen.varianceY else math.nan, b["covariance"],
        pen.varianceY, b["varianceY"])
    return b


def read_glyphs(stream):
    """Number, name and statistics of every glyph."""
    number = name = None
    for line in stream:
        words = line.split()
        if words[0] == "glyph":
            number, name = int(words[1]), words[3]
        elif words[0] == "statistics":
            yield number, name, dict(zip(STATISTICS, map(float.fromhex, words[1:])))


def bears_otherwise(font, name):
    """Is its left side bearing not where the outline starts?"""
    least = getattr(font["glyf"][name], "xMin", None)
    return least is not None and least != font["hmtx"][name][1]


def reads_otherwise(font, name):
    """Does fontTools see other points than FreeType? In composites it moves each part to its left
    side bearing, FreeType the whole; and FreeType rounds the points of scaled parts."""
    glyph = font["glyf"][name] if "glyf" in font else None
    if glyph is None or not glyph.isComposite():
        return False
    for part in glyph.components:
        scaled = any(x not in (-1, 0, 1) for row in getattr(part, "transform", []) for x in row)
        if scaled or bears_otherwise(font, part.glyphName):
            return True
        if reads_otherwise(font, part.glyphName):
            return True
    return bears_otherwise(font, name)


def sizes(pen):
    """What differences are reported in: of variances, the E[x^2] that they are computed from."""
    x, y = pen.momentXX / pen.area, pen.momentYY / pen.area
    root_x, root_y = math.sqrt(abs(x)), math.sqrt(abs(y))
    return {"area": abs(pen.area), "meanX": root_x, "meanY": root_y, "varianceX": abs(x),
            "varianceY": abs(y), "stddevX": root_x, "stddevY": root_y,
            "covariance": root_x * root_y, "correlation": 1, "slant": 1}


class Comparison:
    def __init__(self):
        self.why = dict.fromkeys(("outlines",) + STATISTICS, "")
        self.largest = dict.fromkeys(STATISTICS, (0.0, 0.0, ""))
        self.compared = self.empty = self.left_out = 0

    def fail(self, group, text):
        self.why[group] = self.why[group] or text

    def compare(self, name, ours, pen, formula):
        moments = moment_bounds(pen, formula)
        if abs(pen.area) <= moments["area"]:
            self.empty += 1
            for key in STATISTICS:
                if ours[key] != 0:
                    self.fail(key, f"{name} has no area, but {ours[key]!r}")
            return
        self.compared += 1
        bounds, scale = statistic_bounds(pen, moments), sizes(pen)
        for key in STATISTICS:
            theirs, bound = getattr(pen, key), bounds[key]
            zeroed = key in ("correlation", "slant") and theirs == 0
            difference = abs(ours[key] - theirs)
            if not difference <= bound + SMALL * zeroed < math.inf:
                self.fail(key, f"{name}: {ours[key]!r}, fontTools {theirs!r}, allowed {bound:g}")
            if not zeroed:
                self.largest[key] = max(self.largest[key], (
                    difference / scale[key], bound / scale[key], name))

    def report(self):
        print(f"# {self.compared} glyphs compared, {self.empty} without area, "
              f"{self.left_out} left out: fontTools reads their parts otherwise")
        for key, (difference, bound, name) in self.largest.items():
            print(f"# {key}: largest difference {difference:.2g} of its size, {name}, "
                  f"allowed there {bound:.2g}")
        for group, why in self.why.items():
            print(f"not ok {group}: {why}" if why else f"ok {group}")
        failed = sum(map(bool, self.why.values()))
        print(f"{len(self.why) - failed} passed, {failed} failed")
        return failed > 0


def main():
    font = TTFont(sys.argv[1])
    glyphs, order, formula = font.getGlyphSet(), font.getGlyphOrder(), formulas()
    result, seen = Comparison(), 0
    for number, name, ours in read_glyphs(sys.stdin):
        if number != seen or name != order[number]:
            result.fail("outlines", f"{number} {name} where fontTools has {order[seen]}")
        seen += 1
        if reads_otherwise(font, order[number]):
            result.left_out += 1
            continue
        pen = BoundedPen(glyphs)
        glyphs[order[number]].draw(pen)
        result.compare(order[number], ours, pen, formula)
    if seen != len(order) or result.left_out > seen / 50:
        result.fail("outlines", f"{seen} glyphs where fontTools has {len(order)}, "
                    f"{result.left_out} left out")
    return result.report()


if __name__ == "__main__":
    sys.exit(main())
