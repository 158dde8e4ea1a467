#include "element/block.hpp"

#include <algorithm>

#include "element/kernels.hpp"

namespace nereid::element {

namespace {

template <class Kind>
AnyBlock make(const mesh::Mesh& mesh, const std::string& region, const Connectivity& nodes, const AnyLaw& any,
              const typename Kind::Options& options) {
  return std::visit(
      [&]<class Law>(const Law& law) -> AnyBlock { return Kernels<Kind, Law>::make(mesh, region, nodes, law, options); }, any);
}

/// Calls f(block, kernels of the block) for the block that is held.
template <class F>
auto with_kernels(const AnyBlock& any, F&& f) {
  return std::visit([&]<class Kind, class Law>(const Block<Kind, Law>& block) { return f(block, Kernels<Kind, Law>{}); }, any);
}

}  // namespace

AnyBlock solids(const mesh::Mesh& mesh, const std::string& region, const AnyLaw& law, const AnyHexahedronOptions& any) {
  const Connectivity nodes = mesh::hexahedra(mesh, region).nodes;
  return std::visit(
      [&]<class Options>(const Options& options) {
        using Kind = std::conditional_t<std::is_same_v<Options, Hexahedron::Options>, Hexahedron, FullHexahedron>;
        return make<Kind>(mesh, region, nodes, law, options);
      },
      any);
}

AnyBlock hexahedra(const mesh::Mesh& mesh, const std::string& region, const AnyLaw& law,
                   const Hexahedron::Options& options) {
  return solids(mesh, region, law, options);
}

AnyBlock plates(const mesh::Mesh& mesh, const std::string& region, const AnyLaw& law, const Plate::Options& options) {
  return make<Plate>(mesh, region, mesh::triangles(mesh, region).nodes, law, options);
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
bool is_plate(const AnyBlock& any) {
  return std::visit([]<class Kind, class Law>(const Block<Kind, Law>&) { return std::is_same_v<Kind, Plate>; }, any);
}
std::vector<std::string> stored_names(const AnyBlock& any) {
  const auto names = std::visit(
      []<class Kind, class Law>(const Block<Kind, Law>& block) { return Kind::stored(block.options); }, any);
  return {names.begin(), names.end()};
}
std::vector<std::string> dissipated_names(const AnyBlock& any) {
  const auto names = std::visit(
      []<class Kind, class Law>(const Block<Kind, Law>& block) { return Kind::dissipated(block.options); }, any);
  return {names.begin(), names.end()};
}

namespace {
Stored stored_channel(const std::string& name) {
  return static_cast<Stored>(std::find(words_of_stored.begin(), words_of_stored.end(), name) - words_of_stored.begin());
}
Dissipated dissipated_channel(const std::string& name) {
  return static_cast<Dissipated>(std::find(words_of_dissipated.begin(), words_of_dissipated.end(), name) - words_of_dissipated.begin());
}
}  // namespace

Source source(const AnyBlock& any) {
  Source source{name(any), SourceKind::block, {}, {}};
  for (const std::string& word : stored_names(any)) source.stored.push_back(stored_channel(word));
  for (const std::string& word : dissipated_names(any)) source.dissipated.push_back(dissipated_channel(word));
  return source;
}

void post(const AnyBlock& any, const Memory& memory, Account& account) {
  account.work = memory.work;
  account.hold(Stored::elastic, memory.stored[0]);
  account.hold(is_plate(any) ? Stored::transverse_shear : Stored::hourglass, memory.stored[1]);
  account.dissipated[Dissipated::plastic] = memory.plastic;
  account.dissipated[Dissipated::viscous] = memory.viscous;
  account.dissipated[Dissipated::hourglass] = memory.hourglass;
}

void set_turning(AnyBlock& any, const std::vector<Index>& column_of_node) {
  std::visit(
      [&](auto& block) {
        block.turning.clear();
        for (const Index node : block.tiling.node) block.turning.push_back(column_of_node[node]);
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
  const auto places = static_cast<Eigen::Index>(t.node.size());
  return {.force = Vectors::Zero(3, places),
          .moment = Vectors::Zero(3, is_plate(any) ? places : 0),
          .reports = std::vector<TileForces::Report>(t.tiles.size())};
}

Vote advance(const AnyBlock& any, const Vectors& x, const Vectors& v, const Vectors& w, double dt, Memory& memory,
             TileForces& forces) {
  return with_kernels(any, [&](const auto& block, auto kernels) { return kernels.advance(block, x, v, w, dt, memory, forces); });
}

std::vector<Field> fields(const AnyBlock& any, const Vectors& x, const Memory& memory) {
  return with_kernels(any, [&](const auto& block, auto kernels) { return kernels.fields(block, x, memory); });
}

}  // namespace nereid::element
