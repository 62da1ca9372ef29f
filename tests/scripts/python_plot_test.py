#!/usr/bin/env python3
"""Facts about yars.plot, drawn by Agg from made-up results. Skipped (77) without NumPy or matplotlib."""
import importlib.util
import math
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest
import warnings

sys.dont_write_bytecode = True
PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "python"
sys.path.insert(0, str(PACKAGE))
if importlib.util.find_spec("numpy") is None or importlib.util.find_spec("matplotlib") is None:
    print("python_plot_test: skipped: python3-numpy or python3-matplotlib is not installed; "
          "scripts/setup --python brings them")
    sys.exit(77)
import matplotlib  # noqa: E402
import numpy  # noqa: E402

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

from yars import plot  # noqa: E402

UNITS = {"power": "1", "height": "m MSL", "slant_range": "m", "ground_range": "m", "azimuth": "deg", "latitude": "deg",
         "longitude": "deg", "grazing_angle": "deg"}
DEGREE_M = 111195.0  # [m] of latitude
APEX = (37.0, -122.0)


def with_arrays(shape, **more):
    """A result with every array that scans and patches have."""
    ramp = numpy.linspace(0.0, 1.0, shape[0] * shape[1]).reshape(shape)
    arrays = {"power": (ramp + 1e-3).astype("f4"), "video": (255 * ramp).astype("u1"),
              "shadow": (ramp > 0.5).astype("u1"), "layover": (ramp < 0.1).astype("u1"), "height": ramp * 900,
              "grazing_angle": 90 * ramp, "slant_range": 1000 * ramp, "object": numpy.full(shape, -1, "i4"),
              "material": numpy.zeros(shape, "u1"), "units": dict(UNITS)}
    return types.SimpleNamespace(**{**arrays, **more})


def made_up_scan(first_deg=145.0, last_deg=245.0, sweeps=101, samples=80, apex=APEX):
    """Azimuths are those of the middle of each sweep. The nearest five samples have no ground."""
    azimuth = numpy.linspace(first_deg, last_deg, sweeps)
    range_m = numpy.tile((numpy.arange(samples) + 0.5) * 926.0, (sweeps, 1))
    turn = numpy.radians(azimuth)[:, None]
    latitude = apex[0] + range_m * numpy.cos(turn) / DEGREE_M
    longitude = apex[1] + range_m * numpy.sin(turn) / DEGREE_M / math.cos(math.radians(apex[0]))
    for array in (range_m, latitude, longitude):
        array[:, :5] = numpy.nan
    return with_arrays((sweeps, samples), azimuth=azimuth, ground_range=range_m, latitude=latitude,
                       longitude=(longitude + 180.0) % 360.0 - 180.0)


def made_up_patch(size=64, pixel_m=5.0, centre=(36.7, -122.1)):
    rows, columns = numpy.meshgrid(numpy.arange(size), numpy.arange(size), indexing="ij")
    north_m, east_m = (size / 2 - 0.5 - rows) * pixel_m, (columns + 0.5 - size / 2) * pixel_m
    made = with_arrays((size, size), ground_range=30000.0 + north_m, latitude=centre[0] + north_m / DEGREE_M,
                       longitude=centre[1] + east_m / DEGREE_M)
    made.power[-1] = numpy.nan
    made.object[10:20, 10:20] = 3
    return made


class Terrain:
    """Land west of `shore`, sea east of it, a void in the south."""

    def __init__(self, shore=-121.9):
        self.shore = shore

    def elevation(self, latitude, longitude):
        elevation = numpy.where(longitude < self.shore, 300.0, 0.0)
        return numpy.where(latitude < 36.35, numpy.nan, elevation)


def bars(ax):
    """Labels of the colour bars of the figure."""
    return [other.get_ylabel() for other in ax.figure.axes if other is not ax]


class Pictures(unittest.TestCase):
    def tearDown(self):
        pyplot.close("all")

    def drawn(self, ax):
        """The picture has axes with units, and Agg draws it."""
        for label in (ax.get_xlabel(), ax.get_ylabel()):
            self.assertRegex(label, r"\[(NM|m|deg)\]$")
        self.assertEqual(ax.get_title(), "")
        with tempfile.TemporaryDirectory() as folder:
            ax.figure.savefig(pathlib.Path(folder, "picture.png"))
        return ax


class Ppi(Pictures):
    def test_the_middle_of_the_scan_points_up(self):
        ax = self.drawn(plot.ppi(made_up_scan()))
        corners = ax.collections[0].get_coordinates()
        self.assertEqual(corners.shape, (102, 81, 2))
        # the unknown nearest samples reach to the aircraft
        self.assertTrue(numpy.allclose(corners[:, 0], 0.0, atol=1e-9))
        far = corners[:, -1]
        self.assertTrue(numpy.allclose(numpy.hypot(*far.T), 40.0, rtol=1e-6))
        self.assertAlmostEqual(far[0, 0], -40.0 * math.sin(math.radians(50.5)), places=6)
        self.assertAlmostEqual(far[-1, 0], 40.0 * math.sin(math.radians(50.5)), places=6)
        self.assertIn("195.0", ax.get_xlabel())
        self.assertEqual(ax.get_aspect(), 1.0)

    def test_a_scan_across_north_is_one_sector(self):
        scan = made_up_scan(-50.0, 50.0)
        scan.azimuth = scan.azimuth % 360.0
        ax = plot.ppi(scan)
        self.assertLess(numpy.abs(ax.collections[0].get_coordinates()[:, -1, 0]).max(), 32.0)
        self.assertIn("azimuth 0.0", ax.get_xlabel())

    def test_what_has_a_unit_has_a_colour_bar(self):
        scan = made_up_scan()
        for quantity, label in (("video", []), ("shadow", []), ("object", []), ("power", ["power [dB]"]),
                                ("height", ["height [m MSL]"]), ("grazing_angle", ["grazing angle [deg]"])):
            self.assertEqual(bars(self.drawn(plot.ppi(scan, quantity=quantity))), label)

    def test_one_sweep_is_a_sector_of_a_degree(self):
        scan = made_up_scan(195.0, 195.0, 1)
        far = self.drawn(plot.ppi(scan)).collections[0].get_coordinates()[:, -1]
        self.assertAlmostEqual(far[1, 0] - far[0, 0], 2 * 40.0 * math.sin(math.radians(0.5)), places=6)

    def test_a_sweep_over_a_void_has_the_ranges_of_its_neighbour(self):
        scan = made_up_scan()
        whole = plot.ppi(scan).collections[0].get_coordinates()
        for sweep in (0, 1, 50, 100):
            scan.ground_range[sweep] = numpy.nan
        self.assertTrue(numpy.allclose(plot.ppi(scan).collections[0].get_coordinates(), whole))

    def test_power_is_in_decibels(self):
        scan = made_up_scan()
        scan.power[:] = 0.01
        scan.power[0, 0] = 0.0
        drawn = plot.ppi(scan, quantity="power").collections[0].get_array().reshape(scan.power.shape)
        self.assertTrue(drawn.mask[0, 0])
        self.assertAlmostEqual(float(drawn[1, 1]), -20.0, places=5)

    def test_bad_arguments_are_value_errors(self):
        scan = made_up_scan()
        for bad, said in ((lambda: plot.ppi(scan, quantity="colour"), "expected one of video, power"),
                          (lambda: plot.ppi(types.SimpleNamespace(**{**vars(scan), "azimuth": scan.azimuth[1:]})),
                           "each of its 101 sweeps"),
                          (lambda: plot.ppi(types.SimpleNamespace(
                              **{**vars(scan), "ground_range": scan.ground_range * numpy.nan})),
                           "a sweep with at least two known samples"),
                          (lambda: plot.ppi(types.SimpleNamespace(**{**vars(scan), "units": {"ground_range": "ft"}})),
                           "found 'ft'")):
            with self.assertRaises(ValueError) as caught:
                bad()
            self.assertIn(said, str(caught.exception))


class Patch(Pictures):
    def test_the_far_edge_is_at_the_top_and_pixels_are_square(self):
        ax = self.drawn(plot.patch(made_up_patch()))
        image = ax.images[0]
        self.assertTrue(numpy.allclose(image.get_extent(), (-160.0, 160.0, -160.0, 160.0)))
        self.assertEqual((image.origin, ax.get_aspect()), ("upper", 1.0))
        self.assertGreater(ax.get_ylim()[1], ax.get_ylim()[0])  # the first row is farthest up
        self.assertEqual(bars(ax), [])

    def test_the_blind_zone_is_not_drawn(self):
        drawn = plot.patch(made_up_patch(), quantity="power").images[0].get_array()
        self.assertTrue(drawn.mask[-1].all())
        self.assertFalse(drawn.mask[:-1].any())

    def test_ground_without_an_object_is_not_drawn(self):
        self.assertEqual(plot.patch(made_up_patch(), quantity="object").images[0].get_array().count(), 100)

    def test_it_draws_into_axes_that_are_given(self):
        figure, axes = pyplot.subplots(1, 2)
        self.assertIs(plot.patch(made_up_patch(), ax=axes[1]), axes[1])
        self.assertFalse(axes[0].has_data())
        self.assertIs(axes[1].figure, figure)


class Map(Pictures):
    def test_it_has_coast_and_footprints(self):
        ax = self.drawn(plot.map(Terrain(), made_up_scan(), made_up_patch()))
        self.assertEqual([line.get_label() for line in ax.lines], ["scan 1", "patch 2"])
        coast = [path for one in ax.collections for path in one.get_paths() if one.get_facecolor().size == 0]
        self.assertEqual(len(coast), 1)
        self.assertLess(numpy.abs(coast[0].vertices[:, 0] + 121.9).max(), 0.01)
        west, east = ax.get_xlim()
        for line in ax.lines:
            self.assertTrue(west < line.get_xdata().min() and line.get_xdata().max() < east)
        self.assertEqual(bars(ax), ["elevation [m MSL]"])
        self.assertAlmostEqual(ax.get_aspect(), 1.0 / math.cos(math.radians(sum(ax.get_ylim()) / 2)))

    def test_voids_are_neither_land_nor_water(self):
        water, land = plot.map(Terrain(), bounds=(36.0, -123.0, 37.0, -121.0), posts=101).collections[:2]
        void = numpy.zeros((101, 101), bool)
        void[:35] = True
        self.assertTrue(
            (water.get_array().mask.reshape(101, 101) & land.get_array().mask.reshape(101, 101) == void).all())

    def test_open_sea_has_no_coast(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            ax = self.drawn(plot.map(Terrain(), bounds=(36.5, -121.0, 37.0, -120.0)))
        self.assertEqual(bars(ax), [])

    def test_a_footprint_across_the_antimeridian_is_whole(self):
        ax = self.drawn(plot.map(Terrain(), made_up_scan(apex=(37.0, 179.9)), made_up_scan(apex=(37.0, -179.9))))
        west, east = ax.get_xlim()
        self.assertLess(east - west, 4.0)
        for line in ax.lines:
            self.assertTrue(west < line.get_xdata().min() and line.get_xdata().max() < east)

    def test_without_results_it_needs_bounds(self):
        for arguments in ({}, {"bounds": (38.0, -122.0, 37.0, -121.0)}):
            with self.assertRaisesRegex(ValueError, r"bounds: expected \(south, west, north, east\)"):
                plot.map(Terrain(), **arguments)


class TradeFront(Pictures):
    def rows(self):
        def value(mean):
            return {"mean": mean, "worst": mean if mean is None else 2 * mean}

        points = [{"point": name, "family": "preset", "ms": value(ms), "gray": value(gray), "shadow": value(shadow)}
                  for name, ms, gray, shadow in (("1996", 1.0, 100.0, None), ("draft", 2.0, 30.0, 5.0),
                                                 ("slow", 3.0, 40.0, 6.0), ("reference", 99.0, 0.0, 0.0))]
        return {"axes": {"time": {"column": "ms", "title": "time (ms)"},
                         "errors": [{"column": "gray", "title": "gray levels"},
                                    {"column": "shadow", "title": "shadow (%)"}]},
                "scenes": ["one"], "points": points}

    def test_axes_have_the_titles_of_the_columns(self):
        ax = plot.trade_front(self.rows())
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("time (ms)", "gray levels"))
        self.assertEqual((ax.get_xscale(), ax.get_yscale()), ("log", "log"))
        self.assertEqual({text.get_text() for text in ax.texts}, {"1996", "draft", "slow", "reference", "none"})
        self.assertEqual(list(ax.lines[0].get_xdata()), [1.0, 2.0, 99.0])  # the front leaves out what others beat

    def test_another_error_is_chosen_by_its_column(self):
        ax = plot.trade_front(self.rows(), error="shadow")
        self.assertEqual(ax.get_ylabel(), "shadow (%)")
        self.assertNotIn("1996", {text.get_text() for text in ax.texts})
        with self.assertRaisesRegex(ValueError, "error: expected one of gray, shadow, found 'power'"):
            plot.trade_front(self.rows(), error="power")


class Backend(unittest.TestCase):
    def test_no_screen_is_needed(self):
        done = subprocess.run([sys.executable, "-B", "-c", "import yars; ax = yars.plot._axes(None); "
                                                           "print(ax.figure.canvas.__class__.__name__)"],
                              env={"PYTHONPATH": str(PACKAGE), "PATH": "/usr/bin:/bin",
                                   "MPLCONFIGDIR": tempfile.gettempdir()}, capture_output=True, text=True, timeout=120)
        self.assertEqual((done.returncode, done.stdout), (0, "FigureCanvasAgg\n"), done.stderr)


if __name__ == "__main__":
    unittest.main()
