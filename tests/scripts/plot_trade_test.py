"""Facts about scripts/plot_trade: labels keep apart, bad input is one line. Skipped (77) without matplotlib."""
import importlib.machinery
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
PLOT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "plot_trade"
loader = importlib.machinery.SourceFileLoader("plot_trade", str(PLOT))
plot_trade = importlib.util.module_from_spec(importlib.util.spec_from_loader("plot_trade", loader))
loader.exec_module(plot_trade)


def value(mean, worst=None):
    return {"mean": mean, "worst": mean if worst is None else worst, "worst_scene": 1, "scenes": []}


def crowd():
    """Sixteen points in one place, as knobs that cost nothing give, and the exact one far off."""
    points = [{"point": f"knob{i % 4}={i}", "family": f"knob{i % 4}", "ms": value(2.5 + 0.01 * i),
               "gray": value(12.0 + 0.1 * i, 20.0), "shadow": value(1.4, 3.2)} for i in range(16)]
    points.append({"point": "1996", "family": "preset", "ms": value(0.7), "gray": value(130.0), "shadow": value(None)})
    points.append({"point": "reference", "family": "preset", "ms": value(2300.0), "gray": value(0.0),
                   "shadow": value(0.0)})
    return {"axes": {"time": {"column": "ms", "title": "time"}, "errors": [{"column": "gray", "title": "gray"},
                                                                         {"column": "shadow", "title": "shadow"}]},
            "scenes": ["one"], "points": points}


def run(*arguments):
    done = subprocess.run([sys.executable, str(PLOT), *arguments], capture_output=True, text=True, timeout=120,
                          check=False)
    return done.returncode, done.stderr


class PlotTrade(unittest.TestCase):
    def test_no_label_covers_another(self):
        _, panels = plot_trade.draw(crowd(), plot_trade.drawing())
        self.assertEqual([len(boxes) for boxes in panels], [18, 17])  # 1996 has no shadow to compare
        for boxes in panels:
            for i, one in enumerate(boxes):
                for other in boxes[:i]:
                    apart = one[0] >= other[2] or other[0] >= one[2] or one[1] >= other[3] or other[1] >= one[3]
                    self.assertTrue(apart, (one, other))

    def test_the_front_is_what_no_other_point_beats_in_both(self):
        self.assertEqual(plot_trade.drawing().pareto_front([(2, 5), (1, 9), (3, 6), (4, 1), (2, 7)]),
                         [(1, 9), (2, 5), (4, 1)])

    def test_a_picture_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            source, picture = pathlib.Path(folder, "trade.json"), pathlib.Path(folder, "trade.png")
            source.write_text(json.dumps(crowd()))
            self.assertEqual(run(str(source), str(picture)), (0, ""))
            self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")

    def test_help_is_no_error(self):
        done = subprocess.run([sys.executable, str(PLOT), "--help"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("FILE.json FILE.png", done.stdout)

    def test_bad_input_is_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            broken = pathlib.Path(folder, "broken.json")
            broken.write_text('{"points": [1]}')
            for arguments in ([], ["a.json"], ["a.json", "a.txt"], [str(pathlib.Path(folder, "none.json")), "a.png"],
                              [str(broken), "a.png"]):
                status, said = run(*arguments)
                self.assertEqual(status, 1)
                self.assertEqual(said.count("\n"), 1, said)
                self.assertIn("expected", said)


if __name__ == "__main__":
    if importlib.util.find_spec("matplotlib") is None:
        print("plot_trade_test: skipped: python3-matplotlib is not installed; scripts/setup --python brings it")
        sys.exit(77)
    unittest.main()
