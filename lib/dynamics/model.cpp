#include "dynamics/model.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace nereid::dynamics {

namespace {

PlacesOfNodes places_of_nodes(const element::Tiling& tiling) {
  PlacesOfNodes places;
  places.node = tiling.node;
  std::sort(places.node.begin(), places.node.end());
  places.node.erase(std::unique(places.node.begin(), places.node.end()), places.node.end());
  const auto at = [&](Index node) {
    return std::lower_bound(places.node.begin(), places.node.end(), node) - places.node.begin();
  };
  places.begin.assign(places.node.size() + 1, 0);
  for (const Index node : tiling.node) ++places.begin[at(node) + 1];
  for (std::size_t i = 0; i < places.node.size(); ++i) places.begin[i + 1] += places.begin[i];
  places.place.resize(tiling.node.size());
  std::vector<Index> next(places.begin.begin(), places.begin.end() - 1);
  for (std::size_t p = 0; p < tiling.node.size(); ++p) places.place[next[at(tiling.node[p])]++] = static_cast<Index>(p);
  return places;
}

std::vector<Share> shares(const std::vector<std::string>& names) {
  std::vector<Share> list;
  for (const std::string& name : names) list.push_back({name, 0});
  return list;
}

Account account(const std::string& name, const std::string& kind, const std::vector<std::string>& stored,
                const std::vector<std::string>& dissipated) {
  Account a;
  a.name = name;
  a.kind = kind;
  a.stored = shares(stored);
  a.dissipated = shares(dissipated);
  return a;
}

/// One account for every source of force, in the order of Model.
std::vector<Account> accounts(const Model& model) {
  std::vector<Account> list;
  for (const auto& block : model.blocks) {
    list.push_back(account(element::name(block), "block", element::stored_names(block), element::dissipated_names(block)));
  }
  using Names = std::vector<std::string>;
  for (const auto& interface : model.interfaces) {
    const bool rubs = interface.friction.coefficient > 0;
    list.push_back(account(interface.name, "interface", rubs ? Names{"penalty", "stick"} : Names{"penalty"},
                           rubs ? Names{"damping", "friction"} : Names{"damping"}));
  }
  for (const auto& plane : model.rigid_planes) {
    const bool rubs = plane.friction.coefficient > 0;
    list.push_back(account(plane.name, "rigid_plane", rubs ? Names{"penalty", "stick"} : Names{"penalty"}, rubs ? Names{"friction"} : Names{}));
  }
  for (const auto& plane : model.constraints.planes) {
    constexpr std::array<const char*, 5> kinds{"held", "fixed", "symmetry", "floor", "driven"};
    const auto stored = load::moves(plane) ? std::vector<std::string>{"outside"} : std::vector<std::string>{};
    list.push_back(account(plane.name, kinds[static_cast<std::size_t>(plane.kind)], stored, {"caught"}));
  }
  for (const auto& any : model.loads) {
    const bool spring = load::is_spring(any);
    const auto dissipated = spring ? std::vector<std::string>{"damping"} : std::vector<std::string>{};
    list.push_back(account(load::name(any), load::kind(any), {spring ? "elastic" : "outside"}, dissipated));
  }
  if (model.relaxation) list.push_back(account("relaxation", "relaxation", {}, {"removed"}));
  if (!model.gravity.isZero(0)) list.push_back(account("gravity", "gravity", {"potential"}, {}));
  return list;
}

}  // namespace

void finish(Model& model) {
  const auto nodes = static_cast<Index>(model.mesh.X.cols());
  model.mass = Scalars::Zero(nodes);
  model.turn_of_node.assign(nodes, -1);
  model.node_of_turn.clear();
  model.places.clear();
  for (const auto& block : model.blocks) {
    element::add_mass(block, model.mass);
    model.places.push_back(places_of_nodes(element::tiling(block)));
    if (!element::is_plate(block)) continue;
    for (const Index node : model.places.back().node) {
      if (model.turn_of_node[node] >= 0) continue;
      model.turn_of_node[node] = static_cast<Index>(model.node_of_turn.size());
      model.node_of_turn.push_back(node);
    }
  }
  for (const load::PointMass& point : model.point_masses)
    for (const Index node : point.nodes) model.mass(node) += point.mass / static_cast<double>(point.nodes.size());
  check((model.mass.array() > 0).all(), "a node has neither an element nor a point mass");
  model.inertia = Scalars::Zero(static_cast<Eigen::Index>(model.node_of_turn.size()));
  for (auto& block : model.blocks) {
    if (!element::is_plate(block)) continue;
    element::set_turning(block, model.turn_of_node);
    element::add_rotary_inertia(block, model.inertia);
  }
}

State initial_state(const Model& model, std::vector<contact::Memory> interfaces) {
  check(interfaces.size() == model.interfaces.size(), "every interface must be connected before the start");
  State state;
  state.x = model.mesh.X;
  state.v = Vectors::Zero(3, model.mesh.X.cols());
  state.w = Vectors::Zero(3, model.inertia.size());
  for (const auto& block : model.blocks) state.blocks.push_back(element::initial_memory(block));
  state.interfaces = std::move(interfaces);
  for (const auto& plane : model.rigid_planes) state.rigid_planes.push_back(contact::initial_memory(plane));
  state.constraints = load::prepare(model.constraints, static_cast<Index>(model.mesh.X.cols()), model.turn_of_node);
  for (const auto& any : model.loads) state.loads.push_back(load::initial_memory(any));
  state.ledger.accounts = accounts(model);
  return state;
}

Forces make_forces(const Model& model, std::vector<contact::Workspace> interfaces) {
  Forces forces;
  for (const auto& block : model.blocks) forces.blocks.push_back(element::tile_forces(block));
  forces.interfaces = std::move(interfaces);
  forces.force = Vectors::Zero(3, model.mesh.X.cols());
  forces.moment = Vectors::Zero(3, model.inertia.size());
  forces.partial.reserve(static_cast<std::size_t>(model.mesh.X.cols()));
  forces.springs = load::spring_rates(model.loads, model.mass);
  if (model.relaxation) {
    forces.before = {.x = model.mesh.X, .turned = forces.moment, .force = forces.force, .moment = forces.moment,
                     .w = forces.moment, .source_force = forces.force, .source_moment = forces.moment};
  }
  return forces;
}

}  // namespace nereid::dynamics
