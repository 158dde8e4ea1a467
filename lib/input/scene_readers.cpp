#include "input/scene_readers.hpp"

#include <algorithm>
#include <cctype>

namespace nereid::input {

namespace {

const std::vector<std::string> axes{"x", "y", "z"};
const std::vector<std::string> of_vectors{"magnitude", "x", "y", "z"};

/// Names given so far, of one kind of things or of several that must differ.
using Names = std::vector<std::string>;

bool has(const Names& names, const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); }

constexpr const char* sources = "bodies, contacts, planes, loads and springs";

/// Points are kept for what belongs to a body, as in `bar.x_low`.
bool is_plain(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return std::all_of(name.begin(), name.end(), plain) && std::isdigit(static_cast<unsigned char>(name[0])) == 0;
}

/// Refuses a name that is none, or taken.
void check_name(const Section& section, const std::string& name, const Names& taken, const std::string& whose) {
  if (name.empty()) return;  // that has been said
  if (!is_plain(name))
    section.fault("name", "'name' = " + name + " is no name: expected letters, digits and '_', a letter first");
  else if (has(taken, name))
    section.fault("name", "'name' = " + name + " is given twice: names of " + whose + " differ");
}

std::string read_name(const Section& section, Names& taken, const std::string& whose) {
  const std::string name = section.word("name");
  check_name(section, name, taken, whose);
  taken.push_back(name);
  return name;
}

/// A unit vector of a direction of any length but zero.
Vec3 read_direction(const Section& section, std::string_view key) {
  const Vec3 v = read_vector(section, key, dim::none);
  if (v.norm() > 0) return v.normalized();
  if (v.norm() == 0) section.fault(key, "'" + std::string(key) + "' has no direction: its length is zero");
  return Vec3::UnitZ();
}

Placement read_placement(const Section& body) {
  Placement place;
  const Section turn = body.when(body.has("turn")).section("turn");
  place.axis = read_direction(turn, "axis");
  place.angle = turn.quantity("angle", dim::angle);
  const auto zero = std::array<double, 3>{0, 0, 0};
  const auto about = turn.vector_or("about", zero, dim::length), move = body.vector_or("move", zero, dim::length);
  place.about = Vec3(about.data());
  place.move = Vec3(move.data());
  if (!body.has("turn")) place.angle = 0;
  return place;
}

template <class... Kinds>
bool is_one_of(const MeshOptions& mesh) {
  return (std::holds_alternative<Kinds>(mesh) || ...);
}

BodyOptions read_body(const Section& section, Names& taken) {
  const Section mesh = section.section("mesh");
  BodyOptions body{.at = section,
                   .name = read_name(section, taken, sources),
                   .mesh = read_mesh_options(mesh),
                   .map = read_map(mesh),
                   .place = read_placement(section),
                   .points = {},
                   .law = read_law(section.section("material")),
                   .solids = true,
                   .plates = false,
                   .solid = {},
                   .plate = {}};
  body.plates = is_one_of<mesh::Tube, mesh::WedgeTube, mesh::Disc, mesh::WedgeDisc, mesh::Sheet>(body.mesh);
  body.solids = !body.plates;
  if (const auto* file = std::get_if<mesh::Mesh>(&body.mesh)) {
    body.solids = !file->hexahedra.empty();
    body.plates = !file->triangles.empty();
  }
  const Section element = section.section_or_empty("element");
  body.solid = read_hexahedron_options(element.when(body.solids));
  body.plate = read_plate_options(element.when(body.plates));
  Names points;
  for (const Section& point : section.list("points"))
    body.points.push_back({.at = point, .name = read_name(point, points, "points of a body"), .near = read_vector(point, "near", dim::length)});
  return body;
}

ContactOptions read_contact(const Section& section, Names& taken) {
  ContactOptions contact{.at = section,
                         .name = read_name(section, taken, sources),
                         .apexes = section.word("apexes"),
                         .base = section.word("base"),
                         .height_from_thickness = false,
                         .interface = read_solid_interface(section)};
  contact.height_from_thickness = read_contact_height(section, HeightFrom::thickness, contact.interface) == HeightFrom::thickness;
  if (contact.interface.two_passes) taken.push_back(contact.name + "_back");
  return contact;
}

RigidOptions read_rigid(const PlaneRequest& plane) {
  const Section& section = plane.section;
  const Section if_rigid = section.when(plane.rigid);
  const bool given = section.has("penalty");
  const dynamics::InterfaceOptions usual;
  RigidOptions rigid{.at = section,
                     .name = plane.name,
                     .surface = if_rigid.word("surface"),
                     .point = plane.point,
                     .normal = plane.normal,
                     .penalty = std::nullopt,
                     .hardness = if_rigid.when(!given).number_or("hardness", usual.hardness, positive),
                     .friction = read_friction(if_rigid),
                     .created_in_a_bounce = if_rigid.number_or("created_in_a_bounce", usual.created_in_a_bounce, within(1e-5, 0.04))};
  const double penalty = if_rigid.when(given).quantity("penalty", dim::penalty, positive);
  if (given) rigid.penalty = penalty;
  return rigid;
}

/// Names of the internal variables of all laws, each once.
template <class... Laws>
Names internal_variables(const std::variant<Laws...>*) {
  Names names;
  const auto add = [&names](const auto& internal) {
    for (const auto& name : internal)
      if (!has(names, std::string(name))) names.emplace_back(name);
  };
  (add(Laws::internal), ...);
  return names;
}

ProbeOptions read_probe(const Section& section, Names& taken) {
  ProbeOptions probe{.at = section, .name = read_name(section, taken, "probes"), .quantity = {}, .of = section.word("of")};
  if (probe.name == "time" || probe.name.rfind("energy_", 0) == 0)
    section.fault("name", "'name' = " + probe.name + " is a column of every history: choose another");
  Names words;
  for (const Measurable& one : measurables()) words.push_back(one.name);
  const std::string word = section.choice("quantity", words);
  probe.quantity = *std::find_if(measurables().begin(), measurables().end(), [&](const Measurable& one) { return one.name == word; });
  const auto& components = probe.quantity.components;
  if (!components.empty()) {
    const Section chosen = section.when(true);
    const std::string component = probe.quantity.required ? chosen.choice("component", components)
                                                          : chosen.choice_or("component", components.front(), components);
    probe.component = static_cast<int>(std::find(components.begin(), components.end(), component) - components.begin());
  }
  if (probe.quantity.of == Of::body)
    probe.largest = section.when(true).choice_or("take", "mean", {"mean", "largest"}) == "largest";
  return probe;
}

StopOptions read_stop(const Section& section, const std::vector<ProbeOptions>& probes) {
  StopOptions stop{.probe = section.word("probe"), .above = section.has("above"), .value = 0, .after = 0};
  stop.after = section.quantity_or("after", 0, dim::time, not_negative);
  const char* key = stop.above ? "above" : "below";
  const auto probe = std::find_if(probes.begin(), probes.end(), [&](const auto& one) { return one.name == stop.probe; });
  if (probe == probes.end()) {
    Names names;
    for (const ProbeOptions& one : probes) names.push_back(one.name);
    section.unknown_name("probe", stop.probe, "probes", names);
    section.has("below");
    return stop;
  }
  if (stop.above && section.has("below"))
    section.fault("below", "'above' and 'below' are two conditions: write them one by one");
  else if (!stop.above && !section.has("below"))
    section.fault("above", "a condition needs 'above' or 'below'");
  else
    stop.value = section.quantity(key, probe->quantity.dimension);
  return stop;
}

/// runs  whether time passes
SceneOptions read_scene(const Section& root, bool runs) {
  const Section run = root.when(runs);
  SceneOptions scene{.bodies = {}, .contacts = {}, .rigid_planes = {}, .actions = {}, .probes = {}, .stops = {},
                     .time = read_time(run.section("time")), .recording = {}};
  Names taken{"gravity", "relaxation"}, probes;
  for (const Section& body : root.list("bodies", 1)) scene.bodies.push_back(read_body(body, taken));
  for (const Section& contact : root.list("contacts")) scene.contacts.push_back(read_contact(contact, taken));
  scene.actions = read_actions(root, runs);
  for (const PlaneRequest& plane : scene.actions.planes) {
    check_name(plane.section, plane.name, taken, sources);
    RigidOptions rigid = read_rigid(plane);
    if (plane.rigid) scene.rigid_planes.push_back(std::move(rigid));
  }
  for (const LoadRequest& load : scene.actions.loads) check_name(load.section, load.name, taken, sources);
  for (const SpringRequest& spring : scene.actions.springs) check_name(spring.section, spring.name, taken, sources);
  for (const PointMassRequest& mass : scene.actions.point_masses) check_name(mass.section, mass.name, taken, sources);
  for (const Section& probe : run.list("probes")) scene.probes.push_back(read_probe(probe, probes));
  for (const Section& stop : run.list("stop")) scene.stops.push_back(read_stop(stop, scene.probes));
  scene.recording = read_recording(run.section_or_empty("output"), scene.time.end);
  return scene;
}

}  // namespace

const std::vector<Measurable>& measurables() {
  static const std::vector<Measurable> all = [] {
    std::vector<Measurable> list{
        {"displacement", dim::length, Of::nodes, of_vectors},
        {"velocity", dim::speed, Of::nodes, of_vectors},
        {"position", dim::length, Of::nodes, axes, true},
        {"extent", dim::length, Of::nodes, axes, true},
        {"radius", dim::length, Of::nodes, axes, true},
        {"momentum", dim::momentum, Of::nodes, of_vectors},
        {"kinetic_energy", dim::energy, Of::nodes, {}},
        {"force", dim::force, Of::source, {"magnitude", "x", "y", "z", "normal"}},
        {"gap", dim::length, Of::contact, {}},
        {"contact_pressure", dim::stress, Of::contact, {}},
        {"contact_area", dim::area, Of::contact, {}},
        {"stress", dim::stress, Of::body, {"xx", "yy", "zz", "xy", "yz", "xz"}, true},
        {"pressure", dim::stress, Of::body, {}},
        {"von_mises", dim::stress, Of::body, {}},
    };
    for (const std::string& name : internal_variables(static_cast<const element::AnyLaw*>(nullptr)))
      list.push_back({name, dim::none, Of::body, {}});
    return list;
  }();
  return all;
}

SceneOptions read_scene(const Section& root) { return read_scene(root, true); }

SceneOptions read_scene_at_rest(const Section& root) {
  SceneOptions scene = read_scene(root, false);
  scene.probes.clear(), scene.stops.clear();
  if (!scene.contacts.empty())
    root.fault("contacts", "'contacts' open and close, which no small motion about rest keeps: take them out");
  for (const PlaneRequest& plane : scene.actions.planes)
    if (plane.rigid || plane.kind == load::PlaneKind::floor)
      plane.section.fault("kind", "a floor or rigid plane lets go, which no small motion about rest keeps: take it out, or say 'held'");
  return scene;
}

}  // namespace nereid::input
