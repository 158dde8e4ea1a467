#include "model/meshes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/check.hpp"
#include "base/words.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/placement.hpp"
#include "mesh/skin.hpp"
#include "model/sets.hpp"

namespace nereid::model {

namespace {

constexpr double smallest = 1e-25;  // [m] of any body, and any side of an element, for the reason of `farthest`

double parts(mesh::Revolution turn) { return turn == mesh::Revolution::full ? 4 : 1; }

double parts(mesh::SpherePart part) {
  return part == mesh::SpherePart::full ? 8 : part == mesh::SpherePart::half ? 4 : part == mesh::SpherePart::quarter ? 2 : 1;
}

double cells_of_quarter(double core, double ring) { return core * core + 2 * core * ring; }

double elements(const mesh::Box& box) { return box.cells.cast<double>().prod(); }
double elements(const mesh::Cylinder& c) { return parts(c.turn) * cells_of_quarter(c.cells_core, c.cells_ring) * c.cells_along; }
double elements(const mesh::Tube& t) { return parts(t.turn) * 4.0 * t.cells_core * t.cells_along; }
double elements(const mesh::Wedge& w) { return 1.0 * w.cells_around * w.cells_radial * w.cells_along; }
double elements(const mesh::Revolved& r) { return mesh::count(r); }
double elements(const mesh::WedgeTube& t) { return 2.0 * t.cells_around * t.cells_along; }
double elements(const mesh::Sphere& s) {
  const double core = s.cells_core;
  return parts(s.part) * core * core * (core + 3.0 * s.cells_ring);
}
double elements(const mesh::Disc& d) { return 2 * parts(d.turn) * cells_of_quarter(d.cells_core, d.cells_ring); }
double elements(const mesh::WedgeDisc& d) { return d.cells_around * (2.0 * d.cells_radial - 1); }  // one triangle at the axis
double elements(const mesh::Sheet& s) { return 2.0 * s.cells_along * s.cells_across; }
double elements(const mesh::Mesh& m) {
  double sum = 0;
  for (const auto& region : m.hexahedra) sum += static_cast<double>(region.nodes.cols());
  for (const auto& region : m.triangles) sum += static_cast<double>(region.nodes.cols());
  return sum;
}

/// Throws InternalError for a given mesh that cannot be one: no nodes, numbers of nodes that are not there, names of another body.
void check_given(const mesh::Mesh& mesh) {
  const auto refuse_if = [](bool wrong, const std::string& what) { check(!wrong, ("the mesh " + what).c_str()); };
  const Eigen::Index nodes = mesh.X.cols();
  refuse_if(nodes == 0, "has no nodes");
  const auto look = [&](const char* kind, const std::string& name, const auto& numbers) {
    const std::string one = std::string(" its ") + kind + " " + quote(name);
    refuse_if(!name.empty() && name[0] != '.', "is yet without the name of its body, so its names begin with a point as '.x_low' does:" +
                                                   one + " does not");
    for (const Index node : numbers)
      refuse_if(node < 0 || node >= nodes, "has no node " + std::to_string(node) + ", which" + one + " names");
  };
  for (const mesh::Hexahedra& region : mesh.hexahedra) look("region", region.name, region.nodes.reshaped());
  for (const mesh::Triangles& region : mesh.triangles) look("region", region.name, region.nodes.reshaped());
  for (const mesh::Surface& surface : mesh.surfaces) look("surface", surface.name, surface.facets.reshaped());
  for (const mesh::NodeSet& set : mesh.node_sets) look("node set", set.name, set.nodes);
  const auto whole = [](const mesh::NodeSet& set) { return set.name.empty(); };
  refuse_if(std::none_of(mesh.node_sets.begin(), mesh.node_sets.end(), whole), "has no node set '' of all its nodes");
}

mesh::Mesh with_names(const std::string& name, mesh::Mesh mesh) {
  check_given(mesh);
  const auto prefix = [&name](auto& all) {
    for (auto& one : all) one.name = name + one.name;
  };
  prefix(mesh.hexahedra), prefix(mesh.triangles), prefix(mesh.surfaces), prefix(mesh.node_sets);
  return mesh;
}

/// What is wrong with the volumes and areas of a mesh whose nodes stood at `built`, or nothing.
std::string flat_or_inverted(const mesh::Mesh& mesh, const Vectors& built) {
  std::string said;
  int wrong = 0;
  const auto look_at = [&](const auto& region, const Scalars& size, const char* what) {
    for (Eigen::Index element = 0; element < size.size(); ++element) {
      if (size(element) > 0 || wrong++ > 0) continue;
      Vec3 from = Vec3::Zero(), to = Vec3::Zero();
      for (const Index node : region.nodes.col(element)) from += built.col(node), to += mesh.X.col(node);
      from /= region.nodes.rows(), to /= region.nodes.rows();
      said = formatted("leaves element %lld of '%s' no positive %s: %.4g. Its middle goes from (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g) m",
                       static_cast<long long>(element), region.name.c_str(), what, size(element), from.x(), from.y(), from.z(), to.x(),
                       to.y(), to.z());
    }
  };
  for (const mesh::Hexahedra& region : mesh.hexahedra) look_at(region, mesh::volumes(mesh, region), "volume");
  for (const mesh::Triangles& region : mesh.triangles) look_at(region, mesh::facet_areas(mesh, {"", region.nodes}), "area");
  return said + (wrong > 1 ? ", and " + std::to_string(wrong - 1) + " more" : std::string());
}

/// Gives names to the nodes nearest to the points of a body.
void name_points(const Body& body, mesh::Mesh& mesh, Faults& faults) {
  const Vec3 low = mesh.X.rowwise().minCoeff(), high = mesh.X.rowwise().maxCoeff();
  for (const Point& point : body.points) {
    const Part here = part("point", point);
    Eigen::Index nearest = 0;
    (mesh.X.colwise() - point.near).colwise().squaredNorm().minCoeff(&nearest);
    const double away = (point.near - point.near.cwiseMax(low).cwiseMin(high)).norm();
    if (away > 1e-3 * diagonal(mesh)) refuse(faults, here, "near", formatted("'near' lies %.4g m beside '%s'", away, body.name.c_str()));
    const std::string name = body.name + "." + point.name;
    for (const mesh::NodeSet& set : mesh.node_sets)
      if (set.name == name) refuse(faults, here, "name", "'name' = " + point.name + " is that of a node set of the mesh already");
    mesh.node_sets.push_back({name, {static_cast<Index>(nearest)}});
  }
}

/// Refuses or warns of what is wrong with the elements of a body where it stands. Shapes as they are built can only have lost their digits.
void judge(const Body& body, const Part& here, const mesh::Mesh& mesh, Faults& faults, MeshWarnings& warnings) {
  const bool is_given = std::holds_alternative<mesh::Mesh>(body.mesh), is_mapped = static_cast<bool>(body.map[0]);
  const std::vector<mesh::Finding> all = is_given || is_mapped ? mesh::judge(mesh, body.origin) : mesh::judge_digits(mesh);
  const std::vector<mesh::Finding> wrong = mesh::refused(all), doubtful = mesh::refused(all, false);
  const auto words = [&](const mesh::Finding& one) {
    return mesh::in_words(one, body.origin, body.origin.numbers.empty() ? "elements" : "cells");
  };
  std::string said;
  for (const mesh::Finding& one : wrong) said += (said.empty() ? "" : "; ") + words(one);
  if (!wrong.empty()) {
    refuse(faults, here, is_mapped ? "map" : "", (is_mapped ? "'map' makes a mesh with " : "the mesh has ") + said, mesh::where_shown);
    faults.back().offenders = {mesh::offenders(body.name, mesh, body.origin, wrong)};
    return;
  }
  for (const mesh::Finding& one : doubtful) warnings.texts.push_back(body.name + ": " + words(one) + " (" + mesh::where_shown + ")");
  if (!doubtful.empty()) warnings.offenders.push_back(mesh::offenders(body.name, mesh, body.origin, doubtful));
  for (const std::string& doubt : body.origin.doubts) warnings.texts.push_back(body.name + ": of its file, " + doubt);
  if (body.origin.lonely > 0)
    warnings.texts.push_back(body.name + ": its file has " + counted(static_cast<std::size_t>(body.origin.lonely), "point") +
                             " without an element (left out)");
}

/// The shortest way between two nodes of an element that are not at one place: the largest of its components. [m]
double shortest_side(const mesh::Mesh& mesh) {
  double least = farthest;
  const auto see = [&](const auto& nodes) {
    for (Eigen::Index e = 0; e < nodes.cols(); ++e)
      for (Eigen::Index a = 0; a < nodes.rows(); ++a)
        for (Eigen::Index b = 0; b < a; ++b) {
          const double side = (mesh.X.col(nodes(a, e)) - mesh.X.col(nodes(b, e))).cwiseAbs().maxCoeff();
          if (side > 0) least = std::min(least, side);
        }
  };
  for (const mesh::Hexahedra& region : mesh.hexahedra) see(region.nodes);
  for (const mesh::Triangles& region : mesh.triangles) see(region.nodes);
  return least;
}

/// The mesh of one body where it stands.
mesh::Mesh placed_mesh(const Body& body, Faults& faults, MeshWarnings& warnings) {
  Part here = part("body", body);
  if (!here.at.empty()) here.at += ".mesh";
  const std::size_t before = faults.size();
  mesh::Mesh mesh = make_mesh(body.name, body.mesh);
  if (std::holds_alternative<mesh::Mesh>(body.mesh)) {
    const std::string said = flat_or_inverted(mesh, mesh.X);
    if (!said.empty()) refuse(faults, here, "", "the mesh " + said);
  }
  if (body.scale != 1) mesh.X *= body.scale;
  if (body.map[0]) mesh = mapped(body.map, std::move(mesh), here, faults, body.origin);
  if (body.place.angle != 0) mesh = mesh::rotated_about(std::move(mesh), body.place.axis, body.place.angle, body.place.about);
  if (!body.place.move.isZero(0)) mesh = mesh::moved(std::move(mesh), body.place.move);
  if (!(mesh.X.cwiseAbs().maxCoeff() < farthest)) {  // also where it is no number
    const bool finite = mesh.X.allFinite();
    refuse(faults, here, "",
           finite ? formatted("a node stands %.4g m from the origin: expected less than %g m", mesh.X.cwiseAbs().maxCoeff(), farthest)
                  : "a node stands at no finite place");
  } else if (!(diagonal(mesh) > smallest)) {
    refuse(faults, here, "", formatted("the body is %.4g m across: expected more than %g m", diagonal(mesh), smallest));
  } else if (!(shortest_side(mesh) > smallest)) {
    refuse(faults, here, "", formatted("a side of an element is %.4g m long: expected more than %g m", shortest_side(mesh), smallest));
  }
  if (faults.size() == before) judge(body, here, mesh, faults, warnings);
  return mesh;
}

std::string body_of(const std::string& region) { return region.substr(0, region.find('.')); }

/// What the elements of a whole mesh are called in their bodies.
mesh::Origin origin_of(const Scene& scene, const mesh::Mesh& all) {
  std::map<std::string, std::int64_t> seen;
  mesh::Origin origin;
  const auto add = [&](const auto& regions) {
    for (const auto& region : regions)
      for (Eigen::Index e = 0; e < region.nodes.cols(); ++e) origin.numbers.push_back(seen[body_of(region.name)]++);
  };
  add(all.hexahedra), add(all.triangles);
  std::size_t next = 0;
  const auto as_in_its_file = [&](const auto& regions) {
    for (const auto& region : regions) {
      const auto is_its = [&](const Body& one) { return one.name == body_of(region.name); };
      const Body& body = *std::find_if(scene.bodies.begin(), scene.bodies.end(), is_its);
      for (Eigen::Index e = 0; e < region.nodes.cols(); ++e, ++next)
        if (!body.origin.numbers.empty()) origin.numbers[next] = body.origin.numbers[static_cast<std::size_t>(origin.numbers[next])];
    }
  };
  as_in_its_file(all.hexahedra), as_in_its_file(all.triangles);
  return origin;
}

/// Warns of bodies that are laid over each other, element on element, before a run that would find it at its end.
void warn_of_overlays(const Scene& scene, const mesh::Mesh& all, MeshWarnings& warnings) {
  constexpr std::size_t most = 8;  // told and shown
  std::map<std::array<std::string, 2>, mesh::Finding> over;
  for (const mesh::Overlay& one : mesh::overlays(all)) {
    if (body_of(one.regions[0]) == body_of(one.regions[1])) continue;
    mesh::Finding& found = over.try_emplace({body_of(one.regions[0]), body_of(one.regions[1])}, mesh::Finding{mesh::Flaw::laid_over, {}})
                               .first->second;
    found.elements.insert(found.elements.end(), one.elements.begin(), one.elements.end());
  }
  if (over.empty()) return;
  const mesh::Origin origin = origin_of(scene, all);
  std::size_t told = 0;
  for (auto& [bodies, found] : over) {
    if (told++ >= most) continue;
    std::sort(found.elements.begin(), found.elements.end());
    warnings.offenders.push_back(mesh::offenders(bodies[1], all, origin, {found}));
    warnings.texts.push_back(bodies[1] + ": lies on " + bodies[0] + ", " + mesh::in_words(found, origin) +
                             ": is the same body given twice? (" + mesh::where_shown + ")");
  }
  if (told > most) warnings.texts.push_back(counted(told - most, "more pair") + " of bodies that are laid over each other");
}

}  // namespace

double diagonal(const mesh::Mesh& mesh) { return (mesh.X.rowwise().maxCoeff() - mesh.X.rowwise().minCoeff()).norm(); }

double count_elements(const MeshOptions& options) {
  return std::visit([](const auto& one) { return elements(one); }, options);
}

bool has_plates(const MeshOptions& options) {
  if (const auto* given = std::get_if<mesh::Mesh>(&options)) return !given->triangles.empty();
  return std::holds_alternative<mesh::Tube>(options) || std::holds_alternative<mesh::WedgeTube>(options) ||
         std::holds_alternative<mesh::Disc>(options) || std::holds_alternative<mesh::WedgeDisc>(options) ||
         std::holds_alternative<mesh::Sheet>(options);
}

bool has_solids(const MeshOptions& options) {
  if (const auto* given = std::get_if<mesh::Mesh>(&options)) return !given->hexahedra.empty();
  return !has_plates(options);
}

namespace {

/// Both sides of the plates of a mesh, without those whose nodes all belong to other facets: these lie on the skin of solids.
Table<3> sides_of_plates(const mesh::Mesh& mesh, const Table<3>& facets) {
  const Subset taken = mesh::surface_nodes({"", facets});
  const auto is_taken = [&](Index node) { return std::binary_search(taken.begin(), taken.end(), node); };
  std::vector<Index> nodes;
  for (const mesh::Triangles& region : mesh.triangles)
    for (const auto& triangle : region.nodes.colwise())
      if (!std::all_of(triangle.begin(), triangle.end(), is_taken)) nodes.insert(nodes.end(), triangle.begin(), triangle.end());
  return mesh::both_sides(Eigen::Map<const Table<3>>(nodes.data(), 3, static_cast<Eigen::Index>(nodes.size() / 3)));
}

/// The mesh with its skin as a surface and a node set: the outer faces of solids, and both sides of plates.
mesh::Mesh with_skin(const std::string& name, mesh::Mesh mesh) {
  const std::string skin = name + ".skin";
  const auto is_skin = [&](const auto& one) { return one.name == skin; };
  auto surface = std::find_if(mesh.surfaces.begin(), mesh.surfaces.end(), is_skin);
  if (surface == mesh.surfaces.end()) surface = mesh.surfaces.insert(surface, {skin, mesh::skin(mesh.X, mesh.hexahedra).facets});
  const Table<3> solids = surface->facets, plates = sides_of_plates(mesh, solids);
  surface->facets.resize(3, solids.cols() + plates.cols());
  surface->facets << solids, plates;
  const auto set = std::find_if(mesh.node_sets.begin(), mesh.node_sets.end(), is_skin);
  if (set == mesh.node_sets.end()) mesh.node_sets.push_back({skin, mesh::surface_nodes(*surface)});
  else set->nodes = mesh::surface_nodes(*surface);
  return mesh;
}

}  // namespace

mesh::Mesh make_mesh(const std::string& name, const MeshOptions& options) {
  struct Make {
    const std::string& name;
    mesh::Mesh operator()(const mesh::Box& one) const { return mesh::box(name, one); }
    mesh::Mesh operator()(const mesh::Cylinder& one) const { return mesh::cylinder(name, one); }
    mesh::Mesh operator()(const mesh::Tube& one) const { return mesh::tube(name, one); }
    mesh::Mesh operator()(const mesh::Wedge& one) const { return mesh::wedge(name, one); }
    mesh::Mesh operator()(const mesh::Revolved& one) const { return mesh::revolved(name, one); }
    mesh::Mesh operator()(const mesh::WedgeTube& one) const { return mesh::wedge_tube(name, one); }
    mesh::Mesh operator()(const mesh::Sphere& one) const { return mesh::sphere(name, one); }
    mesh::Mesh operator()(const mesh::Disc& one) const { return mesh::disc(name, one); }
    mesh::Mesh operator()(const mesh::WedgeDisc& one) const { return mesh::wedge_disc(name, one); }
    mesh::Mesh operator()(const mesh::Sheet& one) const { return mesh::sheet(name, one); }
    mesh::Mesh operator()(const mesh::Mesh& one) const { return with_names(name, one); }
  };
  return with_skin(name, std::visit(Make{name}, options));
}

mesh::Mesh mapped(const Field& map, mesh::Mesh mesh, const Part& part, Faults& faults, const mesh::Origin& origin) {
  const Vectors built = mesh.X;
  for (Eigen::Index node = 0; node < built.cols(); ++node) {
    const Vec3 from = built.col(node);
    for (int axis = 0; axis < 3; ++axis) mesh.X(axis, node) = map[axis](from.x(), from.y(), from.z(), 0);
    if (mesh.X.col(node).allFinite()) continue;
    refuse(faults, part, "map", formatted("'map' is no finite number at x = %.6g, y = %.6g, z = %.6g", from.x(), from.y(), from.z()));
    mesh.X = built;
    return mesh;
  }
  const std::string said = flat_or_inverted(mesh, built);
  if (said.empty()) return mesh;
  refuse(faults, part, "map", "'map' " + said, mesh::where_shown);
  const std::string body = body_of(mesh.hexahedra.empty() ? mesh.triangles.front().name : mesh.hexahedra.front().name);
  faults.back().offenders = {mesh::offenders(body, mesh, origin, mesh::refused(mesh::judge(mesh, origin)))};
  mesh.X = built;
  return mesh;
}

mesh::Mesh make_mesh(const Scene& scene, Faults& faults, MeshWarnings& warnings) {
  const std::size_t before = faults.size();
  mesh::Mesh all;
  for (const Body& body : scene.bodies) {
    try {
      if (!(count_elements(body.mesh) <= most_elements)) throw InternalError("the mesh would have more than a hundred million elements");
      mesh::Mesh here = placed_mesh(body, faults, warnings);
      name_points(body, here, faults);
      add_sets(body, here, faults);
      all = all.X.cols() == 0 ? here : mesh::join(all, here);
    } catch (const InternalError& error) {  // readers have refused such options, scenes made in C++ may have them
      refuse(faults, part("body", body), "mesh", error.what());
    }
  }
  if (scene.bodies.size() > 1 && faults.size() == before) warn_of_overlays(scene, all, warnings);
  return all;
}

}  // namespace nereid::model
