"""The summary's statistics against values worked out by hand.

    SOURCE=DIR SLOPEMIX=PROGRAM python3 test_summary.py
"""
import os
import pathlib
import sys
import tempfile
import unittest

from folders import SOURCE, workflow_python

python = workflow_python()
if sys.executable != python:  # it has numpy and FLIP
    os.execv(python, [python, "-B", *sys.argv])
sys.path.insert(0, str(SOURCE / "tools" / "workflow"))
import numpy
from plan import Plan, sheet_flags
from summary import cost, reason, statistics, tables, times
from gallery.image import BACKGROUND
from summary.measure import flip, shown

ALPHAS = {1: (0.1, 0.1), 2: (0.1, 0.0), 3: (0.0, 0.1)}


def image(id, relrmse, flip, model="shared", lobes=1, order=0, light=90.0):
    alpha_x, alpha_y = ALPHAS[int(id[0])]
    return {"id": id, "model": model, "lobes": lobes, "widening_order": order, "alpha_x": alpha_x, "alpha_y": alpha_y,
            "light_phi_deg": light, "relrmse": relrmse, "flip": flip}


# Means: a 0.2, b 0.6 under shared N = 1; a 0.3, b 0.1 under per-lobe N = 8.
METRICS = {
    "a": {"images": [image("1.1.3", 0.1, 0.01), image("2.1.3", 0.3, 0.03, light=0.0),
                     image("1.1.6", 0.3, 0.05, "per-lobe", 8)],
          "references": [{"samples": 1000, "seconds": 0.5}, {"samples": 3000, "seconds": 0.9}]},
    "b": {"images": [image("1.1.3", 0.4, 0.04), image("2.1.3", 0.8, 0.08, light=0.0),
                     image("1.1.6", 0.1, 0.02, "per-lobe", 8)], "references": [{"samples": 2000, "seconds": 0.7}]}}
ROWS = statistics.rows_of(METRICS, {"a": "paint", "b": "metal"})


class Distributions(unittest.TestCase):
    def test_ninth_of_ten_is_the_90th_percentile(self):
        values = [3, 1, 2, 10, 5, 4, 7, 6, 9, 8]
        self.assertEqual(statistics.distribution(values), {"median": 5.5, "mean": 5.5, "p90": 9, "worst": 10})

    def test_one_value_is_all_of_them(self):
        self.assertEqual(statistics.distribution([0.3]), {"median": 0.3, "mean": 0.3, "p90": 0.3, "worst": 0.3})

    def test_a_material_is_the_mean_of_its_images(self):
        shared, per_lobe = statistics.by_fit(ROWS)
        self.assertEqual((shared["fit"], per_lobe["fit"]), ("shared N = 1", "per-lobe N = 8"))
        self.assertAlmostEqual(shared["relrmse"]["mean"], 0.4)
        self.assertAlmostEqual(shared["relrmse"]["worst"], 0.6)
        self.assertEqual(shared["relrmse"]["worst_material"], "b")
        self.assertAlmostEqual(shared["flip"]["median"], 0.04)
        self.assertAlmostEqual(per_lobe["relrmse"]["worst"], 0.3)
        self.assertEqual(per_lobe["relrmse"]["worst_material"], "a")
        self.assertEqual(shared["materials"], 2)

    def test_groups(self):
        kinds = statistics.by(ROWS, lambda row: row["kind"], lambda kind: {"kind": kind})
        self.assertEqual([(entry["kind"], entry["fit"]) for entry in kinds], [
            (kind, fit) for kind in ("metal", "paint") for fit in ("shared N = 1", "per-lobe N = 8")])
        self.assertAlmostEqual(kinds[2]["relrmse"]["median"], 0.2)
        rough = statistics.by(ROWS, lambda row: row["roughness"], lambda name: {"roughness": name})
        self.assertEqual([entry["roughness"] for entry in rough], ["isotropic", "isotropic", "latitudinal"])
        self.assertAlmostEqual(rough[2]["relrmse"]["mean"], 0.55)  # latitudinal: 0.3 and 0.8

    def test_an_order_is_a_fit_of_its_own(self):
        self.assertEqual(statistics.fit_name("per-lobe", 8, 3), "per-lobe N = 8, order 3")
        self.assertEqual(statistics.fit_name("per-lobe", 8, "auto"), "per-lobe N = 8, order auto")

    def test_the_worst_are_those_of_the_per_lobe_model_in_closed_form(self):
        self.assertEqual(statistics.worst_materials(ROWS, 5), [("a", 0.3), ("b", 0.1)])
        self.assertEqual(statistics.worst_materials(ROWS, 1), [("a", 0.3)])


class Reasons(unittest.TestCase):
    def parts(self, fit, widening, shared_fit=1.0):
        rows = [{"model": "shared", "inversion": 0.2, "fit": shared_fit, "widening": 0.1, "total": 0.3},
                {"model": "per-lobe", "inversion": None, "fit": fit, "widening": widening, "total": 0.4}]
        return reason.split({"mean": rows})

    def test_the_larger_part_dominates(self):
        self.assertIn("the fit dominates (fit 0.300, widening 0.100)", reason.reason(self.parts(0.3, 0.1)))
        self.assertIn("the widening dominates", reason.reason(self.parts(0.1, 0.3)))
        self.assertIn("alike", reason.reason(self.parts(0.2, 0.25)))

    def test_the_shared_model_is_named_where_it_is_better(self):
        self.assertIn("one curve", reason.reason(self.parts(0.3, 0.1, shared_fit=0.2)))
        self.assertNotIn("one curve", reason.reason(self.parts(0.3, 0.1, shared_fit=0.4)))

    def test_parts(self):
        parts = self.parts(0.3, 0.1)
        self.assertEqual((parts["inversion"], parts["fit"], parts["total"]), (0.2, 0.3, 0.4))


class Cost(unittest.TestCase):
    def test_pixels_on_the_sphere(self):
        centres = (numpy.arange(128) + 0.5) / 64 - 1
        inside = (centres[:, None] ** 2 + centres[None, :] ** 2 < 1).sum()
        self.assertEqual(cost.PIXELS_ON_SPHERE, inside)
        x, y = numpy.meshgrid(centres, centres)
        z = numpy.sqrt(numpy.maximum(0, 1 - x**2 - y**2))  # towards the camera, where phi is 90 degrees
        lit = sum((numpy.cos(phi) * x + numpy.sin(phi) * z > 0)[x**2 + y**2 < 1].sum()
                  for phi in numpy.radians(cost.LIGHTS))
        self.assertAlmostEqual(cost.LIT_PIXELS / lit, 1, delta=0.01)

    def test_the_protocol_from_the_cost_of_one_sample_more(self):
        found = cost.extrapolation(METRICS, threads=2)  # 0.3 s and 0.2 ms a sample
        samples = 100 * 9 * cost.LIT_PIXELS * 65536
        self.assertAlmostEqual(found["core_seconds"] / (samples * 2e-4 * 2), 1)
        self.assertIn("one more", found["assumes"])

    def test_the_mean_where_one_sample_more_is_not_told(self):
        same = [{"samples": 100, "seconds": seconds} for seconds in (1.0, 3.0)]
        falling = [{"samples": 100, "seconds": 3.0}, {"samples": 300, "seconds": 1.0}]
        self.assertAlmostEqual(cost.seconds_per_sample(same)[0], 0.02)
        self.assertAlmostEqual(cost.seconds_per_sample(falling)[0], 0.01)

    def test_stages(self):
        with tempfile.TemporaryDirectory() as out:
            for path, took in (("fit/a/shared-1", (1.0, 2.0, 50)), ("fit/b/shared-1", (0.5, 0.25, 70)),
                               ("worst", (3.0, 9.0, 5)), ("page/a", (1.0, 1.0, 1))):
                file = pathlib.Path(out, "times", f"{path}.json")
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text('{"seconds": %g, "cpu_seconds": %g, "max_rss_mb": %d}' % took)
            self.assertEqual(cost.time_of(pathlib.Path(out)), [
                {"stage": "worst", "jobs": 1, "seconds": 3.0, "cpu_seconds": 9.0, "max_rss_mb": 5},
                {"stage": "fit", "jobs": 2, "seconds": 1.5, "cpu_seconds": 2.25, "max_rss_mb": 70},
                {"stage": "all", "jobs": 3, "seconds": 4.5, "cpu_seconds": 11.25, "max_rss_mb": 70}])

    def test_clock(self):
        self.assertEqual([times.clock(seconds) for seconds in (4.21, 60, 3723)],
                         ["4.2 s", "1 min 00 s", "1 h 02 min 03 s"])


class Images(unittest.TestCase):
    def sphere(self, value):
        """A grey disc with nothing around it."""
        at = numpy.linspace(-1, 1, 32)
        alpha = (at[:, None] ** 2 + at[None, :] ** 2 < 0.8).astype(numpy.float32)
        return numpy.stack([value * alpha] * 3 + [alpha], axis=-1)

    def test_what_is_shown(self):
        pixels = numpy.array([[[0.5, 0.001, 4.0, 1.0], [0, 0, 0, 0]]], numpy.float32)
        self.assertEqual((255 * shown(pixels, 1.0)[0, 0]).round().tolist(), [188, 3, 255])  # sRGB of a half is 0.735
        self.assertTrue(numpy.allclose(255 * shown(pixels, 1.0)[0, 1], BACKGROUND))

    def test_flip_of_black_and_white_is_1_and_of_the_same_0(self):
        self.assertEqual(flip(self.sphere(0.5), self.sphere(0.5), 1.0, 67), 0.0)
        self.assertGreater(flip(self.sphere(0.0), self.sphere(1.0), 1.0, 67), 0.9)

    def test_the_background_is_not_in_the_mean(self):
        disc, other = self.sphere(0.2), self.sphere(0.6)
        wide = [numpy.pad(part, ((32, 32), (32, 32), (0, 0))) for part in (disc, other)]
        self.assertAlmostEqual(flip(disc, other, 1.0, 67), flip(*wide, 1.0, 67), delta=0.01)


class Tables(unittest.TestCase):
    def test_csv(self):
        with tempfile.TemporaryDirectory() as out:
            tables.write_materials(pathlib.Path(out, "summary.csv"), ROWS)
            lines = pathlib.Path(out, "summary.csv").read_text().splitlines()
        self.assertEqual(lines[0], "material,kind,relrmse shared N = 1,relrmse per-lobe N = 8,"
                                   "flip shared N = 1,flip per-lobe N = 8")
        self.assertEqual(lines[1], "a,paint,0.2,0.3,0.02,0.05")


class Plans(unittest.TestCase):
    def test_the_documents_columns(self):
        plan = Plan((0.1, 0.25, 0.5), (1, 8), ())
        self.assertEqual(plan.references, [2, 5, 8])
        self.assertEqual(plan.others, [1, 3, 4, 6, 7, 9, 10, 11, 12, 13])
        self.assertEqual(plan.fits, ["shared-1", "shared-8", "per-lobe-8"])
        self.assertEqual(len(plan.all_images()), 3 * 3 * 13)

    def test_orders_are_three_columns_each_behind_the_closed_form(self):
        plan = Plan.of({"radii": [0.1], "lobes": [8], "widening_order": [0, 1, 3]})
        self.assertEqual((plan.references, plan.others), ([2, 4, 6], [1, 3, 5, 7, *range(8, 17)]))

    def test_shards_cover_the_sheet(self):
        plan = Plan((0.1, 0.25), (1,), ())
        self.assertEqual(plan.images("light", plan.references), ["{table}.{row}.{column}"])
        self.assertEqual(plan.images("row", [2, 4]), ["{table}.{row}.2", "{table}.{row}.4"])
        self.assertEqual(plan.images("table", [2]), ["{table}.1.2", "{table}.2.2"])
        self.assertEqual(plan.images("sheet", [2]), [f"{t}.{r}.2" for t in (1, 2, 3) for r in (1, 2)])

    def test_flags(self):
        settings = {"res": 64, "spp": 0, "target_error": 0.01, "seed": 3, "radii": [0.1, 0.5], "lobes": [1, 8],
                    "widening_order": []}
        self.assertEqual(sheet_flags(settings),
                         "--res 64 --target-error 0.01 --seed 3 --radii 0.1,0.5 --lobes 1,8 --model both")


if __name__ == "__main__":
    unittest.main()
