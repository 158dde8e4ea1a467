#include "input/load_readers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "dynamics/displace.hpp"
#include "input/words.hpp"

namespace nereid::input {

namespace {

std::string in_quotes(const std::string& text) { return "'" + text + "'"; }

/// A moment is a force times an arm: an angle has no part in its unit.
constexpr Dimension moment_unit = dim::force * dim::length;

load::OverTime over_time(const Expression& value) {
  return [value](double t) { return value(0, 0, 0, t); };
}

/// A value at the start, where a text can still be blamed for it.
void refuse_infinite(const Section& section, std::string_view key, double value, const std::string& where) {
  if (std::isfinite(value)) return;
  const char* what = std::isnan(value) ? "is no number" : "is infinite";
  section.fault(key, "'" + std::string(key) + "' " + what + " at " + where);
}

std::string at_place(const Vec3& X) {
  std::array<char, 100> text{};
  std::snprintf(text.data(), text.size(), "x = %.6g, y = %.6g, z = %.6g", X.x(), X.y(), X.z());
  return text.data();
}

LoadRequest read_load(const Section& section) {
  using Kind = LoadRequest::Kind;
  LoadRequest load{.section = section, .name = section.word("name"), .kind = Kind::pressure, .on = {}, .value = {}};
  const std::string kind = section.choice("kind", {"pressure", "force", "moment", "body_force"});
  const bool pressure = kind == "pressure", force = kind == "force", moment = kind == "moment", body = kind == "body_force";
  load.kind = pressure ? Kind::pressure : force ? Kind::force : moment ? Kind::moment : Kind::body_force;
  const std::string surface = section.when(pressure).word("surface");
  const std::string nodes = section.when(force || moment).word("nodes");
  const std::string of = section.when(body).word("body");
  load.on = pressure ? surface : body ? of : nodes;
  if (!section.has("kind")) return load;  // of what shape the value is, nobody knows
  const double unit = read_unit(section, pressure ? dim::stress : force ? dim::force : moment ? moment_unit : dim::acceleration);
  const Expression none = [](double, double, double, double) { return 0.0; };
  load.value = pressure ? std::array<Expression, 3>{read_expression(section, "value", of_time, unit), none, none}
                        : read_expressions(section, "value", body ? of_both : of_time, unit);
  if (!body)
    for (const Expression& value : load.value) refuse_infinite(section, "value", value(0, 0, 0, 0), "t = 0");
  return load;
}

SpringRequest read_spring(const Section& section) {
  SpringRequest spring{.section = section, .name = section.word("name"), .from = section.word("from"), .to = section.word("to"),
                       .stiffness = section.quantity("stiffness", dim::stiffness, not_negative),
                       .damping = section.quantity_or("damping", 0, dim::stiffness * dim::time, not_negative), .length = {}};
  if (section.has("rest_length")) spring.length = section.quantity("rest_length", dim::length, not_negative);
  return spring;
}

PointMassRequest read_point_mass(const Section& section) {
  return {.section = section, .name = section.word("name"), .nodes = section.word("nodes"),
          .mass = section.quantity("mass", dim::mass, positive)};
}

InitialRequest read_initial(const Section& section) {
  InitialRequest initial{.section = section, .body = section.word("body"), .displacement = section.has("displacement"), .value = {}};
  if (section.has("displacement") && section.has("velocity"))
    section.fault("velocity", "'velocity' and 'displacement' have units of their own: make two items of 'initial'");
  if (!section.has("displacement") && !section.has("velocity"))
    section.fault("velocity", "expected 'velocity' or 'displacement'" + (section.path().empty() ? "" : " in " + in_quotes(section.path())));
  const double unit = read_unit(section, initial.displacement ? dim::length : dim::speed);
  if (initial.displacement) initial.value = read_expressions(section, "displacement", of_place, unit);
  else if (section.has("velocity")) initial.value = read_expressions(section, "velocity", of_place, unit);
  return initial;
}

/// A name is an account of the ledger, so it is given once.
void refuse_repeated(const Section& section, const std::string& name, std::map<std::string, std::string>& seen) {
  const auto [first, fresh] = seen.emplace(name, section.path());
  if (!fresh) section.fault("name", "the name " + in_quotes(name) + " is given twice: " + in_quotes(first->second) + " has it too");
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

/// Faults a name that is not among those of the mesh.
void refuse_unknown(const Section& section, std::string_view key, const std::string& name, const char* kind,
                    const std::vector<std::string>& known) {
  std::string list;
  constexpr std::size_t most = 40;  // names one still reads
  for (std::size_t i = 0; i < std::min(known.size(), most); ++i) list += (i == 0 ? "" : ", ") + known[i];
  if (known.size() > most) list += ", and " + std::to_string(known.size() - most) + " more";
  section.fault(key, in_quotes(name) + " is no " + kind + " of this scene: there are " + (known.empty() ? "none" : list), nearest(name, known));
}

template <class Named>
const Named* find(const std::vector<Named>& all, const Section& section, std::string_view key, const std::string& name, const char* kind) {
  for (const Named& one : all)
    if (one.name == name) return &one;
  refuse_unknown(section, key, name, kind, names_of(all));
  return nullptr;
}

/// The single node of a set; -1 after a fault.
Index find_node(const mesh::Mesh& mesh, const Section& section, std::string_view key, const std::string& name) {
  const Subset* nodes = find_nodes(mesh, section, key, name);
  if (nodes == nullptr) return -1;
  if (nodes->size() != 1) {
    section.fault(key, "the node set " + in_quotes(name) + " has " + std::to_string(nodes->size()) + " nodes: a spring ends at a single one");
    return -1;
  }
  return nodes->front();
}

void add_spring(const SpringRequest& request, dynamics::Model& model) {
  const Index from = find_node(model.mesh, request.section, "from", request.from);
  const bool grounded = request.to == "ground";
  const Index to = grounded ? -1 : find_node(model.mesh, request.section, "to", request.to);
  if (from < 0 || (!grounded && to < 0)) return;
  if (from == to) {
    request.section.fault("to", "'from' and 'to' are the same node");
    return;
  }
  const double* length = request.length ? &*request.length : nullptr;
  model.loads.emplace_back(grounded ? load::spring_to_point(request.name, model.mesh.X, from, model.mesh.X.col(from),
                                                            request.stiffness, request.damping, length)
                                    : load::spring_between(request.name, model.mesh.X, from, to, request.stiffness, request.damping, length));
}

void add_load(const LoadRequest& request, dynamics::Model& model) {
  const Section& section = request.section;
  const std::array<load::OverTime, 3> values{over_time(request.value[0]), over_time(request.value[1]), over_time(request.value[2])};
  if (request.kind == LoadRequest::Kind::pressure) {
    const mesh::Surface* surface = find_surface(model.mesh, section, "surface", request.on);
    if (surface != nullptr) model.loads.emplace_back(load::pressure_on(request.name, model.mesh, *surface, values[0]));
    return;
  }
  const bool body = request.kind == LoadRequest::Kind::body_force;
  const Subset* nodes = find_nodes(model.mesh, section, body ? "body" : "nodes", request.on);
  if (nodes == nullptr) return;
  if (body) {
    load::BodyForce force{.name = request.name, .nodes = *nodes, .mass = Scalars(static_cast<Eigen::Index>(nodes->size())),
                          .acceleration = request.value};
    Scalars mass = Scalars::Zero(model.mesh.X.cols());
    for (const auto& block : model.blocks) element::add_mass(block, mass);  // without point masses
    for (std::size_t i = 0; i < nodes->size(); ++i) {
      force.mass(static_cast<Eigen::Index>(i)) = mass((*nodes)[i]);
      const Vec3 X = model.mesh.X.col((*nodes)[i]);
      for (const Expression& value : request.value) refuse_infinite(section, "value", value(X.x(), X.y(), X.z(), 0), at_place(X) + ", t = 0");
    }
    model.loads.emplace_back(std::move(force));
  } else if (request.kind == LoadRequest::Kind::force) {
    model.loads.emplace_back(load::NodalForce{.name = request.name, .nodes = *nodes, .force = values});
  } else {
    load::NodalMoment moment{.name = request.name, .nodes = *nodes, .turns = {}, .moment = values};
    for (const Index node : *nodes) {
      moment.turns.push_back(model.turn_of_node[node]);
      if (moment.turns.back() >= 0) continue;
      section.fault("nodes", "a moment acts on nodes of plates only: " + in_quotes(request.on) + " has others");
      return;
    }
    model.loads.emplace_back(std::move(moment));
  }
}

/// What drives nodes is a number at the start.
void refuse_infinite_start(const PlaneRequest& request, const Subset& nodes, const Vectors& X) {
  for (const auto& [key, field] : {std::pair("velocity", &request.field), std::pair("turning", &request.turning)}) {
    if (!(*field)[0]) continue;
    const Section section = request.section.section(key);
    for (const Index node : nodes) {
      const Vec3 at = X.col(node);
      for (const Expression& value : *field) refuse_infinite(section, "value", value(at.x(), at.y(), at.z(), 0), at_place(at) + ", t = 0");
    }
  }
}

/// The gradient of a field at X, by differences over a hundred-thousandth of the scene's size.
Mat3 gradient_at(const std::array<Expression, 3>& field, const Vec3& X, double size) {
  Mat3 gradient;
  const double h = 1e-5 * size;  // halves the digits between round-off and curvature
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 ahead = X + h * Vec3::Unit(axis), behind = X - h * Vec3::Unit(axis);
    for (int i = 0; i < 3; ++i)
      gradient(i, axis) = (field[i](ahead.x(), ahead.y(), ahead.z(), 0) - field[i](behind.x(), behind.y(), behind.z(), 0)) / (2 * h);
  }
  return gradient;
}

}  // namespace

double read_unit(const Section& section, Dimension dimension) {
  const std::string text = section.word("unit");
  if (text.empty()) return 1;
  const auto parsed = parse_quantity("1 " + text);
  if (const auto* fault = std::get_if<TextFault>(&parsed)) {
    section.fault("unit", "cannot read 'unit' = " + text + ": " + fault->message);
    return 1;
  }
  const auto& quantity = std::get<Quantity>(parsed);
  if (quantity.dimension != dimension) {
    section.fault("unit", "'unit' = " + text + " has the dimension [" + describe(quantity.dimension) + "]: expected [" +
                              describe(dimension) + "], for example '" + si_unit(dimension) + "'");
    return 1;
  }
  return quantity.value;
}

PlaneRequest read_plane(const Section& section) {
  using load::PlaneKind;
  PlaneRequest plane{.section = section, .name = section.word("name"), .rigid = false, .kind = PlaneKind::held, .nodes = {},
                     .point = Vec3::Zero(), .normal = Vec3::UnitZ(), .velocity = {}, .field = {}, .turning = {}};
  const std::string kind = section.choice("kind", {"symmetry", "held", "fixed", "floor", "rigid", "driven"});
  plane.rigid = kind == "rigid";
  plane.kind = kind == "symmetry" ? PlaneKind::symmetry
               : kind == "fixed"  ? PlaneKind::fixed
               : kind == "floor"  ? PlaneKind::floor
               : kind == "driven" ? PlaneKind::driven
                                  : PlaneKind::held;
  plane.nodes = section.when(!plane.rigid).words("nodes");
  const bool floor = kind == "floor", driven = kind == "driven", no_normal = driven || kind == "fixed";
  const auto point = section.when(floor || plane.rigid).vector("point", dim::length);
  const auto normal = section.when(!no_normal).vector("normal", dim::none);
  if (floor || plane.rigid) plane.point = Vec3(point[0], point[1], point[2]);
  if (!no_normal) {
    const Vec3 given(normal[0], normal[1], normal[2]);
    if (given.norm() > 0) {
      plane.normal = given.normalized();
    } else {
      section.fault("normal", "'normal' has no length");
    }
  }
  if (section.has("turning")) {
    const Section turning = section.when(driven).section("turning");
    const auto value = read_expressions(turning, "value", of_both, read_unit(turning, dim::angular_speed));
    if (driven) plane.turning = value;
  }
  const bool held = kind == "held";
  if (driven) {
    const Section velocity = section.section("velocity");
    plane.field = read_expressions(velocity, "value", of_both, read_unit(velocity, dim::speed));
  } else if (section.has("velocity")) {
    const Section velocity = section.when(held).section("velocity");
    const double unit = read_unit(velocity, dim::speed);
    const Expression value = read_expression(velocity, "value", of_time, unit);
    if (held) {
      refuse_infinite(velocity, "value", value(0, 0, 0, 0), "t = 0");
      plane.velocity = over_time(value);
    }
  }
  return plane;
}

std::optional<dynamics::Relaxation> read_relaxation(const Section& root) {
  if (!root.has("relaxation")) return std::nullopt;
  const Section section = root.section_or_empty("relaxation");
  dynamics::Relaxation relaxation;
  relaxation.residual = section.number_or("residual", relaxation.residual, between(0, 1));
  relaxation.after = section.quantity_or("after", relaxation.after, dim::time, not_negative);
  relaxation.samples = section.count_or("samples", relaxation.samples);
  return relaxation;
}

Actions read_actions(const Section& root, bool runs) {
  Actions actions;
  const Section run = root.when(runs);
  const auto gravity = run.vector_or("gravity", {0, 0, 0}, dim::acceleration);
  actions.gravity = Vec3(gravity[0], gravity[1], gravity[2]);
  std::map<std::string, std::string> seen;
  for (const Section& section : root.list("planes")) {
    actions.planes.push_back(read_plane(section));
    refuse_repeated(section, actions.planes.back().name, seen);
  }
  for (const Section& section : run.list("loads")) {
    actions.loads.push_back(read_load(section));
    refuse_repeated(section, actions.loads.back().name, seen);
  }
  for (const Section& section : root.list("springs")) {
    actions.springs.push_back(read_spring(section));
    refuse_repeated(section, actions.springs.back().name, seen);
  }
  for (const Section& section : root.list("point_masses")) {
    actions.point_masses.push_back(read_point_mass(section));
    refuse_repeated(section, actions.point_masses.back().name, seen);
  }
  for (const Section& section : run.list("initial")) actions.initial.push_back(read_initial(section));
  actions.relaxation = read_relaxation(run);
  if (!runs) actions.gravity.setZero(), actions.loads.clear(), actions.initial.clear(), actions.relaxation.reset();
  return actions;
}

const Subset* find_nodes(const mesh::Mesh& mesh, const Section& section, std::string_view key, const std::string& name) {
  const mesh::NodeSet* found = find(mesh.node_sets, section, key, name, "node set");
  return found == nullptr ? nullptr : &found->nodes;
}

const mesh::Surface* find_surface(const mesh::Mesh& mesh, const Section& section, std::string_view key, const std::string& name) {
  return find(mesh.surfaces, section, key, name, "surface");
}

void constrain(const Actions& actions, dynamics::Model& model) {
  std::vector<const PlaneRequest*> requests;  // beside the planes that are added here
  load::Constraints added;
  for (const PlaneRequest& request : actions.planes) {
    if (request.rigid) continue;
    load::Plane plane{.name = request.name, .kind = request.kind, .point = request.point, .normal = request.normal, .nodes = {},
                      .velocity = request.velocity, .field = request.field, .turning = request.turning};
    for (const std::string& name : request.nodes) {
      const Subset* nodes = find_nodes(model.mesh, request.section, "nodes", name);
      if (nodes != nullptr) plane.nodes.insert(plane.nodes.end(), nodes->begin(), nodes->end());
    }
    std::sort(plane.nodes.begin(), plane.nodes.end());
    plane.nodes.erase(std::unique(plane.nodes.begin(), plane.nodes.end()), plane.nodes.end());
    refuse_infinite_start(request, plane.nodes, model.mesh.X);
    requests.push_back(&request);
    added.planes.push_back(std::move(plane));
  }
  const load::Conflict conflict = load::find_conflict(added);
  if (conflict.moving >= 0) {
    const PlaneRequest& moving = *requests[conflict.moving];
    const std::string does = moving.kind == load::PlaneKind::driven ? " drives" : " moves";
    moving.section.fault("velocity", in_quotes(moving.name) + does + " nodes that " + in_quotes(requests[conflict.other]->name) +
                                         " holds in the same direction");
  }
  const Index overheld = load::find_overheld(added);
  for (std::size_t p = added.planes.size(); overheld >= 0 && p-- > 0;) {
    if (!std::binary_search(added.planes[p].nodes.begin(), added.planes[p].nodes.end(), overheld)) continue;
    requests[p]->section.fault("nodes", "too many planes hold one node: there is room for " +
                                            std::to_string(load::HeldNode::most_rows) +
                                            " directions, and a fixed or driven one takes three");
    break;
  }
  if (conflict.moving < 0 && overheld < 0)
    for (load::Plane& plane : added.planes) model.constraints.planes.push_back(std::move(plane));
  for (const PointMassRequest& request : actions.point_masses) {
    const Subset* nodes = find_nodes(model.mesh, request.section, "nodes", request.nodes);
    if (nodes != nullptr) model.point_masses.push_back({request.name, *nodes, request.mass});
  }
}

void add_loads(const Actions& actions, dynamics::Model& model) {
  model.gravity = actions.gravity;
  for (const LoadRequest& request : actions.loads) add_load(request, model);
  for (const SpringRequest& request : actions.springs) add_spring(request, model);
  model.relaxation = actions.relaxation;
  for (const PlaneRequest& request : actions.planes) {
    if (!request.turning[0]) continue;
    const auto turns = [&](Index node) { return model.turn_of_node[node] >= 0; };
    for (const load::Plane& plane : model.constraints.planes)
      if (plane.name == request.name && std::none_of(plane.nodes.begin(), plane.nodes.end(), turns))
        request.section.fault("turning", "'turning' is of nodes of plates: " + in_quotes(request.name) + " has none");
  }
}

void set_initial(const Actions& actions, const dynamics::Model& model, dynamics::State& state) {
  Vectors displacement = Vectors::Zero(3, model.mesh.X.cols());
  std::vector<Mat3> gradient(model.node_of_turn.size(), Mat3::Zero()), rate = gradient;
  const Vec3 extent = model.mesh.X.rowwise().maxCoeff() - model.mesh.X.rowwise().minCoeff();
  const InitialRequest* displaced = nullptr;
  for (const InitialRequest& request : actions.initial) {
    const Subset* nodes = find_nodes(model.mesh, request.section, "body", request.body);
    if (nodes == nullptr) continue;
    const char* key = request.displacement ? "displacement" : "velocity";
    for (const Index node : *nodes) {
      const Vec3 X = model.mesh.X.col(node);
      Vec3 value;
      for (int axis = 0; axis < 3; ++axis) {
        value(axis) = request.value[axis](X.x(), X.y(), X.z(), 0);
        refuse_infinite(request.section, key, value(axis), at_place(X));
      }
      const Index turn = model.turn_of_node[node];
      if (turn >= 0) (request.displacement ? gradient : rate)[turn] += gradient_at(request.value, X, extent.norm());
      if (request.displacement) {
        displacement.col(node) += value;
      } else {
        state.v.col(node) += value;
      }
    }
    if (request.displacement) displaced = &request;
  }
  state.w += dynamics::turns_of(model, rate);
  if (displaced == nullptr || !displaced->section.sound()) return;
  const element::Vote smallest = dynamics::displace(model, state, displacement, gradient);
  if (!(smallest.size > 0))
    displaced->section.fault("displacement", "'displacement' turns element " + std::to_string(smallest.size_element) + " inside out");
}

}  // namespace nereid::input
