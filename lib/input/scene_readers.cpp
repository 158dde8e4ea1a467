#include "input/scene_readers.hpp"

#include <algorithm>

#include "base/words.hpp"
#include "input/expression.hpp"
#include "input/load_readers.hpp"
#include "input/mesh_readers.hpp"
#include "input/readers.hpp"
#include "model/meshes.hpp"
#include "model/names.hpp"
#include "model/probes.hpp"
#include "model/values.hpp"

namespace nereid::input {

namespace {

/// Names given so far, of one kind of things or of several that must differ.
using Names = std::vector<std::string>;

constexpr const char* sources = "bodies, contacts, planes, loads, springs and sections";

/// Refuses a name that is none, or taken.
void check_name(const Section& section, const std::string& name, const Names& taken, const std::string& whose) {
  if (name.empty()) return;  // that has been said
  if (!model::is_name(name))
    section.fault("name", model::is_no_name(name));
  else if (model::has(taken, name))
    section.fault("name", "'name' = " + name + " is given twice: names of " + whose + " differ");
}

std::string read_name(const Section& section, Names& taken, const std::string& whose) {
  const std::string name = section.word("name");
  check_name(section, name, taken, whose);
  taken.push_back(name);
  return name;
}

model::Placement read_placement(const Section& body) {
  model::Placement place;
  const Section rotate = body.when(body.has("rotate")).section("rotate");
  place.axis = read_direction(rotate, "axis");
  place.angle = rotate.quantity("angle", dim::angle);
  const auto zero = std::array<double, 3>{0, 0, 0};
  const auto about = rotate.vector_or("about", zero, dim::length), move = body.vector_or("move", zero, dim::length);
  place.about = Vec3(about.data());
  place.move = Vec3(move.data());
  if (!body.has("rotate")) place.angle = 0;
  return place;
}

/// `mass`, `centre` and `inertia` of a rigid body, all optional; the latter [xx, yy, zz, xy, yz, xz].
model::GivenMass read_given_mass(const Section& section) {
  model::GivenMass given;
  if (section.has("mass")) given.mass = section.quantity("mass", dim::mass, positive);
  if (section.has("centre")) given.centre = read_vector(section, "centre", dim::length);
  if (!section.has("inertia")) return given;
  const std::vector<double> J = section.quantities("inertia", dim::mass * dim::length * dim::length, any, 6);
  if (J.size() != 6) {
    section.fault("inertia", "'inertia' has six values: xx, yy, zz, xy, yz, xz");
    return given;
  }
  Mat3 inertia;
  inertia << J[0], J[3], J[5], J[3], J[1], J[4], J[5], J[4], J[2];
  given.inertia = inertia;
  return given;
}

/// A round shape: `centre` [m], and of all but spheres `axis` and `length`.
model::GivenShape read_given_shape(const Section& section) {
  const std::string kind = section.choice("kind", {"sphere", "cylinder", "ring", "tube"});
  const bool is_sphere = kind == "sphere";
  model::GivenShape given;
  given.shape.kind = is_sphere            ? geometry::RoundKind::sphere
                     : kind == "cylinder" ? geometry::RoundKind::cylinder
                     : kind == "ring"     ? geometry::RoundKind::ring
                                          : geometry::RoundKind::tube;
  given.shape.radius = section.quantity("radius", dim::length, positive);
  const double inner = section.when(kind == "ring").quantity("inner_radius", dim::length, positive);
  const double length = section.when(!is_sphere).quantity("length", dim::length, positive);
  if (kind == "ring") given.shape.inner = inner;
  if (!is_sphere) given.shape.half_length = length / 2;
  const auto centre = section.vector_or("centre", std::array<double, 3>{0, 0, 0}, dim::length);
  given.centre = Vec3(centre.data());
  if (!is_sphere) given.axis = read_direction(section, "axis");
  return given;
}

/// `start: {pressure, hydrostatic}` of a fluid; the pressure is optional but for a gas.
void read_fluid_start(const Section& body, model::Body& fluid) {
  auto* gas = std::get_if<material::IdealGas>(&fluid.law);
  const Section start = gas != nullptr ? body.section("start") : body.section_or_empty("start");
  fluid.start.pressure = gas != nullptr ? start.quantity("pressure", dim::stress, positive) : start.quantity_or("pressure", 0, dim::stress);
  fluid.start.hydrostatic = start.flag_or("hydrostatic", false);
  if (gas != nullptr) gas->pressure = fluid.start.pressure;
}

/// A zone of one of the kinds, whichever key the set has; none for a set of sets.
std::optional<model::Zone> read_zone(const Section& set) {
  using Kind = model::Zone::Kind;
  std::optional<model::Zone> zone;
  const auto place = [](const Section& section, std::string_view key) { return read_vector(section, key, dim::length); };
  if (set.has("box")) {
    const Section box = set.section("box");
    zone = {.kind = Kind::box, .from = place(box, "low"), .to = place(box, "high")};
    if (box.sound() && !((zone->to - zone->from).array() >= 0).all()) box.fault_between({"low", "high"}, "'high' must not be below 'low'");
  }
  if (set.has("cylinder")) {
    const Section cylinder = set.section("cylinder");
    zone = {.kind = Kind::cylinder, .from = place(cylinder, "from"), .to = place(cylinder, "to")};
    zone->radius = cylinder.quantity("radius", dim::length, positive);
    if (cylinder.sound() && zone->from == zone->to)
      cylinder.fault_between({"from", "to"}, "'from' and 'to' are one place: the axis has no direction");
  }
  if (set.has("sphere")) {
    const Section sphere = set.section("sphere");
    zone = {.kind = Kind::sphere, .from = place(sphere, "centre")};
    zone->radius = sphere.quantity("radius", dim::length, positive);
  }
  for (const auto& [key, kind] : {std::pair("plane", Kind::plane), std::pair("half_space", Kind::half_space)}) {
    if (!set.has(key)) continue;
    const Section plane = set.section(key);
    zone = {.kind = kind, .from = place(plane, "point")};
    zone->normal = read_direction(plane, "normal");
  }
  return zone;
}

model::Set read_set(const Section& section, Names& taken) {
  static const Names kinds{"box", "cylinder", "sphere", "plane", "half_space", "any_of", "all_of"};
  model::Set set{.name = read_name(section, taken, "points and sets of a body"), .zone = read_zone(section), .at = section.path()};
  if (section.has("any_of")) set.any_of = section.words("any_of");
  if (section.has("all_of")) set.all_of = section.words("all_of");
  if (section.has("without")) set.without = section.words("without");
  Names given;
  for (const std::string& kind : kinds)
    if (section.has(kind)) given.push_back(kind);
  if (given.empty()) section.fault("name", "a set needs one of " + joined(kinds));
  if (given.size() > 1)
    section.fault(given[1], quote(given[0]) + " and " + quote(given[1]) + ": a set has one of them; join sets by 'any_of' or 'all_of'");
  return set;
}

/// `materials: [{of: REGION OR SET, material: {...}}]` of parts of a body.
std::vector<model::PartMaterial> read_parts(const Section& section, const model::Body& body) {
  std::vector<model::PartMaterial> parts;
  for (const Section& part : section.list("materials")) {
    const Section material = part.section("material");
    const bool only_plates = model::has_plates(body.mesh) && !model::has_solids(body.mesh);
    parts.push_back({.of = part.word("of"), .law = only_plates ? read_plate_law(material) : read_law(material), .at = part.path()});
  }
  return parts;
}

model::Body read_body(const Section& section, Names& taken) {
  const Section mesh = section.section("mesh");
  mesh::Origin origin;
  model::Body body{.name = read_name(section, taken, sources),
                   .mesh = read_mesh_options(mesh, &origin),
                   .scale = read_scale(mesh),
                   .map = read_map(mesh),
                   .place = read_placement(section),
                   .points = {},
                   .sets = {},
                   .law = {},
                   .parts = {},
                   .solid = {},
                   .plate = {},
                   .rigid = section.flag_or("rigid", false),
                   .surface = {},
                   .shape = {},
                   .given = {},
                   .start = {},
                   .origin = {},
                   .at = section.path()};
  body.origin = std::move(origin);
  if (section.has("mass_properties")) {
    const model::GivenMass given = read_given_mass(section.when(body.rigid).section("mass_properties"));
    if (body.rigid) body.given = given;
  }
  if (section.has("surface")) {
    const std::string word = section.when(body.rigid).choice("surface", {"exact", "facets"});
    body.surface = word == "exact" ? model::TouchesAs::exact : model::TouchesAs::facets;
  }
  if (section.has("shape")) {
    const model::GivenShape given = read_given_shape(section.when(body.rigid).section("shape"));
    if (body.rigid) body.shape = given;
  }
  const Section material = section.section("material");
  body.law = model::has_plates(body.mesh) ? read_plate_law(material) : read_solid_or_fluid_law(material);
  const Section element = section.section_or_empty("element");
  const bool is_fluid = material::is_fluid(body.law);
  if (is_fluid) body.solid = read_fluid_options(element);
  else body.solid = read_hexahedron_options(element.when(model::has_solids(body.mesh)));
  if (is_fluid || section.has("start")) read_fluid_start(section.when(is_fluid), body);
  body.plate = read_plate_options(element.when(model::has_plates(body.mesh)));
  Names points;
  constexpr const char* of_a_body = "points and sets of a body";
  for (const Section& point : section.list("points"))
    body.points.push_back(
        {.name = read_name(point, points, of_a_body), .near = read_vector(point, "near", dim::length), .at = point.path()});
  for (const Section& set : section.list("sets")) body.sets.push_back(read_set(set, points));
  body.parts = read_parts(section, body);
  return body;
}

model::AutomaticContact read_automatic_contact(const Section& section, Names& taken) {
  model::AutomaticContact contact{.name = read_name(section, taken, sources),
                                  .bodies = section.has("bodies") ? section.words("bodies") : Names{},
                                  .self_contact = section.flag_or("self_contact", true),
                                  .interface = read_automatic_interface(section),
                                  .at = section.path()};
  if (contact.interface.edges) taken.push_back(contact.name + "_edges");
  return contact;
}

model::Contact read_contact(const Section& section, bool tied, Names& taken) {
  model::Contact contact{.name = read_name(section, taken, sources),
                         .apexes = section.word("apexes"),
                         .base = section.word("base"),
                         .height_from_thickness = false,
                         .interface = read_solid_interface(section, tied),
                         .at = section.path()};
  contact.height_from_thickness = read_contact_height(section, HeightFrom::thickness, contact.interface) == HeightFrom::thickness;
  if (contact.interface.two_passes) taken.push_back(contact.name + "_back");
  if (contact.interface.edges) taken.push_back(contact.name + "_edges");
  return contact;
}

/// `value`, a formula of the probes above it, and its `unit`, an SI unit (1).
model::Formula read_probe_formula(const Section& section, const Names& above) {
  const FormulaText text = read_formula(section, "value", above);
  model::Formula formula{.inputs = text.inputs, .value = text.value, .unit = section.word_or("unit", "1")};
  const auto parsed = parse_quantity("1 " + formula.unit);
  const bool plain = formula.unit == "1", is_unit = std::holds_alternative<Quantity>(parsed);
  if (!plain && !is_unit) section.fault("unit", "'unit' = " + formula.unit + ": " + std::get<TextFault>(parsed).message);
  else if (!plain && std::get<Quantity>(parsed).value != 1)
    section.fault("unit", "'unit' = " + formula.unit + " is no SI unit: probes are in SI, so expected " +
                              quote(si_unit(std::get<Quantity>(parsed).dimension)));
  return formula;
}

model::Probe read_probe(const Section& section, Names& taken) {
  const Names above = taken;
  model::Probe probe{.name = read_name(section, taken, "probes"), .quantity = {}, .of = {}, .at = section.path()};
  if (model::is_column_of_every_history(probe.name))
    section.fault("name", "'name' = " + probe.name + " is a column of every history: choose another");
  if (section.has("value")) {
    probe.formula = read_probe_formula(section, above);
    for (const char* key : {"quantity", "of"})
      if (section.has(key))
        section.fault(key, quote(key) + " and 'value': a probe measures something, or is computed from the probes above it");
    return probe;
  }
  probe.of = section.word("of");
  Names words;
  for (const model::Measurable& one : model::measurables()) words.push_back(one.name);
  const std::string word = section.choice("quantity", words);
  if (!section.decided()) {  // of which quantity these are, nobody knows
    for (const char* key : {"component", "take", "place", "near", "along", "between"}) section.has(key);
    return probe;
  }
  probe.quantity = word;
  const model::Measurable& quantity = *model::find_measurable(probe.quantity);
  const bool is_tensor = model::is_tensor(quantity), is_pair = quantity.of == model::Of::source && section.has("between");
  if (is_tensor && section.has("along")) {
    probe.along = read_direction(section, "along");
    if (section.has("component")) section.fault("component", "'component' and 'along' are two directions: give one of them");
  } else if (!quantity.components.empty())
    probe.component = quantity.required ? section.choice("component", quantity.components)
                                        : section.choice_or("component", quantity.components.front(), quantity.components);
  if (quantity.of == model::Of::body) {
    probe.largest = section.choice_or("take", "mean", {"mean", "largest"}) == "largest";
    if (section.has("near")) probe.near = read_vector(section, "near", dim::length);
    if (probe.near && section.has("take")) section.fault("take", "'near' takes one element: leave 'take' out");
    if (section.has("place")) probe.place = section.choice("place", {element::words_of_places.begin(), element::words_of_places.end()});
  }
  if (is_pair) {
    const Names bodies = section.words("between", 2);
    if (bodies.size() == 2) probe.between = {bodies[0], bodies[1]};
    else section.fault("between", "'between' has two bodies, as in [ball, plate]");
  }
  return probe;
}

/// The one condition of the section; empty after a fault.
std::string condition_of(const Section& section) {
  static const Names conditions{"above", "below", "peaked", "dipped", "steady", "rest"};
  std::string found;
  for (const std::string& key : conditions) {
    if (!section.has(key)) continue;
    if (!found.empty()) {
      section.fault(key, quote(found) + " and " + quote(key) + " are two conditions: write them one by one");
      return "";
    }
    found = key;
  }
  if (found.empty()) section.fault("above", "a condition needs one of " + joined(conditions));
  return found;
}

model::Stop read_rest(const Section& section) {
  const Section rest = section.section("rest");
  return {.kind = model::StopKind::rest,
          .part = rest.number("part", model::range::rest_part),
          .span = rest.quantity("for", dim::time, positive),
          .of_scene = rest.choice_or("of", "largest", {"largest", "scene"}) == "scene",
          .at = section.path()};
}

model::Stop read_peak(const Section& section, const std::string& key) {
  const Section peak = section.section(key);
  if (!peak.has("fallen") && !peak.has("for")) section.fault(key, quote(key) + " needs 'fallen', 'for' or both");
  return {.above = key == "peaked",
          .kind = model::StopKind::peak,
          .part = peak.has("fallen") ? peak.number("fallen", model::range::fallen) : 0,
          .span = peak.has("for") ? peak.quantity("for", dim::time, positive) : 0};
}

model::Stop read_steady(const Section& section, Dimension dimension, double row) {
  const Section steady = section.section("steady");
  const model::Stop stop{.value = steady.quantity("within", dimension, positive),
                         .kind = model::StopKind::steady,
                         .span = steady.quantity("window", dim::time, positive)};
  if (stop.span < 2 * row) steady.fault("window", model::window_too_short(stop.span, row));
  return stop;
}

model::Stop read_stop(const Section& section, const std::vector<Measured>& probes, double row) {
  const std::string condition = condition_of(section);
  const double after = section.quantity_or("after", 0, dim::time, not_negative);
  model::Stop stop;
  if (condition == "rest") {
    stop = read_rest(section);
    stop.after = after;
    return stop;
  }
  const std::string name = section.word("probe");
  const auto probe = std::find_if(probes.begin(), probes.end(), [&](const auto& one) { return one.name == name; });
  if (probe == probes.end()) {
    Names names;
    for (const Measured& one : probes) names.push_back(one.name);
    section.unknown_name("probe", name, "probes", names);
  }
  const bool known = section.surveyed() || (probe != probes.end() && !probe->unit.empty());  // else the probe is at fault, or its name
  const Dimension dimension = section.surveyed() ? dim::length : known ? dimension_of(probe->unit) : dim::none;
  if (condition == "peaked" || condition == "dipped") stop = read_peak(section, condition);
  if (condition == "steady" && known) stop = read_steady(section, dimension, row);
  if (condition == "above" || condition == "below") stop.above = condition == "above";
  if ((condition == "above" || condition == "below") && known) stop.value = section.quantity(condition, dimension);
  stop.probe = name, stop.after = after, stop.at = section.path();
  return stop;
}

model::Section read_section(const Section& section, Names& taken) {
  model::Section cut{.name = read_name(section, taken, sources), .body = section.word("body"), .at = section.path()};
  const auto point = section.vector("point", dim::length);
  cut.point = Vec3(point.data()), cut.normal = read_direction(section, "normal");
  if (section.has("radius")) cut.radius = section.quantity("radius", dim::length, positive);
  return cut;
}

/// runs  whether time passes
model::Scene read_scene(const Section& root, bool runs) {
  const Section run = root.when(runs);
  model::Scene scene;
  const bool has_stages = run.has("stages");
  scene.time = has_stages ? read_time(run.section_or_empty("time"), false) : read_time(run.section("time"));
  Names taken{"gravity", "relaxation"}, probes;
  for (const Section& body : root.list("bodies", 1)) scene.bodies.push_back(read_body(body, taken));
  for (const Section& contact : root.list("contacts")) {
    const std::string kind = contact.choice_or("kind", "contact", {"contact", "tied", "automatic"});
    if (!contact.decided()) {  // which keys it has, nobody knows
      for (const std::string& key : contact.keys()) contact.has(key);
      continue;
    }
    if (kind == "automatic") scene.automatic_contacts.push_back(read_automatic_contact(contact, taken));
    else scene.contacts.push_back(read_contact(contact, kind == "tied", taken));
  }
  read_actions(root, runs, scene);
  scene.stages = read_stages(run);
  if (has_stages && scene.stages.empty() && run.sound()) run.fault("stages", "'stages' has none: leave it out, or give one");
  for (const model::Stage& stage : scene.stages) scene.time.end += stage.duration;
  const auto check_names = [&taken](const std::vector<Section>& sections) {
    for (const Section& section : sections) check_name(section, section.word("name"), taken, sources);
  };
  check_names(root.list("planes")), check_names(run.list("loads"));
  check_names(root.list("springs")), check_names(root.list("point_masses"));
  for (const Section& section : run.list("sections")) scene.sections.push_back(read_section(section, taken));
  for (const Section& probe : run.list("probes")) scene.probes.push_back(read_probe(probe, probes));
  scene.recording = read_recording(run.section_or_empty("output"), scene.time.end);
  scene.stops = read_stops(run, measured_by(scene.probes), scene.recording);
  return scene;
}

}  // namespace

std::vector<Measured> measured_by(const std::vector<model::Probe>& probes) {
  std::vector<Measured> measured;
  for (const model::Probe& probe : probes) {
    const model::Measurable* quantity = model::find_measurable(probe.quantity);
    const std::string unit = probe.formula.value ? probe.formula.unit : quantity == nullptr ? "" : quantity->unit;
    measured.push_back({probe.name, unit});
  }
  return measured;
}

std::vector<model::Stop> read_stops(const Section& root, const std::vector<Measured>& probes, const model::Recording& recording) {
  std::vector<model::Stop> stops;
  for (const Section& stop : root.list("stop")) stops.push_back(read_stop(stop, probes, recording.history));
  return stops;
}

model::Scene read_scene(const Section& root) { return read_scene(root, true); }

model::Scene read_scene_at_rest(const Section& root) {
  model::Scene scene = read_scene(root, false);
  scene.probes.clear(), scene.stops.clear(), scene.stages.clear(), scene.sections.clear();
  scene.time = {.end = 1}, scene.recording = {};  // [s] none passes
  for (const Section& body : root.list("bodies", 1))
    if (body.flag_or("rigid", false)) body.fault("rigid", "a rigid body has no modes of its own: take it out, or hold what it touches");
  if (!scene.contacts.empty() || !scene.automatic_contacts.empty())
    root.fault("contacts", "'contacts' open and close, which no small motion about rest keeps: take them out");
  for (const Section& plane : root.list("planes")) {
    const std::string kind = plane.choice("kind", {"symmetry", "constrained", "fixed", "floor", "rigid", "driven"});
    if (kind == "rigid" || kind == "floor")
      plane.fault("kind", "modes cannot include the release of nodes from a floor or rigid plane: take it out, or say 'constrained'");
  }
  return scene;
}

model::Simulation build(const CaseFile& file, const model::Scene& scene) {
  file.finish();
  try {
    return model::build(scene);
  } catch (const model::SceneError& error) {
    for (const model::Fault& fault : error.faults)
      for (const mesh::Offenders& one : fault.offenders) file.show(one);
    for (const model::Fault& fault : error.faults)
      file.fault(fault.at.empty() || fault.key.empty() ? fault.at + fault.key : fault.at + "." + fault.key, fault.message, fault.hint);
    file.finish();
    throw;  // a fault without a place in the case
  }
}

}  // namespace nereid::input
