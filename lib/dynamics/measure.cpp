#include "dynamics/measure.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "contact/multiplier/tie.hpp"

namespace nereid::dynamics {

namespace {

template <class Value>
Vec3 mean(const Subset& nodes, Value&& value) {
  Vec3 sum = Vec3::Zero();
  for (const Index node : nodes) sum += value(node);
  return sum / static_cast<double>(nodes.size());
}

}  // namespace

Vec3 mean_position(const View& view, const Subset& nodes) {
  return mean(nodes, [&](Index node) -> Vec3 { return view.now.x.col(node); });
}

Vec3 mean_displacement(const View& view, const Subset& nodes) {
  return mean(nodes, [&](Index node) -> Vec3 { return view.now.x.col(node) - view.model.mesh.X.col(node); });
}

Vec3 mean_velocity(const View& view, const Subset& nodes) {
  return mean(nodes, [&](Index node) -> Vec3 { return view.now.v.col(node); });
}

namespace {

/// Calls visit(body, state) for each rigid body of which a set has all nodes, and returns which these are.
template <class Visit>
std::vector<char> whole_bodies(const View& view, const Subset& nodes, Visit&& visit) {
  std::vector<char> whole(view.model.rigid_bodies.size(), 0);
  for (std::size_t b = 0; b < whole.size(); ++b) {
    const rigid::Body& body = view.model.rigid_bodies[b];
    whole[b] = std::includes(nodes.begin(), nodes.end(), body.nodes.begin(), body.nodes.end());
    if (whole[b]) visit(body, view.now.rigid_bodies[b]);
  }
  return whole;
}

/// The mass at a node; zero if it belongs to a rigid body that counts as a whole. Of a part of a rigid body, what its elements have. [kg]
double mass_at(const View& view, Index node, const std::vector<char>& whole) {
  if (!is_rigid_node(view.model, node)) return view.model.mass(node);
  const Index body = view.model.rigid_of_node[node];
  return whole[static_cast<std::size_t>(body)] ? 0 : view.model.mass(node) / view.model.rigid_share(body);
}

}  // namespace

Vec3 momentum(const View& view, const Subset& nodes) {
  Vec3 sum = Vec3::Zero();
  const auto whole = whole_bodies(view, nodes, [&](const rigid::Body&, const rigid::State& state) { sum += state.momentum; });
  for (const Index node : nodes) sum += mass_at(view, node, whole) * view.now.v.col(node);
  return sum;
}

Vec3 angular_momentum(const View& view, const Subset& nodes) {
  Vec3 sum = Vec3::Zero();
  const auto whole = whole_bodies(view, nodes, [&](const rigid::Body& body, const rigid::State& state) {
    sum += rigid::centre(body, state).cross(state.momentum) + state.angular_momentum;
  });
  for (const Index node : nodes) {
    sum += mass_at(view, node, whole) * Vec3(view.now.x.col(node)).cross(Vec3(view.now.v.col(node)));
    const Index rotation = view.model.rotation_of_node[node];
    if (rotation >= 0) sum += view.model.inertia(rotation) * view.now.omega.col(rotation);
  }
  return sum;
}

Vec3 mean_spin(const View& view, const Subset& nodes) {
  const Vec3 at = mean_position(view, nodes), speed = mean_velocity(view, nodes);
  Vec3 turning = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
  for (const Index node : nodes) {
    const Vec3 r = view.now.x.col(node) - at;
    turning += r.cross(Vec3(view.now.v.col(node) - speed));
    inertia += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
  }
  return inertia.ldlt().solve(turning);
}

namespace {

/// Calls visit(area across gravity [m2], gravity . x of the three nodes [m2/s2]) for each facet.
template <class Visit>
void visit_heights(const Table<3>& facets, const Vec3& gravity, const Vectors& x, Visit&& visit) {
  const Vec3 down = gravity.normalized();
  for (const auto& nodes : facets.colwise()) {
    const Vec3 a = x.col(nodes[0]), b = x.col(nodes[1]), c = x.col(nodes[2]);
    visit(0.5 * std::abs((b - a).cross(c - a).dot(down)), Vec3(gravity.dot(a), gravity.dot(b), gravity.dot(c)));
  }
}

}  // namespace

FreeSurface free_surface(const Model& model, const mesh::Surface& surface, double density, const Vectors& start) {
  double area = 0, sum = 0;
  visit_heights(surface.facets, model.gravity, start, [&](double part, const Vec3& at) { area += part, sum += part * at.mean(); });
  return {surface.facets, density, model.gravity, area > 0 ? sum / area : 0};
}

double wave_energy(const View& view, const FreeSurface& surface) {
  double sum = 0;  // over a facet the square of a linear function has the mean ((a + b + c)^2 + a^2 + b^2 + c^2)/12
  visit_heights(surface.facets, surface.gravity, view.now.x, [&](double part, const Vec3& at) {
    const Vec3 above = at.array() - surface.level;
    sum += part / 12 * (above.sum() * above.sum() + above.squaredNorm());
  });
  return 0.5 * surface.density / surface.gravity.norm() * sum;
}

double kinetic_energy(const View& view, const Subset& nodes) {
  double sum = 0;
  const auto whole =
      whole_bodies(view, nodes, [&](const rigid::Body& body, const rigid::State& state) { sum += rigid::kinetic_energy(body, state); });
  for (const Index node : nodes) {
    sum += 0.5 * mass_at(view, node, whole) * view.now.v.col(node).squaredNorm();
    const Index rotation = view.model.rotation_of_node[node];
    if (rotation >= 0) sum += 0.5 * view.model.inertia(rotation) * view.now.omega.col(rotation).squaredNorm();
  }
  return sum;
}

double extent(const View& view, const Subset& nodes, int axis) {
  const auto [low, high] = std::minmax_element(nodes.begin(), nodes.end(), [&](Index a, Index b) {
    return view.now.x(axis, a) < view.now.x(axis, b);
  });
  return view.now.x(axis, *high) - view.now.x(axis, *low);
}

double radius(const View& view, const Subset& nodes, int axis) {
  double most = 0;
  for (const Index node : nodes)
    most = std::max(most, std::hypot(view.now.x((axis + 1) % 3, node), view.now.x((axis + 2) % 3, node)));
  return most;
}

double of_body(const View& view, const std::vector<std::size_t>& blocks, const element::Shown& shown, int component, Take take) {
  element::Reduced all;
  for (const std::size_t b : blocks)
    add(element::reduce(view.model.blocks[b], view.model.mesh.X, view.now.x, view.now.blocks[b], shown, component), all);
  return take == Take::largest ? all.largest : all.sum / all.mass;
}

double of_elements(const View& view, const PickedElements& elements, const element::Shown& shown, int component, Take take) {
  element::Reduced all;
  for (std::size_t i = 0; i < elements.blocks.size(); ++i) {
    const std::size_t b = elements.blocks[i];
    add(element::reduce(view.model.blocks[b], view.model.mesh.X, view.now.x, view.now.blocks[b], shown, component, elements.picked[i]),
        all);
  }
  return take == Take::largest ? all.largest : all.sum / all.mass;
}

double area_across(const View& view, std::size_t c, Index apex, const Vec3& force) {
  const auto& interface = std::get<contact::Interface>(view.model.contacts[c]);
  if (interface.faces.begin.empty()) return interface.area(apex);
  return mesh::tributary_area_facing(interface.faces, view.now.x, apex, force);
}

namespace {

/// What acts on the node of an apex; null if nothing does.
const contact::NodeForce* force_on(const View& view, std::size_t c, Index apex, const std::vector<contact::NodeForce>& forces) {
  const Index node = contact::sides(view.model.contacts[c]).apexes[static_cast<std::size_t>(apex)];
  const auto at = std::lower_bound(forces.begin(), forces.end(), node, [](const auto& one, Index n) { return one.node < n; });
  return at != forces.end() && at->node == node && !at->push.isZero(0) ? &*at : nullptr;
}

/// What of a force constraints leave at an apex: on a symmetry plane the mirror images take what leads out of it.
Vec3 allowed_of(const contact::Interface& interface, Index apex, const Vec3& force) {
  return interface.allowed.empty() ? force : Vec3(interface.allowed[apex] * force);
}

}  // namespace

std::vector<contact::NodeForce> forces_of_contact(const Model& model, const State& now, std::size_t c) {
  const auto& contacts = model.contacts;
  std::size_t first = c;
  while (first > 0 && contact::follows(contacts[first])) --first;
  std::vector<contact::NodeForce> all;
  for (std::size_t i = first; i == first || (i < contacts.size() && contact::follows(contacts[i])); ++i)
    contact::with_memory(contacts[i], now.contacts[i],
                         [&](const auto& one, const auto& memory) { contact::list_forces(one, memory, all); });
  std::stable_sort(all.begin(), all.end(), [](const auto& one, const auto& other) { return one.node < other.node; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (kept > 0 && all[kept - 1].node == all[i].node) all[kept - 1].push += all[i].push, all[kept - 1].friction += all[i].friction;
    else all[kept++] = all[i];
  }
  all.resize(kept);
  return all;
}

Traction traction_at(const View& view, std::size_t c, Index apex, const std::vector<contact::NodeForce>& forces) {
  const contact::NodeForce* on = force_on(view, c, apex, forces);
  if (on == nullptr) return {};
  const auto& interface = std::get<contact::Interface>(view.model.contacts[c]);
  const Vec3 push = allowed_of(interface, apex, on->push);
  if (interface.kind == contact::InterfaceKind::tied && interface.ties[apex].facet >= 0) {
    const Vec3 normal = contact::normal_of(interface, *contact::near(std::get<contact::Memory>(view.now.contacts[c]), apex), view.now.x);
    const double pressure = push.dot(normal) / interface.area(apex);
    return {pressure, (push / interface.area(apex) - pressure * normal).norm()};
  }
  const double size = push.norm();
  if (!(size > 0)) return {};
  const Vec3 friction = allowed_of(interface, apex, on->friction), along = push / size;
  double facing = interface.area(apex), behind = 0;
  if (!interface.faces.begin.empty()) {
    const auto has_across = [&](const Vec3& force) { return mesh::tributary_area_against(interface.faces, view.now.x, apex, force) > 0; };
    if (has_across(push) || has_across(-push)) facing = area_across(view, c, apex, push), behind = area_across(view, c, apex, -push);
  }
  const double area = std::max(facing, behind);
  // a sheet has as much on both sides but for round-off, and is pushed
  return {2 * facing >= behind ? size / area : -size / area, (friction - friction.dot(along) * along).norm() / area};
}

ContactState contact_state(const View& view, std::size_t c) {
  ContactState state{.largest_pressure = 0, .area = 0};
  if (contact::interface_of(view.model.contacts[c]) == nullptr) return state;
  const contact::Interface& interface = *contact::interface_of(view.model.contacts[c]);
  const std::vector<contact::NodeForce> forces = forces_of_contact(view.model, view.now, c);
  for (Index a = 0; a < static_cast<Index>(interface.apexes.size()); ++a) {
    const contact::NodeForce* on = force_on(view, c, a, forces);
    if (on == nullptr) continue;
    state.largest_pressure = std::max(state.largest_pressure, traction_at(view, c, a, forces).pressure);
    state.area += area_across(view, c, a, on->push);
  }
  return state;
}

double least_gap(const View& view, std::size_t c) {
  const contact::Interface* interface = contact::interface_of(view.model.contacts[c]);
  if (interface == nullptr) return std::numeric_limits<double>::quiet_NaN();  // of edges that cross nothing is known before
  const auto& memory = std::get<contact::Memory>(view.now.contacts[c]);
  const Vec3 extent = view.now.x.rowwise().maxCoeff() - view.now.x.rowwise().minCoeff();
  return contact::least_gap(*interface, view.now.x, memory, extent.norm());
}

namespace {

/// By how much an impulse has grown since the last look, over the time since then; `first` [N s] is where it began.
Vec3 growth(const Vec3& impulse, const Vec3& first, double t, Kept& kept) {
  if (kept.since < 0) kept = {.integral = first, .since = t};
  else if (t > kept.since) kept = {.integral = impulse, .value = (impulse - kept.integral) / (t - kept.since), .since = t};
  return kept.value;
}

}  // namespace

Vec3 mean_acceleration(const View& view, const Subset& nodes, Kept& kept) {
  double mass = 0;
  const auto whole = whole_bodies(view, nodes, [&](const rigid::Body& body, const rigid::State&) { mass += body.mass.mass; });
  for (const Index node : nodes) mass += mass_at(view, node, whole);
  const Vec3 velocity = momentum(view, nodes) / mass;
  return growth(velocity, velocity, view.now.t, kept);
}

Vec3 mean_contact_force(const View& view, const std::vector<std::size_t>& passes, Kept& kept) {
  Vec3 impulse = Vec3::Zero();
  for (const std::size_t pass : passes)
    impulse += contact::side_of(view.model.contacts[pass]) * contact::sides(view.now.contacts[pass]).impulse;
  return growth(impulse, Vec3::Zero(), view.now.t, kept);
}

Vec3 mean_force(const View& view, std::size_t source, Kept& kept) {
  const Vec3& impulse = view.now.ledger.accounts[source].impulse;
  const std::size_t first = view.model.blocks.size() + view.model.contacts.size();
  const bool rigid = source >= first && source < first + view.model.rigid_planes.size();
  return growth(impulse, rigid ? Vec3(Vec3::Zero()) : impulse, view.now.t, kept);
}

Vec3 mean_section_force(const View& view, std::size_t section, Kept& kept) {
  return growth(view.now.sections[section].impulse, Vec3::Zero(), view.now.t, kept);
}

namespace {

/// Calls visit(contact, names of both sides, record, sign of its impulse) for each record of a pair. Passes and edges belong to their
/// contact.
template <class Visit>
void each_pair_record(const Model& model, const State& now, Visit&& visit) {
  std::string_view contact;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const contact::Sides& both = contact::sides(model.contacts[c]);
    if (!contact::follows(model.contacts[c])) contact = both.name;
    const auto& names = both.bodies.names;
    const auto name = [&](Index side, std::string_view without) -> std::string_view {
      return names.empty() ? without : std::string_view(names[static_cast<std::size_t>(side)]);
    };
    for (const contact::PairRecord& one : contact::sides(now.contacts[c]).pair_records)
      visit(contact, std::array{name(one.one, "apexes"), name(one.other, "base")}, one, contact::side_of(model.contacts[c]));
  }
}

}  // namespace

Vec3 pair_impulse(const View& view, const std::string& contact, const std::string& one, const std::string& other) {
  Vec3 sum = Vec3::Zero();
  each_pair_record(view.model, view.now, [&](std::string_view of, const auto& sides, const contact::PairRecord& record, double sign) {
    if (of != contact) return;
    if (sides[0] == one && sides[1] == other) sum += sign * record.impulse;
    if (sides[0] == other && sides[1] == one) sum -= sign * record.impulse;
  });
  return sum;
}

Vec3 mean_pair_force(const View& view, const std::string& contact, const std::string& one, const std::string& other, Kept& kept) {
  return growth(pair_impulse(view, contact, one, other), Vec3::Zero(), view.now.t, kept);
}

std::vector<Touched> touched(const Model& model, const State& now) {
  std::vector<Touched> all;
  each_pair_record(model, now, [&](std::string_view contact, const auto& names, const contact::PairRecord& one, double sign) {
    const std::array<std::string, 2> sides{std::string(names[0]), std::string(names[1])};
    auto at = std::find_if(all.begin(), all.end(), [&](const Touched& t) { return t.contact == contact && t.sides == sides; });
    if (at == all.end()) at = all.insert(all.end(), {std::string(contact), sides, one.first, one.last, Vec3::Zero()});
    at->first = std::min(at->first, one.first), at->last = std::max(at->last, one.last);
    at->impulse += sign * one.impulse;
  });
  return all;
}

namespace {

template <class Channel>
std::string column(const Source& source, Channel channel) {
  return "energy_" + source.name + "_" + std::string(word(channel));
}
std::string column_of_created(const Source& source) { return "energy_created_" + source.name; }

}  // namespace

std::vector<std::string> ledger_columns(const Source& source) {
  std::vector<std::string> columns;
  for (const Stored channel : source.stored) columns.push_back(column(source, channel));
  for (const Dissipated channel : source.dissipated) columns.push_back(column(source, channel));
  columns.push_back(column_of_created(source));
  return columns;
}

std::vector<Probe> ledger_probes(const Model& model) {
  std::vector<Probe> probes;
  const auto add = [&probes](const std::string& name, auto value) {
    probes.push_back({name, "J", [value](const View& view, Kept&) { return value(view.now.ledger); }});
  };
  add("energy_kinetic", [](const Ledger& ledger) { return ledger.kinetic; });
  const std::vector<Source> all = sources(model);
  for (std::size_t s = 0; s < all.size(); ++s) {
    for (const Stored channel : all[s].stored)
      add(column(all[s], channel), [=](const Ledger& ledger) { return ledger.accounts[s].stored[channel]; });
    for (const Dissipated channel : all[s].dissipated)
      add(column(all[s], channel), [=](const Ledger& ledger) { return ledger.accounts[s].dissipated[channel]; });
  }
  for (std::size_t s = 0; s < all.size(); ++s)
    add(column_of_created(all[s]), [s](const Ledger& ledger) { return created(ledger.accounts[s]); });
  add("energy_integration", [](const Ledger& ledger) { return ledger.integration; });
  add("energy_residual", [](const Ledger& ledger) { return energy_residual(ledger); });
  return probes;
}

std::size_t source_of(const Model& model, std::string_view name) {
  const std::vector<Source> all = sources(model);
  for (std::size_t s = 0; s < all.size(); ++s)
    if (all[s].name == name) return s;
  throw InternalError("no source of force is called '" + std::string(name) + "'");
}

}  // namespace nereid::dynamics
