#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compensated contours against an offset that shares no code with the control: GEOS (python3-shapely).

Random closed contours of lines and arcs are compensated inside and outside by the control, with CONTOUR_CHECK, from a way in and back on a way out: lines at
right angles, quarter circles with and without a ramp, lines along the first and the last block (a corner is then left on its lengthened sides), lines at
any angle. Some go round twice, the first time down along a helix, whole circles among them. Corners between lines and, as the machine has the option for
it, beside arcs are cut. Offset numbers differ from contour to contour; some contours change theirs on the way. Each third contour is a profile as CAM systems
write them (cam_profiles.py). The programs run in contour_paths.cpp. Of each that does not end in an alarm it is asked:

  gouge    no part of the tool's path, the ways in and out included, comes nearer than the radius to any element of the contour
  uncut    every point of the contour that GEOS' offset curve reaches is reached by the path
  open     the path has no gap and ends where the program says

to a micrometre and the error of the fine polygons. Contours of which the tool reaches every block are asked for the gouge without CONTOUR_CHECK, too: what is wrong at a corner must
not be left to it. Then the contour is mirrored, turned, scaled and run backwards, and the path has to follow. How
many may end in an alarm is bounded for each kind of contour.

NC_CONTOURS=n   how many (default 10000, 200 under a sanitizer; a long run takes 1000000); NC_FIRST_SEED=n   the first of them; NC_EVERY=n   which
of them are transformed (default 5: each fifth); NC_EVERY_WITHOUT=n   which of them go without CONTOUR_CHECK, too (default 1: each that the tool
reaches); NC_SHOW=1   prints the program of each that fails
Exit 77: no shapely.
"""
import copy
import math
import os
import subprocess
import sys

try:
    import numpy
    from shapely.geometry import LineString, MultiLineString, Point, Polygon
    from shapely.ops import unary_union
except ImportError:
    # A python3 in front of Debian's in PATH does not see Debian's packages.
    debian = "/usr/bin/python3"
    if os.path.realpath(sys.executable) != os.path.realpath(debian) and os.path.exists(debian) and "NC_TRIED" not in os.environ:
        os.execve(debian, [debian, *sys.argv], dict(os.environ, NC_TRIED="1"))
    print("skipped: no python3-shapely")
    sys.exit(77)
from cam_profiles import Profile  # noqa: E402
from contours import NO_DIRECTION, SAGITTA, Contour, Element, cut_at, tangent_at  # noqa: E402

TOLERANCE = 0.001 + 3 * SAGITTA
LAST_DIGIT = 0.0009  # mm
MOST_ALARMS = {"star": 0.5, "slot": 0.65, "plate": 0.45, "round": 0.5, "circle": 0.5, "scallops": 0.5, "flared": 0.45, "noses": 0.6, "fillets": 0.5, "cam star": 0.65, "cam slot": 0.8,
               "cam plate": 0.65, "cam round": 0.65, "cam circle": 0.7, "cam scallops": 0.65, "cam flared": 0.65, "cam noses": 0.7, "cam fillets": 0.65}  # shares of each kind

# ---- transformed contours


def negated(text):
    return text[1:] if text.startswith("-") else "-" + text


def transformed(blocks, way):
    """The program of the contour mirrored in X, turned by a right angle, or twice as large: exact in its digits."""
    result = []
    for block in blocks:
        if block[0] in "#I":  # macro statements
            result.append(block)
            continue
        words = block.split()
        swap = {"G2": "G3", "G3": "G2", "G41": "G42", "G42": "G41"}
        if way == "mirror":
            words = [swap.get(w, w[0] + negated(w[1:]) if w[0] in "XI" else w) for w in words]
        elif way == "turn":
            words = [{"X": "Y", "I": "J"}[w[0]] + w[1:] if w[0] in "XI" else {"Y": "X", "J": "I"}[w[0]] + negated(w[1:]) if w[0] in "YJ" else w for w in words]
        else:
            words = [w[: 2 if w[0] == "," else 1] + f"{2 * float(w[2 if w[0] == ',' else 1:]):.6f}" if w[0] in "XYIJR," else w for w in words]
        result.append(" ".join(words))
    return result


TRANSFORMS = {"mirror": lambda p: (-p[0], p[1]), "turn": lambda p: (-p[1], p[0]), "scale": lambda p: (2 * p[0], 2 * p[1])}


def line_of(move, scale):
    return LineString([(scale * x, scale * y) for x, y in move.points()])


def run_backwards(contour):
    """The same contour the other way round, on its other side."""
    if isinstance(contour, Profile):
        return contour.reversed_copy().blocks()
    back = copy.copy(contour)
    back.elements = back.programmed = [Element(e.end, e.start, e.center, not e.ccw) for e in reversed(contour.programmed)]
    back.turn_round()
    return back.blocks()


def as_large_as_the_tool(contour):
    """Whether an arc has the radius of the tool to within two nanometres: to the last digit of the words it is or is not one that the tool fits into."""
    return any(e.center and abs(e.radius() - contour.radius) < 2e-6 for e in contour.elements)


def follows(result, other, change, way, edge=False):
    """None, or how the other result differs from what the change makes of this one. What is too short to be a move, how far a path may come near
    a wall, and by how much the radii of an arc may differ that is one (a micrometre: the last digit of these words), does not scale; nor does what P152 allows at an arc of the tool's radius (`edge`). Backwards the
    check meets the blocks in another order."""
    backwards = way == "back"
    if result.alarm or other.alarm:
        same = result.alarm == other.alarm and result.alarm_block == other.alarm_block
        tolerances = way == "scale" and ("P153" in (result.alarm, other.alarm) or (edge and "P152" in (result.alarm, other.alarm)))
        return None if backwards or same or tolerances else f"alarm {other.alarm} and not {result.alarm}"
    ends = [change(move.end) for _, move, *_ in result.moves[:-1] if move.length() > 1e-5]
    others = [move.end for _, move, *_ in other.moves[:-1] if move.length() > (2e-5 if way == "scale" else 1e-5)]
    if backwards:
        others.reverse()
    worst = max((math.dist(a, b) for a, b in zip(ends, others)), default=0)
    if way in ("scale", "back") and (len(ends) != len(others) or worst > 3e-5):  # lines without a direction: ends beside them may lie elsewhere on the same path
        paths = [MultiLineString([line_of(move, by) for _, move, *_ in r.moves if move.length() > 1e-9]) for r, by in ((result, 2 if way == "scale" else 1), (other, 1))]
        apart = paths[0].hausdorff_distance(paths[1])
        return f"apart by {apart:.6f} mm" if apart > 4 * TOLERANCE else None
    if len(ends) != len(others):
        return f"{len(others)} moves and not {len(ends)}"
    return f"off by {worst:.6f} mm" if worst > 3e-5 else None


# ---- the control


class Result:
    def __init__(self):
        self.alarm = None
        self.alarm_block = None
        self.moves = []  # (block, Element, lowest and highest Z): block 0 is the start of compensation


def run_all(programs):
    """Results of programs (lists of blocks). Each begins at zero: where the one before it ended, and at which height, is no part of it."""
    text = "".join("\n".join(["!1229/bit2 0", "!CONTOUR_CHECK 1", "G17 G90 G21 G94 G0 X0 Y0 Z0", *blocks, "M30", "%", ""]) for blocks in programs)
    tool = os.path.join(os.environ.get("NC_BINARY_DIR", "build/release"), "bin", "contour_paths")
    answers = subprocess.run([tool], input=text, stdout=subprocess.PIPE, check=True, text=True).stdout.split("\n.\n")
    assert len(answers) == len(programs) + 1, "an answer for each program"
    return [read_result(blocks, answer.splitlines()) for blocks, answer in zip(programs, answers)]


def read_result(blocks, lines):
    """`lines` as contour_paths.cpp writes them."""
    result = Result()
    blocks = [block for block in blocks if block[0] != "!"]
    first_line = next(number for number, block in enumerate(blocks, 2) if "G41" in block or "G42" in block)
    for line in lines:
        kind, number, *rest = line.split()
        block = int(number) - first_line
        if kind == "a":
            result.alarm, result.alarm_block = rest[0], block
        elif block >= 0:
            x0, y0, z0, x1, y1, z1, *arc = map(float, rest)
            element = Element((x0, y0), (x1, y1))
            if arc:
                element = Element((x0, y0), (x1, y1), (arc[0], arc[1]), arc[2] > 0, angle=math.radians(arc[2]))
            result.moves.append((block, element, min(z0, z1), max(z0, z1)))
    return result


# ---- the judgement


def judge(contour, result):
    """None, or what is wrong."""
    profile = isinstance(contour, Profile)
    at, end = (contour.ends() if profile else (contour.lead, contour.lead))
    for _, move, *_ in result.moves:
        if not (math.dist(at, move.start) < 1e-6 and all(math.isfinite(x) for x in move.end)):
            return "open: a gap"
        at = move.end
    if math.dist(at, end) > 1e-6:
        return "open: the path does not come back"
    if profile:
        return judge_profile(contour, result)
    bottom = min((low for _, _, low, _ in result.moves), default=0)
    at_level = [(block, move) for block, move, low, _ in result.moves if not contour.ramp or low <= bottom + 1e-6]  # the tool comes and goes above the walls: it cuts none of them there
    paths = [(block, LineString(move.points())) for block, move in at_level if move.length() > 1e-9]
    if contour.depth:  # the way in lies above the walls
        paths = [each for each in paths if each[0] > (1 if contour.way or contour.along else 0)]
    if not paths:  # the radius of the tool is that of the hole: it stands in the middle
        paths = [(0, LineString([at, at]))]
    radius = min(contour.radius, contour.other[1]) if contour.other else contour.radius
    bad = judge_gouge(paths, contour.wall(), radius)
    return bad if bad or contour.other else judge_uncut(contour, together(paths), contour.radius, contour.inside, contour.elements, 0)  # with two amounts there is no one offset curve


def together(paths):
    return MultiLineString([line for _, line in paths])


def judge_gouge(paths, wall, radius, ends=True):
    """`ends`: the first of the paths starts compensation and the last one ends it. They may come nearer by the last digit of their words (docs/compensation.md)."""
    depth = radius - together(paths).distance(wall)
    if depth <= TOLERANCE:
        return None
    allowed = lambda block: TOLERANCE + (LAST_DIGIT if ends and block in (paths[0][0], paths[-1][0]) else 0)
    block, depth = max(((block, radius - path.distance(wall)) for block, path in paths), key=lambda each: each[1] - allowed(each[0]))
    return f"gouge of {depth:.4f} mm in block {block}" if depth > allowed(block) else None


def judge_profile(contour, result):
    """Each round with the radius of its tool, what lies at the depth of the contour."""
    bottom = -contour.level
    for (first, behind), (_, radius) in zip(contour.spans, contour.cuts):
        moves = [(block, move) for block, move, low, high in result.moves if first <= block < behind and low <= bottom + 1e-6 and high >= bottom - 1e-6]
        if contour.cross is not None:
            bad = judge_change(contour, moves)
        else:
            paths = [(block, LineString(move.points())) for block, move in moves if move.length() > 1e-9]
            bad = judge_gouge(paths, contour.wall(), radius) or judge_uncut(contour, together(paths), radius, contour.inside, contour.elements, 0)
        if bad:
            return bad
    return None


def judge_change(contour, moves):
    """A change of side: before it and behind it the contour is cut like any other. The two blocks beside it end and begin on their own offset curves, and
    where these meet is no wall for them (12.4.2, 12.4.5)."""
    r, elements = contour.radius, contour.elements
    a, b = contour.cross - 1, contour.cross  # but for lines that have no direction
    while a > 0 and elements[a].length() < NO_DIRECTION:
        a -= 1
    while b + 1 < len(elements) and elements[b].length() < NO_DIRECTION:
        b += 1
    before, behind = contour.lines_of[a], contour.lines_of[b]
    if elements[a].length() < NO_DIRECTION:  # the way in is what has a direction
        before = 0
        lengthened = moves
    else:
        lengthened = with_lengthened_start(moves, before, elements[a], r)
    if elements[b].length() < NO_DIRECTION:
        behind = contour.spans[0][1]
    paths = [(block, LineString(move.points())) for block, move in lengthened if move.length() > 1e-9]
    beside = [each for each in paths if before <= each[0] <= behind]
    others = [each for each in paths if not before <= each[0] <= behind]
    rest = [e.points() for i, e in enumerate(elements) if not a <= i <= b and e.length() > TOLERANCE]  # of a shorter one the ends are those of its neighbours
    bad = (others and judge_gouge(others, contour.wall(), r)) or (beside and rest and judge_gouge(beside, MultiLineString(rest), r, ends=False))
    bad = bad or judge_beyond_change((elements[a], elements[b]), [[path for block, path in paths if block == line] for line in (before, behind)], r)
    if bad:
        return bad
    off = 0
    for i, line, last in ((a, before, True), (b, behind, False)):
        of_block = [move for block, move in moves if block == line]
        if elements[i].length() > 0.01 and not (elements[i].center and abs(elements[i].radius() - r) < 0.01):
            off = max(off, min(beside_curve(elements[i], point, r, contour.left_at(i), last) for point in ends_beside(of_block, last, r)))
    if off > (NO_DIRECTION if contour.touches_by_a_digit() else 1e-5):
        return f"off the offset curve by {off:.6f} mm at the change of side"
    return (judge_uncut(contour, together([each for each in paths if each[0] <= before]), r, contour.inside, elements[:a], 0)
            or judge_uncut(contour, together([each for each in paths if each[0] >= behind]), r, not contour.inside, elements[b + 1:], -1))


def judge_beyond_change(elements, paths, r):
    """The path of each of the two blocks beside a change of side and the other block. The tool crosses the contour there: it cuts the block from the joint on, as far as that is without a gap, and what comes
    back to the joint."""
    for element, others, last in ((elements[0], paths[1], True), (elements[1], paths[0], False)):
        if not others or element.length() < NO_DIRECTION:
            continue
        path, crossing, joint = MultiLineString(others), True, element.end if last else element.start
        count = min(4000, max(50, math.ceil(element.length() / (r / 50))))
        for i in range(count + 1):
            point = element.at(1 - i / count if last else i / count)[0]
            away = path.distance(Point(point))
            if crossing and away > r + TOLERANCE:
                crossing = False
            elif not crossing and away < r - 2 * TOLERANCE and math.dist(point, joint) > 2 * r:
                return f"gouge of {r - away:.4f} mm beyond the change of side"
    return None


def with_lengthened_start(moves, block, element, r):
    """The moves with the one that leads up to this block's offset curve along its tangent as a move of the block. At an outer corner beside an arc the control counts it to the block in front (12.4.1), but of
    a line, and where the offset curves meet, it is a part of the block behind, which is lengthened by it."""
    in_front = max((k for k, (of, move) in enumerate(moves) if of < block and move.length() > 1e-9), default=None)
    if in_front is None or moves[in_front][1].center:
        return moves
    move, ((x, y), (ux, uy)) = moves[in_front][1], element.at(0)
    vx, vy = move.end[0] - move.start[0], move.end[1] - move.start[1]
    beside, along = (move.end[0] - x, move.end[1] - y), (vx * ux + vy * uy) / move.length()
    lengthens = abs(math.hypot(*beside) - r) < 1e-5 and abs(beside[0] * ux + beside[1] * uy) < 1e-5 and along > 1 - 1e-9
    return [*moves[:in_front], (block, move), *moves[in_front + 1:]] if lengthens else moves


def ends_beside(moves, last, r):
    """Where a block beside a change of side may end or begin. The step to the other side, a line of twice the radius, belongs to the block before, and so is
    its first move where nothing is left of it otherwise; behind a vector that the program gives it belongs to the block behind, in front of its own path."""
    first = moves[0]
    crosses = abs(math.dist(first.start[:2], first.end[:2]) - 2 * r) < 1e-3 and abs(first.length() - 2 * r) < 1e-3
    own = first.end if last else first.start
    return [own, first.start if last else first.end] if crosses else [own]


def beside_curve(element, point, r, left, last):
    """How far a point is from the curve that lies beside the element by r, lengthened. At its end (`last`) an arc has the radius that it ends with."""
    offset = r if left else -r
    if element.center is None:
        p, u = element.at(0)
        return abs((point[1] - p[1]) * u[0] - (point[0] - p[0]) * u[1] - offset)
    radius = math.dist(element.end, element.center) if last else element.radius()
    return abs(math.dist(point, element.center) - (radius - offset if element.ccw else radius + offset))


def judge_uncut(contour, path, r, inside, elements, near):
    """The manual goes round an outer corner by the meeting of the two offset lines (12.4.1), not on an arc: GEOS' mitre does so, too. What only an
    arc could reach in the inner corner behind is not asked for. `elements`: those that are asked about; `near`: the contour's element beside which the
    tool goes, where it could also go elsewhere."""
    if not elements:
        return None
    curve = reached(contour, r, inside, near, [])
    if isinstance(curve, str):
        return curve
    allowed = TOLERANCE + r * (1 - math.cos(math.pi / 256)) + 2 * SAGITTA  # ... of the circle that GEOS divides
    left_over = []
    for element in elements:
        for part in (0.1, 0.5, 0.9):
            point = Point(element.at(part)[0]) if element.length() > 0 else Point(element.start)
            left = path.distance(point) - r
            if left > allowed and curve.distance(point) <= r + 2 * SAGITTA:
                left_over.append((left, point))
    corners = lengthened_arcs(contour, r, inside) if left_over else []
    if corners:
        curve = reached(contour, r, inside, near, corners)
    worst = max((left for left, point in left_over if curve.distance(point) <= r + 2 * SAGITTA), default=0)
    if worst > allowed:
        return f"uncut by {worst:.4f} mm"
    return None


def reached(contour, r, inside, near, corners):
    """The curve that the tool's centre goes along by GEOS; into `corners` it does not go. A text: there is none."""
    if not inside:
        whole = unary_union([contour.part.buffer(r, resolution=64, join_style=2, mitre_limit=10), *corners])
        return max(getattr(whole, "geoms", [whole]), key=lambda piece: piece.area).exterior
    reach = contour.part.buffer(-r, resolution=64, join_style=2, mitre_limit=10)
    if reach.is_empty:  # as wide as the tool
        reach = contour.part.buffer(-r + TOLERANCE, resolution=64)
    if reach.is_empty:
        return "inside of a contour that the tool does not fit into, without an alarm"
    for corner in corners:
        reach = reach.difference(corner)
    pieces = list(reach.geoms) if reach.geom_type == "MultiPolygon" else [reach]
    start, u = contour.elements[near].start if near == 0 else contour.elements[near].end, tangent_at(contour.elements, near != 0)
    side = 1 if inside != contour.backwards else -1
    center = Point(start[0] - side * u[1] * r, start[1] + side * u[0] * r)
    return min(pieces, key=lambda piece: piece.distance(center)).exterior


def lengthened_arcs(contour, r, inside):
    """What lies between an outer corner of up to 90 degrees beside an arc and the point where the two offset curves meet (12.4.1). GEOS knows nothing of arcs: it lengthens the chords of
    the fine polygon, which meet elsewhere, so what an arc that is bent to the tool takes away from the wall behind the corner has to be told it."""
    left = r if inside != contour.backwards else -r
    elements = [e for e in contour.elements if e.center or e.length() >= NO_DIRECTION]
    corners = []
    for before, behind in zip(elements, elements[1:] + elements[:1]):
        (corner, u), (_, w) = before.at(1), behind.at(0)
        sine, cosine = u[0] * w[1] - u[1] * w[0], u[0] * w[0] + u[1] * w[1]
        if not (before.center or behind.center) or abs(sine) < 1e-3 or cosine < 0 or (sine > 0) == (left > 0):
            continue
        meeting = cut_at((before, left), (behind, left))
        if meeting:
            sides = [along_offset(e, (corner[0] - left * t[1], corner[1] + left * t[0]), meeting[0]) for e, t in ((before, u), (behind, w))]
            corners.append(Polygon([corner, *sides[0], *reversed(sides[1])]).buffer(0))
    return corners


def along_offset(element, start, end):
    """Points from one to another of a curve beside the element."""
    if element.center is None:
        return [start, end]
    angles = [math.atan2(p[1] - element.center[1], p[0] - element.center[0]) for p in (start, end)]
    turn, radius = (angles[1] - angles[0] + math.pi) % (2 * math.pi) - math.pi, math.dist(start, element.center)
    return [(element.center[0] + radius * math.cos(angles[0] + turn * i / 32), element.center[1] + radius * math.sin(angles[0] + turn * i / 32)) for i in range(33)]


def crosses_at_a_turn(before, behind):
    """Do two blocks cross beside the point in which the path turns back? Their tangents tell another side than their curvatures do: what lies there has no side."""
    bend = sum((1 if e.ccw else -1) / e.radius() for e in (before, behind) if e.center)
    (ux, uy), (vx, vy) = before.at(1)[1], behind.at(0)[1]
    sine = ux * vy - uy * vx
    return ux * vx + uy * vy < 0 and abs(sine) < 0.1 and sine * bend > 1e-12


def reaches_every_block(contour):
    """Does the tool touch each block of the contour, as it goes round it in one piece? Then no block is in the way of another one, and all that the control has to get right is the corners."""
    if isinstance(contour, Profile) and (contour.cross is not None or len(contour.cuts) > 1):
        return False
    if not contour.wall().is_simple:
        return False  # blocks that cross each other have no side on which nothing is in the way
    solid = [e for e in contour.elements if e.length() >= NO_DIRECTION]
    if any(crosses_at_a_turn(e, solid[(i + 1) % len(solid)]) for i, e in enumerate(solid)):
        return False
    curve = None if contour.other else reached(contour, contour.radius, contour.inside, 0, lengthened_arcs(contour, contour.radius, contour.inside))
    if curve is None or isinstance(curve, str) or curve.is_empty:
        return False
    touches = lambda point: curve.distance(Point(point)) <= contour.radius + 2 * SAGITTA
    inside = [0.01, *(part / 40 for part in range(1, 40)), 0.99]  # at its ends the tool may be there for the neighbours alone, and never come to what lies behind a narrow mouth
    if not touches(contour.elements[0].start) or not all(e.length() < NO_DIRECTION or any(touches(e.at(part)[0]) for part in inside) for e in contour.elements):
        return False
    # A line that the last digit of its words turns has the tool beside it in another place than the one from which it is touched, nearer to what stands opposite.
    is_place = lambda point: curve.distance(Point(point)) <= TOLERANCE - 3 * SAGITTA
    turned = [e for e in with_direction(contour.elements) if e.center is None and 1e-6 * contour.radius > 2 * SAGITTA * e.length()]
    return all(any(is_place(place) for part in inside for place in beside_element(e, part, contour.radius)) for e in turned)


def with_direction(elements):
    """The blocks, where lines that are too short to have a direction are one as soon as together they lead far enough."""
    blocks, start = [], None
    for element in elements:
        if element.center is None:
            element = Element(start or element.start, element.end)
            start = element.start if element.length() < NO_DIRECTION else None
        else:
            start = None
        if start is None:
            blocks.append(element)
    return blocks


def beside_element(element, part, radius):
    """The centre of a tool that touches this part of the element, from its left and from its right."""
    (x, y), (along_x, along_y) = element.at(part)
    return [(x - r * along_y, y + r * along_x) for r in (radius, -radius)]


def beside(element, move, radius):
    """The parts of a move on which the tool touches its own block. On the others it goes round a corner, on sides that 12.4.1 lengthens; what else stands there is for CONTOUR_CHECK."""
    corners = numpy.array(move.points())
    ends = [corners[:1]]
    for one, other in zip(corners, corners[1:]):
        pieces = max(1, math.ceil(math.dist(one, other) / (radius / 20)))
        ends.append(one + (other - one) * (numpy.arange(pieces) + 1)[:, None] / pieces)
    ends = numpy.concatenate(ends)
    touches = numpy.concatenate(([False], element.distances(ends) <= radius + TOLERANCE, [False]))
    changes = numpy.flatnonzero(touches[1:] != touches[:-1])  # where a part begins, and behind where it ends, in turn
    return [ends[first:behind] for first, behind in zip(changes[::2], changes[1::2]) if behind - first > 1]


def judge_blocks(contour, result):
    """The contour without its ways in and out and the two blocks that these lead to: what they pass there is for CONTOUR_CHECK."""
    elements = dict(list(zip(contour.lines_of, contour.programmed))[1:-1])
    paths = [(block, LineString(part)) for block, move, *_ in result.moves if block in elements and move.length() > 1e-9 for part in beside(elements[block], move, contour.radius)]
    return judge_gouge(paths, contour.wall(), contour.radius, ends=False) if paths else None


class Noses(Contour):
    """The digits of a cusp decide wrongly in one of some hundred, so there have to be many of them."""
    only = "noses"


# Once judged wrongly: a change of side onto an arc of two radii, which the path behind it touches at the one and not at the other; a block that lies behind a mouth narrower than the tool but for its end; a start
# that comes nearer than the radius by the last digit of its words; the lengthened start of an arc in front of a change of side. And a whole turn on the way in to a circle, which was taken for the turn of a way out by a control once,
# and two lines of a third of a micrometre in front of an arc as large as the tool.
ONCE_WRONG = [20085150, 20171280, 40011606, 60097302, 40001130, 600105451]


def judge_without_check(contours, without, wrong):
    contours = [c for c in contours if reaches_every_block(c)]
    for contour, result in zip(contours, run_all([["!CONTOUR_CHECK 0", *c.blocks()] for c in contours])):
        without[0] += 1
        without[1] += 1 if result.alarm else 0
        bad = None if result.alarm else judge_blocks(contour, result)
        if bad:
            wrong["without the check"] = wrong.get("without the check", 0) + 1
            print(f"seed {contour.seed} ({type(contour).__name__}, {contour.kind}, r {contour.radius}), without the check: {bad}")


def contour_of(seed):
    """Each third one is a profile of a CAM system."""
    return Profile(seed) if seed % 3 == 0 else Contour(seed)


def main():
    count, first = int(os.environ.get("NC_CONTOURS", "200" if os.environ.get("NC_SANITIZE") else "10000")), int(os.environ.get("NC_FIRST_SEED", "1"))
    show = os.environ.get("NC_SHOW")
    alarms, alarmed, wrong, kinds = {}, {}, {}, {}
    without = [0, 0]  # contours without CONTOUR_CHECK, and how many of them end in an alarm
    every_without = int(os.environ.get("NC_EVERY_WITHOUT", "1"))
    batches = [range(from_seed, min(from_seed + 500, first + count)) for from_seed in range(first, first + count, 500)]
    for seeds in [ONCE_WRONG, *batches]:
        contours = [contour_of(seed) for seed in seeds]
        for contour, result in zip(contours, run_all([c.blocks() for c in contours])):
            kinds[contour.kind] = kinds.get(contour.kind, 0) + 1
            if result.alarm:
                alarms[result.alarm] = alarms.get(result.alarm, 0) + 1
                alarmed[contour.kind] = alarmed.get(contour.kind, 0) + 1
                continue
            bad = judge(contour, result)
            if bad:
                what = bad.split(" by ")[0].split(" of ")[0]
                wrong[what] = wrong.get(what, 0) + 1
                if show or sum(wrong.values()) <= 10:
                    print(f"seed {contour.seed} ({contour.kind}, {'inside' if contour.inside else 'outside'}, r {contour.radius}): {bad}")
                if show:
                    print("\n".join(contour.blocks()))
        judge_without_check(contours[::every_without] + [Noses(seed) for seed in seeds[::5 * every_without]], without, wrong)
    tried = [contour_of(seed) for seed in range(first, first + count, int(os.environ.get("NC_EVERY", "5")))]
    results = run_all([c.blocks() for c in tried])
    for way in [*TRANSFORMS, "back"]:
        programs = [run_backwards(c) if way == "back" else transformed(c.blocks(), way) for c in tried]
        for contour, result, other in zip(tried, results, run_all(programs)):
            if way == "back" and not contour.reversible():
                continue  # their words stand at other blocks then, and along its sides the tool comes from the other end
            if way == "scale" and (contour.changes_in_a_tiny_line() or contour.becomes_a_block() or contour.changes_from_a_point() or contour.touches_by_a_digit()):
                continue  # twice as long it may be a block, which has a side of its own; twice as far apart paths do not touch, and twice as far from a centre one begins beside it
            bad = follows(result, other, TRANSFORMS.get(way, lambda p: p), way, as_large_as_the_tool(contour))
            if bad:
                wrong[way] = wrong.get(way, 0) + 1
                if sum(wrong.values()) <= 10 or show:
                    print(f"seed {contour.seed} ({contour.kind}, r {contour.radius}), {way}: {bad}")
    shares = {kind: alarmed.get(kind, 0) / of for kind, of in kinds.items()}
    print(f"{sum(kinds.values())} contours {kinds}: {sum(alarms.values())} end in an alarm {alarms}, of each kind {', '.join(f'{k} {share:.0%}' for k, share in shares.items())}; {without[0]} without the check, {without[1]} alarms; wrong {wrong}")
    for kind, share in shares.items():
        if kinds[kind] >= 100 and share > MOST_ALARMS[kind]:
            wrong["alarms"] = 1
            print(f"{kind}: more than {MOST_ALARMS[kind]:.0%} end in an alarm")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
