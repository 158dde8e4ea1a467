#include "output/frames.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dynamics/measure.hpp"

namespace nereid::output {

namespace {

Field scalar(const std::string& name, const std::string& unit, Eigen::Index count, bool integer = false) {
  return {name, unit, {}, Eigen::MatrixXd::Zero(1, count), integer};
}

Field vector(const std::string& name, const std::string& unit, Eigen::MatrixXd values) {
  return {name, unit, vector_components, std::move(values)};
}

/// Moves what acts on the four nodes of round shapes to the node of the body that is nearest to the point of contact.
void show_at_nearest(const dynamics::View& view, const std::vector<contact::ShapePoint>& points, Vectors& force) {
  for (const contact::ShapePoint& point : points) {
    const Vec3 push = point.pressed * point.normal, whole = push + point.friction;
    for (int first = point.nodes % 4; first < point.nodes; first += 4) {  // the last nodes are those of one shape or of two
      double sign = 0;
      for (int j = first; j < first + 4; ++j) {
        const auto at = static_cast<std::size_t>(j);
        force.col(point.node[at]) -= point.weight[at] * push + point.rub_weight[at] * point.friction, sign += point.weight[at];
      }
      Index nearest = point.node[static_cast<std::size_t>(first)];
      const auto body = static_cast<std::size_t>(view.model.rigid_of_node[static_cast<std::size_t>(nearest)]);
      for (const Index node : view.model.rigid_bodies[body].nodes)
        if ((view.now.x.col(node) - point.place).squaredNorm() < (view.now.x.col(nearest) - point.place).squaredNorm()) nearest = node;
      force.col(nearest) += sign * whole;
    }
  }
}

/// Contact forces on the nodes, of contacts between bodies and rigid planes. [N]
Vectors contact_forces(const dynamics::View& view) {
  Vectors force = Vectors::Zero(3, view.now.x.cols()), moment = Vectors::Zero(3, view.now.omega.cols());
  for (std::size_t c = 0; c < view.model.contacts.size(); ++c)
    contact::with_memory(view.model.contacts[c], view.now.contacts[c],
                         [&](const auto& one, const auto& memory) { contact::add_forces(one, memory, force, moment); });
  for (const contact::AnyMemory& any : view.now.contacts)
    if (const auto* memory = std::get_if<contact::Memory>(&any)) show_at_nearest(view, memory->shape_points, force);
  for (std::size_t p = 0; p < view.model.rigid_planes.size(); ++p)
    contact::add_forces(view.model.rigid_planes[p], view.now.rigid_planes[p], force);
  for (const contact::PlaneMemory& memory : view.now.rigid_planes) show_at_nearest(view, memory.shape_points, force);
  return force;
}

/// Fields of all blocks under one another, zero where a block has no such field.
std::vector<Field> element_fields(const dynamics::View& view, Eigen::Index total, FrameFields which) {
  std::vector<Field> all;
  Eigen::Index first = 0;
  for (std::size_t b = 0; b < view.model.blocks.size(); ++b) {
    const auto wanted = [which](const element::Shown& one) { return which == FrameFields::all || element::in_usual_frames(one); };
    const auto fields = element::fields(view.model.blocks[b], view.model.mesh.X, view.now.x, view.now.blocks[b], wanted);
    const Eigen::Index count = fields[0].values.cols();
    for (const Field& field : fields) {
      auto here = std::find_if(all.begin(), all.end(), [&](const Field& f) { return f.name == field.name; });
      if (here == all.end()) {
        all.push_back({field.name, field.unit, field.components, Eigen::MatrixXd::Zero(field.values.rows(), total), field.integer});
        here = std::prev(all.end());
      }
      here->values.middleCols(first, count) = field.values;
    }
    first += count;
  }
  return all;
}

constexpr double of_edges = 4;  // kind of an element, after those of features

/// Whether an edge is over another one, so that both are an element.
bool is_over(const contact::Crossing& crossing) { return crossing.side != 0 && !(crossing.weight[0] == 0 && crossing.weight[1] == 0); }

}  // namespace

Grid body_grid(const dynamics::View& view, FrameFields which) {
  const dynamics::Model& model = view.model;
  Grid grid;
  grid.time = view.now.t;
  grid.reference = model.mesh.X;
  grid.displacement = view.now.x - model.mesh.X;
  Eigen::Index total = 0;
  for (const auto& block : model.blocks) total += element::tiling(block).elements;
  const auto integers = [total](const char* name) { return scalar(name, "1", total, true); };
  Field part = integers("part_id"), number = integers("element_id"), body = integers("body");
  Eigen::Index first = 0;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const auto& block = model.blocks[b];
    const bool is_plate = element::nodes(block).rows() == 3;
    grid.cells.push_back({is_plate ? CellKind::triangle : CellKind::hexahedron, element::nodes(block)});
    const std::string name = element::name(block).substr(0, element::name(block).find('.'));
    const auto is_it = [&name](const auto& one) { return one.name == name; };
    auto here = std::find_if(grid.names.begin(), grid.names.end(), is_it);
    if (here == grid.names.end()) here = grid.names.insert(here, {name, static_cast<int>(grid.names.size()), is_plate ? 2 : 3});
    body.values.middleCols(first, element::tiling(block).elements).setConstant(here->number);
    for (Eigen::Index e = 0; e < element::tiling(block).elements; ++e) {
      part.values(0, first + e) = static_cast<double>(b);
      number.values(0, first + e) = static_cast<double>(e);
    }
    first += element::tiling(block).elements;
  }
  Field node = scalar("node_id", "1", model.mesh.X.cols(), true);
  for (Eigen::Index n = 0; n < model.mesh.X.cols(); ++n) node.values(0, n) = static_cast<double>(n);
  grid.point_fields.push_back(vector("velocity", "m/s", view.now.v));
  grid.point_fields.push_back(vector("contact_force", "N", contact_forces(view)));
  grid.point_fields.push_back(std::move(node));
  grid.cell_fields = element_fields(view, total, which);
  grid.cell_fields.push_back(std::move(body));
  grid.cell_fields.push_back(std::move(part));
  grid.cell_fields.push_back(std::move(number));
  return grid;
}

namespace {

/// Whether a frame has the element of an apex: one that acts, or with `all` also an open one that is no guard.
bool is_shown(const contact::Interface& interface, const contact::Memory& memory, Index apex, FrameFields which) {
  return memory.status[static_cast<std::size_t>(apex)] == contact::Status::closed ||
         (which == FrameFields::all && interface.heights != contact::Heights::guards);
}
bool is_shown(const contact::Crossing& crossing, FrameFields which) {
  return is_over(crossing) && (crossing.closed || which == FrameFields::all);
}

Eigen::Index elements_shown(const contact::Interface& interface, const contact::Memory& memory, FrameFields which) {
  Eigen::Index count = 0;
  for (Index a = 0; a < static_cast<Index>(interface.apexes.size()); ++a) count += is_shown(interface, memory, a, which);
  return count;
}
Eigen::Index elements_shown(const contact::EdgeContact&, const contact::EdgeMemory& memory, FrameFields which) {
  return std::count_if(memory.crossings.begin(), memory.crossings.end(), [which](const auto& one) { return is_shown(one, which); });
}

}  // namespace

Grid contact_grid(const dynamics::View& view, FrameFields which) {
  const dynamics::Model& model = view.model;
  Eigen::Index count = 0;
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    contact::with_memory(model.contacts[c], view.now.contacts[c],
                         [&](const auto& one, const auto& memory) { count += elements_shown(one, memory, which); });
  // five points for each element: foot, apex and the corners of the facet; of edges that cross their points, and the base edge with one
  Grid grid;
  grid.time = view.now.t;
  grid.reference = Vectors::Zero(3, 5 * count);
  grid.displacement = Vectors::Zero(3, 5 * count);
  Cells lines{CellKind::line, {}}, facets{CellKind::triangle, {}};
  lines.nodes.resize(2, count);
  facets.nodes.resize(3, count);
  std::vector<Field> cells = {scalar("part", "1", 2 * count, true),          scalar("interface_id", "1", 2 * count, true),
                              scalar("kind", "1", 2 * count, true),          scalar("base_id", "1", 2 * count, true),
                              scalar("apex_node", "1", 2 * count, true),     scalar("gap", "m", 2 * count),
                              scalar("contact_pressure", "Pa", 2 * count),   scalar("shear_traction", "Pa", 2 * count),
                              scalar("slides", "1", 2 * count, true),        scalar("contact_status", "1", 2 * count, true),
                              scalar("reconnect_count", "1", 2 * count, true)};
  Eigen::Index e = 0;
  const auto add = [&](const std::array<std::array<Vec3, 2>, 5>& points, const std::array<double, 11>& values) {
    for (Eigen::Index k = 0; k < 5; ++k) {
      const auto& [reference, now] = points[static_cast<std::size_t>(k)];
      grid.reference.col(5 * e + k) = reference;
      grid.displacement.col(5 * e + k) = now - reference;
    }
    const auto first = static_cast<Index>(5 * e);
    lines.nodes.col(e) << first, first + 1;
    facets.nodes.col(e) << first + 2, first + 3, first + 4;
    for (std::size_t f = 0; f < cells.size(); ++f) {
      cells[f].values(0, e) = values[f];
      cells[f].values(0, count + e) = f == 0 ? 1.0 : values[f];
    }
    ++e;
  };
  const auto at = [&](Index node) { return std::array<Vec3, 2>{model.mesh.X.col(node), view.now.x.col(node)}; };
  const auto add_apexes = [&](std::size_t c, const contact::Interface& interface, const contact::Memory& memory) {
    const std::vector<contact::NodeForce> forces = dynamics::forces_of_contact(view.model, view.now, c);
    for (Index a = 0; a < static_cast<Index>(interface.apexes.size()); ++a) {
      if (!is_shown(interface, memory, a, which)) continue;
      const auto element = contact::view(interface, view.now.x, memory, a);
      const dynamics::Traction traction = dynamics::traction_at(view, c, a, forces);
      const bool lost = element.feature.facet < 0;
      std::array<std::array<Vec3, 2>, 5> points;
      points[0] = {Vec3::Zero(), Vec3::Zero()};
      points[1] = at(element.apex);
      for (int k = 0; k < 3; ++k) {
        const Index node = lost ? element.apex : interface.base.facets(k, element.feature.facet);
        const double weight = lost ? 1.0 / 3.0 : element.weight[k];
        points[static_cast<std::size_t>(2 + k)] = at(node);
        for (std::size_t when = 0; when < 2; ++when) points[0][when] += weight * at(node)[when];
      }
      add(points, {0.0, static_cast<double>(c), lost ? 0.0 : static_cast<double>(element.feature.kind),
                   static_cast<double>(element.feature.facet), static_cast<double>(element.apex), lost ? interface.margin : element.gap,
                   traction.pressure, traction.shear, element.slides ? 1.0 : 0.0, static_cast<double>(element.status),
                   static_cast<double>(element.reconnections)});
    }
  };
  const auto add_edges = [&](std::size_t c, const contact::EdgeMemory& memory) {
    for (const contact::Crossing& crossing : memory.crossings) {
      if (!is_shown(crossing, which)) continue;
      std::array<std::array<Vec3, 2>, 5> points;
      for (std::size_t when = 0; when < 2; ++when) {
        points[0][when] = -crossing.weight[2] * at(crossing.node[2])[when] - crossing.weight[3] * at(crossing.node[3])[when];
        points[1][when] = crossing.weight[0] * at(crossing.node[0])[when] + crossing.weight[1] * at(crossing.node[1])[when];
      }
      points[2] = at(crossing.node[2]), points[3] = at(crossing.node[3]), points[4] = points[1];
      const bool slides = crossing.friction->acts && !crossing.friction->stuck;
      add(points, {0.0, static_cast<double>(c), of_edges, static_cast<double>(crossing.base_edge), static_cast<double>(crossing.node[0]),
                   crossing.gap, 0.0, 0.0, slides ? 1.0 : 0.0, crossing.closed ? 1.0 : 0.0, 0.0});
    }
  };
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    if (const contact::Interface* interface = contact::interface_of(model.contacts[c]))
      add_apexes(c, *interface, std::get<contact::Memory>(view.now.contacts[c]));
    else add_edges(c, std::get<contact::EdgeMemory>(view.now.contacts[c]));
  }
  grid.cells.push_back(std::move(lines)), grid.cells.push_back(std::move(facets));
  grid.cell_fields = std::move(cells);
  return grid;
}

Grid walls_grid(const dynamics::View& view) {
  std::vector<std::pair<Vec3, Vec3>> walls;
  for (const auto& plane : view.model.rigid_planes) walls.emplace_back(plane.point, plane.normal);
  for (const auto& plane : view.model.constraints.planes)
    if (plane.kind == load::PlaneKind::floor) walls.emplace_back(plane.point, plane.normal);
  const Vectors& X = view.model.mesh.X;
  const Vec3 low = X.rowwise().minCoeff(), high = X.rowwise().maxCoeff(), centre = 0.5 * (low + high);
  const double half = 0.5 * (high - low).norm();
  Grid grid;
  grid.reference = Vectors::Zero(3, static_cast<Eigen::Index>(4 * walls.size()));
  Cells triangles{CellKind::triangle, {}};
  triangles.nodes.resize(3, static_cast<Eigen::Index>(2 * walls.size()));
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const auto& [point, normal] = walls[w];
    const Vec3 middle = centre - normal * normal.dot(centre - point);
    const Vec3 along = normal.unitOrthogonal(), across = normal.cross(along);
    const auto first = static_cast<Index>(4 * w);
    for (int corner = 0; corner < 4; ++corner) {
      const double s = corner == 0 || corner == 3 ? -half : half, t = corner < 2 ? -half : half;
      grid.reference.col(first + corner) = middle + s * along + t * across;
    }
    triangles.nodes.col(first / 2) << first, first + 1, first + 2;
    triangles.nodes.col(first / 2 + 1) << first, first + 2, first + 3;
  }
  grid.displacement = Vectors::Zero(3, grid.reference.cols());
  grid.cells = {triangles};
  grid.cell_fields = {scalar("wall_id", "1", triangles.nodes.cols(), true)};
  for (Eigen::Index t = 0; t < triangles.nodes.cols(); ++t) grid.cell_fields[0].values(0, t) = static_cast<double>(t / 2);
  return grid;
}

}  // namespace nereid::output
