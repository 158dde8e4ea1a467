#include "input/load_readers.hpp"

#include <algorithm>
#include <map>

#include "base/words.hpp"
#include "input/readers.hpp"
#include "model/values.hpp"

namespace nereid::input {

namespace {

model::Load read_load(const Section& section) {
  std::vector<std::string> words;
  for (const model::LoadSyntax& one : model::load_syntax) words.emplace_back(one.word);
  model::Load load{.name = section.word("name"), .kind = {}, .on = {}, .value = {}, .at = section.path()};
  const std::string word = section.choice("kind", words);
  const auto kind = static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
  const model::LoadSyntax& syntax = model::load_syntax[kind];
  load.kind = static_cast<model::LoadKind>(kind);
  for (const char* key : {"surface", "nodes", "body"}) {
    const bool chosen = key == std::string_view(syntax.key);
    const std::string on = section.when(chosen).word(key);
    if (chosen) load.on = on;
  }
  if (!section.decided()) {  // of what shape the value is, nobody knows
    section.has("unit"), section.has("value");
    return load;
  }
  const InUnit unit = read_unit(section, dimension_of(syntax.unit));
  const bool is_bubble = load.kind == model::LoadKind::bubble;
  const Variables variables = is_bubble ? of_volume : syntax.over_place ? of_both : of_time;
  const double volume = section.when(is_bubble).quantity("volume", dim::volume, positive);
  if (is_bubble) load.volume = volume;
  load.value = syntax.is_vector ? read_expressions(section, "value", variables, unit)
                                : model::Field{read_expression(section, "value", variables, unit), model::constant(0), model::constant(0)};
  const bool radiates = load.kind == model::LoadKind::radiation;
  if (section.has("incident")) {
    const Expression incident = read_expression(section.when(radiates), "incident", of_time, unit);
    if (radiates) load.incident = {incident, model::constant(0), model::constant(0)};
  }
  if (section.has("impedance")) load.impedance = section.when(radiates).quantity("impedance", dim::density * dim::speed, positive);
  return load;
}

model::Spring read_spring(const Section& section) {
  model::Spring spring{.name = section.word("name"),
                       .from = section.word("from"),
                       .to = section.word("to"),
                       .stiffness = section.quantity("stiffness", dim::stiffness, not_negative),
                       .damping = section.quantity_or("damping", 0, dim::stiffness * dim::time, not_negative),
                       .length = {},
                       .at = section.path()};
  if (section.has("rest_length")) spring.length = section.quantity("rest_length", dim::length, not_negative);
  return spring;
}

model::PointMass read_point_mass(const Section& section) {
  return {.name = section.word("name"),
          .nodes = section.word("nodes"),
          .mass = section.quantity("mass", dim::mass, positive),
          .at = section.path()};
}

model::Initial read_initial(const Section& section) {
  model::Initial initial{.body = section.word("body"), .displacement = section.has("displacement"), .value = {}, .at = section.path()};
  if (section.has("displacement") && section.has("velocity"))
    section.fault("velocity", "'velocity' and 'displacement' have units of their own: make two items of 'initial'");
  if (!section.has("displacement") && !section.has("velocity"))
    section.fault("velocity", "expected 'velocity' or 'displacement'" + inside(section.path()));
  const InUnit unit = read_unit(section, initial.displacement ? dim::length : dim::speed);
  if (initial.displacement) initial.value = read_expressions(section, "displacement", of_place, unit);
  else if (section.has("velocity")) initial.value = read_expressions(section, "velocity", of_place, unit);
  return initial;
}

/// The velocities of a plane that moves its nodes, or of nodes that are driven.
void read_motion(const Section& section, bool held, bool driven, model::Plane& plane) {
  if (!section.decided()) {  // of what shape these are, nobody knows
    section.has("velocity"), section.has("angular_velocity");
    return;
  }
  if (section.has("angular_velocity")) {
    const Section angular_velocity = section.when(driven).section("angular_velocity");
    const auto value = read_expressions(angular_velocity, "value", of_both, read_unit(angular_velocity, dim::angular_speed));
    if (driven) plane.angular_velocity = value;
  }
  if (driven) {
    const Section velocity = section.section("velocity");
    plane.field = read_expressions(velocity, "value", of_both, read_unit(velocity, dim::speed));
  } else if (section.has("velocity")) {
    const Section velocity = section.when(held).section("velocity");
    const InUnit unit = read_unit(velocity, dim::speed);
    const Expression value = read_expression(velocity, "value", of_time, unit);
    if (held) plane.velocity = [value](double t) { return value(0, 0, 0, t); };
  }
}

/// What a rigid plane has beside name, point and normal.
void read_wall(const Section& section, bool rigid, model::RigidPlane& plane) {
  plane.surface = section.when(rigid).word("surface");
  read_rigid_contact(section.when(rigid), plane);
}

load::PlaneKind plane_kind(const std::string& word) {
  using load::PlaneKind;
  return word == "symmetry" ? PlaneKind::symmetry
         : word == "fixed"  ? PlaneKind::fixed
         : word == "floor"  ? PlaneKind::floor
         : word == "driven" ? PlaneKind::driven
                            : PlaneKind::constrained;
}

/// A name is an account of the ledger, so it is given once.
void refuse_repeated(const Section& section, const std::string& name, std::map<std::string, std::string>& seen) {
  const auto [first, fresh] = seen.emplace(name, section.path());
  if (!fresh) section.fault("name", "the name " + quote(name) + " is given twice: " + quote(first->second) + " has it too");
}

}  // namespace

Dimension dimension_of(const std::string& unit) {
  return unit == "1" ? dim::none : std::get<Quantity>(parse_quantity("1 " + unit)).dimension;
}

InUnit read_unit(const Section& section, Dimension dimension) {
  const InUnit si{1, dimension};
  const std::string text = section.word("unit");
  if (text.empty()) return si;
  const auto parsed = parse_quantity("1 " + text);
  if (const auto* fault = std::get_if<TextFault>(&parsed)) {
    section.fault("unit", "cannot read 'unit' = " + text + ": " + fault->message);
    return si;
  }
  const auto& quantity = std::get<Quantity>(parsed);
  if (quantity.dimension != dimension) {
    section.fault("unit", "'unit' = " + text + " has the dimension [" + describe(quantity.dimension) + "]: expected [" +
                              describe(dimension) + "], for example '" + si_unit(dimension) + "'");
    return si;
  }
  return {quantity.value, dimension};
}

std::variant<model::Plane, model::RigidPlane> read_plane(const Section& section) {
  model::Plane plane{.name = section.word("name"), .at = section.path()};
  const std::string kind = section.choice("kind", {"symmetry", "constrained", "fixed", "floor", "rigid", "driven"});
  const bool rigid = kind == "rigid", floor = kind == "floor", driven = kind == "driven", no_normal = driven || kind == "fixed";
  plane.kind = plane_kind(kind);
  plane.nodes = section.when(!rigid).words("nodes");
  const auto point = section.when(floor || rigid).vector("point", dim::length);
  plane.normal = read_direction(section.when(!no_normal), "normal");
  if (floor || rigid) plane.point = Vec3(point.data());
  read_motion(section, kind == "constrained", driven, plane);
  model::RigidPlane wall{.name = plane.name, .surface = {}, .point = plane.point, .normal = plane.normal, .at = plane.at};
  read_wall(section, rigid, wall);
  if (rigid) return wall;
  return plane;
}

std::vector<model::Stage> read_stages(const Section& root) {
  std::vector<model::Stage> stages;
  for (const Section& section : root.list("stages")) {
    model::Stage stage{.name = section.word("name"), .duration = section.quantity("duration", dim::time, positive), .at = section.path()};
    stage.relaxation = read_relaxation(section);
    stage.off = section.words("off", 0);
    for (const Section& initial : section.list("initial")) stage.initial.push_back(read_initial(initial));
    stages.push_back(std::move(stage));
  }
  return stages;
}

std::optional<dynamics::Relaxation> read_relaxation(const Section& root) {
  if (!root.has("relaxation")) return std::nullopt;
  const Section section = root.section_or_empty("relaxation");
  dynamics::Relaxation relaxation;
  relaxation.residual = section.number_or("residual", relaxation.residual, model::range::residual);
  relaxation.after = section.quantity_or("after", relaxation.after, dim::time, not_negative);
  relaxation.samples = section.count_or("samples", relaxation.samples);
  return relaxation;
}

void read_actions(const Section& root, bool runs, model::Scene& scene) {
  const Section run = root.when(runs);
  const auto gravity = run.vector_or("gravity", {0, 0, 0}, dim::acceleration);
  std::map<std::string, std::string> seen;
  for (const Section& section : root.list("planes")) {
    const auto plane = read_plane(section);
    std::visit([&](const auto& one) { refuse_repeated(section, one.name, seen); }, plane);
    if (const auto* wall = std::get_if<model::RigidPlane>(&plane)) scene.rigid_planes.push_back(*wall);
    else scene.planes.push_back(std::get<model::Plane>(plane));
  }
  for (const Section& section : run.list("loads")) {
    scene.loads.push_back(read_load(section));
    refuse_repeated(section, scene.loads.back().name, seen);
  }
  for (const Section& section : root.list("springs")) {
    scene.springs.push_back(read_spring(section));
    refuse_repeated(section, scene.springs.back().name, seen);
  }
  for (const Section& section : root.list("point_masses")) {
    scene.point_masses.push_back(read_point_mass(section));
    refuse_repeated(section, scene.point_masses.back().name, seen);
  }
  for (const Section& section : run.list("initial")) scene.initial.push_back(read_initial(section));
  scene.relaxation = read_relaxation(run);
  scene.gravity = Vec3(gravity.data());
  if (!runs) scene.gravity.setZero(), scene.loads.clear(), scene.initial.clear(), scene.relaxation.reset();
}

}  // namespace nereid::input
