"""render.py - what must be in the pictures of examples/render, computed by other means.

    python3 tests/render.py WHAT ARGUMENTS... FILE

Reads PNG by zlib alone. Exits silently if all is well, else says on one line what is not. Expected
values are exact rationals from the filters as they stand here, not from gen. Coverage may be off by
2e-6, the library's bound, which is at most 2e-6 * 12.92 * 255 < 0.01 levels of sRGB; so a level may
be that much more than a half from what it is rounded from.
"""
import struct
import sys
import zlib
from fractions import Fraction as Q
from functools import lru_cache

# k(x) for x >= 0: pieces of one pixel (bspline2: knots at 1/2, 3/2), coefficients of 1, x, x^2, ...
FILTERS = {
    'box': [(Q(1, 2), [1])],
    'tent': [(1, [1, -1])],
    'bspline2': [(Q(1, 2), [Q(3, 4), 0, -1]), (Q(3, 2), [Q(9, 8), Q(-3, 2), Q(1, 2)])],
    'bspline3': [(1, [Q(2, 3), 0, -1, Q(1, 2)]), (2, [Q(4, 3), -2, 1, Q(-1, 6)])],
    'catmull_rom': [(1, [1, 0, Q(-5, 2), Q(3, 2)]), (2, [2, -4, Q(5, 2), Q(-1, 2)])],
    'mitchell': [(1, [Q(8, 9), 0, -2, Q(7, 6)]), (2, [Q(16, 9), Q(-10, 3), 2, Q(-7, 18)])],
    'bspline5': [(1, [Q(11, 20), 0, Q(-1, 2), 0, Q(1, 4), Q(-1, 12)]),
                 (2, [Q(17, 40), Q(5, 8), Q(-7, 4), Q(5, 4), Q(-3, 8), Q(1, 24)]),
                 (3, [Q(81, 40), Q(-27, 8), Q(9, 4), Q(-3, 4), Q(1, 8), Q(-1, 120)])],
    'quintic': [(1, [1, 0, Q(-17, 8), 0, Q(63, 32), Q(-27, 32)]),
                (2, [Q(61, 32), Q(-165, 64), Q(-7, 8), Q(85, 32), Q(-21, 16), Q(13, 64)]),
                (3, [Q(-243, 32), Q(891, 64), Q(-81, 8), Q(117, 32), Q(-21, 32), Q(3, 64)])],
}
SLACK = 0.01
DISC = {(0, 0): Q(20, 140), (0, 1): Q(19, 140), (1, 0): Q(19, 140), (1, 1): Q(11, 140)}


class Problem(Exception):
    pass


def unfilter(kind, line, above, step):
    for i in range(len(line)):
        left = line[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = above[i]
        elif kind == 3:
            guess = (left + above[i]) // 2
        elif kind == 4:
            paeth = left + above[i] - corner
            guess = min((left, above[i], corner), key=lambda v: abs(paeth - v))
        else:
            guess = 0
        line[i] = (line[i] + guess) & 255


def read(path):
    """Width, height, and rows of pixels, each a tuple of 1 (grey) or 4 (RGBA) bytes."""
    with open(path, 'rb') as stream:
        data = stream.read()
    if data[:8] != b'\x89PNG\r\n\x1a\n':
        raise Problem('no PNG')
    at, packed, names = 8, b'', []
    while at < len(data):
        size, name = struct.unpack('>I4s', data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if zlib.crc32(name + body) != struct.unpack('>I', data[at + 8 + size:at + 12 + size])[0]:
            raise Problem('a chunk with a wrong sum')
        names.append(name)
        if name == b'IHDR':
            width, height, depth, kind, _, _, interlace = struct.unpack('>IIBBBBB', body)
        if name == b'IDAT':
            packed += body
        at += 12 + size
    if depth != 8 or kind not in (0, 6) or interlace or b'sRGB' not in names:
        raise Problem('depth %d, kind %d, chunks %s' % (depth, kind, names))
    step = 4 if kind == 6 else 1
    raw, above, rows = zlib.decompress(packed), bytearray(width * step), []
    for y in range(height):
        start = y * (width * step + 1)
        line = bytearray(raw[start + 1:start + 1 + width * step])
        unfilter(raw[start], line, above, step)
        rows.append([tuple(line[i:i + step]) for i in range(0, width * step, step)])
        above = line
    return width, height, rows


def encode(light):
    light = min(1.0, max(0.0, float(light)))
    return 255 * (12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055)


def must_be(where, got, want):
    """got: a byte; want: what it is rounded from."""
    if abs(got - want) > 0.5 + SLACK:
        raise Problem('%s is %d, not %.3f' % (where, got, want))


def antiderivative(coefficients, x):
    return sum(c * x ** (i + 1) / Q(i + 1) for i, c in enumerate(coefficients))


@lru_cache(maxsize=None)
def up_to(name, x):
    """The integral of k from 0 to x."""
    if x < 0:
        return -up_to(name, -x)
    total, start = Q(0), Q(0)
    for end, coefficients in FILTERS[name]:
        stop = min(x, Q(end))
        if stop > start:
            total += antiderivative(coefficients, stop) - antiderivative(coefficients, start)
        start = Q(end)
    return total


def share(name, low, high, centre):
    return up_to(name, high - centre) - up_to(name, low - centre)


def rectangle_value(name, corners, x, y):
    x0, y0, x1, y1 = corners
    if name != 'disc':
        return share(name, x0, x1, x) * share(name, y0, y1, y)
    return sum(DISC[abs(i), abs(j)] * share('tent', x0, x1, x + i) * share('tent', y0, y1, y + j)
               for i in (-1, 0, 1) for j in (-1, 0, 1))


def rectangle(name, *arguments):
    """FILTER X0 Y0 X1 Y1 FILE: black on white, or alpha."""
    corners = [Q(a) for a in arguments[:4]]
    width, height, rows = read(arguments[4])
    known = {}
    for j in range(height):
        for i in range(width):
            x, y = i + Q(1, 2), j + Q(1, 2)
            # The same offsets from the edges, within the reach of every filter, the same value.
            key = tuple(min(4, max(-4, d)) for d in
                        (x - corners[0], y - corners[1], x - corners[2], y - corners[3]))
            if key not in known:
                known[key] = min(Q(1), max(Q(0), rectangle_value(name, corners, x, y)))
            pixel = rows[j][i]
            want = 255 * float(known[key]) if len(pixel) == 4 else encode(1 - known[key])
            must_be('pixel %d %d' % (i, j), pixel[-1], want)


def size(width, height, channels, path):
    got = read(path)
    if (got[0], got[1], len(got[2][0][0])) != (int(width), int(height), int(channels)):
        raise Problem('%d x %d x %d' % (got[0], got[1], len(got[2][0][0])))


def symmetric(axes, path):
    """AXES: x, y, xy or t (transposed)."""
    rows = read(path)[2]
    if 'x' in axes and any(row != row[::-1] for row in rows):
        raise Problem('left and right differ')
    if 'y' in axes and rows != rows[::-1]:
        raise Problem('top and bottom differ')
    if 't' in axes and rows != [list(column) for column in zip(*rows)]:
        raise Problem('rows and columns differ')


def same(levels, first, second):
    a, b = read(first)[2], read(second)[2]
    if len(a) != len(b) or len(a[0]) != len(b[0]):
        raise Problem('sizes differ')
    worst = max(abs(p - q) for row, other in zip(a, b) for one, two in zip(row, other)
                for p, q in zip(one, two))
    if worst > int(levels):
        raise Problem('values differ by %d' % worst)


def area(wanted, path):
    """The sum of alpha. Every pixel that is neither 0 nor 255 may be off by half a level, and by
    what lies between a curve and the lines that the library makes of it, 2^-8 high, at most
    sqrt(2) long."""
    alphas = [pixel[3] for row in read(path)[2] for pixel in row]
    inexact = sum(0 < a < 255 for a in alphas)
    got = sum(alphas) / 255
    if abs(got - float(wanted)) > inexact * ((0.5 + SLACK) / 255 + 2 ** 0.5 / 256):
        raise Problem('the area is %.3f, not %s' % (got, wanted))


def decode(byte):
    value = byte / 255
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def mixture(one, two, left, top, right, bottom, path):
    """Within the box every pixel lies between the two colours, in linear light; both occur."""
    a, b = ([decode(int(c[k:k + 2], 16)) for k in (0, 2, 4)] for c in (one, two))
    seen = set()
    for row in read(path)[2][int(top):int(bottom)]:
        for pixel in row[int(left):int(right)]:
            light = [decode(v) for v in pixel[:3]]
            part = (light[0] - b[0]) / (a[0] - b[0])
            seen.add(round(part, 1))
            # Half a level is at most 0.0045 of light. That of red moves the part, too, and the
            # other channels of our two colours are four times closer together than red.
            for k in range(3):
                want = part * a[k] + (1 - part) * b[k]
                if abs(light[k] - want) > 0.0045 * 1.25 + 1e-4 or pixel[3] != 255:
                    raise Problem('a pixel is %s' % (pixel,))
    if not {0.0, 1.0} <= seen or len(seen) < 4:
        raise Problem('parts are %s' % sorted(seen))


if __name__ == '__main__':
    try:
        globals()[sys.argv[1]](*sys.argv[2:])
    except Problem as problem:
        print(problem)
