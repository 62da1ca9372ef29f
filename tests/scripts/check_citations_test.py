"""Facts about scripts/check_citations.py: a clean tree passes, and every rule can fail."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECKER = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_citations.py"

# Pieced together, so that this file is not itself a finding.
DOCS = "do" + "cs"
SPEC = f"{DOCS}/sp" + "ec"
PHYSICS = f"{SPEC}/physics.md"
INTERFACE = f"{DOCS}/pilots_manual.md"
OLD_PAGE = "pv" + "i.md"
BARE_WORD = "sp" + "ec"
RULE = "ru" + "le"
DECISION = "deci" + "sion"

CLEAN = {
    PHYSICS: '# Physics\n\n<a id="sea"></a>\n## What the sea returns\n\n<a id="land"></a>\n## Land\n[sea](#sea)\n',
    INTERFACE: '# Interface\n\n| PB |\n| --- |\n| <a id="pb-2"></a>2 |\n\n<a id="rule-5"></a>\n### Maps\n'
               f"[sea]({PHYSICS[5:]}#sea), [rule](#rule-5)\n",
    f"{DOCS}/terrain.md": "# Terrain\n\n## The `file` formats\n\n## Same\n\n## Same\n\n"
                       "[a](#the-file-formats) [b](#same-1) [c](decisions/0001-first.md) [d](../lib) "
                       "[e](https://x.org/y#z)\n"
                       "```\n[f](nowhere.md)\n```\n`[g](nowhere.md)`\n",
    f"{DOCS}/decisions/0001-first.md": f"# 1. First\n[sea](../{PHYSICS[5:]}#sea)\n",
    f"{DOCS}/decisions/0002-second.md": "# 2. Second\n",
    "lib/sea.hpp": f"// Source: {PHYSICS}#sea, #land; the paper's table 2. {DECISION} 2.\n#pragma once\n",
    "lib/map.hpp": f"// Source: {INTERFACE}#rule-5,\n// #pb-2. As {RULE} 5 says.\n#pragma once\n",
    "config/apg70.guf": f"; Source: {PHYSICS}#land\n( Apg70 )\n",
    "README.md": f"YARS: [terrain]({DOCS}/terrain.md#same), `../shared/data` for tests\n",
}


def check(files):
    """Output and exit status over a tree of CLEAN with `files` laid over it; None takes a file away."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**CLEAN, **files}.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            if text is not None:
                path.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, str(CHECKER), "--root", folder], capture_output=True, text=True,
                              timeout=60, check=False)
    return done.stdout + done.stderr, done.returncode


class CheckCitations(unittest.TestCase):
    def finds(self, name, text, finding, words=""):
        output, status = check({name: text})
        self.assertEqual(status, 1, output)
        self.assertIn(f"{name}:{finding}", output)
        self.assertIn(words, output)
        self.assertIn("check_citations: 1 finding", output)

    def test_a_clean_tree_passes(self):
        self.assertEqual(check({}), ("check_citations: every citation leads somewhere\n", 0))

    def test_an_anchor_that_is_not_there_is_found_and_the_nearest_is_named(self):
        self.finds("lib/sea.hpp", f"#pragma once\n// Source: {PHYSICS}#see\n", "2: citation", "the nearest is 'sea'")

    def test_a_page_that_is_not_there_is_found(self):
        self.finds("lib/sea.hpp", f"// Source: {SPEC}/chemistry.md#sea\n", "1: citation",
                   "not a file of the repository")

    def test_other_documents_are_cited_by_path_too(self):
        self.finds("lib/sea.hpp", f"// Source: {DOCS}/terrein.md\n", "1: citation")
        self.finds("lib/sea.hpp", f"// Source: {DOCS}/terrain.md#nothing\n", "1: citation")

    def test_the_second_anchor_of_a_list_is_looked_at(self):
        self.finds("lib/sea.hpp", f"// Source: {PHYSICS}#sea, #rain\n", "1: citation", "'rain'")

    def test_a_list_goes_on_behind_the_end_of_a_line(self):
        self.finds("lib/map.hpp", f"// Source: {INTERFACE}#rule-5,\n// #rule-6\n", "1: citation", "'rule-6'")
        self.finds("config/apg70.guf", f"; Source: {PHYSICS}#sea and\n; #rain\n", "1: citation", "'rain'")

    def test_a_page_of_the_specification_is_cited_with_an_anchor(self):
        self.finds("lib/sea.hpp", f"// Source: {PHYSICS}\n", "1: citation", "without an anchor")

    def test_comments_of_configurations_tests_and_scripts_are_looked_at(self):
        for name, leader in (("config/apg70.guf", ";"), ("tests/sea_test.cpp", "//"), ("tests/rows.csv", "#"),
                             ("scripts/start", "#"), ("HACKING.md", "")):
            self.finds(name, f"{leader} Source: {PHYSICS}#see\n", "1: citation")

    def test_a_heading_of_the_specification_is_no_anchor(self):
        self.finds("lib/sea.hpp", f"// Source: {PHYSICS}#what-the-sea-returns\n", "1: citation")

    def test_an_anchor_stands_once(self):
        self.finds(PHYSICS, CLEAN[PHYSICS] + '<a id="sea"></a>\n', "9: anchor")

    def test_pages_outside_of_the_repository_are_found(self):
        for text in (f"// {OLD_PAGE} says so\n", f"// see {PHYSICS[10:]}\n", f"// the {BARE_WORD} says so\n",
                     "// ../see" + "d/report.txt\n", "// ../shar" + "ed/design.md\n"):
            self.finds("lib/land.hpp", text, "1: outside")

    def test_a_rule_is_one_of_the_interface(self):
        self.finds("lib/map.hpp", f"// Source: {INTERFACE}#rule-5. As {RULE}s 5 and 99 say.\n", "1: rule", "99")

    def test_a_rule_by_number_needs_the_page_by_name(self):
        self.finds("lib/sea.hpp", f"// As {RULE} 5 says.\n", "1: rule", "of what?")

    def test_a_link_to_a_missing_file_is_found(self):
        self.finds("README.md", f"[a]({DOCS}/missing.md)\n", "1: link")
        self.finds(f"{DOCS}/terrain.md", CLEAN[DOCS + "/terrain.md"] + "![a](pictures/missing.png)\n", "14: link")
        self.finds(f"{DOCS}/decisions/0002-second.md", "# 2. Second\n[a](../../../elsewhere.md)\n", "2: link")

    def test_a_link_to_a_missing_heading_is_found(self):
        self.finds("README.md", f"[a]({DOCS}/terrain.md#sames)\n", "1: link", "the nearest is 'same'")
        self.finds(f"{DOCS}/decisions/0002-second.md", "# 2. Second\n[a](#third)\n", "2: link")

    def test_a_link_to_a_heading_of_the_specification_is_found(self):
        self.finds("README.md", f"[a]({PHYSICS}#what-the-sea-returns)\n", "1: link")

    def test_a_gap_in_the_decisions_is_found(self):
        output, status = check({f"{DOCS}/decisions/0004-fourth.md": "# 4. Fourth\n"})
        self.assertEqual(status, 1)
        self.assertIn(f"{DOCS}/decisions:1: decision: number 0003 is missing", output)

    def test_a_double_in_the_decisions_is_found(self):
        self.finds(f"{DOCS}/decisions/0002-twice.md", "# 2. Twice\n", "1: decision", "also that of")

    def test_a_decisions_title_has_its_number(self):
        self.finds(f"{DOCS}/decisions/0002-second.md", "# 3. Second\n", "1: decision", "expected the title '# 2. ...'")

    def test_a_decision_that_is_named_is_there(self):
        self.finds("lib/sea.hpp", f"#pragma once\n// {DECISION}s 1 and 7\n", "2: decision", "decision 7")


if __name__ == "__main__":
    unittest.main()
