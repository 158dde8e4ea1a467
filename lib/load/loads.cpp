#include "load/loads.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/check.hpp"

namespace nereid::load {

namespace {

/// The nodes of a load, in the order of its forces.
template <class Load>
struct Nodes {
  const Load& load;
  Index size() const { return static_cast<Index>(load.nodes.size()); }
  Index operator[](Index i) const { return load.nodes[i]; }
};
template <>
struct Nodes<Spring> {
  const Spring& load;
  Index size() const { return load.to < 0 ? 1 : 2; }
  Index operator[](Index i) const { return i == 0 ? load.from : load.to; }
};
template <class Load>
Nodes<Load> nodes_of(const Load& load) {
  return {load};
}

Vec3 at(const std::array<OverTime, 3>& vector, double t) { return {vector[0](t), vector[1](t), vector[2](t)}; }

void set_forces(const BodyForce& load, const Vectors& X, const Vectors&, const Vectors&, double t, double, LoadMemory& memory) {
  for (std::size_t i = 0; i < load.nodes.size(); ++i) {
    const Vec3 at_node = X.col(load.nodes[i]);
    for (int axis = 0; axis < 3; ++axis)
      memory.force(axis, static_cast<Eigen::Index>(i)) = load.mass(static_cast<Eigen::Index>(i)) *
                                                         load.acceleration[axis](at_node.x(), at_node.y(), at_node.z(), t);
  }
}

/// Calls visit(place, area) for the corners of the faces of a surface: areas along their outward normals, of a hexahedron's face
/// (A n + T n)/6 with T of the triangle at the corner, so that they are the gradient of the enclosed volume. [m2]
///
/// at  the position of a node [m]
template <class At, class Visit>
void each_corner_area(const Table<4>& corners, const Subset& nodes, At&& at, Visit&& visit) {
  for (Eigen::Index face = 0; face < corners.cols(); ++face) {
    const auto corner = corners.col(face);
    const int count = corner(3) < 0 ? 3 : 4;
    std::array<Vec3, 4> twice;  // areas of the triangles at the corners, along their normals
    Vec3 sum = Vec3::Zero();
    for (int a = 0; a < count; ++a) {
      const Vec3 here = at(nodes[corner(a)]);
      const Vec3 to_next = at(nodes[corner((a + 1) % count)]) - here;
      const Vec3 to_last = at(nodes[corner((a + count - 1) % count)]) - here;
      sum += twice[a] = to_next.cross(to_last);
    }
    for (int a = 0; a < count; ++a) visit(corner(a), count == 3 ? Vec3(sum / 18) : Vec3((sum / 2 + twice[a]) / 12));
  }
}

/// The positions of a state, for each_corner_area().
auto positions(const Vectors& x) {
  return [&x](Index node) -> Vec3 { return x.col(node); };
}

void set_forces(const Pressure& load, const Vectors&, const Vectors& x, const Vectors&, double t, double, LoadMemory& memory) {
  const double pressure = load.pressure(t);
  memory.force.setZero();
  each_corner_area(load.corners, load.nodes, positions(x),
                   [&](Index place, const Vec3& area) { memory.force.col(place) -= pressure * area; });
}

void set_forces(const Bubble& load, const Vectors&, const Vectors& x, const Vectors& v, double, double dt, LoadMemory& memory) {
  const auto before = [&](Index node) -> Vec3 { return x.col(node) - dt * v.col(node); };
  const auto sweep = [&](Index place, const Vec3& area) { memory.swept -= 0.5 * dt * area.dot(v.col(load.nodes[place])); };
  each_corner_area(load.corners, load.nodes, before, sweep);
  each_corner_area(load.corners, load.nodes, positions(x), sweep);
  const double pressure = load.pressure(load.volume + memory.swept);
  memory.force.setZero();
  each_corner_area(load.corners, load.nodes, positions(x),
                   [&](Index place, const Vec3& area) { memory.force.col(place) -= pressure * area; });
}

void set_forces(const Radiation& load, const Vectors&, const Vectors& x, const Vectors& v, double t, double, LoadMemory& memory) {
  const double pressure = load.pressure(t) + 2 * load.incident(t);
  memory.force.setZero(), memory.drag.setZero();
  each_corner_area(load.corners, load.nodes, positions(x), [&](Index place, const Vec3& area) {
    memory.force.col(place) -= pressure * area;
    const double size = area.norm();
    if (size > 0) memory.drag.col(place) -= load.impedance / size * area.dot(v.col(load.nodes[place])) * area;
  });
  memory.force += memory.drag;
}

void set_forces(const NodalForce& load, const Vectors&, const Vectors&, const Vectors&, double t, double, LoadMemory& memory) {
  memory.force.colwise() = at(load.force, t) / static_cast<double>(load.nodes.size());
}

void set_forces(const NodalMoment& load, const Vectors&, const Vectors&, const Vectors&, double t, double, LoadMemory& memory) {
  memory.moment.colwise() = at(load.moment, t) / static_cast<double>(load.nodes.size());
}

void set_forces(const Couple& load, const Vectors&, const Vectors& x, const Vectors&, double t, double, LoadMemory& memory) {
  Vec3 middle = Vec3::Zero();
  for (const Index node : load.nodes) middle += x.col(node) / static_cast<double>(load.nodes.size());
  Mat3 inertia = Mat3::Zero();
  for (const Index node : load.nodes) {
    const Vec3 r = x.col(node) - middle;
    inertia += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
  }
  const Vec3 turn = inertia.inverse() * at(load.moment, t);
  for (std::size_t i = 0; i < load.nodes.size(); ++i)
    memory.force.col(static_cast<Eigen::Index>(i)) = turn.cross(Vec3(x.col(load.nodes[i]) - middle));
}

void set_forces(const Spring& load, const Vectors&, const Vectors& x, const Vectors& v, double, double dt, LoadMemory& memory) {
  const bool grounded = load.to < 0;
  // from `from` to the other end, at the end and at the start of the step
  const Vec3 line = (grounded ? load.ground : Vec3(x.col(load.to))) - x.col(load.from);
  const Vec3 rate = (grounded ? Vec3::Zero() : Vec3(v.col(load.to))) - v.col(load.from);
  const double length = line.norm();
  Vec3 pull = Vec3::Zero();  // on `from`
  double lost = 0;           // per time
  if (grounded && load.length == 0) {
    pull = load.stiffness * line + load.damping * rate;
    lost = load.damping * rate.squaredNorm();
  } else if (length > 0) {
    // the length's own difference: a rigid rotation has none, whatever the step
    const double lengthening = dt > 0 ? (length - (line - dt * rate).norm()) / dt : 0;
    pull = (load.stiffness * (length - load.length) + load.damping * lengthening) / length * line;
    lost = load.damping * lengthening * lengthening;
  }
  memory.force.col(0) = pull;
  if (!grounded) memory.force.col(1) = -pull;
  memory.stored = 0.5 * load.stiffness * (length - load.length) * (length - load.length);
  memory.dissipated += dt * lost;
}

/// Posts half a step's work and impulses with the forces as they are; x where they act.
template <class Load>
void post(const Load& load, const Vectors& x, const Vectors& v, const Vectors& omega, double back, double half, LoadMemory& memory) {
  const auto nodes = nodes_of(load);
  double power = 0;
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (Index i = 0; i < nodes.size(); ++i) {
    if constexpr (std::is_same_v<Load, NodalMoment>) {
      const Vec3 here = memory.moment.col(i);
      power += here.dot(omega.col(load.rotations[i]));
      moment += here;
    } else {
      const Vec3 here = memory.force.col(i), speed = v.col(nodes[i]), place = x.col(nodes[i]) - back * speed;
      power += here.dot(speed);
      force += here;
      moment += place.cross(here);
      if constexpr (std::is_same_v<Load, Radiation>) memory.dissipated -= half * memory.drag.col(i).dot(speed);
    }
  }
  memory.work += half * power;
  memory.impulse += half * force;
  memory.angular_impulse += half * moment;
}

Spring make_spring(const std::string& name, const Vectors& X, Index from, Index to, const Vec3& ground, double stiffness,
                   double damping, const double* length) {
  const auto count = static_cast<Index>(X.cols());
  check(from >= 0 && from < count && to < count && from != to, "a spring joins two nodes of the mesh");
  Spring spring{.name = name, .from = from, .to = to, .ground = ground, .stiffness = stiffness, .damping = damping, .length = 0};
  const Vec3 end = to < 0 ? ground : Vec3(X.col(to));
  spring.length = length != nullptr ? *length : (end - X.col(from)).norm();
  return spring;
}

}  // namespace

Pressure pressure_on(const std::string& name, const mesh::Mesh& mesh, const mesh::Surface& surface, OverTime pressure) {
  Pressure load{
      .name = name, .nodes = mesh::surface_nodes(surface), .corners = mesh::faces(mesh, surface), .pressure = std::move(pressure)};
  for (Eigen::Index i = 0; i < load.corners.size(); ++i) {
    Index& corner = load.corners.data()[i];
    if (corner < 0) continue;
    corner = static_cast<Index>(std::lower_bound(load.nodes.begin(), load.nodes.end(), corner) - load.nodes.begin());
  }
  return load;
}

Bubble bubble_under(const std::string& name, const mesh::Mesh& mesh, const mesh::Surface& surface, OverTime pressure, double volume) {
  Pressure same = pressure_on(name, mesh, surface, std::move(pressure));
  return {.name = name, .nodes = std::move(same.nodes), .corners = std::move(same.corners), .pressure = std::move(same.pressure),
          .volume = volume};
}

Radiation radiation_from(const std::string& name, const mesh::Mesh& mesh, const mesh::Surface& surface, OverTime pressure,
                         OverTime incident, double impedance) {
  Pressure same = pressure_on(name, mesh, surface, std::move(pressure));
  return {.name = name, .nodes = std::move(same.nodes), .corners = std::move(same.corners), .pressure = std::move(same.pressure),
          .incident = std::move(incident), .impedance = impedance};
}

Spring spring_between(const std::string& name, const Vectors& X, Index from, Index to, double stiffness, double damping,
                      const double* length) {
  check(to >= 0, "a spring joins two nodes of the mesh");
  return make_spring(name, X, from, to, Vec3::Zero(), stiffness, damping, length);
}

Spring spring_to_point(const std::string& name, const Vectors& X, Index from, const Vec3& ground, double stiffness,
                       double damping, const double* length) {
  return make_spring(name, X, from, -1, ground, stiffness, damping, length);
}

AnyLoad in_stage(const AnyLoad& any, bool is_on, double start) {
  AnyLoad changed = any;
  const auto set = [&](auto& value) { value = load::in_stage(value, is_on, start); };
  const auto set_all = [&](auto& values) { for (auto& value : values) set(value); };
  if (auto* force = std::get_if<BodyForce>(&changed)) set_all(force->acceleration);
  if (auto* pressure = std::get_if<Pressure>(&changed)) set(pressure->pressure);
  if (auto* bubble = std::get_if<Bubble>(&changed); bubble != nullptr && !is_on) bubble->pressure = [](double) { return 0.0; };
  if (auto* radiation = std::get_if<Radiation>(&changed)) set(radiation->pressure), set(radiation->incident);
  if (auto* force = std::get_if<NodalForce>(&changed)) set_all(force->force);
  if (auto* moment = std::get_if<NodalMoment>(&changed)) set_all(moment->moment);
  if (auto* couple = std::get_if<Couple>(&changed)) set_all(couple->moment);
  return changed;
}

const std::string& name(const AnyLoad& any) {
  return std::visit([](const auto& load) -> const std::string& { return load.name; }, any);
}

Source source(const AnyLoad& any) {
  constexpr std::array kinds{SourceKind::body_force, SourceKind::pressure, SourceKind::force,  SourceKind::moment,
                             SourceKind::moment,     SourceKind::spring,   SourceKind::radiation, SourceKind::bubble};
  static_assert(std::variant_size_v<AnyLoad> == kinds.size());
  if (is_spring(any)) return {name(any), SourceKind::spring, {Stored::elastic}, {Dissipated::damping}};
  if (std::holds_alternative<Radiation>(any))
    return {name(any), SourceKind::radiation, {Stored::external_work}, {Dissipated::radiated}};
  return {name(any), kinds[any.index()], {Stored::external_work}, {}};
}

void post(const AnyLoad& any, const LoadMemory& memory, Account& account) {
  account.work = memory.work;
  if (is_spring(any)) {
    account.hold(Stored::elastic, memory.stored);
    account.dissipated[Dissipated::damping] = memory.dissipated;
  } else {
    account.stored[Stored::external_work] = -memory.work - memory.dissipated;
    account.dissipated[Dissipated::radiated] = memory.dissipated;
  }
  account.impulse = memory.impulse;
  account.angular_impulse = memory.angular_impulse;
}

bool is_spring(const AnyLoad& any) { return std::holds_alternative<Spring>(any); }

LoadMemory initial_memory(const AnyLoad& any) {
  return std::visit(
      [](const auto& load) {
        LoadMemory memory;
        const Index count = nodes_of(load).size();
        constexpr bool rotations = std::is_same_v<std::decay_t<decltype(load)>, NodalMoment>;
        memory.force = Vectors::Zero(3, rotations ? 0 : count);
        if constexpr (std::is_same_v<std::decay_t<decltype(load)>, Radiation>) memory.drag = memory.force;
        memory.moment = Vectors::Zero(3, rotations ? count : 0);
        return memory;
      },
      any);
}

void advance(const AnyLoad& any, const Vectors& X, const Vectors& x, const Vectors& v, const Vectors& omega, double t, double dt,
             LoadMemory& memory) {
  std::visit(
      [&](const auto& load) {
        post(load, x, v, omega, dt, 0.5 * dt, memory);
        set_forces(load, X, x, v, t, dt, memory);
        post(load, x, v, omega, 0, 0.5 * dt, memory);
      },
      any);
}

void add_forces(const AnyLoad& any, const LoadMemory& memory, Vectors& force, Vectors& moment) {
  std::visit(
      [&](const auto& load) {
        const auto nodes = nodes_of(load);
        for (Index i = 0; i < nodes.size(); ++i) {
          if constexpr (std::is_same_v<std::decay_t<decltype(load)>, NodalMoment>) {
            moment.col(load.rotations[i]) += memory.moment.col(i);
          } else {
            force.col(nodes[i]) += memory.force.col(i);
          }
        }
      },
      any);
}

namespace {
/// Zero of none, for which Eigen would compute with a null pointer.
Vec3 sum_of(const Vectors& all) { return all.cols() > 0 ? Vec3(all.rowwise().sum()) : Vec3(Vec3::Zero()); }
}  // namespace

Vec3 resultant(const LoadMemory& memory) { return sum_of(memory.force); }
Vec3 resultant_moment(const LoadMemory& memory) { return sum_of(memory.moment); }

double applied(const LoadMemory& memory, double length) {
  const auto sum = [](const Vectors& all) { return all.cols() > 0 ? all.colwise().norm().sum() : 0.0; };
  return sum(memory.force) + sum(memory.moment) / length;
}

SpringRates spring_rates(const std::vector<AnyLoad>& loads, const Vectors& X, const Scalars& mass) {
  std::unordered_map<Index, std::array<double, 2>> at_node;  // stiffness and damping over mass
  for (const AnyLoad& any : loads) {
    if (!is_spring(any)) continue;
    const auto& spring = std::get<Spring>(any);
    for (const Index node : {spring.from, spring.to}) {
      if (node < 0) continue;
      at_node[node][0] += spring.stiffness / mass(node);
      at_node[node][1] += spring.damping / mass(node);
    }
  }
  SpringRates rates;
  for (const AnyLoad& any : loads)
    if (const auto* radiation = std::get_if<Radiation>(&any)) {
      each_corner_area(radiation->corners, radiation->nodes, positions(X), [&](Index place, const Vec3& area) {
        const Index node = radiation->nodes[place];
        at_node[node][1] += radiation->impedance * area.norm() / mass(node);
      });
      for (const Index node : radiation->nodes) rates.damping = std::max(rates.damping, 0.5 * at_node[node][1]);
    }
  for (std::size_t i = 0; i < loads.size(); ++i) {
    if (!is_spring(loads[i])) continue;
    const auto& spring = std::get<Spring>(loads[i]);
    std::array<double, 2> both = at_node[spring.from];
    if (spring.to >= 0)
      for (int s = 0; s < 2; ++s) both[s] += at_node[spring.to][s];
    if (both[0] > rates.omega_squared || rates.stiffest < 0) rates.stiffest = static_cast<int>(i);
    rates.omega_squared = std::max(rates.omega_squared, both[0]);
    rates.damping = std::max(rates.damping, 0.5 * both[1]);
  }
  return rates;
}

double step_with_springs(double step, const SpringRates& rates) {
  const double s = rates.damping + 1 / step;
  return 2 / (s + std::sqrt(s * s + rates.omega_squared));
}

}  // namespace nereid::load
