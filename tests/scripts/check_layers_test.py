"""Facts about scripts/check_layers.py: a clean tree passes, and every rule can fail."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECKER = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_layers.py"

CLEAN = {
    "lib/geo/quantity.hpp": "#pragma once\n#include <cmath>\n",
    "lib/geo/quantity.cpp": '#include "lib/geo/quantity.hpp"\n#include <GeographicLib/Geodesic.hpp>\n',
    "databuffer/session/session.hpp": "#pragma once\n",
    "databuffer/messages/world_state.hpp": "#pragma once\n",
    "statemachine/machine.hpp": '#pragma once\n#include "databuffer/messages/world_state.hpp"\n',
    "display/symbology/symbology.hpp": "#pragma once\n",
    "model/app/radar_model_main.cpp": '#include <chrono>\n#include <spdlog/spdlog.h>\n'
                                      '#include "databuffer/session/session.hpp"\n',
    "model/terrain/formats/dted.hpp": "#pragma once\n",
    "model/terrain/formats/dted.cpp": '#include "model/terrain/formats/dted.hpp"\n',
    "model/terrain/formats/cell_reading.hpp": "#pragma once\n",
    "model/terrain/formats/cell_reading.cpp": '#include "model/terrain/formats/cell_reading.hpp"\n'
                                              'std::ifstream open(const char* path);\n',
    "README.md": "YARS\n",
}
# Pieced together, so that this file is not itself a finding.
MACHINE_PATH = "/ho" + "me/somebody/yars"
REGISTRY = "https://py" + "pi.org/simple"


def check(files):
    """Output and exit status over a tree of CLEAN with `files` laid over it."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**CLEAN, **files}.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, str(CHECKER), "--root", folder], capture_output=True, text=True,
                              timeout=60, check=False)
    return done.stdout, done.returncode


class CheckLayers(unittest.TestCase):
    def finds(self, name, text, finding):
        output, status = check({name: text})
        self.assertEqual(status, 1, output)
        self.assertIn(f"{name}:{finding}", output)
        self.assertIn("check_layers: 1 finding", output)

    def test_a_clean_tree_passes(self):
        output, status = check({})
        self.assertEqual((output, status), ("check_layers: the layers hold\n", 0))

    def test_a_role_may_not_include_another(self):
        self.finds("statemachine/machine.hpp", '#pragma once\n#include "display/symbology/symbology.hpp"\n', "2: layer")

    def test_a_lower_layer_may_not_include_a_higher(self):
        self.finds("lib/geo/quantity.hpp", '#pragma once\n#include "databuffer/messages/world_state.hpp"\n', "2: layer")

    def test_the_segment_is_for_shells(self):
        self.finds("statemachine/machine.hpp", '#pragma once\n#include "databuffer/session/session.hpp"\n', "2: layer")

    def test_the_log_is_for_shells(self):
        self.finds("model/terrain/formats/dted.cpp",
                   '#include "model/terrain/formats/dted.hpp"\n#include <spdlog/spdlog.h>\n', "2: layer")

    def test_clocks_are_for_shells(self):
        self.finds("statemachine/machine.hpp", "#pragma once\nauto now = std::chrono::steady_clock::now();\n",
                   "2: clock")

    def test_records_are_pure_though_they_live_below_databuffer(self):
        self.finds("databuffer/messages/world_state.hpp", "#pragma once\n#include <chrono>\n", "2: layer")

    def test_geographiclib_has_one_caller(self):
        self.finds("model/terrain/formats/dted.cpp",
                   '#include "model/terrain/formats/dted.hpp"\n#include <GeographicLib/Geodesic.hpp>\n', "2: layer")

    def test_opengl_stays_in_display_gl(self):
        self.finds("display/symbology/symbology.hpp", "#pragma once\n#include <epoxy/gl.h>\n", "2: layer")

    def test_dds_stays_in_gateway_dds(self):
        self.finds("gateway/hosts.hpp", "#pragma once\n#include <dds/dds.h>\n", "2: layer")
        output, status = check({"gateway/dds/participant.hpp": '#pragma once\n#include <dds/dds.h>\n'
                                                               '#include "gateway/dds/yars_network.h"\n'})
        self.assertEqual(status, 0, output)

    def test_a_header_from_nowhere_needs_a_row(self):
        self.finds("display/symbology/symbology.hpp", "#pragma once\n#include <novel/thing.hpp>\n", "2: layer")

    def test_only_readers_open_files(self):
        self.finds("statemachine/machine.hpp", "#pragma once\nstd::ifstream stream;\n", "2: reader")

    def test_a_format_reads_through_the_one_reader(self):
        self.finds("model/terrain/formats/dted.cpp",
                   '#include "model/terrain/formats/dted.hpp"\nstd::ifstream open(const char* path);\n', "2: reader")

    def test_only_lib_file_makes_files(self):
        for text in ("std::ofstream stream;", 'auto* file = fopen(path, "wb");', "std::filesystem::rename(a, b);"):
            self.finds("tools/table_writer.hpp", f"#pragma once\n{text}\n", "2: writer")

    def test_a_comment_is_not_a_call(self):
        _, status = check({"statemachine/machine.hpp": "#pragma once\n// std::ifstream\n/* fopen\n"
                                                       " #include <chrono> */\n"})
        self.assertEqual(status, 0)

    def test_a_missing_header_is_found(self):
        self.finds("statemachine/machine.hpp", '#pragma once\n#include "machine_parts.hpp"\n', "2: include")

    def test_a_header_without_pragma_once_is_found(self):
        self.finds("statemachine/machine.hpp", "int x;\n", "1: header")

    def test_heavy_headers_stay_in_sources(self):
        self.finds("databuffer/session/session.hpp", "#pragma once\n#include <spdlog/spdlog.h>\n", "2: header")

    def test_a_source_has_its_header(self):
        self.finds("statemachine/table.cpp", "\n", "1: pair")

    def test_file_names_are_lower_snake(self):
        self.finds("statemachine/MachineTable.hpp", "#pragma once\n", "1: name")

    def test_a_folder_called_utils_is_found(self):
        self.finds("notes/utils/page.md", "\n", "1: name")

    def test_units_that_include_one_another_are_found(self):
        output, status = check({"statemachine/maps.hpp": '#pragma once\n#include "statemachine/modes.hpp"\n',
                                "statemachine/modes.hpp": "#pragma once\n",
                                "statemachine/modes.cpp": '#include "statemachine/modes.hpp"\n'
                                                          '#include "statemachine/maps.hpp"\n'})
        self.assertEqual(status, 1, output)
        self.assertIn("cycle: units that include one another: statemachine/maps, statemachine/modes", output)

    def test_the_chapters_of_a_vector_source_belong_to_it(self):
        output, status = check({"model/rbm/sweep_simd.hpp": "#pragma once\n",
                                "model/rbm/gain-inl.hpp": '#include "model/rbm/sweep_simd.hpp"\n',
                                "model/rbm/sweep_simd.cpp": '#include "model/rbm/sweep_simd.hpp"\n'
                                                            '#include "model/rbm/gain-inl.hpp"\n'})
        self.assertEqual(status, 0, output)

    def test_a_diagram_of_other_folders_is_found(self):
        self.finds("docs/layers.dot", "digraph layers {}\n", "1: diagram")

    def test_a_folder_without_a_row_is_found(self):
        self.finds("novel/thing.hpp", "#pragma once\n", "1: layer")

    def test_a_path_of_one_machine_is_found(self):
        self.finds("notes/page.md", f"see {MACHINE_PATH}\n", "1: path")

    def test_a_registry_host_is_found(self):
        self.finds("notes/page.md", f"see {REGISTRY}\n", "1: registry")

    def test_a_long_file_is_only_warned_of(self):
        output, status = check({"statemachine/machine.hpp": "#pragma once\n" + "int x;\n" * 500})
        self.assertEqual(status, 0)
        self.assertIn("statemachine/machine.hpp: warning: 501 lines", output)


if __name__ == "__main__":
    unittest.main()
