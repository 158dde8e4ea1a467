#include "model/values.hpp"

#include <algorithm>
#include <cmath>

#include "base/words.hpp"
#include "model/meshes.hpp"

namespace nereid::model {

namespace {

/// A value of a part, what a case would call it, and what it may be.
struct Value {
  std::string key;
  double value;
  Range allowed = finite;
  const char* unit = "1";
};
using Values = std::vector<Value>;

/// Whether all values are in their ranges.
bool check(Faults& faults, const Part& part, const Values& values) {
  const std::size_t before = faults.size();
  for (const auto& [key, value, allowed, unit] : values)
    if (!std::isfinite(value))
      refuse(faults, part, key, quote(last_of(key)) + " = " + shortest(value) + " is no finite number");
    else if (!allowed.contains(value))
      refuse(faults, part, key,
             quote(last_of(key)) + " = " + shortest(value) + " is out of range: expected " + words_of(allowed, last_of(key), unit));
  return faults.size() == before;
}

/// The components of a vector, which are any finite numbers.
Values components(const char* key, const Vec3& vector) { return {{key, vector.x()}, {key, vector.y()}, {key, vector.z()}}; }

/// One of the words of an enumeration, by the last of them.
template <class Enum>
Value kind(const char* key, Enum value, Enum last) {
  return {key, static_cast<double>(value), within(0, static_cast<double>(last))};
}

void check_direction(Faults& faults, const Part& part, const char* key, const Vec3& direction) {
  if (!(std::abs(direction.norm() - 1) < 1e-9)) refuse(faults, part, key, quote(last_of(key)) + " is no unit vector");
}

/// The functions for x, y and z; where `may_be_empty`, all or none of them.
void check_functions(Faults& faults, const Part& part, const char* key, const Field& field, bool may_be_empty) {
  const int count = (field[0] ? 1 : 0) + (field[1] ? 1 : 0) + (field[2] ? 1 : 0);
  if (count < 3 && !(may_be_empty && count == 0)) refuse(faults, part, key, quote(key) + " needs a function for each of x, y and z");
}

// Constants that Hooke's law does not have, by law.

Values strength(const material::Elastic&) { return {}; }
Values strength(const material::NeoHookean&) { return {}; }
Values strength(const material::LinearFluid& law) {
  return {{"bulk_modulus", law.bulk_modulus, positive, "Pa"}, {"cutoff", law.cutoff, below(law.bulk_modulus), "Pa"}};
}
Values strength(const material::MieGruneisen& law) {
  return {{"sound_speed", law.sound_speed, positive, "m/s"}, {"slope", law.slope, range::shock_slope}, {"gamma", law.gamma, not_negative},
          {"cutoff", law.cutoff, below(material::bulk_modulus_at_start(law)), "Pa"}};
}
Values strength(const material::IdealGas& law) { return {{"gamma", law.gamma, range::adiabatic}}; }
Values strength(const material::J2Bilinear& law) {
  return {{"yield", law.flow.yield, positive, "Pa"}, {"tangent", law.flow.tangent, not_negative.below(law.young), "Pa"}};
}
Values strength(const material::J2Mixed& law) {
  return {{"yield", law.yield, positive, "Pa"},
          {"tangent", law.tangent, not_negative.below(law.young), "Pa"},
          {"isotropic_share", law.isotropic, range::share}};
}
Values strength(const material::J2JohnsonCook& law) {
  const material::JohnsonCook& f = law.flow;
  const Range above_reference = f.reference_temperature >= 0 ? above(f.reference_temperature) : positive;
  return {{"yield", f.yield, positive, "Pa"},
          {"hardening_coefficient", f.hardening, not_negative, "Pa"},
          {"hardening_exponent", f.hardening_exponent, range::hardening_exponent},
          {"rate_coefficient", f.rate_coefficient, range::share},
          {"reference_rate", f.reference_rate, positive, "1/s"},
          {"thermal_exponent", f.thermal_exponent, range::thermal_exponent},
          {"reference_temperature", f.reference_temperature, not_negative, "K"},
          {"melting_temperature", f.melting_temperature, above_reference, "K"},
          {"specific_heat", f.specific_heat, positive, "J/(kg*K)"},
          {"taylor_quinney", f.heat_share, range::share},
          {"temperature", f.temperature, not_negative, "K"}};
}

Values strength(const material::J2Curve& law) {
  using Kind = material::HardeningCurve::Kind;
  const material::HardeningCurve& f = law.flow;
  Values all;
  if (f.kind != Kind::measured) all.push_back({"curve.growth", f.growth, not_negative, "Pa"});
  if (f.kind == Kind::voce || f.kind == Kind::ludwik) all.push_back({"curve.yield", f.yield, positive, "Pa"});
  if (f.kind == Kind::voce) all.push_back({"curve.exponent", f.exponent, positive});
  if (f.kind == Kind::ludwik || f.kind == Kind::swift) all.push_back({"curve.exponent", f.exponent, range::hardening_exponent});
  if (f.kind == Kind::swift) all.push_back({"curve.offset", f.offset, positive});
  all.push_back({"cowper_symonds.rate", f.cowper_rate, not_negative, "1/s"});
  all.push_back({"cowper_symonds.exponent", f.cowper_exponent, range::cowper_exponent});
  return all;
}

/// Faults of measured curves; readers have found them at their files.
void check_curves(Faults& faults, const Part& here, const material::HardeningCurve& flow) {
  if (flow.kind != material::HardeningCurve::Kind::measured) return;
  if (flow.curves.empty()) refuse(faults, here, "curve", "there is no curve");
  for (std::size_t i = 0; i < flow.curves.size(); ++i) {
    const std::string said = wrong_with(flow.curves[i]);
    if (!said.empty()) refuse(faults, here, "curve", said);
    if (i > 0 && !(flow.curves[i].rate > flow.curves[i - 1].rate && flow.curves[i - 1].rate > 0))
      refuse(faults, here, "curve", "the rates of its curves do not grow from above zero");
  }
}

void check_law(const Body& body, const element::AnyLaw& any, Part here, Faults& faults) {
  if (!here.at.empty()) here.at += ".material";
  const auto constants = [&]<class Law>(const Law& law) {
    bool sound = check(faults, here, {{"density", law.density, positive, "kg/m^3"}});
    if constexpr (!material::FluidLaw<Law>)
      sound = check(faults, here, {{"young", law.young, positive, "Pa"}, {"poisson", law.poisson, range::poisson}}) && sound;
    if (sound) check(faults, here, strength(law));  // some of these ranges end at one of those
    if constexpr (std::is_same_v<Law, material::J2Curve>) check_curves(faults, here, law.flow);
  };
  const bool is_fluid = material::is_fluid(any);
  if (has_plates(body.mesh) && is_fluid)
    refuse(faults, here, "kind", fluids_are_solid_meshes);
  else if (is_fluid && body.rigid)
    refuse(faults, here, "kind", "a rigid body is no fluid: expected a law of solids");
  else if (has_plates(body.mesh) && !element::plates_may_have(any))
    refuse(faults, here, "kind", plates_may_have_other_laws);
  else if (is_fluid != std::holds_alternative<element::Fluid::Options>(body.solid))
    refuse(faults, here, "kind", is_fluid ? "a fluid needs the options of fluids" : "a solid has the options of fluids");
  else
    std::visit(constants, any);
}

// Options of elements, by kind.

Values of_viscosity(const element::Viscosity& viscosity) {
  return {{"element.viscosity.linear", viscosity.linear, range::linear_viscosity},
          {"element.viscosity.quadratic", viscosity.quadratic, range::quadratic_viscosity}};
}
Values own(const element::Hexahedron::Options& options) {
  return {{"element.hourglass", options.hourglass, range::hourglass},
          {"element.distortion", options.distortion.stiffness, range::distortion}};
}
Values own(const element::FullHexahedron::Options& options) {
  return {{"element.distortion", options.distortion.stiffness, range::distortion}};
}
Values own(const element::Fluid::Options& options) {
  return {{"element.hourglass", options.hourglass, range::hourglass_of_fluids},
          {"element.distortion", options.distortion.stiffness, range::distortion}};
}
Values own(const element::Plate::Options& options) {
  return {{"element.thickness", options.thickness, positive, "m"},
          {"element.layers", static_cast<double>(options.layers), within(1, element::Plate::most_layers)},
          {"element.drilling", options.drilling, range::drilling}};
}

/// The pressure that a fluid starts with is one that its law can have.
void check_start(const Body& body, Faults& faults) {
  const Part here = part("body", body);
  const double pressure = body.start.pressure;
  Range allowed = positive;  // of a gas
  if (const auto* law = std::get_if<material::LinearFluid>(&body.law)) allowed = at_least(law->cutoff).below(law->bulk_modulus);
  if (const auto* law = std::get_if<material::MieGruneisen>(&body.law))
    allowed = at_least(law->cutoff).below(material::highest_start(*law));
  if (material::is_fluid(body.law)) check(faults, here, {{"start.pressure", pressure, allowed, "Pa"}});
}

void check_set(const Set& set, Faults& faults) {
  if (!set.zone) return;
  const Part here = part("set", set);
  check(faults, here, components("from", set.zone->from));
  check(faults, here, components("to", set.zone->to));
  check(faults, here, {{"radius", set.zone->radius, not_negative, "m"}});
  check_direction(faults, here, "normal", set.zone->normal);
}

void check_body(const Body& body, Faults& faults) {
  const Part here = part("body", body);
  check_start(body, faults);
  const auto look = [&](const auto& options) { check(faults, here, own(options)), check(faults, here, of_viscosity(options.viscosity)); };
  check_law(body, body.law, here, faults);
  for (const PartMaterial& one : body.parts) {
    check_law(body, one.law, {one.at, "material of part '" + one.of + "' of body '" + body.name + "'"}, faults);
    if (material::is_fluid(one.law)) refuse(faults, {one.at, "material of a part"}, "of", "a fluid is a body of its own: parts are solids");
  }
  for (const Set& set : body.sets) check_set(set, faults);
  check_functions(faults, here, "map", body.map, true);
  if (has_solids(body.mesh)) std::visit(look, body.solid);
  if (has_plates(body.mesh)) look(body.plate);
  check(faults, here, {{"mesh.scale", body.scale, positive, "m"}});
  check(faults, here, {{"rotate.angle", body.place.angle}});
  if (body.place.angle != 0) check_direction(faults, here, "rotate.axis", body.place.axis);
  check(faults, here, components("rotate.about", body.place.about)), check(faults, here, components("move", body.place.move));
  if (body.given.mass) check(faults, here, {{"mass_properties.mass", *body.given.mass, positive, "kg"}});
  if (body.given.centre) check(faults, here, components("mass_properties.centre", *body.given.centre));
  for (const Point& point : body.points) check(faults, part("point", point), components("near", point.near));
}

// How surfaces touch.

Values of_friction(const contact::Coulomb& friction, double energy_gain_limit, double step_factor) {
  return {{"friction", friction.coefficient, range::friction},
          {"kinetic_friction", friction.kinetic, range::friction},
          {"friction_decay", friction.decay, not_negative, "s/m"},
          {"tangential_penalty", friction.tangential_penalty, range::tangential_penalty},
          {"energy_gain_limit", energy_gain_limit, range::energy_gain_limit},
          {"step_factor", step_factor, range::step_factor}};
}

void check_contact(const Contact& contact, Faults& faults) {
  const Part here = part("contact", contact);
  const dynamics::InterfaceOptions& o = contact.interface;
  check(faults, here, of_friction(o.friction, o.energy_gain_limit, o.step_factor));
  check(faults, here, {kind("kind", o.kind, contact::InterfaceKind::tied), kind("method", o.method, contact::Method::multiplier),
                       {"penalty", o.penalty.value_or(1), positive, "Pa/m"}, {"penalty_scale", o.penalty_scale, positive},
                       {"restitution", o.restitution, range::restitution}, {"damping_ratio", o.damping_ratio, range::damping_ratio},
                       {"clearance", o.height.clearance, not_negative, "m"}, {"height", o.height.given, not_negative, "m"}});
  if (o.kind == contact::InterfaceKind::tied && o.method == contact::Method::multiplier && o.two_passes)
    refuse(faults, here, "passes", "a tie by multipliers has one pass, since two would stiffen the bodies; or say 'method: penalty'");
  if (o.slides && (o.kind != contact::InterfaceKind::tied || o.method != contact::Method::multiplier))
    refuse(faults, here, "slides", "only a tie by multipliers slides");
}

void check_contact(const AutomaticContact& contact, Faults& faults) {
  const Part here = part("contact", contact);
  const dynamics::InterfaceOptions& o = contact.interface;
  check(faults, here, of_friction(o.friction, o.energy_gain_limit, o.step_factor));
  check(faults, here, {kind("method", o.method, contact::Method::multiplier), {"penalty", o.penalty.value_or(1), positive, "Pa/m"},
                       {"penalty_scale", o.penalty_scale, positive}, {"restitution", o.restitution, range::restitution}});
}

void check_plane(const Plane& plane, Faults& faults) {
  const Part here = part("plane", plane);
  check(faults, here, {kind("kind", plane.kind, load::PlaneKind::driven)});
  check(faults, here, components("point", plane.point));
  check_direction(faults, here, "normal", plane.normal);
  check_functions(faults, here, "velocity", plane.field, plane.kind != load::PlaneKind::driven);
  check_functions(faults, here, "angular_velocity", plane.angular_velocity, true);
  if (plane.nodes.empty()) refuse(faults, here, "nodes", "'nodes' names no node set");
}

void check_wall(const RigidPlane& plane, Faults& faults) {
  const Part here = part("plane", plane);
  check(faults, here, components("point", plane.point));
  check_direction(faults, here, "normal", plane.normal);
  check(faults, here, {{"penalty", plane.penalty.value_or(1), positive, "Pa/m"}, {"penalty_scale", plane.penalty_scale, positive}});
  check(faults, here, {kind("method", plane.method, contact::Method::multiplier), {"restitution", plane.restitution, range::restitution}});
  check(faults, here, of_friction(plane.friction, plane.energy_gain_limit, plane.step_factor));
}

void check_load(const Load& load, Faults& faults) {
  const Part here = part("load", load);
  if (!check(faults, here, {kind("kind", load.kind, LoadKind::bubble)})) return;
  check(faults, here, {{"impedance", load.impedance.value_or(1), positive, "kg/(m^2*s)"}});
  if (load.kind == LoadKind::bubble) check(faults, here, {{"volume", load.volume, positive, "m^3"}});
  const bool is_pressure = load.kind == LoadKind::pressure || load.kind == LoadKind::radiation || load.kind == LoadKind::bubble;
  if (!is_pressure) check_functions(faults, here, "value", load.value, false);
  else if (!load.value[0]) refuse(faults, here, "value", "'value' needs a function");
}

void check_stop(const Stop& stop, double row, Faults& faults) {
  const Part here{stop.at, "condition to stop"};
  if (!check(faults, here, {kind("kind", stop.kind, StopKind::rest), {"after", stop.after, not_negative, "s"}})) return;
  const std::string peak = stop.above ? "peaked" : "dipped";
  switch (stop.kind) {
    case StopKind::level: check(faults, here, {{stop.above ? "above" : "below", stop.value}}); break;
    case StopKind::peak:
      check(faults, here, {{peak + ".fallen", stop.part, range::share}, {peak + ".for", stop.span, not_negative, "s"}});
      if (!(stop.part > 0 || stop.span > 0)) refuse(faults, here, peak, quote(peak) + " needs 'fallen', 'for' or both");
      break;
    case StopKind::steady:
      check(faults, here, {{"steady.within", stop.value, positive}, {"steady.window", stop.span, positive, "s"}});
      if (stop.span < 2 * row) refuse(faults, here, "steady.window", window_too_short(stop.span, row));
      break;
    case StopKind::rest: check(faults, here, {{"rest.part", stop.part, range::rest_part}, {"rest.for", stop.span, positive, "s"}}); break;
  }
}

void check_section(const Section& section, Faults& faults) {
  const Part here = part("section", section);
  check_direction(faults, here, "normal", section.normal);
  check(faults, here, components("point", section.point));
  check(faults, here, {{"radius", section.radius, not_negative, "m"}});
}

void check_run(const Scene& scene, Faults& faults) {
  check(faults, {"", "the scene"}, components("gravity", scene.gravity));
  for (const Body& body : scene.bodies)
    if (body.start.hydrostatic && scene.gravity.isZero(0))
      refuse(faults, part("body", body), "start.hydrostatic", "nothing makes the pressure grow downward: expected 'gravity' in the scene");
  check(faults, {"time", "time"}, {{"end", scene.time.end, positive, "s"}, {"safety", scene.time.safety, range::safety},
                                   {"created_limit", scene.time.created_limit, positive},
                                   {"overlap_limit", scene.time.overlap_limit, positive},
                                   {"corner_limit", scene.time.corner_limit, below(1)}});
  check(faults, {"output", "recording"}, {{"history_every", scene.recording.history, not_negative, "s"},
                                          {"frames_every", scene.recording.frames, not_negative, "s"}});
  const model::Recording& recording = scene.recording;
  for (const auto& [key, every] : {std::pair("history_every", recording.history), std::pair("frames_every", recording.frames)}) {
    const std::string said = too_many(key, every, scene.time.end);
    if (!said.empty()) refuse(faults, {"output", "recording"}, key, said);
  }
  const std::string between = frames_between_rows(recording.frames, recording.history);
  if (!between.empty()) refuse(faults, {"output", "recording"}, "frames_every", between);
  if (scene.relaxation) check_relaxation({"relaxation", "relaxation"}, "", *scene.relaxation, faults);
  const double row = recording.history > 0 ? recording.history : usual_rows(recording.frames, scene.time.end);
  for (const Stop& stop : scene.stops) check_stop(stop, row, faults);
}

}  // namespace

std::string wrong_with(const material::MeasuredCurve& curve) {
  if (curve.strain.size() != curve.stress.size() || curve.strain.empty()) return "it has not one stress for each plastic strain";
  if (curve.strain.front() != 0)
    return "its first plastic strain is " + shortest(curve.strain.front()) + ": expected 0, at which flow begins";
  for (std::size_t i = 0; i < curve.strain.size(); ++i) {
    const std::string at = " at the plastic strain " + shortest(curve.strain[i]);
    if (!std::isfinite(curve.strain[i]) || !std::isfinite(curve.stress[i])) return "it has a value that is no finite number" + at;
    if (!(curve.stress[i] > 0)) return "its stress is " + shortest(curve.stress[i]) + " Pa" + at + ": expected more than 0";
    if (i > 0 && !(curve.strain[i] > curve.strain[i - 1])) return "its plastic strain does not grow" + at;
    if (i > 0 && curve.stress[i] < curve.stress[i - 1]) return "its stress falls" + at + ": expected a curve that does not soften";
  }
  return "";
}

void check_relaxation(const Part& here, const std::string& before, const dynamics::Relaxation& relaxation, Faults& faults) {
  check(faults, here, {{before + "residual", relaxation.residual, range::residual},
                       {before + "after", relaxation.after, not_negative, "s"},
                       {before + "samples", static_cast<double>(relaxation.samples), at_least(1)}});
}

void check_duration(const Part& here, double duration, Faults& faults) { check(faults, here, {{"duration", duration, positive, "s"}}); }

std::string too_many(const std::string& key, double every, double end) {
  const bool frames = key == "frames_every";
  const double most = frames ? most_frames : most_rows, count = end / every;
  if (!(every > 0) || count <= most) return "";
  return quote(key) + " = " + shortest(every) + " s gives " + formatted("%.3g", count) + (frames ? " frames" : " rows") +
         " by the end at " + shortest(end) + " s: expected at most " + (frames ? "a million" : "ten million");
}

std::string frames_between_rows(double frames, double rows) {
  if (!(frames > 0) || !(rows > frames * (1 + 1e-9))) return "";
  return "'frames_every' = " + shortest(frames) + " s is shorter than 'history_every' = " + shortest(rows) +
         " s: a frame is written with a row of the history";
}

double usual_rows(double frames, double end) { return frames > 0 ? std::min(frames, end / 400) : end / 400; }

std::string window_too_short(double window, double row) {
  return "'window' = " + shortest(window) + " s is shorter than two rows of the history, which are " + shortest(row) + " s apart";
}

void check_values(const Scene& scene, Faults& faults) {
  for (const Body& body : scene.bodies) check_body(body, faults);
  for (const Contact& contact : scene.contacts) check_contact(contact, faults);
  for (const AutomaticContact& contact : scene.automatic_contacts) check_contact(contact, faults);
  for (const Plane& plane : scene.planes) check_plane(plane, faults);
  for (const RigidPlane& plane : scene.rigid_planes) check_wall(plane, faults);
  for (const Section& section : scene.sections) check_section(section, faults);
  for (const Load& load : scene.loads) check_load(load, faults);
  for (const Spring& spring : scene.springs)
    check(faults, part("spring", spring), {{"stiffness", spring.stiffness, not_negative, "N/m"},
                                           {"damping", spring.damping, not_negative, "N s/m"},
                                           {"rest_length", spring.length.value_or(0), not_negative, "m"}});
  for (const PointMass& mass : scene.point_masses) check(faults, part("point mass", mass), {{"mass", mass.mass, positive, "kg"}});
  const auto look = [&](const std::vector<Initial>& all) {
    for (const Initial& initial : all)
      check_functions(faults, {initial.at, "initial motion of '" + initial.body + "'"}, initial.displacement ? "displacement" : "velocity",
                      initial.value, false);
  };
  look(scene.initial);
  for (const Stage& stage : scene.stages) look(stage.initial);
  check_run(scene, faults);
}

}  // namespace nereid::model
