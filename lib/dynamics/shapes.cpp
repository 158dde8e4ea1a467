#include "dynamics/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "dynamics/side.hpp"
#include "mesh/adjacency.hpp"

namespace nereid::dynamics {

namespace {

constexpr double on_side = 1e-6;  // of the size of a body: so near its round side a node lies on it

/// Whether a surface has all nodes of the round side of a body.
bool is_whole(const rigid::Body& body, const Vectors& X, const mesh::Surface& surface) {
  const mesh::RoundBody& round = *body.round;
  const geometry::PlacedRound at = mesh::placed(round, X);
  geometry::Round sheet = round.shape;
  sheet.half_thickness = 0;
  const double near = on_side * geometry::reach(sheet);
  const Subset nodes = mesh::surface_nodes(surface);
  return std::all_of(body.nodes.begin(), body.nodes.end(), [&](Index node) {
    const Vec3 x = X.col(node), arm = x - at.centre;
    const double from_axis = sheet.kind == geometry::RoundKind::sphere ? arm.norm() : arm.cross(at.axis).norm();
    return std::abs(from_axis - sheet.radius) > near || std::binary_search(nodes.begin(), nodes.end(), node);
  });
}

/// The surface of a body as facets, edges and nodes.
contact::Faceted faceted_of(const Model& model, const mesh::Surface& surface) {
  contact::Faceted faceted;
  faceted.nodes = mesh::surface_nodes(surface);
  faceted.area = mesh::tributary_areas(model.mesh, surface, faceted.nodes);
  faceted.faces = mesh::faces_around(model.mesh, surface, faceted.nodes);
  const std::vector<Index> others = mesh::other_sides(surface.facets);
  const auto place = [&](Index node) {
    return std::lower_bound(faceted.nodes.begin(), faceted.nodes.end(), node) - faceted.nodes.begin();
  };
  faceted.half = Scalars::Zero(static_cast<Eigen::Index>(faceted.nodes.size()));
  for (const auto& block : model.blocks) {
    const double half = element::thickness(block) / 2;
    if (!(half > 0)) continue;
    for (const Index node : element::nodes(block).reshaped())
      if (const auto at = place(node); at < faceted.half.size() && faceted.nodes[static_cast<std::size_t>(at)] == node)
        faceted.half(at) = std::max(faceted.half(at), half);
  }
  std::vector<Index> facets, edges;
  std::map<std::array<Index, 2>, std::vector<Index>> seen;  // the third nodes of the facets at each edge
  std::vector<std::array<Index, 2>> in_order;
  for (Index f = 0; f < surface.facets.cols(); ++f) {
    const Index other = others[static_cast<std::size_t>(f)];
    if (other >= 0 && other < f) continue;
    // a surface of one side of plates has no other sides: what turns is of plates
    const bool is_plate = other >= 0 || (model.rotation_of_node.size() > 0 && model.rotation_of_node[surface.facets(0, f)] >= 0);
    faceted.is_plate.push_back(is_plate);
    for (int i = 0; i < 3; ++i) facets.push_back(surface.facets(i, f));
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(surface.facets(i, f), surface.facets((i + 1) % 3, f));
      std::vector<Index>& thirds = seen[{a, b}];
      if (thirds.empty()) in_order.push_back({a, b}), edges.push_back(a), edges.push_back(b);
      thirds.push_back(surface.facets((i + 2) % 3, f));
    }
  }
  faceted.across = Table<2>::Constant(2, static_cast<Eigen::Index>(in_order.size()), -1);
  std::vector<Subset> beside(faceted.nodes.size());
  for (std::size_t e = 0; e < in_order.size(); ++e) {
    const std::vector<Index>& thirds = seen[in_order[e]];
    for (std::size_t side = 0; side < std::min<std::size_t>(2, thirds.size()); ++side)
      faceted.across(static_cast<Eigen::Index>(side), static_cast<Eigen::Index>(e)) = thirds[side];
    for (std::size_t end = 0; end < 2; ++end)
      beside[static_cast<std::size_t>(place(in_order[e][end]))].push_back(in_order[e][1 - end]);
  }
  faceted.first_beside.assign(1, 0);
  for (const Subset& nodes : beside) {
    faceted.beside.insert(faceted.beside.end(), nodes.begin(), nodes.end());
    faceted.first_beside.push_back(static_cast<Index>(faceted.beside.size()));
  }
  faceted.facets = Eigen::Map<const Table<3>>(facets.data(), 3, static_cast<Eigen::Index>(facets.size() / 3));
  faceted.edges = Eigen::Map<const Table<2>>(edges.data(), 2, static_cast<Eigen::Index>(edges.size() / 2));
  return faceted;
}

double mean_area(const Model& model, const mesh::Surface& surface) { return mesh::facet_areas(model.mesh, surface).mean(); }

bool has_usual_height(const InterfaceOptions& options) {
  return !options.height.from_initial_height && (options.height.from_thickness || options.height.given == 0);
}

}  // namespace

const rigid::Body* round_body_of(const Model& model, const mesh::Surface& surface) {
  if (surface.facets.cols() == 0 || model.rigid_of_node.empty()) return nullptr;
  const Index b = model.rigid_of_node[static_cast<std::size_t>(surface.facets(0, 0))];
  if (b < 0) return nullptr;
  const rigid::Body& body = model.rigid_bodies[static_cast<std::size_t>(b)];
  return body.round && is_whole(body, model.mesh.X, surface) ? &body : nullptr;
}

std::optional<contact::Shapes> shapes_of_pair(const Model& model, const mesh::Surface& apexes, const mesh::Surface& base,
                                              const InterfaceOptions& options, const contact::Between& between) {
  if (options.method != contact::Method::multiplier || options.kind != contact::InterfaceKind::contact || !has_usual_height(options))
    return std::nullopt;
  const rigid::Body *of_apexes = round_body_of(model, apexes), *of_base = round_body_of(model, base);
  if (of_apexes == nullptr && of_base == nullptr) return std::nullopt;
  contact::Shapes shapes;
  contact::ShapePair pair{.round = 0, .side = of_base != nullptr ? -1.0 : 1.0, .between = between};
  pair.area = std::min(mean_area(model, apexes), mean_area(model, base));
  shapes.rounds.push_back(of_base != nullptr ? *of_base->round : *of_apexes->round);
  if (of_apexes != nullptr && of_base != nullptr) {
    shapes.rounds.push_back(*of_apexes->round);
    pair.other = 1;
  } else {
    shapes.faceted.push_back(faceted_of(model, of_base != nullptr ? apexes : base));
    pair.faceted = 0;
  }
  shapes.pairs.push_back(pair);
  return shapes;
}

contact::Shapes shapes_of_bodies(const Model& model, const std::vector<const mesh::Surface*>& skins, const Subset& apexes,
                                 const InterfaceOptions& options, contact::Bodies& bodies) {
  contact::Shapes shapes;
  if (options.method != contact::Method::multiplier) return shapes;
  const Index count = bodies.count();
  std::vector<Index> round_of(skins.size(), -1), faceted_at(skins.size(), -1);
  for (std::size_t b = 0; b < skins.size(); ++b)
    if (const rigid::Body* body = round_body_of(model, *skins[b]); body != nullptr) {
      round_of[b] = static_cast<Index>(shapes.rounds.size());
      shapes.rounds.push_back(*body->round);
    }
  for (Index a = 0; a < count; ++a)
    for (Index b = 0; b < count; ++b) {
      const auto one = static_cast<std::size_t>(a), other = static_cast<std::size_t>(b);
      const bool touch = bodies.touch[bodies.pair(a, b)] != 0 && a != b;
      const bool both = round_of[one] >= 0 && round_of[other] >= 0;
      if (!touch || round_of[one] < 0 || (both && b < a)) continue;
      contact::ShapePair pair{.round = round_of[one], .body = a, .other_body = b, .between = bodies.between[bodies.pair(b, a)]};
      pair.area = std::min(mean_area(model, *skins[one]), mean_area(model, *skins[other]));
      if (both) {
        pair.other = round_of[other];
      } else {
        if (faceted_at[other] < 0) {
          faceted_at[other] = static_cast<Index>(shapes.faceted.size());
          contact::Faceted faceted = faceted_of(model, *skins[other]);
          for (const Index node : faceted.nodes)
            faceted.apex.push_back(static_cast<Index>(std::lower_bound(apexes.begin(), apexes.end(), node) - apexes.begin()));
          shapes.faceted.push_back(std::move(faceted));
        }
        pair.faceted = faceted_at[other];
      }
      shapes.pairs.push_back(pair);
    }
  for (const contact::ShapePair& pair : shapes.pairs)
    bodies.touch[bodies.pair(pair.body, pair.other_body)] = bodies.touch[bodies.pair(pair.other_body, pair.body)] = 0;
  return shapes;
}

}  // namespace nereid::dynamics
