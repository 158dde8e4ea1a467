#include "mesh/split.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "base/check.hpp"
#include "mesh/skin.hpp"

namespace nereid::mesh {
namespace {

using Brick = std::array<Index, 8>;

constexpr int edges_of_hexahedron[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

/// The same hexahedron with its corners counted from elsewhere: a quarter of a turn about two of its axes.
Brick counted_about_z(const Brick& c) { return {c[1], c[2], c[3], c[0], c[5], c[6], c[7], c[4]}; }
Brick counted_about_x(const Brick& c) { return {c[3], c[2], c[6], c[7], c[0], c[1], c[5], c[4]}; }

std::size_t different(const Brick& cell) {
  Brick sorted = cell;
  std::sort(sorted.begin(), sorted.end());
  return static_cast<std::size_t>(std::unique(sorted.begin(), sorted.end()) - sorted.begin());
}

/// A hexahedron with its corners counted such that the edges 2-3 and 6-7 are those of no length; nothing if it is no wedge.
std::optional<Brick> as_wedge(Brick cell) {
  if (different(cell) != 6) return {};
  for (int a = 0; a < 4; ++a, cell = counted_about_z(cell))
    for (int b = 0; b < 4; ++b, cell = counted_about_x(cell))
      for (int c = 0; c < 4; ++c, cell = counted_about_z(cell))
        if (cell[2] == cell[3] && cell[6] == cell[7]) return cell;
  return {};
}

/// Places of new nodes by the nodes that they are the means of.
struct Hash {
  template <std::size_t n>
  std::size_t operator()(const std::array<Index, n>& key) const {
    std::uint64_t state = 0;
    for (const Index node : key) state = (state ^ static_cast<std::uint64_t>(node)) * 0x9e3779b97f4a7c15U, state ^= state >> 29U;
    return state;
  }
};
using Pair = std::array<Index, 2>;

Pair pair(Index a, Index b) { return a < b ? Pair{a, b} : Pair{b, a}; }

/// What a new node is the mean of.
struct Mean {
  Brick nodes{};
  std::size_t count = 0;
};

/// A mesh cut once: its new nodes, asked for by what they lie on.
class Cutter {
 public:
  explicit Cutter(const Mesh& mesh) : mesh_(mesh), next_(static_cast<Index>(mesh.X.cols())) {
    Index element = 0;
    for (const Hexahedra& region : mesh.hexahedra)
      for (Index e = 0; e < region.nodes.cols(); ++e, ++element) add_hexahedron(cell(region, e), element);
    refuse_diagonals_that_are_edges();
    std::sort(refused_.begin(), refused_.end());
    refused_.erase(std::unique(refused_.begin(), refused_.end()), refused_.end());
    if (!refused_.empty()) return;
    for (const Triangles& region : mesh.triangles)
      for (const auto& t : region.nodes.colwise())
        for (int i = 0; i < 3; ++i) add_side(t(i), t((i + 1) % 3), t((i + 2) % 3));
  }

  const std::vector<Index>& refused() const { return refused_; }

  Split result() {
    Split split;
    Mesh& fine = split.mesh;
    Index element = 0;
    for (const Hexahedra& region : mesh_.hexahedra) {
      std::vector<Brick> parts;
      for (Index e = 0; e < region.nodes.cols(); ++e, ++element) {
        const Brick whole = cell(region, e);
        if (const std::optional<Brick> wedge = as_wedge(whole)) add_parts_of_wedge(*wedge, parts);
        else add_parts_of_hexahedron(whole, parts);
        split.parents.insert(split.parents.end(), 8, element);
      }
      fine.hexahedra.push_back({region.name, Eigen::Map<const Table<8>>(parts.empty() ? nullptr : parts[0].data(), 8,
                                                                        static_cast<Eigen::Index>(parts.size()))});
    }
    for (const Triangles& region : mesh_.triangles) {
      fine.triangles.push_back({region.name, parts_of_triangles(region.nodes)});
      for (Index e = 0; e < region.nodes.cols(); ++e, ++element) split.parents.insert(split.parents.end(), 4, element);
    }
    for (const Surface& surface : mesh_.surfaces) fine.surfaces.push_back({surface.name, parts_of_triangles(surface.facets)});
    fine.X.resize(3, next_);
    fine.X.leftCols(mesh_.X.cols()) = mesh_.X;
    for (std::size_t n = 0; n < means_.size(); ++n) {
      Vec3 sum = Vec3::Zero();
      for (std::size_t i = 0; i < means_[n].count; ++i) sum += mesh_.X.col(means_[n].nodes[i]);
      fine.X.col(mesh_.X.cols() + static_cast<Index>(n)) = sum / static_cast<double>(means_[n].count);
    }
    for (const NodeSet& set : mesh_.node_sets) fine.node_sets.push_back({set.name, nodes_of_set(set, fine)});
    return split;
  }

 private:
  /// A plate's own side: the third corners of the triangles at it.
  struct Side {
    Index node = -1;
    std::vector<Index> thirds;
  };

  static Brick cell(const Hexahedra& region, Index e) {
    Brick nodes;
    for (std::size_t a = 0; a < 8; ++a) nodes[a] = region.nodes(static_cast<Index>(a), e);
    return nodes;
  }

  Index new_node(const Mean& mean) {
    means_.push_back(mean);
    return next_++;
  }

  void add_hexahedron(const Brick& c, Index element) {
    if (different(c) < 8 && !as_wedge(c)) {
      refused_.push_back(element);
      return;
    }
    for (const auto& [a, b] : edges_of_hexahedron)
      if (const Pair key = pair(c[a], c[b]); key[0] != key[1] && edges_.find(key) == edges_.end())
        edges_[key] = new_node({{key[0], key[1]}, 2});
    for (const auto& f : corners_of_faces) {
      std::array<Index, 4> key{c[f[0]], c[f[1]], c[f[2]], c[f[3]]};
      const Pair diagonals[] = {pair(key[0], key[2]), pair(key[1], key[3])};
      std::sort(key.begin(), key.end());
      if (std::adjacent_find(key.begin(), key.end()) != key.end()) continue;
      auto& node = faces_.try_emplace(key, -1).first->second;
      if (node < 0) node = new_node({{key[0], key[1], key[2], key[3]}, 4});
      for (const Pair& diagonal : diagonals) {
        const auto [at, is_new] = diagonals_.try_emplace(diagonal, Diagonal{node, {}});
        if (at->second.node != node) refused_.push_back(element);  // two faces with one diagonal
        at->second.elements.push_back(element);
      }
    }
  }

  void refuse_diagonals_that_are_edges() {
    for (const auto& [key, diagonal] : diagonals_)
      if (edges_.count(key) > 0) refused_.insert(refused_.end(), diagonal.elements.begin(), diagonal.elements.end());
  }

  void add_side(Index a, Index b, Index third) {
    const Pair key = pair(a, b);
    if (edges_.count(key) > 0 || diagonals_.count(key) > 0) return;
    Side& side = sides_[key];
    if (side.node < 0) side.node = new_node({{key[0], key[1]}, 2}), side_of_[side.node] = key;
    side.thirds.push_back(third);
  }

  Index edge(Index a, Index b) const { return a == b ? a : edges_.at(pair(a, b)); }

  Index face(std::array<Index, 4> key) const {
    std::sort(key.begin(), key.end());
    return faces_.at(key);
  }

  /// The middle of a side of a triangle.
  Index side(Index a, Index b) const {
    const Pair key = pair(a, b);
    if (const auto at = edges_.find(key); at != edges_.end()) return at->second;
    if (const auto at = diagonals_.find(key); at != diagonals_.end()) return at->second.node;
    const auto at = sides_.find(key);
    check(at != sides_.end(), "a facet of a surface has a side that no element has");
    return at->second.node;
  }

  /// Eight cells between the 27 places of one: corners, middles of edges and faces, and its own.
  void add_parts_of_hexahedron(const Brick& c, std::vector<Brick>& parts) {
    const Index middle = new_node({c, 8});
    Index at[3][3][3];  // z, y, x
    const int place[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};
    const auto put = [&](std::initializer_list<int> corners, Index node) {
      int sum[3] = {0, 0, 0};
      for (const int corner : corners)
        for (int i = 0; i < 3; ++i) sum[i] += place[corner][i];
      const int n = static_cast<int>(corners.size());
      at[sum[2] / n][sum[1] / n][sum[0] / n] = node;
    };
    for (int a = 0; a < 8; ++a) put({a}, c[static_cast<std::size_t>(a)]);
    for (const auto& [a, b] : edges_of_hexahedron) put({a, b}, edge(c[a], c[b]));
    for (const auto& f : corners_of_faces) put({f[0], f[1], f[2], f[3]}, face({c[f[0]], c[f[1]], c[f[2]], c[f[3]]}));
    at[1][1][1] = middle;
    for (const auto& from : place) {
      const int x = from[0] / 2, y = from[1] / 2, z = from[2] / 2;
      parts.push_back({at[z][y][x], at[z][y][x + 1], at[z][y + 1][x + 1], at[z][y + 1][x],
                       at[z + 1][y][x], at[z + 1][y][x + 1], at[z + 1][y + 1][x + 1], at[z + 1][y + 1][x]});
    }
  }

  /// Eight wedges in two layers of four: three at the corners of the triangle, and one between them that points the other way.
  void add_parts_of_wedge(const Brick& c, std::vector<Brick>& parts) const {
    const std::array<Index, 3> low{c[0], c[1], c[2]}, high{c[4], c[5], c[6]};
    using Layer = std::array<Index, 6>;  // corners, then the middles of 0-1, 1-2, 2-0
    const auto layer = [&](const std::array<Index, 3>& at) {
      return Layer{at[0], at[1], at[2], edge(at[0], at[1]), edge(at[1], at[2]), edge(at[2], at[0])};
    };
    Layer between{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      between[i] = edge(low[i], high[i]);
      between[i + 3] = face({low[i], low[j], high[j], high[i]});
    }
    const Layer layers[] = {layer(low), between, layer(high)};
    for (int l = 0; l < 2; ++l)
      for (const auto& [i, j, k] : {std::array<std::size_t, 3>{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {4, 5, 3}}) {
        const Layer &under = layers[l], &over = layers[l + 1];
        parts.push_back({under[i], under[j], under[k], under[k], over[i], over[j], over[k], over[k]});
      }
  }

  /// Four triangles of each; the first side of every one runs along that of the whole, as cuts of faces need it.
  Table<3> parts_of_triangles(const Table<3>& whole) const {
    Table<3> parts(3, 4 * whole.cols());
    for (Eigen::Index t = 0; t < whole.cols(); ++t) {
      const Index a = whole(0, t), b = whole(1, t), c = whole(2, t), ab = side(a, b), bc = side(b, c), ca = side(c, a);
      parts.middleCols<4>(4 * t) << a, ab, ca, bc, ab, b, bc, ca, ca, bc, c, ab;
    }
    return parts;
  }

  bool is_rim(Index a, Index b) const {
    const auto at = sides_.find(pair(a, b));
    return at != sides_.end() && at->second.thirds.size() == 1;
  }

  /// Whether the middle of a plate's side, both of whose ends are in a set, only cuts off a corner of the rim.
  bool cuts_off_a_corner(Index node, const std::vector<char>& in_set) const {
    const auto at = side_of_.find(node);
    if (at == side_of_.end()) return false;
    const auto [a, b] = at->second;
    const std::vector<Index>& thirds = sides_.at(at->second).thirds;
    const auto is_in = [&](Index third) { return in_set[static_cast<std::size_t>(third)] != 0; };
    const auto is_corner = [&, a = a, b = b](Index third) { return is_in(third) && is_rim(a, third) && is_rim(third, b); };
    return thirds.size() > 1 && std::any_of(thirds.begin(), thirds.end(), is_corner) && !std::all_of(thirds.begin(), thirds.end(), is_in);
  }

  Subset nodes_of_set(const NodeSet& set, const Mesh& fine) const {
    const auto of_elements = [&](const auto& coarse, const auto& regions) -> std::optional<Subset> {
      for (std::size_t r = 0; r < regions.size(); ++r)
        if (regions[r].name == set.name && used(coarse[r].nodes) == set.nodes) return used(regions[r].nodes);
      return {};
    };
    if (const auto nodes = of_elements(mesh_.hexahedra, fine.hexahedra)) return *nodes;
    if (const auto nodes = of_elements(mesh_.triangles, fine.triangles)) return *nodes;
    for (std::size_t s = 0; s < mesh_.surfaces.size(); ++s)
      if (mesh_.surfaces[s].name == set.name && surface_nodes(mesh_.surfaces[s]) == set.nodes) return surface_nodes(fine.surfaces[s]);
    std::vector<char> in_set(static_cast<std::size_t>(mesh_.X.cols()), 0);
    for (const Index node : set.nodes) in_set[static_cast<std::size_t>(node)] = 1;
    Subset nodes = set.nodes;
    for (std::size_t n = 0; n < means_.size(); ++n) {
      const Index node = static_cast<Index>(mesh_.X.cols()) + static_cast<Index>(n);
      const auto* begin = means_[n].nodes.data();
      if (std::all_of(begin, begin + means_[n].count, [&](Index of) { return in_set[static_cast<std::size_t>(of)] != 0; }) &&
          !cuts_off_a_corner(node, in_set))
        nodes.push_back(node);
    }
    return nodes;
  }

  /// The nodes of elements, ascending, each once.
  template <class Nodes>
  static Subset used(const Nodes& elements) {
    Subset nodes(elements.data(), elements.data() + elements.size());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  struct Diagonal {
    Index node;  ///< the middle of its face
    std::vector<Index> elements;
  };

  const Mesh& mesh_;
  Index next_;
  std::vector<Mean> means_;
  std::vector<Index> refused_;
  std::unordered_map<Pair, Index, Hash> edges_;
  std::unordered_map<std::array<Index, 4>, Index, Hash> faces_;
  std::unordered_map<Pair, Diagonal, Hash> diagonals_;
  std::unordered_map<Pair, Side, Hash> sides_;
  std::unordered_map<Index, Pair> side_of_;
};

Split cut_in_two(const Mesh& mesh) {
  Cutter cutter(mesh);
  if (!cutter.refused().empty()) return {{}, {}, cutter.refused()};
  return cutter.result();
}

}  // namespace

Split split(const Mesh& mesh, int factor) {
  check(std::find(split_factors.begin(), split_factors.end(), factor) != split_factors.end(), "meshes are split by 2 and 4 only");
  if (factor == 1) {
    Split same{mesh, {}, {}};
    Eigen::Index elements = 0;
    for (const Hexahedra& region : mesh.hexahedra) elements += region.nodes.cols();
    for (const Triangles& region : mesh.triangles) elements += region.nodes.cols();
    for (Index e = 0; e < elements; ++e) same.parents.push_back(e);
    return same;
  }
  Split found = cut_in_two(mesh);
  if (factor == 2 || !found.refused.empty()) return found;
  Split finer = cut_in_two(found.mesh);
  for (std::vector<Index>* elements : {&finer.parents, &finer.refused})
    for (Index& element : *elements) element = found.parents[static_cast<std::size_t>(element)];
  return finer;
}

}  // namespace nereid::mesh
