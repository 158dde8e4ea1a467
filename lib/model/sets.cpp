#include "model/sets.hpp"

#include <algorithm>

#include "base/words.hpp"
#include "mesh/facets.hpp"
#include "mesh/skin.hpp"
#include "model/meshes.hpp"

namespace nereid::model {

namespace {

constexpr double on_boundary = 1e-6;  // of the size of the body: places on a boundary are inside, round-off or not

/// The set of that name among the first `count` sets of a body: a set knows those before it only.
const Set* find_set(const Body& body, const std::string& name, std::size_t count) {
  for (std::size_t i = 0; i < std::min(count, body.sets.size()); ++i)
    if (body.sets[i].name == name) return &body.sets[i];
  return nullptr;
}
const Set* find_set(const Body& body, const std::string& name) { return find_set(body, name, body.sets.size()); }
std::size_t place_of(const Body& body, const Set& set) { return static_cast<std::size_t>(&set - body.sets.data()); }

/// Which of some things a set has, from those that a zone has and those of a name that is none of the body's sets.
template <class InZone, class OfName>
std::vector<char> members(const Body& body, const Set& set, const InZone& in_zone, const OfName& of_name) {
  const auto of = [&](const std::string& name) {
    const Set* other = find_set(body, name, place_of(body, set));
    return other != nullptr ? members(body, *other, in_zone, of_name) : of_name(name);
  };
  std::vector<char> all = set.zone ? in_zone(*set.zone) : std::vector<char>();
  const auto join = [&](const std::vector<std::string>& names, auto&& rule) {
    for (const std::string& name : names) {
      const std::vector<char> other = of(name);
      if (all.empty()) all = other;
      else for (std::size_t i = 0; i < all.size(); ++i) all[i] = rule(all[i] != 0, other[i] != 0) ? 1 : 0;
    }
  };
  join(set.any_of, [](bool a, bool b) { return a || b; });
  join(set.all_of, [](bool a, bool b) { return a && b; });
  join(set.without, [](bool a, bool b) { return a && !b; });
  return all;
}

Subset nodes_of(const std::vector<char>& in_set) {
  Subset nodes;
  for (std::size_t i = 0; i < in_set.size(); ++i)
    if (in_set[i] != 0) nodes.push_back(static_cast<Index>(i));
  return nodes;
}

Table<3> facets_within(const Table<3>& facets, const std::vector<char>& in_set) {
  mesh::Facets inside;
  for (const auto& facet : facets.colwise())
    if (std::all_of(facet.begin(), facet.end(), [&](Index node) { return in_set[static_cast<std::size_t>(node)] != 0; }))
      inside.add(facet(0), facet(1), facet(2));
  return inside.table();
}

void add_surfaces(const std::string& name, const Table<3>& skin, const std::vector<char>& in_set, mesh::Mesh& mesh) {
  const auto add = [&mesh](const std::string& surface, const Table<3>& facets) {
    if (facets.cols() > 0) mesh.surfaces.push_back({surface, facets});
  };
  add(name, facets_within(skin, in_set));
  mesh::Facets plates;
  for (const mesh::Triangles& region : mesh.triangles)
    for (const auto& t : region.nodes.colwise()) plates.add(t(0), t(1), t(2));
  const Table<3> top = facets_within(plates.table(), in_set);
  add(name + "_top", top), add(name + "_bottom", mesh::reversed(top));
}

/// How far beyond the boundary of a zone a place of the body still lies in it. [m]
double tolerance_of(const Body& body, const mesh::Mesh& mesh) {
  const Vectors X = mesh.X(Eigen::all, mesh::node_set(mesh, body.name));
  return on_boundary * (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm();
}

/// What a set names that is there before it; faults for what is not.
void check_members(const Body& body, const Set& set, const mesh::Mesh& mesh, Faults& faults) {
  const Part here = part("set", set);
  std::vector<std::string> known;
  for (const Set& one : body.sets) {
    if (&one == &set) break;
    known.push_back(one.name);
  }
  for (const mesh::NodeSet& one : mesh.node_sets)
    if (one.name.size() > body.name.size()) known.push_back(one.name.substr(body.name.size() + 1));
  const auto look = [&](const char* key, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string at = std::string(key) + "[" + std::to_string(i) + "]";
      if (names[i].rfind(body.name + ".", 0) == 0)
        refuse(faults, here, at, quote(names[i]) + " has the name of the body: expected " + quote(names[i].substr(body.name.size() + 1)));
      else expect(faults, here, at, names[i], "node sets of " + body.name + " and sets above this one", known);
    }
  };
  look("any_of", set.any_of), look("all_of", set.all_of), look("without", set.without);
  if (!set.zone && set.any_of.empty() && set.all_of.empty())
    refuse(faults, here, "", "a set needs one of box, cylinder, sphere, plane, half_space, any_of, all_of");
}

std::string place(const Vec3& x) { return formatted("(%.4g, %.4g, %.4g) m", x.x(), x.y(), x.z()); }

}  // namespace

bool holds(const Zone& zone, const Vec3& place, double tolerance) {
  switch (zone.kind) {
    case Zone::Kind::box: return ((place - zone.from).array() >= -tolerance).all() && ((zone.to - place).array() >= -tolerance).all();
    case Zone::Kind::sphere: return (place - zone.from).norm() <= zone.radius + tolerance;
    case Zone::Kind::plane: return std::abs((place - zone.from).dot(zone.normal)) <= tolerance;
    case Zone::Kind::half_space: return (place - zone.from).dot(zone.normal) >= -tolerance;
    case Zone::Kind::cylinder: break;
  }
  const Vec3 axis = (zone.to - zone.from).normalized(), from = place - zone.from;
  const double along = from.dot(axis);
  return along >= -tolerance && along <= (zone.to - zone.from).norm() + tolerance &&
         (from - along * axis).norm() <= zone.radius + tolerance;
}

Vectors middles(const Vectors& X, const element::Connectivity& nodes) {
  Vectors middle = Vectors::Zero(3, nodes.cols());
  for (Eigen::Index e = 0; e < nodes.cols(); ++e)
    for (Eigen::Index a = 0; a < nodes.rows(); ++a) middle.col(e) += X.col(nodes(a, e)) / static_cast<double>(nodes.rows());
  return middle;
}

namespace {

bool has_elements(const Body& body, const Set* set) {
  if (set == nullptr) return false;
  const auto has = [&](const std::string& one) { return has_elements(body, find_set(body, one, place_of(body, *set))); };
  if (set->zone) return set->zone->kind != Zone::Kind::plane && std::all_of(set->without.begin(), set->without.end(), has);
  return std::all_of(set->any_of.begin(), set->any_of.end(), has) && std::all_of(set->all_of.begin(), set->all_of.end(), has) &&
         std::all_of(set->without.begin(), set->without.end(), has);
}

}  // namespace

bool has_elements(const Body& body, const std::string& name) { return has_elements(body, find_set(body, name)); }

std::vector<char> elements_in(const Body& body, const std::string& name, const mesh::Mesh& mesh, const element::Connectivity& nodes) {
  if (!has_elements(body, name)) return {};
  const Vectors middle = middles(mesh.X, nodes);
  const double tolerance = tolerance_of(body, mesh);
  const auto in_zone = [&](const Zone& zone) {
    std::vector<char> inside(static_cast<std::size_t>(middle.cols()));
    for (Eigen::Index e = 0; e < middle.cols(); ++e) inside[static_cast<std::size_t>(e)] = holds(zone, middle.col(e), tolerance) ? 1 : 0;
    return inside;
  };
  const auto of_name = [&](const std::string&) { return std::vector<char>(static_cast<std::size_t>(middle.cols()), 0); };
  return members(body, *find_set(body, name), in_zone, of_name);
}

void add_sets(const Body& body, mesh::Mesh& mesh, Faults& faults) {
  if (body.sets.empty()) return;
  const double tolerance = tolerance_of(body, mesh);
  Table<3> skin = mesh.triangles.empty() ? mesh::surface(mesh, body.name + ".skin").facets : mesh::skin(mesh.X, mesh.hexahedra).facets;
  std::vector<std::string> wrong;  // sets at fault: what names them is not judged
  const auto in_zone = [&](const Zone& zone) {
    std::vector<char> inside(static_cast<std::size_t>(mesh.X.cols()));
    for (Eigen::Index n = 0; n < mesh.X.cols(); ++n) inside[static_cast<std::size_t>(n)] = holds(zone, mesh.X.col(n), tolerance) ? 1 : 0;
    return inside;
  };
  const auto of_name = [&](const std::string& name) {
    std::vector<char> inside(static_cast<std::size_t>(mesh.X.cols()), 0);
    for (const Index node : mesh::node_set(mesh, body.name + "." + name)) inside[static_cast<std::size_t>(node)] = 1;
    return inside;
  };
  const auto names_wrong = [&wrong](const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return std::find(wrong.begin(), wrong.end(), name) != wrong.end(); });
  };
  for (const Set& set : body.sets) {
    const Part here = part("set", set);
    const std::size_t before = faults.size();
    const std::string name = body.name + "." + set.name;
    const auto is_it = [&name](const auto& one) { return one.name == name; };
    if (std::any_of(mesh.node_sets.begin(), mesh.node_sets.end(), is_it) || std::any_of(mesh.surfaces.begin(), mesh.surfaces.end(), is_it))
      refuse(faults, here, "name", "'name' = " + set.name + " is that of a node set or surface of the mesh already");
    check_members(body, set, mesh, faults);
    if (faults.size() > before || names_wrong(set.any_of) || names_wrong(set.all_of) || names_wrong(set.without)) {
      wrong.push_back(set.name);
      continue;
    }
    const std::vector<char> in_set = members(body, set, in_zone, of_name);
    const Subset nodes = nodes_of(in_set);
    const auto has_some = [&](const auto& region) {
      const std::vector<char> inside = elements_in(body, set.name, mesh, region.nodes);
      return std::find(inside.begin(), inside.end(), 1) != inside.end();
    };
    if (nodes.empty() && std::none_of(mesh.hexahedra.begin(), mesh.hexahedra.end(), has_some) &&
        std::none_of(mesh.triangles.begin(), mesh.triangles.end(), has_some))
      refuse(faults, here, "", quote(set.name) + " has neither nodes nor elements: '" + body.name + "' reaches from " +
                                   place(mesh.X.rowwise().minCoeff()) + " to " + place(mesh.X.rowwise().maxCoeff()));
    if (nodes.empty()) continue;
    mesh.node_sets.push_back({name, nodes});
    add_surfaces(name, skin, in_set, mesh);
  }
}

}  // namespace nereid::model
