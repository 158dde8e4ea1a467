#include "element/block.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "element/kernels.hpp"

namespace nereid::element {

namespace {

template <class Kind>
AnyBlock make(const mesh::Mesh& mesh, const std::string& region, const Connectivity& nodes, const AnyLaw& any,
              const typename Kind::Options& options) {
  return std::visit(
      [&]<class Law>(const Law& law) -> AnyBlock {
        if constexpr (may_have<Kind, Law>) return Kernels<Kind, Law>::make(mesh, region, nodes, law, options);
        throw InternalError("elements of this kind have no such law");
      },
      any);
}

/// Calls f(block, kernels of the block) for the block that is held.
template <class F>
auto with_kernels(const AnyBlock& any, F&& f) {
  return std::visit([&]<class Kind, class Law>(const Block<Kind, Law>& block) { return f(block, Kernels<Kind, Law>{}); }, any);
}

/// Those channels of a kind that it has with these options.
template <class Kind, class Channel, std::size_t count>
std::vector<Channel> those_of(const std::array<Channel, count>& channels, const typename Kind::Options& options) {
  std::vector<Channel> list;
  for (const Channel channel : channels)
    if (Kind::has(options, channel)) list.push_back(channel);
  return list;
}

}  // namespace

AnyBlock solids(const mesh::Mesh& mesh, const std::string& region, const AnyLaw& law, const AnyHexahedronOptions& any) {
  return solids(mesh, region, Connectivity(mesh::hexahedra(mesh, region).nodes), law, any);
}

AnyBlock solids(const mesh::Mesh& mesh, const std::string& name, const Connectivity& nodes, const AnyLaw& law,
                const AnyHexahedronOptions& any) {
  return std::visit(
      [&]<class Options>(const Options& options) {
        using Solid = std::conditional_t<std::is_same_v<Options, Hexahedron::Options>, Hexahedron, FullHexahedron>;
        using Kind = std::conditional_t<std::is_same_v<Options, Fluid::Options>, Fluid, Solid>;
        return make<Kind>(mesh, name, nodes, law, options);
      },
      any);
}

AnyBlock hexahedra(const mesh::Mesh& mesh, const std::string& region, const AnyLaw& law,
                   const Hexahedron::Options& options) {
  return solids(mesh, region, law, options);
}

AnyBlock plates(const mesh::Mesh& mesh, const std::string& region, const AnyLaw& law, const Plate::Options& options) {
  return plates(mesh, region, Connectivity(mesh::triangles(mesh, region).nodes), law, options);
}

AnyBlock plates(const mesh::Mesh& mesh, const std::string& name, const Connectivity& nodes, const AnyLaw& law,
                const Plate::Options& options) {
  return make<Plate>(mesh, name, nodes, law, options);
}

const std::string& name(const AnyBlock& any) {
  return std::visit([](const auto& block) -> const std::string& { return block.name; }, any);
}
const Connectivity& nodes(const AnyBlock& any) {
  return std::visit([](const auto& block) -> const Connectivity& { return block.nodes; }, any);
}
const Tiling& tiling(const AnyBlock& any) {
  return std::visit([](const auto& block) -> const Tiling& { return block.tiling; }, any);
}
bool rotates(const AnyBlock& any) {
  return std::visit([]<class Kind, class Law>(const Block<Kind, Law>&) { return Kind::rotates; }, any);
}

std::vector<Stored> stored_channels(const AnyBlock& any) {
  return std::visit(
      []<class Kind, class Law>(const Block<Kind, Law>& block) {
        return those_of<Kind>(Kind::stored_channels, block.options);
      },
      any);
}
std::vector<Dissipated> dissipated_channels(const AnyBlock& any) {
  return std::visit(
      []<class Kind, class Law>(const Block<Kind, Law>& block) {
        return those_of<Kind>(Kind::dissipated_channels, block.options);
      },
      any);
}

void post(const AnyBlock& any, const Memory& memory, Account& account) {
  account.work = memory.work;
  account.angular_impulse = memory.angular_impulse;
  std::visit(
      [&]<class Kind, class Law>(const Block<Kind, Law>&) {  // channels that these options do not use stay zero
        for (const Stored channel : Kind::stored_channels) account.hold(channel, memory.stored[channel]);
        for (const Dissipated channel : Kind::dissipated_channels) account.dissipated[channel] = memory.dissipated[channel];
      },
      any);
}

double depth(const AnyBlock& any, const Vectors& X, Index element, double area) {
  return std::visit(
      [&]<class Kind, class Law>(const Block<Kind, Law>& block) {
        std::array<Vector<double>, Kind::nodes> corners;
        for (int a = 0; a < Kind::nodes; ++a) {
          const Index node = block.nodes(a, element);
          corners[a] = {X(0, node), X(1, node), X(2, node)};
        }
        return Kind::depth(block.options, constants(block.law, block.options, corners).mass / block.law.density, area);
      },
      any);
}

double thickness(const AnyBlock& any) {
  return std::visit([]<class Kind, class Law>(const Block<Kind, Law>& block) { return Kind::thickness(block.options); }, any);
}

double drilling(const AnyBlock& any) {
  return std::visit(
      []<class Kind, class Law>(const Block<Kind, Law>& block) {
        if constexpr (Kind::layered) return block.options.drilling;
        return 0.0;
      },
      any);
}

bool thins(const AnyBlock& any) {
  return std::visit(
      []<class Kind, class Law>(const Block<Kind, Law>& block) {
        if constexpr (Kind::layered) return Kind::template thins<Law>(block.options);
        return false;
      },
      any);
}

Thinned thinned(const AnyBlock& any, const Vectors& x, const Memory& memory) {
  return with_kernels(any, [&](const auto& block, auto kernels) { return kernels.thinned(block, x, memory); });
}

Pressed pressed(const AnyBlock& any, const Memory& memory) {
  return with_kernels(any, [&](const auto& block, auto kernels) { return kernels.pressed(block, memory); });
}

Contrast contrast(const AnyBlock& any, const Vectors& x, const Memory& memory) {
  const std::vector<Held> all = with_kernels(any, [&](const auto& block, auto kernels) { return kernels.held(block, x, memory); });
  Contrast found;
  if (all.empty()) return found;
  struct AtNode {
    double count = 0, bending = 0, strain = 0, volume = 0;
  };
  const Connectivity& corners = nodes(any);
  const Index first = corners.minCoeff();
  std::vector<AtNode> at(static_cast<std::size_t>(corners.maxCoeff() - first + 1));
  const auto of = [&](Index a, std::size_t e) -> AtNode& {
    return at[static_cast<std::size_t>(corners(a, static_cast<Index>(e)) - first)];
  };
  for (std::size_t e = 0; e < all.size(); ++e)
    for (Index a = 0; a < corners.rows(); ++a) {
      AtNode& node = of(a, e);
      node.count += 1, node.bending += all[e].bending, node.strain += all[e].strain, node.volume += all[e].volume;
    }
  const double part = 1.0 / static_cast<double>(corners.rows());
  for (std::size_t e = 0; e < all.size(); ++e) {
    double bending = 0, density = 0, most = 1;
    for (Index a = 0; a < corners.rows(); ++a) {
      const AtNode& node = of(a, e);
      bending += part * node.bending / node.count, density += part * node.strain / node.volume, most = std::max(most, node.count);
    }
    const Held& own = all[e];
    found.strain += own.strain;
    found.bending += own.stiff || most == 1 ? own.bending : std::max(0.0, own.bending - bending);
    found.density += std::max(0.0, own.strain - own.volume * density);
  }
  return found;
}

Source source(const AnyBlock& any) { return {name(any), SourceKind::block, stored_channels(any), dissipated_channels(any)}; }

bool plates_may_have(const AnyLaw& any) {
  return std::visit([]<class Law>(const Law&) { return may_have<Plate, Law>; }, any);
}

void set_rotations(AnyBlock& any, const std::vector<Index>& column_of_node) {
  std::visit(
      [&](auto& block) {
        block.rotation_column.clear();
        for (const Index node : block.tiling.node) block.rotation_column.push_back(column_of_node[node]);
      },
      any);
}

void add_mass(const AnyBlock& any, Scalars& mass) {
  with_kernels(any, [&](const auto& block, auto kernels) { kernels.add_mass(block, mass); });
}

Scalars element_masses(const AnyBlock& any) {
  return with_kernels(any, [](const auto& block, auto kernels) { return kernels.element_masses(block); });
}

void add_rotary_inertia(const AnyBlock& any, Scalars& inertia) {
  with_kernels(any, [&](const auto& block, auto kernels) { kernels.add_rotary_inertia(block, inertia); });
}

Memory initial_memory(const AnyBlock& any) {
  return with_kernels(any, [](const auto& block, auto kernels) { return kernels.initial_memory(block); });
}

TileForces tile_forces(const AnyBlock& any) {
  const Tiling& t = tiling(any);
  const auto slots = static_cast<Eigen::Index>(t.node.size());
  return {.force = Vectors::Zero(3, slots),
          .moment = Vectors::Zero(3, rotates(any) ? slots : 0),
          .thickness = Scalars::Constant(thins(any) ? t.elements : 0, thickness(any))};
}

TileReports tile_reports(const AnyBlock& any) {
  const bool is_viscous = std::visit([](const auto& block) { return acts(block.options.viscosity); }, any);
  return {.tile = std::vector<TileReport>(tiling(any).tiles.size()), .departures = departures_for(tiling(any), is_viscous)};
}

BlockLimit advance(const AnyBlock& any, const Vectors& x, const Vectors& dx, const Vectors& rotation, double dt, Memory& memory,
             TileForces& forces, TileReports& reports) {
  return with_kernels(
      any, [&](const auto& block, auto kernels) { return kernels.advance(block, x, dx, rotation, dt, memory, forces, reports); });
}

Reduced reduce(const AnyBlock& any, const Vectors& X, const Vectors& x, const Memory& memory, const Shown& shown, int component) {
  return with_kernels(any, [&](const auto& block, auto kernels) { return kernels.reduce(block, X, x, memory, shown, component); });
}

Picked pick(const AnyBlock& any, const std::vector<Index>& elements) {
  const Tiling& cut = tiling(any);
  std::vector<std::size_t> place(static_cast<std::size_t>(cut.elements));
  for (std::size_t at = 0; at < cut.element.size(); ++at)
    if (static_cast<int>(at % lanes) < cut.filled[at / lanes]) place[static_cast<std::size_t>(cut.element[at])] = at;
  const Scalars mass = element_masses(any);
  Picked picked;
  for (const Index element : elements)
    picked.place.push_back(place[static_cast<std::size_t>(element)]), picked.mass.push_back(mass(element));
  return picked;
}

Reduced reduce(const AnyBlock& any, const Vectors& X, const Vectors& x, const Memory& memory, const Shown& shown, int component,
               const Picked& picked) {
  return with_kernels(any, [&](const auto& block, auto kernels) {
    return kernels.reduce_picked(block, X, x, memory, shown, component, picked);
  });
}

std::vector<Field> fields(const AnyBlock& any, const Vectors& X, const Vectors& x, const Memory& memory, const Wanted& wanted) {
  return with_kernels(any, [&](const auto& block, auto kernels) { return kernels.fields(block, X, x, memory, wanted); });
}

}  // namespace nereid::element
