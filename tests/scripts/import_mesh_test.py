"""scripts/import_mesh: one mesh out of a deck of each code, what each reader knows, and what is refused with its line.

The decks of tests/scripts/decks/ are ours: two hexahedra and a wedge with a sheet of plates at their upper edge, the node sets FOOT and
EDGE and the surface LOAD, as four codes write them.
"""
import contextlib
import doctest
import io
import runpy
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DECKS = Path(__file__).resolve().parent / "decks"
sys.path.insert(0, str(ROOT / "scripts"))
sys.dont_write_bytecode = True
import import_abaqus  # noqa: E402  (after the path)
import import_cells  # noqa: E402
import import_deck  # noqa: E402
import mesh_files  # noqa: E402

try:
    import meshio
    import numpy as np
except ImportError:
    meshio = None

COMMAND = runpy.run_path(str(ROOT / "scripts/import_mesh"))
CUBE = {1: (0, 0, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (0, 1, 0), 5: (0, 0, 1), 6: (1, 0, 1), 7: (1, 1, 1), 8: (0, 1, 1)}
ABAQUS = "*NODE\n" + "".join(f"{n},{x},{y},{z}\n" for n, (x, y, z) in CUBE.items())
DYNA = "*KEYWORD\n*NODE\n" + "".join(f"{n:8d}{x:16d}{y:16d}{z:16d}\n" for n, (x, y, z) in CUBE.items())
RADIOSS = "/NODE\n" + "".join(f"{n:10d}{x:20d}{y:20d}{z:20d}\n" for n, (x, y, z) in CUBE.items())
HEXAHEDRON = "*ELEMENT, TYPE=C3D8R, ELSET=A\n1,1,2,3,4,5,6,7,8\n"
SOLID = "*ELEMENT_SOLID\n" + "".join(f"{n:8d}" for n in (1, 1, *range(1, 9))) + "\n"
BRICK = "/BRICK/1\n" + "".join(f"{n:10d}" for n in (1, *range(1, 9))) + "\n"


def columns(width, *numbers):
    return "".join(f"{n:>{width}}" for n in numbers) + "\n"


class Import(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def start(self, path, *options):
        """(exit status, stdout, stderr, the mesh or None)."""
        target = self.folder / "out.vtu"
        target.unlink(missing_ok=True)
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = COMMAND["main"]([str(path), str(target), *options])
        return status, out.getvalue(), err.getvalue(), mesh_files.read(target) if target.is_file() else None

    def read(self, ending, text, *options):
        """The mesh of a deck, and what was said of it."""
        path = self.folder / f"deck{ending}"
        path.write_text(text, encoding="utf-8")
        status, out, err, mesh = self.start(path, *options)
        self.assertEqual((status, err), (0, ""))
        return mesh, out

    def refused(self, ending, text, *says, options=()):
        path = self.folder / f"deck{ending}"
        path.write_text(text, encoding="utf-8")
        status, out, err, mesh = self.start(path, *options)
        self.assertEqual((status, out, mesh), (2, "", None), err)
        self.assertEqual([line.split(" ")[0] for line in err.splitlines()], [one.split(" ")[0] for one in says], err)
        for said, line in zip(says, err.splitlines()):
            self.assertIn(said, line)

    def places(self, mesh, name):
        return sorted(tuple(mesh.points[node]) for node, flag in enumerate(mesh.sets[name]) if flag)

    def cells(self, mesh, name):
        """The places of the corners of the cells of a group, in an order of their own."""
        return sorted(sorted(tuple(mesh.points[node]) for node in cell)
                      for cell, number in zip(mesh.cells, mesh.cell_arrays["region"]) if number == mesh.groups[name][0])


class Equal(Import):
    def test_four_codes_give_one_mesh(self):
        first = None
        for name in ("block.inp", "block.k", "block_0000.rad", "block.msh"):
            if name.endswith(".msh") and meshio is None:
                continue
            with self.subTest(name):
                status, out, err, mesh = self.start(DECKS / name)
                self.assertEqual((status, err), (0, ""))
                self.assertIn("20 nodes, 2 hexahedra, 1 wedge, 2 quadrilaterals, 2 triangles", out)
                self.assertIn("cuts 2 quadrilaterals into two triangles each, from the first corner to the third", out)
                self.assertEqual({name: dimension for name, (_, dimension) in mesh.groups.items()}, {"BLOCK": 3, "SHEET": 2, "LOAD": 2})
                found = [sorted(map(tuple, mesh.points)), *(self.places(mesh, name) for name in ("FOOT", "EDGE")),
                         *(self.cells(mesh, name) for name in ("BLOCK", "SHEET", "LOAD"))]
                self.assertEqual([len(one) for one in found], [20, 6, 2, 3, 4, 3])
                first = first or found
                self.assertEqual(found, first)

    def test_what_is_not_taken_over_is_listed_with_its_line(self):
        for name, lines in (("block.inp", {"*SHELL SECTION": 56, "*DSLOAD": 63}), ("block.k", {"*MAT_ELASTIC": 61, "*DEFINE_CURVE": 67}),
                            ("block_0000.rad", {"/MAT/LAW1": 57, "/BCS": 67})):
            out = self.start(DECKS / name)[1]
            for keyword, line in lines.items():
                self.assertIn(f"    {keyword}: at {name}:{line}\n", out)

    def test_examples_of_the_modules(self):
        for module in (import_abaqus, import_cells, import_deck):
            done = doctest.testmod(module)
            self.assertEqual((done.failed, done.attempted > 0), (0, True))

    def test_a_mark_of_the_order_of_bytes_is_passed_over(self):
        for ending, text in ((".inp", ABAQUS + HEXAHEDRON), (".k", DYNA + SOLID), ("_0000.rad", RADIOSS + BRICK)):
            self.assertEqual(self.read(ending, "\ufeff" + text)[0], self.read(ending, text)[0])

    def test_nodes_near_each_other_are_at_one_place_also_at_the_edge_of_a_bin(self):
        for x, far, expected in ((0.5, 0.9, 1), (0.5 + 0.5e-8, 0.9, 1), (0.5 - 1e-13, 0.9, 1), (0.5, 1.1, 2), (0.5 + 0.5e-8, 1.1, 2)):
            points = {0: (1.0, 0.0, 0.0), 1: (x, 0.25, -0.125), 2: (x + far * import_cells.NEAR, 0.25, -0.125)}
            self.assertEqual(import_cells.first_at_place(points), {0: 0, 1: 1, 2: expected}, (x, far))


class Abaqus(Import):
    def test_faces_of_solids_have_the_numbers_of_abaqus(self):
        for face, (axis, value) in {"S1": (2, 0), "S2": (2, 1), "S3": (1, 0), "S4": (0, 1), "S5": (1, 1), "S6": (0, 0)}.items():
            mesh, _ = self.read(".inp", ABAQUS + HEXAHEDRON + f"*SURFACE, NAME=F\nA, {face}\n")
            self.assertEqual({point[axis] for point in self.cells(mesh, "F")[0]}, {value}, face)
        mesh, _ = self.read(".inp", ABAQUS + HEXAHEDRON + "*SURFACE, NAME=F\nA,\n")
        self.assertEqual(len(self.cells(mesh, "F")), 6)

    def test_instances_are_moved_and_turned_and_have_sets_of_their_own(self):
        part = "*PART, NAME=P\n" + ABAQUS + HEXAHEDRON + "*NSET, NSET=LOW\n1,2,3,4\n*SOLID SECTION, ELSET=A, MATERIAL=M\n*END PART\n"
        deck = part + ("*ASSEMBLY, NAME=W\n*INSTANCE, NAME=I-1, PART=P\n*END INSTANCE\n*INSTANCE, NAME=I-2, PART=P\n4., 0, 0\n"
                       "4., 0, 0, 4., 0, 1, 90.\n*END INSTANCE\n*NSET, NSET=TIP, INSTANCE=I-2\n1\n"
                       "*NSET, NSET=BOTH\nI-1.LOW, I-2.LOW\n*NSET, NSET=ONE\nI-1.7\n"
                       "*ELSET, ELSET=E, INSTANCE=I-1\n1\n*SURFACE, NAME=F\nE, S2\n*END ASSEMBLY\n")
        mesh, out = self.read(".inp", deck)
        self.assertEqual(set(mesh.groups), {"I_1_A", "I_2_A", "F"})
        self.assertEqual(self.places(mesh, "TIP"), [(4, 0, 0)])
        self.assertEqual(self.places(mesh, "ONE"), [(1, 1, 1)])
        self.assertEqual(self.places(mesh, "BOTH"), sorted([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), *self.places(mesh, "I_2_LOW")]))
        x = [round(a, 9) for point in self.cells(mesh, "I_2_A")[0] for a in point[:1]]
        self.assertEqual((min(x), max(x)), (3, 4))  # turned from x = 4...5 about z
        self.assertIn("the region 'I-1_A' is now 'I_1_A'", out)
        lower, _ = self.read(".inp", deck.replace("I-", "arm-"))
        self.assertEqual((set(lower.groups), "arm_1_LOW" in lower.sets), ({"arm_1_A", "arm_2_A", "F"}, True))
        lonely = part.replace("*ELEMENT", "*NODE\n9, 5, 5, 5\n*ELEMENT")
        _, out = self.read(".inp", lonely + "*INSTANCE, NAME=I-1, PART=P\n*END INSTANCE\n")
        self.assertIn("1 node is left out, since no element has it: I-1.9", out)
        turned = "*INSTANCE, NAME=I-1, PART=P\n0,0,0\n1,0,0, 1,0,0, 90\n*END INSTANCE\n"
        self.refused(".inp", part.replace("1,1,2,3,4", "1,1,2,3,99") + turned,
                     "deck.inp:12: element 1 has the node I-1.99, which is not there",
                     "deck.inp:19: the two points of the axis of *INSTANCE coincide")

    def test_files_that_are_included_stand_in_their_places(self):
        (self.folder / "nodes.txt").write_text("".join(ABAQUS.splitlines(True)[1:]), encoding="utf-8")
        mesh, _ = self.read(".inp", "*NODE\n*INCLUDE, INPUT=nodes.txt\n" + HEXAHEDRON)
        self.assertEqual(len(mesh.points), 8)
        (self.folder / "nodes.txt").write_text("1, 0, x, 0\n", encoding="utf-8")
        self.refused(".inp", "*NODE\n*INCLUDE, INPUT=nodes.txt\n*INCLUDE, INPUT=none.txt\n", "deck.inp:3: includes the file 'none.txt'",
                     "nodes.txt:1: 'x' is no number")

    def test_sets_and_surfaces_of_many_kinds(self):
        deck = ABAQUS + "*NODE\n9, 2, 0, 1\n10, 2, 1, 1\n" + "*ELEMENT, TYPE=C3D8, ELSET=A\n1,1,2,3,\n4,5,6,7,8\n" \
            "*ELEMENT, TYPE=S4, ELSET=S\n2,6,9,10,7\n*NSET, NSET=N, GENERATE\n1,4\n*NSET, NSET=n\nS\n*NSET, NSET=S, ELSET=S\n" \
            "*SURFACE, NAME=ON NODES, TYPE=NODE\nN,\n*SURFACE, NAME=PLATES\nS, SPOS\n*SURFACE, NAME=RIM\nS, E2\n*SURFACE, " \
            "NAME=U, COMBINE=UNION\nPLATES,\n*SURFACE, NAME=MIXED\nS, SNEG\n1, S2\n*ELSET, ELSET=_I, INTERNAL\n1\n" \
            "*SURFACE, NAME=I\n_I, S1\n"
        mesh, out = self.read(".inp", deck)
        self.assertEqual(len(self.places(mesh, "N")), 8)
        self.assertEqual(self.places(mesh, "RIM"), [(2, 0, 1), (2, 1, 1)])
        self.assertEqual(len(self.places(mesh, "PLATES")), 4)
        self.assertEqual(len(self.cells(mesh, "MIXED")), 1)
        self.assertEqual(len(self.places(mesh, "MIXED_plates")), 4)
        self.assertEqual(set(mesh.sets), {"N", "ON_NODES", "PLATES", "RIM", "U", "MIXED_plates"})
        self.assertIn("the node set 'S' has the nodes of the region 'S'", out)
        self.assertIn("1 internal element set of a surface is not written as sets of nodes", out)

    def test_damage_is_told_with_its_line(self):
        self.refused(".inp", ABAQUS + "*ELEMENT, TYPE=C3D8\n1,1,2,3,4,5,6,7\n2,1,2,3,4,5,6,7,88\n3,1,2,x,4,5,6,7,8\n",
                     "deck.inp:11: element 1 has 7 nodes; expected are 8 of C3D8", "deck.inp:12: element 2 has the node 88, which is not",
                     "deck.inp:13: 'x' is no whole number")
        self.refused(".inp", ABAQUS.replace("8,0,1,1", "8,0,1,1e") + HEXAHEDRON + HEXAHEDRON, "deck.inp:9: '1e' is no number",
                     "deck.inp:11: element 1 has the node 8", "deck.inp:13: element 1 is given twice, before at deck.inp:11")
        self.refused(".inp", ABAQUS + HEXAHEDRON + "*NSET, NSET=N\n9\n*SURFACE, NAME=F\nB, S1\nA, S7\n*NGEN\n1,2,3\n"
                     "*NSET, NSET=R, GENERATE\n1\n",
                     "deck.inp:13: there is no node 9", "deck.inp:15: there is no element set 'B'",
                     "deck.inp:16: element 1 has no face 'S7'", "deck.inp:17: *NGEN changes the mesh", "deck.inp:20: '1' is no range")
        self.refused(".inp", "1,2,3\n*NODE, SYSTEM=C\n", "deck.inp:1: data without a keyword", "deck.inp:2: *NODE in cylindrical")
        self.refused(".inp", "*HEADING\n", "deck.inp: it has no elements")
        self.refused(".inp", ABAQUS + HEXAHEDRON + "*NSET, NSET=N\n²\n*SURFACE, NAME=F\n²\n*ELEMENT, TYPE=B31, ELSET=B\n²,1,2\n",
                     "deck.inp:13: there is no node set '²'", "deck.inp:15: there is no element set '²'",
                     "deck.inp:17: 1 element of the type B31 (²)")
        self.refused(".inp", ABAQUS + HEXAHEDRON + "*ELSET, ELSET=B\nC\n*ELSET, ELSET=C\nB\n", "deck.inp:12: the set 'B' contains itself",
                     "deck.inp:14: the set 'C' contains itself")

    def test_elements_of_other_types_are_refused_or_left_out(self):
        deck = ABAQUS + HEXAHEDRON + "*ELEMENT, TYPE=B31\n7,1,2\n8,2,3\n*ELEMENT, TYPE=C3D10\n9,1,2,3,4,5,6,7,8,\n1,2\n" \
            "*ELEMENT, TYPE=C3D4\n10,1,2,3,5\n*ELSET, ELSET=SOME\n1, 7\n*NSET, NSET=OF, ELSET=SOME\n"
        self.refused(".inp", deck, "deck.inp:13: 2 elements of the type B31 (7, 8)", "deck.inp:16: 1 element of the type C3D10 (9)",
                     "deck.inp:19: 1 tetrahedron (C3D4: 10)")
        mesh, out = self.read(".inp", deck, "--without-others", "--tetrahedra")
        self.assertEqual(sorted(len(set(cell)) for cell in mesh.cells), [4, 8])
        self.assertIn("elements of the type B31: 2 times, first at deck.inp:13", out)


class Dyna(Import):
    def test_widths_and_cards(self):
        plain, _ = self.read(".k", DYNA + SOLID)
        long = "*KEYWORD LONG=Y\n*NODE\n" + "".join(columns(20, n, *p) for n, p in CUBE.items()) + "*ELEMENT_SOLID\n" \
            + columns(20, 1, 1, *CUBE)
        ten = "*KEYWORD\n*NODE %\n" + "".join(f"{n:10d}" + columns(16, *p) for n, p in CUBE.items()) + "*ELEMENT_SOLID %\n" \
            + columns(10, 1, 1) + columns(10, *CUBE)
        commas = "*KEYWORD\n*NODE\n" + "".join(f"{n},{x},{y},{z}\n" for n, (x, y, z) in CUBE.items()) \
            + "*element_solid\n1,1,1,2,3,4,5,6,7,8\n"
        for text in (long, ten, commas):
            self.assertEqual(self.read(".k", text)[0], plain)
        self.assertEqual(list(plain.groups), ["part_1"])

    def test_a_sign_behind_a_keyword_goes_before_the_format_of_the_file(self):
        plain, _ = self.read(".k", DYNA + SOLID)
        for of_file, sign, number, size in (("LONG=Y", "-", 8, 16), ("LONG=Y", " -", 8, 16), ("I10=Y", "-", 8, 16), ("", "+", 20, 20),
                                            ("", "%", 10, 16), ("LONG=Y", "", 20, 20), ("I10=Y", "", 10, 16), ("", "", 8, 16)):
            with self.subTest(of_file=of_file, sign=sign):
                nodes = "".join(f"{n:>{number}}" + columns(size, *p) for n, p in CUBE.items())
                text = f"*KEYWORD {of_file}\n*NODE{sign}\n{nodes}*ELEMENT_SOLID{sign}\n" + columns(number, 1, 1, *CUBE)
                self.assertEqual(self.read(".k", text)[0], plain)

    def test_sets_of_many_kinds(self):
        deck = DYNA + "       9" + columns(16, 2, 0, 1) + "      10" + columns(16, 2, 1, 1) + SOLID \
            + "*ELEMENT_SHELL_THICKNESS\n" + columns(8, 1, 2, 6, 9, 10, 7) + columns(16, 1, 1, 1, 1) \
            + "*PART\nthe cube\n" + columns(10, 1, 1, 1) + "*PART_INERTIA\nthe plate\n" + columns(10, 2, 1, 1) + "x\ny\nz\n" \
            + "*SET_NODE_COLUMN\n" + columns(10, 1) + columns(10, 3) + columns(10, 4) \
            + "*SET_NODE_GENERAL_TITLE\nall but one\n" + columns(10, 2) + columns(10, "PART", 1) + columns(10, "DNODE", 8) \
            + "*SET_SHELL_LIST\n" + columns(10, 3) + columns(10, 1) + "*SET_PART_LIST\n" + columns(10, 4) + columns(10, 1, 2) \
            + "*SET_SEGMENT\n" + columns(10, 5) + columns(10, 5, 6, 7, 7) + columns(10, 5, 7, 8, 0) \
            + "*SET_SEGMENT\n" + columns(10, 6) + columns(10, 5, 6, 7, 7) + "*SET_SOLID_GENERAL\n" + columns(10, 7) + "*END\nrubbish\n"
        mesh, out = self.read(".k", deck)
        self.assertEqual(set(mesh.groups), {"the_cube", "the_plate", "segments_5"})
        self.assertEqual(len(self.cells(mesh, "segments_5")), 1)
        self.assertEqual({name: sum(flags) for name, flags in mesh.sets.items()},
                         {"nodes_1": 2, "all_but_one": 7, "shells_3": 4, "parts_4": 10, "segments_6": 3})
        self.assertIn("the surface 'segments_6' (deck.k:46) has 1 face that is no whole face", out)
        self.assertIn("*SET_SOLID_GENERAL: at deck.k", out)
        self.assertIn("*ELEMENT_SHELL_THICKNESS: thickness", out)

    def test_lines_behind_an_element_may_be_blank(self):
        first, second = columns(8, 1, 1, *CUBE), columns(8, 2, 1, *(n + 8 for n in CUBE))
        nodes = DYNA + "".join(f"{n + 8:8d}{x + 3:16d}{y:16d}{z:16d}\n" for n, (x, y, z) in CUBE.items())
        plain, _ = self.read(".k", nodes + "*ELEMENT_SOLID\n" + first + second)
        for option, lines in (("_BETA", 1), ("_ORTHO", 2)):
            for behind in ("\n", "\n" * 3):  # of the last element, and blank lines behind it
                deck = nodes + f"*ELEMENT_SOLID{option}\n" + first + "\n" * lines + second + "\n" * (lines - 1) + behind
                self.assertEqual(self.read(".k", deck)[0], plain, option)
        two = "".join(columns(8, 1 + i, 1) + columns(8, *(n + 8 * i for n in CUBE)) + "\n" for i in (0, 1))
        self.assertEqual(self.read(".k", nodes + "*ELEMENT_SOLID_BETA\n" + two)[0], plain)
        first, second = columns(8, 1, 1, 1, 2, 3, 4), columns(8, 2, 1, 5, 6, 7, 8)
        plain, _ = self.read(".k", DYNA + "*ELEMENT_SHELL\n" + first + "\n" + second)
        for option, lines in (("_THICKNESS", 1), ("_BETA", 1), ("_MCID", 1), ("_OFFSET", 1), ("_DOF", 1), ("_THICKNESS_OFFSET", 2)):
            deck = DYNA + f"*ELEMENT_SHELL{option}\n" + first + "\n" * lines + second + "\n" * lines
            self.assertEqual(self.read(".k", deck)[0], plain, option)
        self.refused(".k", DYNA + "*ELEMENT_SHELL_BETA\n" + first + "\n" + second,
                     "deck.k:14: behind element 2 of *ELEMENT_SHELL_BETA stand 0 lines; expected are 1")

    def test_only_keywords_of_parts_give_parts(self):
        for keyword in ("*PART_MOVE", "*PART_DUPLICATE"):
            self.refused(".k", DYNA + SOLID + f"{keyword}\n" + columns(10, 1, 1, 1),
                         f"deck.k:13: {keyword} changes the mesh and is not read")
        mesh, out = self.read(".k", DYNA + SOLID + "*PART_ADAPTIVE_FAILURE\n" + columns(10, 1, 1) + "*PART_SENSOR\n" + columns(10, 1, 2)
                              + "*PART_COMPOSITE\nlayers\n" + columns(10, 1, 16, 0.833))
        self.assertEqual(list(mesh.groups), ["layers"])
        self.assertIn("layers: 1 hexahedron (part 1, composite)\n", out)
        for keyword in ("*PART_ADAPTIVE_FAILURE", "*PART_SENSOR"):
            self.assertIn(f"    {keyword}: at deck.k", out)

    def test_a_set_may_have_elements_that_are_left_out_and_nothing_else(self):
        beam = DYNA + SOLID + "*ELEMENT_SHELL\n" + columns(8, 9, 1, 1, 2, 3, 4, 5, 6, 7, 8)
        mesh, _ = self.read(".k", beam + "*SET_SHELL_LIST\n" + columns(10, 2) + columns(10, 9) + "*SET_NODE_LIST\n" + columns(10, 3)
                            + columns(10, 8), "--without-others")
        self.assertEqual(list(mesh.sets), ["nodes_3"])
        for what in ("NODE", "SOLID", "PART"):
            self.refused(".k", beam + f"*SET_{what}_LIST\n" + columns(10, 2) + columns(10, 9),
                         f"deck.k:17: there is no {what.lower()} 9, which a set has", options=("--without-others",))

    def test_plates_on_faces_of_solids_keep_both_readings_open(self):
        deck = DYNA + SOLID + "*ELEMENT_SHELL\n" + columns(8, 1, 2, 5, 6, 7, 8) \
            + "*SET_SEGMENT\n" + columns(10, 5) + columns(10, 1, 2, 6, 5)
        mesh, out = self.read(".k", deck)
        self.assertEqual(len(self.places(mesh, "segments_5")), 4)
        self.assertIn("1 plate lies on faces of solids (1). With 'boundary_cells: plates'", out)
        for node, (x, y, z) in enumerate(list(CUBE.values())[4:], start=11):  # the same with nodes of its own
            deck = deck.replace("*ELEMENT_SOLID", f"{node:8d}" + columns(16, x, y, z) + "*ELEMENT_SOLID")
        mesh, out = self.read(".k", deck.replace("       5       6       7       8\n*SET", "      11      12      13      14\n*SET"))
        self.assertEqual((list(mesh.groups), len(self.places(mesh, "segments_5"))), (["part_1", "part_2"], 4))
        self.assertIn("1 plate lies on faces of solids", out)

    def test_includes_and_damage(self):
        (self.folder / "sub").mkdir()
        (self.folder / "sub/nodes.k").write_text(DYNA, encoding="utf-8")
        mesh, _ = self.read(".k", "*INCLUDE_PATH_RELATIVE\nsub\n*INCLUDE\nno +\ndes.k\n\n" + SOLID)
        self.assertEqual(len(mesh.points), 8)
        self.refused(".k", DYNA + SOLID + "*INCLUDE\n\n*INCLUDE\n", "deck.k:13: includes a file without a name",
                     "deck.k:15: includes a file without a name")
        self.refused(".k", DYNA.replace("\n       8 ", "\n        8 ") + SOLID,  # a column too far to the right
                     "deck.k:10: '' is no number of a node; see the widths", "deck.k:12: element 1 has the node 8, which is not there")
        self.refused(".k", DYNA + SOLID.replace("       8\n", "      8x\n") + "*NODE_TRANSFORM\n",
                     "deck.k:12: '8x' is no whole number; expected is the number of an element, part or node; see the widths",
                     "deck.k:13: *NODE_TRANSFORM changes the mesh")
        self.refused(".k", DYNA + SOLID + "*ELEMENT_BEAM\n" + columns(8, 7, 1, 1, 2, 3),
                     "deck.k:14: 1 element of the type *ELEMENT_BEAM (7)")
        tetrahedron = DYNA + "*ELEMENT_SOLID\n" + columns(8, 5, 1, 1, 2, 3, 5, 5, 5, 5, 5)
        self.refused(".k", tetrahedron, "deck.k:12: 1 tetrahedron (*ELEMENT_SOLID: 5)")
        self.assertEqual(len(set(self.read(".k", tetrahedron, "--tetrahedra")[0].cells[0][:4])), 3)
        self.refused(".k", DYNA + SOLID + "*SET_NODE_LIST\n" + columns(10, 1) + columns(10, 1, 99) + "*SET_SHELL_LIST\n" + columns(10, 2)
                     + columns(10, 1), "deck.k:15: there is no node 99", "deck.k:18: there is no shell 1")


class Radioss(Import):
    def test_groups_of_many_kinds(self):
        deck = "#RADIOSS STARTER\n" + RADIOSS + f"{9:10d}" + columns(20, 2, 0, 1) + f"{10:10d}" + columns(20, 2, 1, 1) + BRICK \
            + "/SHELL/2\n" + columns(10, 2, 6, 9, 10, 7) + "/PART/1\ncube\n/PART/2\nplate\n" \
            + "/GRNOD/PART/1\nall of cube\n" + columns(10, 1) + "/GRNOD/GEN_INCR/2\nodd\n" + columns(10, 1, 7, 2) \
            + "/GRNOD/GRNOD/3\neven\n" + columns(10, 1, -2) + "/GRBRIC/BRIC/4\nbricks\n" + columns(10, 1) \
            + "/GRNOD/GRBRIC/5\n\n" + columns(10, 4) + "/SURF/PART/EXT/6\nskin\n" + columns(10, 1) \
            + "/SURF/SEG/7\nlid\n" + columns(10, 1, 5, 6, 7, 8) + "/SURF/SURF/8\nsame\n" + columns(10, 7) \
            + "/GRSHEL/SHEL/9\nshells\n" + columns(10, 2) + "/SURF/GRSHEL/10\nplates\n" + columns(10, 9) \
            + "/GRNOD/BOX/11\nin a box\n" + columns(10, 1) + "/GRNOD/SURF/12\nof lid\n" + columns(10, 7) + "/END\nrubbish\n"
        mesh, out = self.read("_0000.rad", deck)
        self.assertEqual({name: sum(flags) for name, flags in mesh.sets.items()}, {"odd": 4, "even": 4, "all_of_cube": 8, "bricks": 8,
                                                                                 "nodes_5": 8, "shells": 4, "plates": 4, "of_lid": 4})
        self.assertEqual({name: len(self.cells(mesh, name)) for name in mesh.groups},
                         {"cube": 1, "plate": 1, "skin_surface": 6, "lid": 1, "same": 1})
        self.assertEqual(self.places(mesh, "odd"), sorted(CUBE[n] for n in (1, 3, 5, 7)))
        self.assertEqual(self.places(mesh, "even"), sorted(CUBE[n] for n in (2, 4, 6, 8)))
        self.assertIn("/GRNOD/BOX: at deck_0000.rad", out)
        self.assertIn("the surface 'skin' is now 'skin_surface'", out)

    def test_units_includes_and_damage(self):
        (self.folder / "nodes.inc").write_text(RADIOSS, encoding="utf-8")
        begin = "/BEGIN\nrun\n" + columns(10, 2022, 0) + columns(20, "kg", "mm", "ms") * 2
        self.assertIn("lengths are in mm", self.read("_0000.rad", begin + "#include nodes.inc\n" + BRICK)[1])
        self.refused("_0000.rad", begin.replace("2022", "  44") + RADIOSS + BRICK,
                     "deck_0000.rad:3: version 44: fields of 8 and 16 columns")
        self.refused("_0000.rad", RADIOSS + BRICK.replace("         8", "        88") + "/BEAM/1\n" + columns(10, 3, 1, 2)
                     + "/TRANSFORM/TRA/1\n//SUBMODEL/1\n",
                     "deck_0000.rad:11: element 1 has the node 88", "deck_0000.rad:13: 1 element of the type /BEAM (3)",
                     "deck_0000.rad:14: /TRANSFORM/TRA changes the mesh", "deck_0000.rad:15: //SUBMODEL changes the mesh")
        self.refused("_0000.rad", RADIOSS.replace("\n         8", "\n            8") + BRICK,  # too far to the right
                     "deck_0000.rad:9: '' is no number of a node", "deck_0000.rad:11: element 1 has the node 8, which is not there")
        self.refused("_0000.rad", RADIOSS + BRICK + "/GRNOD/NODE/1\nx\n" + columns(10, 77) + "/SURF/SURF/2\ny\n" + columns(10, 2),
                     "deck_0000.rad:14: there is no node 77", "deck_0000.rad:15: /SURF 2 contains itself")

    def test_elements_of_several_lines_count_once(self):
        bric20 = "/BRIC20/1\n" + columns(10, 7, *range(1, 9)) + columns(10, *range(1, 9)) + columns(10, *range(1, 5))
        self.refused("_0000.rad", RADIOSS + BRICK + bric20 + "/TETRA10/2\n" + columns(10, 8) + columns(10, *CUBE, 1, 2),
                     "deck_0000.rad:13: 1 element of the type /BRIC20 (7)", "deck_0000.rad:17: 1 element of the type /TETRA10 (8)")
        group = "/GRBRIC/BRIC/1\nx\n" + columns(10, 7)
        self.read("_0000.rad", RADIOSS + BRICK + bric20 + group, "--without-others")
        self.refused("_0000.rad", RADIOSS + BRICK + "/BEAM/1\n" + columns(10, 7, 1, 2) + group,
                     "deck_0000.rad:16: there is no element 7 of /BRICK", options=("--without-others",))

    def test_numbers_of_other_scripts_than_digits_are_names(self):
        self.refused("_0000.rad", RADIOSS + BRICK + "/GRNOD/NODE/²\nx\n" + columns(10, 1), "deck_0000.rad:12: /GRNOD/NODE/² has no number")


@unittest.skipIf(meshio is None, "Python has no meshio")
class Gmsh(Import):
    NODES = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 2 \"end\"\n3 1 \"steel\"\n$EndPhysicalNames\n$Nodes\n10\n" \
        + "".join(f"{n} {x} {y} {z}\n" for n, (x, y, z) in CUBE.items()) + "9 2 0 1\n10 2 1 1\n$EndNodes\n$Elements\n"

    def test_groups_that_are_boundary_and_plate_and_elements_of_two_groups(self):
        mesh, out = self.read(".msh", self.NODES + "5\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 5 2 7 1 1 2 3 4 5 6 7 8\n3 3 2 2 1 5 6 7 8\n"
                              "4 3 2 2 1 6 9 10 7\n5 15 2 4 1 1\n$EndElements\n")
        self.assertEqual(set(mesh.groups), {"steel", "end", "end_on_solids"})
        self.assertEqual({name: sum(flags) for name, flags in mesh.sets.items()}, {"points_4": 1, "region_7": 8})
        self.assertIn("of 'end', 1 quadrilateral lies on faces of solids: the surface 'end_on_solids'; the others are plates", out)
        self.assertIn("1 element of the group 'region_7' is in another group, too", out)

    def test_damage(self):
        self.refused(".msh", self.NODES + "1\n1 5 2 1 1 1 2 3 4 5 6 7 11\n$EndElements\n", "deck.msh: meshio does not read it")
        self.refused(".msh", self.NODES + "1\n1 9 2 1 1 1 2 3 4 5 6\n$EndElements\n",
                     "deck.msh, element 1: 1 element of the type triangle6")
        self.refused(".msh", "nonsense", "deck.msh: meshio does not read it as a format")
        cube = "1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n"
        for word in ("nan", "inf"):
            self.refused(".msh", self.NODES.replace("8 0 1 1\n", f"8 0 {word} 1\n") + cube,
                         "deck.msh: node 8 has a coordinate that is no finite number")

    def test_arrays_of_a_whole_file_need_not_be_groups(self):
        path = self.folder / "frame.vtu"
        cells = [("hexahedron", [[0, 1, 2, 3, 4, 5, 6, 7]])]
        for pair in ([1], [1, 2, 3], [0.5, 3.0]):
            meshio.Mesh([[float(x) for x in point] for point in CUBE.values()], cells, field_data={"whole": np.array(pair)}).write(path)
            text = path.read_text(encoding="utf-8")
            status, _, err, mesh = self.start(path)
            self.assertEqual((status, err, list(mesh.groups)), (0, "", ["solids"]), text[:300])

    def test_polyhedra_are_elements_of_another_type(self):
        path = self.folder / "cells.vtu"
        faces = [[[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]]
        points = [[float(x) for x in point] for point in CUBE.values()]
        meshio.Mesh(points, [("polyhedron8", faces)]).write(path)
        status, _, err, _ = self.start(path)
        self.assertEqual(status, 2)
        self.assertIn("cells.vtu, element 1: 1 element of the type polyhedron8 (1)", err)


class Names(Import):
    def test_names_are_made_valid_and_given_once(self):
        deck = ABAQUS + HEXAHEDRON.replace("=A", "=Part-1") + "*NSET, NSET=LOW\n1,2,3,4\n*ELSET, ELSET=LOW\n1\n" \
            "*SURFACE, NAME=LOW\n1, S1\n*NSET, NSET=skin\n1,2\n*NSET, NSET=1 x\n1\n*NSET, NSET=Part_1\n1,2\n"
        mesh, out = self.read(".inp", deck)
        self.assertEqual(set(mesh.groups), {"Part_1", "LOW"})
        self.assertEqual({name: sum(flags) for name, flags in mesh.sets.items()},
                         {"LOW_elements": 8, "skin_nodes": 2, "n_1_x": 1, "Part_1_nodes": 2})
        for said in ("the region 'Part-1' is now 'Part_1'", "the node set 'skin' is now 'skin_nodes'",
                     "the node set 'LOW' has the nodes of the surface 'LOW' and stands for both"):
            self.assertIn(said, out)

    def test_one_part_alone(self):
        mesh, _ = self.read(".inp", (DECKS / "block.inp").read_text(encoding="utf-8"), "--only", "BLOCK")
        self.assertEqual((set(mesh.groups), len(mesh.points)), ({"BLOCK", "LOAD"}, 14))
        self.assertNotIn("EDGE", mesh.sets)
        named = ABAQUS + "*NODE\n9, 2, 0, 1\n10, 2, 1, 1\n" + HEXAHEDRON.replace("=A", "=a b") \
            + "*ELEMENT, TYPE=S4, ELSET=S\n2,6,9,10,7\n"
        for name in ("a_b", "a b"):
            self.assertEqual((list(self.read(".inp", named, "--only", name)[0].groups)), ["a_b"])

    def test_what_only_leaves_out_is_listed(self):
        deck = ABAQUS + "*NODE\n9, 2, 0, 1\n10, 2, 1, 1\n" + HEXAHEDRON + "*ELEMENT, TYPE=S4, ELSET=S\n2,6,9,10,7\n" \
            "*NSET, NSET=TIP\n9,10\n*SURFACE, NAME=F\nS, SPOS\nA, S2\n"
        self.assertIn("all of the file is taken over", self.read(".inp", deck)[1])
        out = self.read(".inp", deck, "--only", "A")[1]
        self.assertNotIn("all of the file", out)
        self.assertIn("not taken over:\n    1 face of the surface 'F': at deck.inp:19\n    the node set 'TIP': at deck.inp:17\n"
                      "    the part 'S' (1 quadrilateral): at deck.inp:16\n", out)

    def test_a_part_that_is_not_there_is_a_fault(self):
        self.refused(".inp", ABAQUS + HEXAHEDRON, "--only B: there is no such part; there are: A", options=("--only", "B"))


if __name__ == "__main__":
    unittest.main()
