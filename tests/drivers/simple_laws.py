"""Small scenes whose answer mechanics gives at once, for laws, elements, loads and contacts that no case of verification/ depends on.

    python3 tests/drivers/simple_laws.py DRIVERS                    DRIVERS: the folder with the programs
    python3 tests/drivers/simple_laws.py DRIVERS Loads              tests of these names alone

Scenes are dicts, as in right_runs.py. Unless a test says otherwise, a run must reach its end and print no warning.
"""
import re
import sys
from math import exp, hypot, log, pi, sin, sqrt

from known_answers import automatic, fixed, material, momenta, plate, thrown
from right_runs import DOWN, box, lengths
from simple_books import Books, ROUND_OFF, Run, cube, main, moving, probe, sheet

HALF = 0.05  # [m] half the side of a cube about the origin


def at_origin(**more):
    """A cube of 1 kg and one cell about the origin."""
    return cube("b", 2 * HALF, low=(-HALF,) * 3, **more)


def turning(rate, place):
    """The velocity [m/s] of nodes that turn about z with a rate [rad/s]; their place [m] at t = 0 is three expressions of x, y, z."""
    x, y, _ = place
    return [f"-{rate!r}*(sin({rate!r}*t)*({x})+cos({rate!r}*t)*({y}))", f"{rate!r}*(cos({rate!r}*t)*({x})-sin({rate!r}*t)*({y}))", "0"]


def driven(body, velocity, **more):
    return {"name": "drive", "kind": "driven", "nodes": [body], "velocity": {"value": velocity, "unit": "m/s"}, **more}


def displaced(body, place):
    """The displacement [m] that brings nodes to a place [m] before the start."""
    return {"body": body, "displacement": [f"({at})-{axis}" for at, axis in zip(place, "xyz")], "unit": "m"}


# ------------------------------------------------------------------------------------------------

class Laws(Books):
    """All nodes of one cell are driven, so that its strain is known."""

    def stretched(self, stuff, velocity, end, *probes, name="a", initial=(), **more):
        """A run of the cube with a given law; all its nodes have the given velocity."""
        body = {**at_origin(), "material": stuff, **more}
        return self.run_scene({"bodies": [body], "planes": [driven("b", velocity)], "probes": list(probes), "time": {"end": end},
                               "initial": list(initial)}, name=name)

    def test_stretched_rubber(self):
        """The stress at a stretch of 1.5 without lateral strain is that of the potential, although the run has few steps."""
        shear, lame = 1e7 / 2.6, 1e7 * 0.3 / 1.3 / 0.4
        right = (shear * (1.5**2 - 1) + lame * log(1.5)) / 1.5
        run = self.stretched({**material(), "kind": "neo_hookean"}, ["100*x", "0", "0"], "5 ms", probe("stress", "stress", "b", "xx"))
        self.assertAlmostEqual(run.result("stress_last") / right, 1, delta=ROUND_OFF)

    def test_stretched_rubber_that_turns(self):
        """A stretched cube makes a quarter of a turn: the stress along y is then the former stress along x."""
        place, rate = ["1.3*x", "y", "z"], pi / 2 / 0.05
        run = self.stretched({**material(), "kind": "neo_hookean"}, turning(rate, place), "50 ms", probe("x", "stress", "b", "xx"),
                             probe("y", "stress", "b", "yy"), initial=[displaced("b", place)], element={"kind": "full"})
        self.assertAlmostEqual(run.result("y_last") / run.result("x_largest"), 1, delta=1e-3)  # the nodes follow chords: 4e-5

    def test_cell_that_is_bent_turns_and_is_straightened(self):
        """A cell is bent, makes a quarter of a turn and is straightened: it gives back all energy of its bending."""
        bend, rate = 100.0, pi / 2 / 0.05  # [1/(m s)], [rad/s]: 20 ms, a quarter of a turn, and 20 ms
        turn = [part.replace("*t)", "*(t-0.02))") for part in turning(rate, [f"x+{bend * 0.02!r}*x*y", "y", "z"])]
        velocity = [f"t < 0.02 ? {bend!r}*x*y : t < 0.07 ? {turn[0]} : 0", f"t < 0.02 ? 0 : t < 0.07 ? {turn[1]} : -{bend!r}*x*y", "0"]
        account = self.stretched(material(), velocity, "90 ms").account("b")
        self.assertLess(account["stored"]["hourglass"]["value"], 0.01 * account["passed"]["value"])  # the nodes follow chords: 2e-5

    def test_liquid_in_tension(self):
        """Above its cut-off the pressure of a liquid in tension is K (1 - V/V0)."""
        liquid = {"kind": "mie_gruneisen", "density": "1000 kg/m^3", "sound_speed": "100 m/s", "slope": 2, "gamma": 0, "cutoff": "-1e8 Pa"}
        run = self.stretched(liquid, ["20*x", "0", "0"], "5 ms", probe("pressure", "pressure", "b"))
        self.assertAlmostEqual(run.result("pressure_last") / (1e7 * -0.1), 1, delta=ROUND_OFF)

    def test_bubbles_that_open_and_close(self):
        """The account of a liquid contains the energy of bubbles that open or close within a step."""
        liquid = {"kind": "linear_fluid", "density": "1000 kg/m^3", "sound_speed": "100 m/s"}
        run = self.stretched(liquid, ["2*cos(2000*t+1)*x", "0", "0"], "10 ms")
        account = run.account("b")
        self.assertLess(abs(account["created"]["value"]), ROUND_OFF * account["passed"]["value"])


class Loads(Books):
    def test_moment_of_a_force_on_a_body_that_moves(self):
        """The angular impulse of the force explains the angular momentum of the body."""
        push = {"name": "push", "kind": "force", "nodes": "b.z_low", "value": ["0", "0", "50"], "unit": "N"}
        run = self.run_scene({"bodies": [cube()], "loads": [push], "initial": [moving("b", 10, 5, 0)], "time": {"end": "10 ms"}})
        self.assertLess(hypot(*run.ledger("angular_momentum_residual")), ROUND_OFF * hypot(*run.ledger("angular_momentum")))

    def no_spin(self, **more):
        """The speed of a prism, which a uniform pressure on its base does not turn. [m/s]

        The base is a trapezoid, and its centroid is below the centre of mass of the prism.
        """
        body = at_origin(rigid=True)
        body["mesh"]["map"] = ["x*(1+10*y)", "y", "z"]
        run = self.run_scene({"bodies": [body], "time": {"end": "1 ms"}, "probes": [
            probe("spin", "angular_velocity", "b"), probe("speed", "velocity", "b", "z")], **more})
        self.assertLess(run.result("spin_largest"), ROUND_OFF)
        return run.result("speed_last")

    def test_pressure_on_a_trapezoid(self):
        """A pressure of 0.1 MPa accelerates 1 kg on 0.01 m2 for 1 ms."""
        push = {"name": "push", "kind": "pressure", "surface": "b.z_low", "value": "1e5", "unit": "Pa"}
        self.assertAlmostEqual(self.no_spin(loads=[push]), 1, delta=ROUND_OFF)

    def test_radiation_from_a_trapezoid(self):
        """The impedance of the base brakes the prism: its speed decays with the impedance times the area over the mass."""
        out = {"name": "out", "kind": "radiation", "surface": "b.z_low", "impedance": "1e5 kg/(m^2*s)", "value": "0", "unit": "Pa"}
        speed = self.no_spin(loads=[out], initial=[moving("b", 0, 0, -1)])
        self.assertAlmostEqual(speed, -exp(-1), delta=1e-3)  # time integration in a thousand steps, 2e-4

    def test_plane_by_a_penalty_below_a_trapezoid(self):
        """The prism bounces: the forces of the penalty are proportional to the tributary areas of its nodes."""
        ground = {"name": "ground", "kind": "rigid", "surface": "b.z_low", "point": lengths((0, 0, -HALF - 1e-5)), "normal": [0, 0, 1],
                  "method": "penalty", "penalty": "1e10 Pa/m"}
        self.assertAlmostEqual(self.no_spin(planes=[ground], initial=[moving("b", 0, 0, -1)]), 1, delta=0.01)  # 'energy_gain_limit'

    def test_bubble_under_a_face_that_grows(self):
        """The pressure is proportional to the volume of the bubble: its impulse is the integral of the volume over the swept volume."""
        grows, up, volume, end = 100.0, 10.0, 1e-3, 0.01  # [1/s], [m/s], [m3], [s]
        push = {"name": "push", "kind": "bubble", "surface": "b.z_low", "value": "1e6*v", "unit": "Pa", "volume": f"{volume!r} m^3"}
        run = self.run_scene({"bodies": [at_origin()], "loads": [push], "time": {"end": f"{end!r} s"}, "planes": [
            driven("b", [f"{grows!r}*x", f"{grows!r}*y", f"{up!r}"])], "probes": [probe("push", "impulse", "push", "z")]})
        area, gain = 4 * HALF**2, (1 + grows * end)**3 - 1
        swept = area * up * gain / (3 * grows)
        right = 1e6 * ((volume * swept + swept**2 / 2) / up)  # [N s]
        self.assertAlmostEqual(run.result("push_last") / right, 1, delta=0.002)  # time integration in 26 steps, 7e-4

    def test_blow_on_a_floor(self):
        """The energy residual is round-off where forces act on the nodes that a floor stops."""
        floor = {"name": "ground", "kind": "floor", "nodes": ["b.z_low"], "point": lengths((0, 0, -0.0001)), "normal": [0, 0, 1]}
        run = self.run_scene({"bodies": [cube()], "planes": [floor], "gravity": [f"{100 * float(a.split()[0])!r} m/s^2" for a in DOWN],
                              "time": {"end": "10 ms"}})
        self.assertLess(abs(run.ledger("energy_residual")), ROUND_OFF * run.ledger("energy_scale"))

    def test_first_force_of_a_rigid_plane(self):
        """A box starts on the plane with a speed into it: the mean forces of all rows add up to the change of its momentum."""
        ground = {"name": "ground", "kind": "rigid", "surface": "b.z_low", "point": lengths((0, 0, 0)), "normal": [0, 0, 1]}
        run = self.run_scene({"bodies": [cube(rigid=True)], "planes": [ground], "initial": [moving("b", 0, 0, -1)],
                              "time": {"end": "10 ms"}, "probes": [probe("force", "force", "ground", "z"), *momenta("b")]})
        rows = run.history()
        times, forces = ([values for name, values in rows.items() if name.startswith(word)][0] for word in ("time ", "force "))
        impulse = sum(force * (end - begin) for begin, end, force in zip(times, times[1:], forces[1:]))
        self.assertAlmostEqual(impulse / (run.result("b_z_last") + 1), 1, delta=ROUND_OFF)


class Rigid(Books):
    def test_spin_about_a_place_that_is_not_the_centre(self):
        """A body turns about the origin: the momentum is the mass times the velocity of the centre of mass."""
        body = at_origin(rigid=True, mass_properties={"centre": lengths((0.02, 0, 0))})
        run = self.run_scene({"bodies": [body], "initial": [moving("b", "-10*y", "10*x", 0)], "time": {"end": "1 us"}})
        self.assertAlmostEqual(run.ledger("initial_momentum")[1], 0.2, delta=ROUND_OFF)

    def test_inertia_of_a_thick_plate(self):
        """A plate is as thick as it is long: about an axis in its plane it has the inertia of a cube."""
        body = plate("p", {**sheet(0.1, 0.1, 2, 2), "map": ["x-0.05", "y-0.05", "0"]}, 0.1, material(), rigid=True)
        run = self.run_scene({"bodies": [body], "initial": [moving("p", 0, "-10*z", "10*y")], "time": {"end": "1 us"}})
        self.assertAlmostEqual(run.ledger("initial_angular_momentum")[0] / (10 * 0.1**2 / 6), 1, delta=ROUND_OFF)

    def test_body_turned_about_a_place(self):
        """A half turn about its side moves a cube by its length."""
        body = cube(rigid=True, rotate={"axis": [0, 0, 1], "angle": "180 deg", "about": lengths((0.1, 0.05, 0))})
        run = self.run_scene({"bodies": [body], "initial": [moving("b", 0, 0, 1)], "time": {"end": "1 us"},
                              "probes": [probe("x", "position", "b", "x"), probe("y", "position", "b", "y")]})
        self.assertAlmostEqual(run.result("x_last"), 0.15, delta=ROUND_OFF)
        self.assertAlmostEqual(run.result("y_last"), 0.05, delta=ROUND_OFF)


class Contacts(Books):
    def falls(self, base, gap, contact, upper):
        """A rigid body moves down with 1 m/s over a gap [m] and bounces off another rigid body, which is held."""
        run = self.run_scene({"bodies": [base, upper], "planes": [fixed(base["name"])], "contacts": contact, "time": {"end": "10 ms"},
                              "initial": [moving(upper["name"], 0, 0, -1)], "probes": [probe("way", "displacement", upper["name"], "z")]})
        self.assertAlmostEqual(run.result("way_smallest"), -gap, delta=2e-5)  # it moves by 10 um in a step

    def test_on_a_plate_as_the_base(self):
        """The surface of the plate is half of its thickness above its nodes."""
        base = plate("p", sheet(0.1, 0.1, 2, 2), 0.01, material(), rigid=True)
        self.falls(base, 0.004, [{"name": "c", "apexes": "b.z_low", "base": "p.top"}], cube(size=0.05, low=(0.02, 0.02, 0.009), rigid=True))

    def test_of_crossed_tubes(self):
        """Tubes touch where their outer surfaces meet."""
        mesh = {"kind": "tube", "radius": "20 mm", "length": "60 mm", "turn": "full", "cells_core": 2, "cells_along": 2}
        low, high = (plate(name, mesh, 0.01, material(), rigid=True, rotate={"axis": axis, "angle": "90 deg"}, move=lengths(move))
                     for name, axis, move in (("low", [0, 1, 0], (-0.03, 0, 0)), ("high", [1, 0, 0], (0, 0.03, 0.055))))
        self.falls(low, 0.005, automatic(0.0), high)

    def crossing(self, overlap, velocity, *probes, **more):
        """A run of two rigid bars that cross on their ridges: the upper one touches the lower one, or overlaps it. [m], [m/s]"""
        bars = [box(name, [-one for one in side], side, cells, rigid=True) for name, side, cells in
                (("lower", (0.05, 0.005, 0.005), (11, 2, 2)), ("upper", (0.005, 0.05, 0.005), (2, 11, 2)))]
        bars[0]["rotate"] = {"axis": [1, 0, 0], "angle": "45 deg"}
        bars[1].update(rotate={"axis": [0, 1, 0], "angle": "45 deg"}, move=lengths((0, 0, 0.01 * sqrt(2) - overlap)))
        contact = {"name": "c", "apexes": "upper.skin", "base": "lower.skin", "passes": "two", **more}
        return self.run_scene({"bodies": bars, "planes": [fixed("lower")], "initial": [moving("upper", *velocity)], "contacts": [contact],
                               "gravity": DOWN, "time": {"end": "2 ms"}, "probes": list(probes)})

    def test_friction_of_ridges_that_cross(self):
        """The impulse of friction is the momentum that the upper bar loses along the lower one: half of the normal impulse."""
        run = self.crossing(0, (1, 0, 0), probe("rub", "impulse", "c", "x"), probe("push", "impulse", "c", "z"), *momenta("upper"),
                            friction=0.5)
        lost = run.ledger("initial_momentum")[0] - run.result("upper_x_last")
        self.assertAlmostEqual(-run.result("rub_last") / lost, 1, delta=ROUND_OFF)
        self.assertAlmostEqual(lost / (0.5 * run.result("push_last")), 1, delta=2e-3)  # friction is absent in the first of a thousand steps

    def test_blow_of_ridges_whose_overlap_is_accepted(self):
        """An impact without restitution leaves the upper bar at its place."""
        run = self.crossing(1e-4, (0, 0, -0.1), probe("way", "displacement", "upper"), initial_penetration="accept", restitution=0)
        self.assertLess(run.result("way_largest"), 1e-9)  # round-off; the overlap is 0.1 mm

    def test_tie_over_a_gap_that_slides(self):
        """The tie keeps the gap: the block above moves by less than its weight over its stiffness."""
        tie = {"name": "tie", "kind": "tied", "apexes": "high.z_low", "base": "low.z_high", "slides": True}
        run = self.run_scene({"bodies": [cube("low"), cube("high", low=(0, 0, 0.101))], "planes": [fixed("low.z_high", "low.z_low")],
                              "contacts": [tie], "gravity": DOWN, "time": {"end": "5 ms"},
                              "probes": [probe("way", "displacement", "high")]})
        self.assertLess(run.result("way_largest"), 1e-5)  # 1 kg over 1 MN/m; the gap is 1 mm

    def test_blow_beyond_the_border_of_the_base(self):
        """Nodes leave the base during an impact: the other nodes get the energy of these nodes, so that nothing is lost."""
        low, high = (box("low", (-0.2, -0.2, -0.1), (0, 0, 0), (2, 2, 1)),
                     box("high", (-0.102, -0.102, 0.0005), (-0.002, -0.002, 0.1005), (2, 2, 2)))
        run = self.run_scene({"bodies": [low, high], "planes": [fixed("low.z_low")], "initial": [moving("high", 5, 5, -1)],
                              "contacts": [{"name": "c", "apexes": "high.z_low", "base": "low.z_high"}],
                              "time": {"end": "6 ms", "safety": 0.2}})
        self.assertLess(abs(run.account("c")["dissipated"]["inelastic_impact"]["value"]), ROUND_OFF)

    def test_restitution_of_bodies_that_deform(self):
        """With a coefficient of a half the nodes get back a quarter of the energy that the impact stops."""
        lost = []
        for part in (0.0, 0.5):
            run = self.run_scene({"bodies": [cube("low", rigid=True), cube("high", low=(0, 0, 0.1001))], "planes": [fixed("low")],
                                  "contacts": [{"name": "c", "apexes": "high.z_low", "base": "low.z_high", "restitution": part}],
                                  "initial": [moving("high", 0, 0, -1)], "time": {"end": "10 ms", "safety": 0.2}}, name=str(part))
            lost.append(run.account("c")["dissipated"]["inelastic_impact"]["value"])
        self.assertAlmostEqual(lost[1] / lost[0], 0.75, delta=1e-6)  # the first contact alone loses energy: 1e-16

    def test_damped_penalty(self):
        """The dashpot dissipates all energy that a critically damped contact takes."""
        contact = {"name": "c", "apexes": "high.z_low", "base": "low.z_high", "method": "penalty", "penalty": "1e8 Pa/m",
                   "damping_ratio": 1}
        run = self.run_scene({"bodies": [cube("low", rigid=True), cube("high", low=(0, 0, 0.1001), rigid=True)], "contacts": [contact],
                              "planes": [fixed("low")], "initial": [moving("high", 0, 0, -1)], "time": {"end": "20 ms"}})
        account = run.account("c")
        self.assertGreater(account["dissipated"]["damping"]["value"], 0.2)  # of 0.5 J
        self.assertLess(abs(account["created"]["value"]), 5e-4)  # [J] time integration, 4e-6

    def test_block_that_sticks_on_a_turntable(self):
        """After two turns the block is where it started; the elastic slip of its friction is a hundredth of its radius."""
        rate, radius = 40.0, 0.01  # [rad/s], [m]
        table = box("table", (-0.05, -0.05, -0.01), (0.05, 0.05, 0), (1, 1, 1), rigid=True)
        block = box("b", (radius - 0.005, -0.005, 0), (radius + 0.005, 0.005, 0.002), (1, 1, 1), rigid=True)
        contact = {"name": "c", "apexes": "b.z_low", "base": "table.z_high", "method": "penalty", "friction": 10,
                   "penalty": f"{100 * 2 * rate**2!r} Pa/m", "damping_ratio": 0.5}  # of a block of 2 kg/m2
        drive = driven("table", ["0", "0", "0"], angular_velocity={"value": ["0", "0", f"{rate!r}"], "unit": "rad/s"})
        run = self.run_scene({"bodies": [table, block], "planes": [drive], "gravity": DOWN, "contacts": [contact],
                              "initial": [thrown(name, (0, 0, 0), (0, 0, rate)) for name in ("table", "b")],
                              "time": {"end": f"{4 * pi / rate!r} s"}, "probes": [probe(axis, "position", "b", axis) for axis in "xy"]})
        self.assertAlmostEqual(run.result("x_last") / radius, 1, delta=0.03)  # elastic slip, and sliding before the block is pressed
        self.assertAlmostEqual(run.result("y_last") / radius, 0, delta=0.03)


class Audit(Books):
    def test_overlap_that_comes_back(self):
        """Bodies overlap at the start, part, and overlap again by as much: the second overlap is not accepted."""
        lift = {**driven("high", ["0", "0", "2*pi*sin(2*pi*20*t)"]), "name": "lift"}
        scene = {"bodies": [cube("low", rigid=True), cube("high", low=(0, 0, 0.07), rigid=True)], "planes": [fixed("low"), lift],
                 "time": {"end": "50 ms"}}
        run = Run(scene, self.folder / "a", "--quiet")
        self.assertIn("warning: low and high overlap by 0.03 m, 0.3 of an element", run.stderr)
        self.assertAlmostEqual(run.result("audit_overlap_elements"), 0.3, delta=1e-6)

    def test_chords_of_circles_that_do_not_overlap(self):
        """A pin turns in a hole with clearance. The chords of both overlap, the circles do not: the run is not stopped."""
        chords, hole, gap, spin = 12, 0.02, 1e-4, 100.0
        bodies = [{"name": name, "rigid": True, "surface": "facets", "material": material(), "mesh": {
            "kind": "revolved", "heights": lengths((0, 0.01)), "radii": lengths(radii), "filled": ["x"], "angle": "360 deg",
            "cells_around": chords, "cells_along": [1], "cells_radial": [1]}} for name, radii in
            (("hub", (hole, hole + 4e-3)), ("pin", (hole - gap - 8e-4, hole - gap)))]
        run = Run({"bodies": bodies, "planes": [fixed("hub")], "initial": [thrown("pin", (0, 0, 0), (0, 0, spin))],
                   "time": {"end": f"{pi / chords / spin!r} s"}}, self.folder / "a", "--quiet")
        self.assertEqual(run.summary()["ending"]["word"], "reached_end")
        self.assertGreater(run.result("audit_overlap_elements"), 0.5)  # 'overlap_limit': so deep are the corners of the pin in the hub


class MeshError(Books):
    def test_of_an_order_above_three_halves(self):
        """The mass of a cylinder converges with the square of its chords; the estimate takes an order of 3/2 at most."""
        body = {"name": "b", "material": material(), "mesh": {"kind": "cylinder", "radius": "0.1 m", "length": "0.1 m", "turn": "full",
                                                              "cells_core": 2, "cells_ring": 1, "cells_along": 1}}
        scene = {"bodies": [body], "initial": [moving("b", 0, 0, 1)], "time": {"end": "1 us"}, "probes": momenta("b")}
        run = self.run_scene(scene, ["--accuracy", "1%", "--of", "b_z_last"])
        factors = [float(factor) for factor in re.findall(r"^refine (\S+): b_z_last = ", run.stdout, re.MULTILINE)]
        self.assertGreater(len(factors), 2)

        def mass(factor):
            chords = round(16 * factor)
            return 10 * 0.1 * chords / 2 * sin(2 * pi / chords)
        self.assertAlmostEqual(run.result("b_z_last") / mass(factors[-1]), 1, delta=ROUND_OFF)
        right = 1.25 * (mass(factors[-1]) - mass(factors[-2])) / ((factors[-1] / factors[-2])**1.5 - 1)
        self.assertAlmostEqual(run.result("b_z_last_mesh_error") / right, 1, delta=0.01)  # the factors are printed with some digits


if __name__ == "__main__":
    main(sys.argv[1:], __doc__)
