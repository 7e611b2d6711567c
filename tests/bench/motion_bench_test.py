# SPDX-License-Identifier: Apache-2.0
"""The tools of the motion benchmark: the reference solver is compared with closed forms, the checker gets recordings that are spoiled on purpose.

Runs in the environment that bench/motion/setup makes; skipped where it cannot be made.
"""
import math
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.environ.get("NC_SOURCE_DIR") or os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BENCH = os.path.join(ROOT, "bench", "motion")
SHARED = os.path.join(os.environ.get("NC_SHARED_DIR") or os.path.join(ROOT, "..", "shared"), "bench", "motion")

if os.environ.get("NC_SANITIZE"):
    print("skipped: these are tools in Python, tried with the release")
    sys.exit(77)
if os.environ.get("NC_MOTION_INSIDE") is None:
    made = subprocess.run([os.path.join(BENCH, "setup")], capture_output=True, text=True)
    if made.returncode != 0:
        print(made.stderr.strip() or "skipped: no environment")
        sys.exit(77)
    sys.exit(subprocess.run([made.stdout.strip(), os.path.abspath(__file__)] + sys.argv[1:], env={**os.environ, "NC_MOTION_INSIDE": "1"}).returncode)

# ---- inside the environment ----

sys.path.insert(0, BENCH)
import numpy as np  # noqa: E402
import free_optimum  # noqa: E402
import motion_check  # noqa: E402
import path_file  # noqa: E402
import path_from_program  # noqa: E402
import peer_path  # noqa: E402
import programs  # noqa: E402
import reference  # noqa: E402
import runner  # noqa: E402
import shop_programs  # noqa: E402

V, A, J = LIMITS = (250.0, 2000.0, 50000.0)
CYCLE = 0.001
KEPT = 1.02  # of a limit: what the grid of the reference may exceed between its nodes


def straight(length, feed):
    path = path_file.Path("XYZ")
    path.line(feed, [0, 0, 0], [length, 0, 0])
    return path


def solve(path, limits=LIMITS, jerk=True, step_s=0.001):
    return reference.Solution(path, reference.limits_of(path, limits), step_s, jerk)


def seven_phases(length, feed):
    """The time from rest to rest on a straight line with limits of jerk, acceleration and speed."""
    def ramp(v):
        return v / A + A / J if v >= A * A / J else 2 * math.sqrt(v / J)

    if ramp(feed) * feed <= length:
        return 2 * ramp(feed) + (length - ramp(feed) * feed) / feed
    low, high = 0.0, feed
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if ramp(middle) * middle < length else (low, middle)
    return 2 * ramp(low)


def program(folder, text, name="p.nc"):
    path = os.path.join(folder, name)
    with open(path, "w", encoding="ascii") as out:
        out.write(text)
    return path


class PathFiles(unittest.TestCase):
    def sample(self):
        path = path_file.Path("XYZ", {"X": LIMITS, "Y": LIMITS, "Z": LIMITS}, 0.01)
        path.line(0, [0, 0, 0], [5, 0, 0])
        path.stop(exact=False)
        path.arc(10, 0, 1, 0, 0, 4.0, [5, 0, 0], [5.5 * math.cos(4), 5.5 * math.sin(4), 3])
        path.stop(0.25)
        path.poly(5, [[0, 1, 2, -1.5], [0, 3, -1, 0.3], [0, 0, 0, 1]])
        return path

    def test_what_is_written_is_read(self):
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "p.path")
            path = self.sample()
            path.write(name)
            again = path_file.read(name)
        self.assertEqual((again.axes, again.limits, again.tolerance, again.pieces, again.stops, again.exact),
                         (path.axes, path.limits, path.tolerance, path.pieces, path.stops, path.exact))
        self.assertEqual(again.exact, {2})

    def test_mistakes_have_their_line(self):
        with tempfile.TemporaryDirectory() as folder:
            for text, says in (("", "no path in it"), ("axes X\n", "p.path:1: must begin with"), ("nc-path 1\naxes X Y\nline 1 2 3\n", "p.path:3: line needs 5"),
                               ("nc-path 1\naxes X\nline 1 2 x\n", "p.path:3: "), ("nc-path 1\naxes X\nbend 1\n", "bend is no item"),
                               ("nc-path 1\naxes X\nline 1 0 nan\n", "must be finite"), ("nc-path 1\naxes X\nlimits Y 1 2 3\n", "an axis of the path")):
                with self.assertRaises(path_file.PathError) as caught:
                    path_file.read(program(folder, text, "p.path"))
                self.assertIn(says, str(caught.exception))

    def test_derivatives_are_those_of_the_points(self):
        curves = self.sample().tables()
        for piece in (1, 2):
            length = curves.length[piece]
            h = 1e-4 * length
            s = 0.37 * length + h * np.arange(-1, 2)
            q = curves.by_length(np.full(3, piece), s)
            for low, high in ((0, 1), (1, 2), (2, 3)):
                self.assertLess(np.abs((q[low][2] - q[low][0]) / (2 * h) - q[high][1]).max(), 1e-6)
            self.assertLess(np.abs(np.linalg.norm(q[1], axis=1) - 1).max(), 1e-12)


class FreeOptimum(unittest.TestCase):
    """The optimum without a jerk limit, by toppra."""

    def test_a_line_is_a_trapezoid(self):
        for length, feed in ((50, 50), (1, 200), (300, 200)):
            ramp = min(feed, math.sqrt(A * length)) / A
            want = 2 * ramp if A * ramp < feed * (1 - 1e-9) else length / feed + feed / A
            self.assertAlmostEqual(free_optimum.seconds(straight(length, feed), LIMITS) / want, 1, delta=2e-3, msg=f"{length} {feed}")

    def test_a_circle_is_as_fast_as_its_acceleration_lets_it_be(self):
        path = path_file.Path("XY")
        path.arc(0, 0, 1, 0, 0, 20 * math.pi, [4, 0], [4, 0])
        round_in = 20 * math.pi * 4 / math.sqrt(A * 4)
        self.assertAlmostEqual(free_optimum.seconds(path, LIMITS) / round_in, 1, delta=0.02)

    def test_it_agrees_with_the_linear_program(self):
        path = path_file.Path("XY")
        path.poly(80, [[0, 20, 10, -30], [0, 5, -20, 30]])
        self.assertAlmostEqual(free_optimum.seconds(path, LIMITS) / solve(path, jerk=False).seconds, 1, delta=3e-3)

    def test_a_rest_is_counted_and_divides(self):
        path = straight(10, 50)
        path.stop(0.3)
        path.line(50, [10, 0, 0], [0, 0, 0])
        self.assertAlmostEqual(free_optimum.seconds(path, LIMITS), 0.3 + 2 * free_optimum.seconds(straight(10, 50), LIMITS), delta=1e-3)


class MeasuredSet(unittest.TestCase):
    def test_programs_are_the_same_bytes_each_time(self):
        for name, text in shop_programs.PROGRAMS.items():
            self.assertEqual(text(), text(), name)
            self.assertTrue(text().endswith("M30\n"), name)

    def test_the_least_speed_is_looked_for_away_from_rests(self):
        ramp = np.linspace(0, 1, 100)
        speed = np.concatenate([ramp, np.ones(800), [0.5], np.ones(800), ramp[::-1]])
        rows = np.stack([np.concatenate([[0], np.cumsum(speed)]), np.zeros(len(speed) + 1)], axis=1)
        self.assertAlmostEqual(runner.slowest_of_mean(rows), 0.5, delta=1e-3)


class Reference(unittest.TestCase):
    def test_a_straight_line_takes_the_time_of_seven_phases(self):
        for length, feed in ((50, 50), (200, 250), (20, 100), (1, 100), (0.05, 100)):
            self.assertAlmostEqual(solve(straight(length, feed)).seconds / seven_phases(length, feed), 1, delta=1e-3, msg=f"{length} {feed}")

    def test_an_oblique_line_is_limited_by_its_strongest_axis(self):
        path = path_file.Path("XY")
        path.line(0, [0, 0], [30, 40])
        want = seven_phases(40, V)
        self.assertAlmostEqual(solve(path).seconds / want, 1, delta=1e-3)

    def test_without_a_jerk_limit_a_line_is_a_trapezoid(self):
        self.assertAlmostEqual(solve(straight(50, 50), jerk=False).seconds, 50 / 50 + 50 / A, delta=1e-4)
        self.assertAlmostEqual(solve(straight(1, 0), jerk=False).seconds, 2 * math.sqrt(1 / A), delta=1e-4)

    def test_a_tighter_limit_takes_longer(self):
        path = straight(20, 100)
        times = [solve(path, limits).seconds for limits in (LIMITS, (V, A, J / 2), (V, A / 2, J), (V / 5, A, J))]
        self.assertLess(times[0], min(times[1:]))

    def test_a_corner_of_directions_is_an_error_with_its_pieces(self):
        path = straight(10, 50)
        path.line(50, [10, 0, 0], [10, 10, 0])
        with self.assertRaisesRegex(path_file.PathError, "pieces 1 and 2 join with a step of the direction"):
            solve(path)
        path.stop()
        path.stops = {1: 0.0}
        self.assertAlmostEqual(solve(path).seconds / (2 * seven_phases(10, 50)), 1, delta=1e-3)

    def test_a_step_of_the_curvature_is_an_error_only_with_a_jerk_limit(self):
        path = straight(10, 50)
        path.arc(50, 0, 1, 10, 5, math.pi / 2, [10, 0, 0], [15, 5, 0])
        with self.assertRaisesRegex(path_file.PathError, "step of the curvature"):
            solve(path)
        self.assertGreater(solve(path, jerk=False).seconds, (10 + 2.5 * math.pi) / 50)

    def test_a_corner_between_two_lines_overlaps_their_ramps(self):
        """One axis stops while the other starts, both with constant jerk, over the length that the tolerance allows: 6 reach / J = time^3."""
        reach, feed = 0.06, 50
        path = path_file.Path("XY")
        path.line(feed, [0, 0], [10 - reach, 0])
        path.poly(feed, [[10 - reach, 3 * reach, -3 * reach, reach], [0, 0, 0, reach]])
        path.line(feed, [10, reach], [10, 10])
        want = 2 * seven_phases(10, feed) - (6 * reach / J) ** (1 / 3)
        self.assertAlmostEqual(solve(path).seconds / want, 1, delta=3e-3)

    def test_dwells_are_added(self):
        path = straight(10, 50)
        path.stop(0.5)
        path.line(50, [10, 0, 0], [20, 0, 0])
        solution = solve(path)
        self.assertAlmostEqual(solution.seconds, 0.5 + 2 * seven_phases(10, 50), delta=1e-3)
        rows = solution.positions(CYCLE)
        self.assertAlmostEqual(len(rows) * CYCLE, solution.seconds, delta=3 * CYCLE)
        self.assertGreaterEqual(int(np.all(rows == rows[len(rows) // 2], axis=1).sum()), 499)


class Programs(unittest.TestCase):
    """Runs programs with ncsim, as the benchmark does."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.ncsim = peer_path.ncsim()

    def path(self, text, **more):
        return path_from_program.path_of(program(self.folder.name, text), self.ncsim, limits=LIMITS, **more)

    def test_the_programs_are_the_same_on_every_run(self):
        first = programs.write(os.path.join(self.folder.name, "a"))
        second = programs.write(os.path.join(self.folder.name, "b"))
        self.assertGreaterEqual(len(first), 25)
        for a, b in zip(first, second):
            with open(a, "rb") as x, open(b, "rb") as y:
                self.assertEqual(x.read(), y.read())

    def test_lengths_are_those_of_ncsim(self):
        for name in ("slot_30_6", "corner_arcs", "helix", "vertical_arcs", "circles", "mixed_stops"):
            text = programs.PROGRAMS[name]()
            said = subprocess.run([self.ncsim, "check", program(self.folder.name, text)], capture_output=True, text=True, check=True).stdout
            length = self.path(text, blend="none").tables().length.sum()
            self.assertAlmostEqual(length, float(said.split()[-2]), delta=1e-3, msg=name)

    def test_rounded_paths_stay_within_the_tolerance_and_are_smooth(self):
        for name in ("teeth_1", "random_short", "slot_30_6", "surface_1"):
            path = self.path(programs.PROGRAMS[name]())
            edges = sorted({0, len(path.pieces), *path.stops})
            for first, last in zip(edges[:-1], edges[1:]):
                reference.Grid(path.tables(), first, last, np.array([])).check_smooth(True)

    def test_stops_split_the_path(self):
        path = self.path(programs.PROGRAMS["mixed_stops"](), blend="none")
        self.assertEqual(len(path.pieces), 9)
        self.assertEqual(path.exact, {3, 5, 6, 7, 9})
        self.assertEqual(path.stops[7], 0.2)
        self.assertEqual(self.path(programs.PROGRAMS["square_50_stop"](), blend="none").exact, {1, 2, 3, 4})

    def check_against_facts(self, name, seconds, share):
        file = os.path.join(SHARED, name + ".nc")
        if not os.path.exists(file):
            self.skipTest("../shared is not here")
        path = path_from_program.path_of(file, self.ncsim, 0.01, "parabola", LIMITS)
        self.assertAlmostEqual(solve(path, jerk=False, step_s=0.002).seconds / seconds, 1, delta=share)

    # Time-optimal path parametrization of others, the same corners: ../shared/bench/README.md.
    def test_without_a_jerk_limit_the_square_is_that_of_others(self):
        self.check_against_facts("a_square_g64", 4.084, 1e-3)
        self.check_against_facts("a_square_g61", 4.100, 1e-3)

    def test_without_a_jerk_limit_the_circles_are_those_of_others(self):
        self.check_against_facts("d_circles", 2.29, 3e-3)

    def test_without_a_jerk_limit_the_spiral_is_that_of_others(self):
        self.check_against_facts("c_spiral_2000", 26.15, 2e-3)

    def test_without_a_jerk_limit_the_surface_is_that_of_others(self):
        if not os.environ.get("NC_MOTION_LONG"):
            self.skipTest("NC_MOTION_LONG=1 runs it: a minute")
        self.check_against_facts("b_zigzag_surface", 14.72, 5e-3)


class Checker(unittest.TestCase):
    """A recording in which everything is kept, and what is reported when something in it is changed."""

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            text = "G17 G21 G90 G94\nG64\nG1 X8. F3000.\nY6.\nG61\nX2.\nG64\nY12.\nM30\n"
            file = program(folder, text)
            ncsim = peer_path.ncsim()
            cls.programmed = path_from_program.path_of(file, ncsim, 0.01, "none", LIMITS)
            cls.rounded = path_from_program.path_of(file, ncsim, 0.01, "cubic", LIMITS)
            cls.loose = path_from_program.path_of(file, ncsim, 0.03, "cubic", LIMITS)
        cls.solution = solve(cls.rounded)
        cls.rows = cls.solution.positions(CYCLE)

    def said(self, rows, tolerance=0.01, path=True):
        return motion_check.breaches("XYZ", rows, CYCLE, [LIMITS] * 3, self.programmed if path else None, tolerance, KEPT)

    def time_of(self, text):
        return float(text.split("t = ")[1].split(" s")[0])

    def test_the_reference_keeps_its_limits_the_path_and_the_feed(self):
        # an exact stop of the reference falls between two cycles
        self.assertEqual([s for s in self.said(self.rows) if not s.startswith("stop")], [])

    def test_one_sample_moved_is_a_jerk_of_its_axis_at_its_time(self):
        for axis, row in ((0, 60), (1, 250), (2, 333)):
            rows = self.rows.copy()
            rows[row, axis] += 0.0004
            said = self.said(rows, path=False)
            self.assertTrue(said)
            for text in said:
                self.assertTrue(text.startswith("axis " + "XYZ"[axis]), text)
                self.assertAlmostEqual(self.time_of(text), row * CYCLE, delta=3.5 * CYCLE)
            self.assertTrue(any("jerk" in s for s in said))

    def test_one_sample_off_the_path_is_seen_at_its_time(self):
        rows = self.rows.copy()
        rows[80, 2] += 0.02
        away = [s for s in self.said(rows) if s.startswith("path")]
        self.assertEqual(len(away), 1)
        self.assertIn("0.020000 mm away at t = 0.080000 s", away[0])

    def test_a_corner_cut_too_far_is_seen_where_it_is(self):
        rows = solve(self.loose).positions(CYCLE)
        away = [s for s in self.said(rows) if s.startswith("path")]
        self.assertEqual(len(away), 1, self.said(rows))
        here = rows[round(self.time_of(away[0]) / CYCLE)]
        self.assertLess(min(np.linalg.norm(here - np.array([8, y, 0])) for y in (0, 6)), 0.1)
        self.assertEqual([s for s in self.said(rows, tolerance=0.03) if not s.startswith("stop")], [])

    def test_one_speed_too_high_is_a_feed_and_an_acceleration(self):
        cruise = int(np.argmax(np.diff(self.rows[:200, 0]) > 0.9999 * 0.05)) + 5
        rows = np.delete(self.rows, cruise, axis=0)
        said = self.said(rows)
        feed = [s for s in said if s.startswith("feed")]
        self.assertEqual(len(feed), 1, said)
        self.assertAlmostEqual(self.time_of(feed[0]), cruise * CYCLE, delta=1.5 * CYCLE)
        hard = [s for s in said if s.startswith("axis")]
        self.assertTrue(any("acceleration" in s for s in hard), said)
        for text in hard:
            self.assertTrue(text.startswith("axis X"), text)
            self.assertAlmostEqual(self.time_of(text), cruise * CYCLE, delta=3.5 * CYCLE)

    def test_a_step_at_the_start_and_the_end_counts(self):
        rows = np.zeros((10, 3))
        rows[:, 1] = 0.001 * np.arange(10)  # 1 mm/s at once, and at once to rest
        worst = motion_check.worst_ratios(rows, CYCLE, [(1.0, 1000.0, 1e6)] * 3)
        self.assertAlmostEqual(worst["acceleration"][1][0], 1.0, places=6)
        self.assertAlmostEqual(worst["jerk"][1][0], 1.0, places=5)
        self.assertEqual(worst["jerk"][0][0], 0.0)

    def test_a_stretch_left_out_or_turned_back_is_seen(self):
        rows = np.concatenate([self.rows[:100], self.rows[300:]])
        velocity = [s for s in self.said(rows) if "velocity" in s]
        self.assertEqual([s[:6] for s in velocity], ["axis X", "axis Y"])
        self.assertAlmostEqual(self.time_of(velocity[0]), 0.1, delta=1e-9)
        self.assertTrue(any(s.startswith("end: missed by") for s in self.said(self.rows[:300])))
        back = np.concatenate([self.rows[:150], self.rows[150:50:-1], self.rows[50:]])
        self.assertTrue(any(s.startswith("path") for s in self.said(back)))

    def test_a_missed_exact_stop_is_said(self):
        exact = self.rows.copy()
        corner = np.array([2.0, 6.0, 0.0])
        row = int(np.argmin(np.linalg.norm(exact - corner, axis=1)))
        exact[row] = corner
        self.assertEqual([s for s in self.said(exact) if s.startswith("stop")], [])
        exact[row, 0] += 2e-6
        self.assertEqual([s.split(":")[0] for s in self.said(exact) if s.startswith("stop")], ["stop behind piece 3"])

    def test_circles_are_followed_over_all_their_turns(self):
        path = path_file.Path("XYZ")
        path.arc(100, 0, 1, 0, 0, 6 * math.pi, [5, 0, 0], [5, 0, 9])
        angle = np.linspace(0, 6 * math.pi, 2000)
        rows = np.stack([5 * np.cos(angle), 5 * np.sin(angle), 9 * angle / (6 * math.pi)], axis=1)
        seen = motion_check.Follower(path, CYCLE, 0.01).follow(rows)
        self.assertLess(seen.deviation[0], 1e-9)
        self.assertLess(seen.left, 1e-9)
        self.assertEqual(seen.share, 1.0)
        rows[1000] *= 1.01
        self.assertAlmostEqual(motion_check.Follower(path, CYCLE, 0.01).follow(rows).deviation[1], 1.0)

    def test_a_recording_is_not_followed_too_far_ahead_where_the_path_turns_back(self):
        path = path_file.Path("XY")
        corners = [[0, 0], [0.024, 0], [0.024, 0.008], [0, 0.008], [0, 0.03]]
        for a, b in zip(corners[:-1], corners[1:]):
            path.line(100, a, b)
        # The third row is nearer to the way back than to the way there, and the fourth one is on the way there again.
        rows = np.array([[0, 0], [0.008, 0], [0.015, 0.0041], [0.022, 0.001], [0.024, 0.004], [0.02, 0.008], [0, 0.008], [0, 0.03]])
        self.assertLessEqual(motion_check.Follower(path, CYCLE, 0.005).follow(rows).deviation[0], 0.005)
        rows[3] = [0.022, -0.006]
        self.assertGreater(motion_check.Follower(path, CYCLE, 0.005).follow(rows).deviation[0], 0.005)

    def test_the_recording_of_ncsim_is_read(self):
        with tempfile.TemporaryDirectory() as folder:
            file = program(folder, "G0 X10.\nG1 X20. F600.\nM30\n")
            out = os.path.join(folder, "m.csv")
            subprocess.run([peer_path.ncsim(), "motion", "--cycle-us", "500", "-o", out, file], check=True)
            axes, cycle_s, rows = motion_check.read_motion(out)
        self.assertEqual(axes, ["X", "Y", "Z"])
        self.assertAlmostEqual(cycle_s, 0.0005)
        self.assertEqual(list(rows[-1]), [20, 0, 0])


if __name__ == "__main__":
    unittest.main()
