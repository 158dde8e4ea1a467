#include "mesh/judge.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "base/words.hpp"
#include "mesh/skin.hpp"

namespace nereid::mesh {
namespace {

constexpr double flat = 1e-9;          // [-] of the edges of a corner or the side of a triangle: no volume, no area
constexpr double digits = 1e6;         // [-] of an edge over the round-off of its coordinates
constexpr double near = 1e-5;          // [-] of an edge: nodes that near are at one place
constexpr double folded = 1e-6;        // [rad] between two triangles at an edge: they lie on each other
constexpr std::size_t most_named = 8;  // enough to find elements, few enough for a line

/// The nodes at the other ends of the three edges of each corner, right-handed.
constexpr int ends[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};

/// All elements of a mesh, counted over its regions.
class Elements {
 public:
  explicit Elements(const Mesh& mesh) {
    for (const Hexahedra& region : mesh.hexahedra) add(region.name, region.nodes.data(), 8, region.nodes.cols());
    solids_ = static_cast<Index>(first_.size());
    for (const Triangles& region : mesh.triangles) add(region.name, region.nodes.data(), 3, region.nodes.cols());
  }
  Index count() const { return static_cast<Index>(first_.size()); }
  Index solids() const { return solids_; }
  bool is_solid(Index e) const { return e < solids_; }
  int corners(Index e) const { return is_solid(e) ? 8 : 3; }
  const Index* nodes(Index e) const { return first_[static_cast<std::size_t>(e)]; }
  Index region(Index e) const { return region_[static_cast<std::size_t>(e)]; }
  const std::string& name(Index region) const { return names_[static_cast<std::size_t>(region)]; }

  /// Calls visit(a, b) for each two corners of an element that an edge joins.
  void edges(Index e, auto&& visit) const {
    if (!is_solid(e)) visit(0, 1), visit(1, 2), visit(2, 0);
    for (int corner = 0; is_solid(e) && corner < 8; ++corner)
      for (const int end : ends[corner])
        if (corner < end) visit(corner, end);
  }

 private:
  void add(const std::string& name, const Index* nodes, int corners, Eigen::Index count) {
    for (Eigen::Index e = 0; e < count; ++e) first_.push_back(nodes + corners * e), region_.push_back(static_cast<Index>(names_.size()));
    names_.push_back(name);
  }
  std::vector<const Index*> first_;
  std::vector<Index> region_;
  std::vector<std::string> names_;
  Index solids_ = 0;
};

/// Elements by flaw, each once.
class Found {
 public:
  void add(Flaw flaw, Index element) { elements_[flaw].push_back(element); }
  bool empty() const { return elements_.empty(); }
  /// Which of all elements have a flaw so far.
  std::vector<char> which(Flaw flaw, Index count) const {
    std::vector<char> has(static_cast<std::size_t>(count), 0);
    const auto at = elements_.find(flaw);
    if (at != elements_.end())
      for (const Index e : at->second) has[static_cast<std::size_t>(e)] = 1;
    return has;
  }
  std::vector<Finding> findings() {
    std::vector<Finding> all;
    for (auto& [flaw, elements] : elements_) {
      std::sort(elements.begin(), elements.end());
      elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
      all.push_back({flaw, std::move(elements)});
    }
    return all;
  }

 private:
  std::map<Flaw, std::vector<Index>> elements_;
};

void look_at_digits(const Mesh& mesh, const Elements& all, Found& found) {
  for (Index e = 0; e < all.count(); ++e) {
    const Index* nodes = all.nodes(e);
    double farthest = 0, shortest = INFINITY;
    for (int a = 0; a < all.corners(e); ++a) farthest = std::max(farthest, mesh.X.col(nodes[a]).cwiseAbs().maxCoeff());
    all.edges(e, [&](int a, int b) {
      const double length = (mesh.X.col(nodes[a]) - mesh.X.col(nodes[b])).norm();
      if (length > 0) shortest = std::min(shortest, length);
    });
    const bool is_point = shortest == INFINITY;  // all that it had is lost
    if (is_point ? farthest > 0 : shortest <= digits * std::numeric_limits<double>::epsilon() * farthest) found.add(Flaw::far_away, e);
  }
}

/// Whether a hexahedron of some volume has a positive Jacobian at its eight Gauss points.
bool has_sound_gauss_points(const Vectors& X, const Index* nodes, double volume) {
  constexpr double closer = 0.78867513459481287, farther = 1 - closer;  // (1 + 1/sqrt 3)/2: weights of the two ends of an edge
  // corners at the ends of the four edges along each direction; the bits of a corner are those of the directions in which it is far
  constexpr int along[3][4][2] = {{{0, 1}, {3, 2}, {4, 5}, {7, 6}}, {{0, 3}, {1, 2}, {4, 7}, {5, 6}}, {{0, 4}, {1, 5}, {3, 7}, {2, 6}}};
  for (int point = 0; point < 8; ++point) {
    const auto weight = [&](int direction, bool end) { return ((point >> direction & 1) != 0) == end ? closer : farther; };
    Mat3 J = Mat3::Zero();
    for (int direction = 0; direction < 3; ++direction) {
      const int second = direction == 0 ? 1 : 0, third = direction == 2 ? 1 : 2;
      for (int edge = 0; edge < 4; ++edge)
        J.col(direction) += weight(second, (edge & 1) != 0) * weight(third, (edge & 2) != 0) *
                            (X.col(nodes[along[direction][edge][1]]) - X.col(nodes[along[direction][edge][0]]));
    }
    if (!(J.col(0).cross(J.col(1)).dot(J.col(2)) > flat * volume)) return false;
  }
  return true;
}

/// Whether each corner of a hexahedron that has three edges has a volume.
bool has_sound_corners(const Vectors& X, const Index* nodes) {
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 edge[3];
    double product = 1;
    for (int i = 0; i < 3; ++i) edge[i] = X.col(nodes[ends[corner][i]]) - X.col(nodes[corner]), product *= edge[i].norm();
    if (product > 0 && !(edge[0].cross(edge[1]).dot(edge[2]) > flat * product)) return false;
  }
  return true;
}

/// Whether the faces of a hexahedron with corners at one place are still those of a solid: each a polygon, or nothing, and no two with
/// three corners in common.
bool has_sound_faces(const Vectors& X, const Index* nodes) {
  std::array<int, 8> place;  // of each corner: the first one there
  for (int a = 0; a < 8; ++a)
    for (place[a] = 0; X.col(nodes[place[a]]) != X.col(nodes[a]);) ++place[a];
  if (std::adjacent_find(place.begin(), place.end(), std::greater_equal<>{}) == place.end()) return true;  // all differ
  std::array<std::vector<int>, 6> polygon;
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < 4; ++i) {
      const int here = place[corners_of_faces[face][i]], next = place[corners_of_faces[face][(i + 1) % 4]];
      if (here != next) polygon[face].push_back(here);
    }
    std::sort(polygon[face].begin(), polygon[face].end());
    if (std::adjacent_find(polygon[face].begin(), polygon[face].end()) != polygon[face].end()) return false;
    for (int before = 0; before < face; ++before) {
      std::vector<int> common;
      std::set_intersection(polygon[face].begin(), polygon[face].end(), polygon[before].begin(), polygon[before].end(),
                            std::back_inserter(common));
      if (common.size() > 2) return false;
    }
  }
  return true;
}

Vec3 twice_area(const Vectors& X, const Index* t) {
  const Vec3 origin = X.col(t[0]);
  return (X.col(t[1]) - origin).cross(X.col(t[2]) - origin);
}

bool has_area(const Vectors& X, const Index* t) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, (X.col(t[(i + 1) % 3]) - X.col(t[i])).squaredNorm());
  return twice_area(X, t).norm() > flat * longest;
}

/// The next element if both are halves of one quadrilateral, else -1.
Index other_half(const Elements& all, const Origin& origin, Index e) {
  if (origin.numbers.empty() || all.is_solid(e) || e + 1 >= all.count() || all.region(e) != all.region(e + 1)) return -1;
  return origin.numbers[static_cast<std::size_t>(e)] == origin.numbers[static_cast<std::size_t>(e) + 1] ? e + 1 : -1;
}

void look_at_shapes(const Mesh& mesh, const Elements& all, const Origin& origin, Found& found) {
  Index e = 0;
  for (const Hexahedra& region : mesh.hexahedra) {
    const Scalars volume = volumes(mesh, region);
    for (Index i = 0; i < volume.size(); ++i, ++e)
      if (!(volume(i) > 0) || !has_sound_gauss_points(mesh.X, all.nodes(e), volume(i)))
        found.add(Flaw::inverted, e);
      else if (!has_sound_faces(mesh.X, all.nodes(e)))
        found.add(Flaw::misfolded, e);
      else if (!has_sound_corners(mesh.X, all.nodes(e)))
        found.add(Flaw::dented, e);
  }
  for (; e < all.count(); ++e) {
    if (!has_area(mesh.X, all.nodes(e))) found.add(Flaw::no_area, e);
    const Index other = other_half(all, origin, e);
    if (other >= 0 && twice_area(mesh.X, all.nodes(e)).dot(twice_area(mesh.X, all.nodes(other))) < 0)
      found.add(Flaw::folded, e), found.add(Flaw::folded, other);
  }
}

/// Nodes in ascending order, -1 for those that are not there: all that can be said of an element whatever its order.
using Key = std::array<Index, 8>;

Key key_of(const Index* nodes, int count, const std::vector<Index>* places = nullptr) {
  Key key;
  key.fill(-1);
  for (int a = 0; a < count; ++a) key[a] = places == nullptr ? nodes[a] : (*places)[static_cast<std::size_t>(nodes[a])];
  std::sort(key.begin(), key.end());
  return key;
}

struct Keyed {
  Key key;
  Index element;
  friend bool operator<(const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.element < b.element; }
};

/// Elements, and quadrilaterals as a whole, by their nodes or by their places.
std::vector<Keyed> keys(const Elements& all, const Origin& origin, const std::vector<Index>* places = nullptr) {
  std::vector<Keyed> keyed;
  for (Index e = 0; e < all.count(); ++e) {
    keyed.push_back({key_of(all.nodes(e), all.corners(e), places), e});
    const Index other = other_half(all, origin, e);
    if (other < 0) continue;
    const Index *one = all.nodes(e), corners[4] = {one[0], one[1], one[2], all.nodes(other)[1]};  // as cut: 0 1 2 and 2 3 0
    keyed.push_back({key_of(corners, 4, places), e});
  }
  std::sort(keyed.begin(), keyed.end());
  return keyed;
}

/// Calls visit(begin, end) for each group of more than one that are alike.
void groups(const auto& sorted, auto&& alike, auto&& visit) {
  for (auto begin = sorted.begin(); begin != sorted.end();) {
    auto end = begin + 1;
    while (end != sorted.end() && alike(*begin, *end)) ++end;
    if (end - begin > 1) visit(begin, end);
    begin = end;
  }
}

constexpr auto same_key = [](const auto& a, const auto& b) { return a.key == b.key; };

/// Elements on the same nodes. Returns which are not the first on theirs.
std::vector<char> look_at_repeated(const Elements& all, const Origin& origin, Found& found) {
  std::vector<char> is_copy(static_cast<std::size_t>(all.count()), 0);
  groups(keys(all, origin), same_key, [&](auto begin, auto end) {
    for (auto one = begin; one != end; ++one) {
      found.add(Flaw::repeated, one->element);
      if (one != begin) is_copy[static_cast<std::size_t>(one->element)] = 1;
    }
  });
  return is_copy;
}

/// A face of a hexahedron with at least three different nodes.
struct SolidFace {
  std::array<Index, 4> key;  ///< ascending; the first is -1 if there are three
  Index element;
  int at;  ///< place in corners_of_faces
  friend bool operator<(const SolidFace& a, const SolidFace& b) { return a.key != b.key ? a.key < b.key : a.element < b.element; }
};

/// Nodes around a face, each once, counter-clockwise seen from outside; the fourth is -1 if there are three.
std::array<Index, 4> around(const Index* nodes, int at, int& count) {
  std::array<Index, 4> corners{-1, -1, -1, -1};
  count = 0;
  for (const int corner : corners_of_faces[at])
    if (std::find(corners.begin(), corners.end(), nodes[corner]) == corners.end())
      corners[static_cast<std::size_t>(count++)] = nodes[corner];
  return corners;
}

std::vector<SolidFace> faces_of_solids(const Elements& all, const std::vector<char>& left_out) {
  std::vector<SolidFace> faces;
  for (Index e = 0; e < all.solids(); ++e)
    for (int at = 0; at < 6 && !left_out[static_cast<std::size_t>(e)]; ++at) {
      int count = 0;
      SolidFace face{around(all.nodes(e), at, count), e, at};
      if (count < 3) continue;
      std::sort(face.key.begin(), face.key.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// Whether two hexahedra go around their face in the same direction, so that both are on one side of it.
bool on_same_side(const Elements& all, const SolidFace& one, const SolidFace& other) {
  int count = 0;
  const auto a = around(all.nodes(one.element), one.at, count), b = around(all.nodes(other.element), other.at, count);
  const auto first = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  return b[(first + 1) % static_cast<std::size_t>(count)] == a[1];
}

/// Sets that are joined two by two.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t one) {
    while (parent_[one] != one) one = parent_[one] = parent_[parent_[one]];
    return one;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

/// Corners of all elements, counted over all, and which of those at a node hang together.
class Joints {
 public:
  explicit Joints(const Elements& all)
      : all_(all), sets_(8 * static_cast<std::size_t>(all.solids()) + 3 * static_cast<std::size_t>(all.count() - all.solids())) {}

  /// Joins the corners of two elements at a node that both have.
  void join(Index one, Index other, Index node) {
    const std::size_t a = corner(one, node), b = corner(other, node);
    if (a != none && b != none) sets_.join(a, b);
  }

  /// Elements at nodes where not all hang together.
  void hinged(std::size_t nodes, const std::vector<char>& left_out, Found& found) {
    std::vector<std::size_t> root_at(nodes, none);
    std::vector<char> is_hinge(nodes, 0);
    each([&](Index element, Index node, std::size_t corner) {
      if (left_out[static_cast<std::size_t>(element)]) return;
      std::size_t& first = root_at[static_cast<std::size_t>(node)];
      if (first == none)
        first = sets_.root(corner);
      else if (first != sets_.root(corner))
        is_hinge[static_cast<std::size_t>(node)] = 1;
    });
    each([&](Index element, Index node, std::size_t) {
      if (!left_out[static_cast<std::size_t>(element)] && is_hinge[static_cast<std::size_t>(node)]) found.add(Flaw::hinged, element);
    });
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::size_t first(Index e) const {
    const auto solids = static_cast<std::size_t>(all_.solids()), element = static_cast<std::size_t>(e);
    return all_.is_solid(e) ? 8 * element : 8 * solids + 3 * (element - solids);
  }
  /// The first corner of an element on a node: coincident corners are one.
  std::size_t corner(Index e, Index node) const {
    const Index* nodes = all_.nodes(e);
    const Index* at = std::find(nodes, nodes + all_.corners(e), node);
    return at == nodes + all_.corners(e) ? none : first(e) + static_cast<std::size_t>(at - nodes);
  }
  void each(auto&& visit) const {
    for (Index e = 0; e < all_.count(); ++e)
      for (int a = 0; a < all_.corners(e); ++a) visit(e, all_.nodes(e)[a], corner(e, all_.nodes(e)[a]));
  }

  const Elements& all_;
  Sets sets_;
};

/// Sides of triangles, and three corners of faces of solids, to find which elements have them.
struct Side {
  std::array<Index, 3> key;  ///< the third -1 of a side of a triangle
  Index element;
  friend bool operator<(const Side& a, const Side& b) { return a.key != b.key ? a.key < b.key : a.element < b.element; }
};

void join_triangles(const Elements& all, const std::vector<SolidFace>& faces, Joints& joints) {
  std::vector<Side> sides;
  for (Index e = all.solids(); e < all.count(); ++e) {
    const Index* t = all.nodes(e);
    for (int i = 0; i < 3; ++i) sides.push_back({{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3]), -1}, e});
    Side whole{{t[0], t[1], t[2]}, e};
    std::sort(whole.key.begin(), whole.key.end());
    sides.push_back(whole);
  }
  if (sides.empty()) return;
  for (const SolidFace& face : faces)
    for (int left_out = 0; left_out < 4; ++left_out) {  // of three corners the first key is -1: only without it there is a triple
      Side side{{-1, -1, -1}, face.element};
      for (int i = 0, to = 0; i < 4; ++i)
        if (i != left_out) side.key[to++] = face.key[i];
      if (side.key[0] >= 0) sides.push_back(side);
    }
  std::sort(sides.begin(), sides.end());
  groups(sides, same_key, [&](auto begin, auto end) {
    for (auto one = begin + 1; one != end; ++one)
      for (const Index node : begin->key)
        if (node >= 0) joints.join(begin->element, one->element, node);
  });
}

/// Triangles that lie on each other at an edge, and the only two at an edge that run along it in the same direction.
void look_at_edges(const Mesh& mesh, const Elements& all, const std::vector<char>& is_copy, Found& found) {
  struct AtEdge {
    std::array<Index, 2> key;  // its nodes, ascending
    Index element;
    int at;  // the corner from which the triangle runs along it to the next one
    double angle = 0;
    bool operator<(const AtEdge& other) const { return key != other.key ? key < other.key : element < other.element; }
  };
  std::vector<AtEdge> sides;
  const std::vector<char> is_flat = found.which(Flaw::no_area, all.count()), is_folded = found.which(Flaw::folded, all.count());
  for (Index e = all.solids(); e < all.count(); ++e) {
    const Index* t = all.nodes(e);
    const auto here = static_cast<std::size_t>(e);
    if (is_copy[here] || is_flat[here] || is_folded[here]) continue;  // nothing else is said of these
    for (int i = 0; i < 3; ++i) sides.push_back({{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}, e, i});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<AtEdge> turning;
  groups(sides, same_key, [&](auto begin, auto end) {
    // angles about the edge, from the first triangle on: those of triangles that lie on each other are one, also across a whole turn
    const Vec3 from = mesh.X.col(begin->key[0]), along = (mesh.X.col(begin->key[1]) - from).normalized();
    const auto across = [&](const AtEdge& one) {
      const Vec3 to = mesh.X.col(all.nodes(one.element)[(one.at + 2) % 3]) - from;
      return Vec3(to - to.dot(along) * along);
    };
    const Vec3 first = across(*begin), second = along.cross(first);
    turning.assign(begin, end);
    for (AtEdge& one : turning) one.angle = std::atan2(across(one).dot(second), across(one).dot(first));
    std::sort(turning.begin(), turning.end(), [](const AtEdge& a, const AtEdge& b) { return a.angle < b.angle; });
    bool any = false;
    for (std::size_t one = 0; one < turning.size(); ++one) {
      const bool is_last = one + 1 == turning.size();
      const AtEdge& next = turning[is_last ? 0 : one + 1];
      if (next.angle + (is_last ? 2 * std::numbers::pi : 0) - turning[one].angle >= folded) continue;
      found.add(Flaw::flat_fold, turning[one].element), found.add(Flaw::flat_fold, next.element), any = true;
    }
    const auto start = [&](const AtEdge& one) { return all.nodes(one.element)[one.at]; };
    if (!any && end - begin == 2 && start(*begin) == start(*(begin + 1)))
      found.add(Flaw::opposed, begin->element), found.add(Flaw::opposed, (begin + 1)->element);
  });
}

void look_at_joints(const Mesh& mesh, const Elements& all, const std::vector<char>& is_copy, Found& found) {
  const std::vector<SolidFace> faces = faces_of_solids(all, is_copy);
  const std::vector<char> is_inverted = found.which(Flaw::inverted, all.count());
  const auto in_order = [&](const SolidFace& face) { return !is_inverted[static_cast<std::size_t>(face.element)]; };
  Joints joints(all);
  groups(faces, same_key, [&](auto begin, auto end) {
    if (end - begin > 2)
      for (auto one = begin; one != end; ++one) found.add(Flaw::crowded, one->element);
    else if (in_order(*begin) && in_order(*(begin + 1)) && on_same_side(all, *begin, *(begin + 1)))
      found.add(Flaw::same_side, begin->element), found.add(Flaw::same_side, (begin + 1)->element);
    for (auto one = begin + 1; one != end; ++one)
      for (const Index node : one->key)
        if (node >= 0) joints.join(begin->element, one->element, node);
  });
  join_triangles(all, faces, joints);
  joints.hinged(static_cast<std::size_t>(mesh.X.cols()), is_copy, found);
}

/// The shortest edge at each node, but for edges of no length; infinite where there is none. [m] [nodes]
Scalars shortest_edges(const Vectors& X, const Elements& all) {
  Scalars shortest = Scalars::Constant(X.cols(), INFINITY);
  for (Index e = 0; e < all.count(); ++e) {
    const Index* nodes = all.nodes(e);
    all.edges(e, [&](int a, int b) {
      const double length = (X.col(nodes[a]) - X.col(nodes[b])).norm();
      if (!(length > 0)) return;
      shortest(nodes[a]) = std::min(shortest(nodes[a]), length);
      shortest(nodes[b]) = std::min(shortest(nodes[b]), length);
    });
  }
  return shortest;
}

std::vector<Index> places(const Vectors& X, const Elements& all) {
  const auto count = static_cast<std::size_t>(X.cols());
  std::vector<Index> first(count);
  std::iota(first.begin(), first.end(), Index{0});
  Scalars reach = near * shortest_edges(X, all);
  double most = 0;
  for (double& one : reach) {
    if (!std::isfinite(one)) one = -1;  // of no element: nothing is there with it
    most = std::max(most, one);
  }
  if (!(most > 0)) return first;
  // nodes by the cells of a grid so wide that a node and what is in its reach lie in one cell or in neighbours
  const Vec3 low = X.rowwise().minCoeff();
  const double width = std::max(4 * most, 1e-15 * (X.rowwise().maxCoeff() - low).maxCoeff());  // so that cells can be numbered
  using Cell = std::array<std::int64_t, 3>;
  struct At {
    Cell cell;
    Index node;
    bool operator<(const At& other) const { return cell != other.cell ? cell < other.cell : node < other.node; }
  };
  const auto cell_of = [&](const Vec3& x) {
    Cell cell;
    for (int i = 0; i < 3; ++i) cell[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor((x(i) - low(i)) / width));
    return cell;
  };
  std::vector<At> sorted(count);
  for (std::size_t n = 0; n < count; ++n) sorted[n] = {cell_of(X.col(static_cast<Index>(n))), static_cast<Index>(n)};
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t n = 0; n < count; ++n) {
    const auto node = static_cast<Index>(n);
    const Vec3 x = X.col(node);
    const Cell from = cell_of(x - Vec3::Constant(most)), to = cell_of(x + Vec3::Constant(most));
    for (std::int64_t i = from[0]; i <= to[0]; ++i)
      for (std::int64_t j = from[1]; j <= to[1]; ++j)
        for (std::int64_t k = from[2]; k <= to[2]; ++k) {
          const Cell cell{i, j, k};
          for (auto at = std::lower_bound(sorted.begin(), sorted.end(), At{cell, 0});
               at != sorted.end() && at->cell == cell && at->node < node; ++at)
            if ((X.col(at->node) - x).norm() <= std::min(reach(node), reach(at->node)))
              first[n] = std::min(first[n], first[static_cast<std::size_t>(at->node)]);
        }
  }
  return first;
}

/// Elements that have a node beside another one, and those that lie on others altogether.
void look_at_places(const Mesh& mesh, const Elements& all, const Origin& origin, const std::vector<char>& is_copy, Found& found) {
  const std::vector<Index> first = places(mesh.X, all);
  std::vector<char> is_shared(first.size(), 0);
  bool any = false;
  for (std::size_t n = 0; n < first.size(); ++n)
    if (first[n] != static_cast<Index>(n)) is_shared[n] = is_shared[static_cast<std::size_t>(first[n])] = 1, any = true;
  if (!any) return;
  for (Index e = 0; e < all.count(); ++e)
    for (int a = 0; a < all.corners(e); ++a)
      if (is_shared[static_cast<std::size_t>(all.nodes(e)[a])]) found.add(Flaw::coincident, e);
  groups(keys(all, origin, &first), same_key, [&](auto begin, auto end) {
    for (auto one = begin; one != end; ++one)
      if (!is_copy[static_cast<std::size_t>(one->element)] && std::any_of(begin, end, [&](const Keyed& other) {
            return key_of(all.nodes(other.element), all.corners(other.element)) !=
                   key_of(all.nodes(one->element), all.corners(one->element));
          }))
        found.add(Flaw::laid_over, one->element);
  });
}

}  // namespace

std::vector<Finding> judge(const Mesh& mesh, const Origin& origin) {
  const Elements all(mesh);
  Found found;
  look_at_digits(mesh, all, found);
  if (!found.empty()) return found.findings();
  look_at_shapes(mesh, all, origin, found);
  const std::vector<char> is_copy = look_at_repeated(all, origin, found);
  look_at_joints(mesh, all, is_copy, found);
  look_at_edges(mesh, all, is_copy, found);
  look_at_places(mesh, all, origin, is_copy, found);
  return found.findings();
}

std::vector<Finding> judge_digits(const Mesh& mesh) {
  Found found;
  look_at_digits(mesh, Elements(mesh), found);
  return found.findings();
}

std::vector<Finding> refused(const std::vector<Finding>& all, bool is_refused) {
  std::vector<Finding> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some),
               [&](const Finding& one) { return words(one.flaw).is_refused == is_refused; });
  return some;
}

std::string in_words(const Finding& finding, const Origin& origin, const std::string& elements) {
  std::vector<std::int64_t> numbers;
  for (const Index e : finding.elements) numbers.push_back(origin.numbers.empty() ? e : origin.numbers[static_cast<std::size_t>(e)]);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::string text = counted(numbers.size(), "element") + " " + words(finding.flaw).phrase + ": " + elements + " ";
  for (std::size_t i = 0; i < std::min(numbers.size(), most_named); ++i) text += (i == 0 ? "" : ", ") + std::to_string(numbers[i]);
  return text + (numbers.size() > most_named ? ", …" : "");
}

Offenders offenders(const std::string& of, const Mesh& mesh, const Origin& origin, const std::vector<Finding>& findings) {
  const Elements all(mesh);
  std::map<Index, std::int32_t> flaws;
  for (const Finding& finding : findings)
    for (const Index e : finding.elements) flaws[e] |= 1 << static_cast<int>(finding.flaw);
  Offenders shown{of, {}, {}, {}, {}, {}};
  std::map<Index, Index> number;  // of nodes
  std::vector<Index> hexahedra, triangles;
  for (const auto& [e, flaw] : flaws) {
    for (int a = 0; a < all.corners(e); ++a)
      (all.is_solid(e) ? hexahedra : triangles).push_back(number.emplace(all.nodes(e)[a], static_cast<Index>(number.size())).first->second);
    shown.numbers.push_back(origin.numbers.empty() ? e : origin.numbers[static_cast<std::size_t>(e)]);
    shown.flaws.push_back(flaw);
  }
  shown.hexahedra = Eigen::Map<const Table<8>>(hexahedra.data(), 8, static_cast<Eigen::Index>(hexahedra.size() / 8));
  shown.triangles = Eigen::Map<const Table<3>>(triangles.data(), 3, static_cast<Eigen::Index>(triangles.size() / 3));
  shown.X.resize(3, static_cast<Eigen::Index>(number.size()));
  for (const auto& [from, to] : number) shown.X.col(to) = mesh.X.col(from);
  return shown;
}

std::vector<Index> places(const Mesh& mesh) { return places(mesh.X, Elements(mesh)); }

std::vector<Overlay> overlays(const Mesh& mesh) {
  const Elements all(mesh);
  const std::vector<Index> first = places(mesh.X, all);
  std::map<std::array<Index, 2>, std::vector<Index>> over;
  groups(keys(all, {}, &first), same_key, [&](auto begin, auto end) {
    for (auto one = begin + 1; one != end; ++one)
      if (all.region(one->element) != all.region(begin->element))
        over[{all.region(begin->element), all.region(one->element)}].push_back(one->element);
  });
  std::vector<Overlay> found;
  for (auto& [regions, elements] : over) {
    std::sort(elements.begin(), elements.end());
    found.push_back({{all.name(regions[0]), all.name(regions[1])}, std::move(elements)});
  }
  return found;
}

}  // namespace nereid::mesh
