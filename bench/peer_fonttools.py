"""peer_fonttools.py - fontTools beside Edgewise, which is compiled for it from one header.

    python3 bench/peer_fonttools.py GEN [--quick]

The same idea, in Python: symfont derives what an edge contributes by SymPy, and MomentsPen is code
that it wrote, in Debian compiled by Cython. First its derivation against gen's, from the integrand
to code; then all moments to degree 2 of the glyphs of DejaVuSans, in interleaved rounds, recorded
outlines to MomentsPen against the same outlines as arrays, called from Python. Results must agree
before anything is timed.
"""

import ctypes
import os
import resource
import statistics
import subprocess
import sys
import tempfile

from fontTools import version
from fontTools.misc import symfont
from fontTools.pens.basePen import BasePen
from fontTools.pens.momentsPen import MomentsPen
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.ttLib import TTFont

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
MOVE, LINE, QUAD, CUBIC, CLOSE = 0, 1, 2, 4, 5
FIELDS = "area", "momentX", "momentY", "momentXX", "momentXY", "momentYY"


class ArrayPen(BasePen):
    """Verbs and points as ew_path_moments takes them."""

    def __init__(self):
        super().__init__(None)
        self.verbs, self.points = [], []

    def add(self, verb, *points):
        self.verbs.append(verb)
        for point in points:
            self.points.extend(point)

    def _moveTo(self, a):
        self.add(MOVE, a)

    def _lineTo(self, a):
        self.add(LINE, a)

    def _qCurveToOne(self, a, b):
        self.add(QUAD, a, b)

    def _curveToOne(self, a, b, c):
        self.add(CUBIC, a, b, c)

    def _closePath(self):
        self.add(CLOSE)


def clock():
    """CPU time of this process and of those it waited for: others on the machine do not count."""
    usages = resource.getrusage(resource.RUSAGE_SELF), resource.getrusage(resource.RUSAGE_CHILDREN)
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def seconds(run):
    begin = clock()
    run()
    return clock() - begin


def derive(gen, folder, degree):
    """Code for x^m y^n over a cubic: what takes symfont how long, and gen with a line besides."""
    m, n = degree
    run = [gen, "--quiet", "--edges", "cubic", "--monomial", f"x{m}y{n}", "--out", folder]
    ours = statistics.median(seconds(lambda: subprocess.run(run, check=True)) for _ in range(5))
    f = symfont.x**m * symfont.y**n
    theirs = seconds(lambda: symfont.sp.lambdify(symfont.P, symfont.sp.gcd_terms(
        symfont.green(f, symfont.BezierCurve[3]).collect(sum(symfont.P, ())))))
    print(f"x^{m} y^{n} over a cubic: symfont {theirs:.2f} s, gen {ours:.4f} s, "
          f"ratio {theirs / ours:.0f}", flush=True)


def build(gen, folder):
    header, library = os.path.join(folder, "edgewise.h"), os.path.join(folder, "edgewise.so")
    subprocess.run([gen, "--quiet", "--families", "moments,curves", "--max-degree", "2",
                    "--single-header", header], check=True)
    subprocess.run([os.environ.get("CC", "cc"), "-O2", "-shared", "-fPIC", "-DEW_IMPLEMENTATION",
                    "-x", "c", header, "-o", library, "-lm"], check=True)
    return ctypes.CDLL(library).ew_path_moments


def call_of(function, pen):
    """The arguments of a call, and where its result will be."""
    out = (ctypes.c_double * len(FIELDS))()
    verbs, points = len(pen.verbs), len(pen.points)
    return (ctypes.c_int(2), (ctypes.c_ubyte * verbs)(*pen.verbs), ctypes.c_size_t(verbs),
            (ctypes.c_double * points)(*pen.points), ctypes.c_size_t(points // 2), None,
            ctypes.c_size_t(0), out), out


def measure_with_pen(recording):
    pen = MomentsPen()
    recording.replay(pen)
    return pen


def compare(recordings, calls, function):
    worst = 0
    for recording, (arguments, out) in zip(recordings, calls):
        pen = measure_with_pen(recording)
        function(*arguments)
        scale = [max(abs(x) for x in out[a:b]) for a, b in ((0, 1), (1, 3), (3, 6))]
        for i, field in enumerate(FIELDS):
            error = abs(getattr(pen, field) - out[i])
            worst = max(worst, error and error / scale[(i > 0) + (i > 2)])
    if not worst <= 1e-9:
        sys.exit(f"fontTools and edgewise differ by {worst:.1e}")
    return worst


def race(font, function, rounds):
    glyphs, recordings, calls, whole = font.getGlyphSet(), [], [], ArrayPen()
    for name in font.getGlyphOrder():
        recording, pen = DecomposingRecordingPen(glyphs), ArrayPen()
        glyphs[name].draw(recording)
        recording.replay(pen)
        recording.replay(whole)
        recordings.append(recording)
        calls.append(call_of(function, pen))
    worst = compare(recordings, calls, function)
    arguments, _ = call_of(function, whole)
    runs = (lambda: [measure_with_pen(recording) for recording in recordings],
            lambda: [function(*call) for call, _ in calls],
            lambda: function(*arguments))
    edges = sum(verb not in (MOVE, CLOSE) for verb in whole.verbs)
    times = [[seconds(run) / edges * 1e9 for run in runs] for _ in range(rounds)]
    print(f"{len(recordings)} glyphs, {edges} edges; results agree within {worst:.0e}")
    for i, name in enumerate(("MomentsPen, glyph by glyph", "ew_path_moments, likewise",
                              "ew_path_moments, one call for all")):
        ratio = statistics.median(round[0] / round[i] for round in times)
        print(f"{name:34} {statistics.median(round[i] for round in times):8.1f} ns per edge"
              + (f", ratio {ratio:.1f}" if i else ""))


def main(gen, quick):
    print(f"fontTools {version}, MomentsPen "
          f"{'compiled' if sys.modules[MomentsPen.__module__].COMPILED else 'interpreted'}, "
          f"SymPy {symfont.sp.__version__}")
    with tempfile.TemporaryDirectory() as folder:
        for degree in ((0, 0), (1, 1)) if quick else ((0, 0), (1, 1), (2, 2)):
            derive(os.path.abspath(gen), os.path.join(folder, "derived"), degree)
        race(TTFont(FONT), build(os.path.abspath(gen), folder), 3 if quick else 31)


if len(sys.argv) < 2 or sys.argv[2:] not in ([], ["--quick"]):
    sys.exit(__doc__)
main(sys.argv[1], len(sys.argv) == 3)
