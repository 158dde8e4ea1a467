#include "dynamics/modes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Spectra/SymEigsSolver.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/check.hpp"
#include "base/dense.hpp"
#include "base/memory.hpp"
#include "base/words.hpp"
#include "dynamics/step.hpp"

namespace nereid::dynamics {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Dense = Eigen::MatrixXd;
using Entries = std::vector<Eigen::Triplet<double>>;

/// [-] a displacement over the shortest side, or a rotation [rad]. Forces of an element at rest are proportional to it, so
/// nothing cancels; what is left of its square is lost between the two directions.
constexpr double small = 1e-7;
/// [s] of that displacement: so slow that dashpots and viscosity have no part in it.
constexpr double slowly = 1e9;
/// [-] omega^2 over that of the highest mode which is no more than round-off.
constexpr double round_off = 1e-12;
/// [-] stiffness of a rotation over the largest of its node which is none.
constexpr double no_stiffness = 1e-9;
/// Freedoms up to which all modes are found at once, by a dense matrix.
constexpr Eigen::Index few = 300;

// ---------------------------------------------------------------------------------------------------------------
// The stiffness

/// Nodes that share an element with each node, itself among them; ascending.
std::vector<Subset> neighbours(const Model& model) {
  std::vector<Subset> all(static_cast<std::size_t>(model.mesh.X.cols()));
  for (const auto& block : model.blocks) {
    const element::Connectivity& nodes = element::nodes(block);
    for (Eigen::Index e = 0; e < nodes.cols(); ++e)
      for (Eigen::Index a = 0; a < nodes.rows(); ++a)
        for (Eigen::Index b = 0; b < nodes.rows(); ++b) all[static_cast<std::size_t>(nodes(a, e))].push_back(nodes(b, e));
  }
  for (Subset& list : all) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return all;
}

/// Groups of nodes that have no neighbour in common, so that all of a group may move at once and every force
/// is the answer to one of them.
std::vector<Subset> groups(const std::vector<Subset>& neighbour) {
  std::vector<int> group(neighbour.size(), -1);
  std::vector<Subset> all;
  std::vector<Index> taken;  // by group: the last node that found it taken
  for (std::size_t n = 0; n < neighbour.size(); ++n) {
    const auto node = static_cast<Index>(n);
    for (const Index next : neighbour[n])
      for (const Index other : neighbour[static_cast<std::size_t>(next)]) {
        const int g = group[static_cast<std::size_t>(other)];
        if (g >= 0) taken[static_cast<std::size_t>(g)] = node;
      }
    std::size_t free = 0;
    while (free < all.size() && taken[free] == node) ++free;
    if (free == all.size()) all.emplace_back(), taken.push_back(-1);
    group[n] = static_cast<int>(free);
    all[free].push_back(node);
  }
  return all;
}

double shortest_side(const Model& model) {
  double shortest = 1e300;
  for (const auto& block : model.blocks) {
    const element::Connectivity& nodes = element::nodes(block);
    for (Eigen::Index e = 0; e < nodes.cols(); ++e)
      for (Eigen::Index a = 0; a < nodes.rows(); ++a) {
        const double side = (model.mesh.X.col(nodes(a, e)) - model.mesh.X.col(nodes((a + 1) % nodes.rows(), e))).norm();
        if (side > 0) shortest = std::min(shortest, side);  // wedges have corners in one
      }
  }
  return shortest;
}

/// Forces and moments of all blocks after a displacement u and rotations from rest.
struct Answers {
  std::vector<element::Memory> rest;      ///< beside the blocks
  std::vector<element::TileForces> none;  ///< no forces yet
  std::vector<element::TileReports> reports;
  Vectors force, moment;

  explicit Answers(const Model& model) {
    for (const auto& block : model.blocks) {
      rest.push_back(element::initial_memory(block));
      none.push_back(element::tile_forces(block));
      reports.push_back(element::tile_reports(block));
    }
  }

  void to(const Model& model, const Vectors& u, const Vectors& rotations) {
    force = Vectors::Zero(3, u.cols());
    moment = Vectors::Zero(3, rotations.cols());
    const Vectors x = model.mesh.X + u;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
      element::Memory memory = rest[b];
      element::TileForces tiles = none[b];
      element::advance(model.blocks[b], x, u, rotations, slowly, memory, tiles, reports[b]);
      element::add_by_node(model.node_sums[b], tiles.force, force);
      if (tiles.moment.cols() > 0) element::add_by_node(model.node_sums[b], tiles.moment, model.rotation_of_node, moment);
    }
  }
};

/// Rows of the stiffness: three displacements of each node, then three rotations of each plate node.
struct Rows {
  Eigen::Index nodes;
  Eigen::Index of_node(Index node) const { return 3 * static_cast<Eigen::Index>(node); }
  Eigen::Index of_rotation(Index rotation) const { return 3 * (nodes + static_cast<Eigen::Index>(rotation)); }
};

/// -df/du of all blocks, by differences to both sides; a column for each displacement and rotation.
void add_blocks(const Model& model, const Rows& rows, Entries& K) {
  const std::vector<Subset> neighbour = neighbours(model);
  const Vectors no_u = Vectors::Zero(3, model.mesh.X.cols()), no_rotation = Vectors::Zero(3, model.inertia.size());
  Answers ahead(model), behind(model);
  const double side = shortest_side(model);
  for (const Subset& group : groups(neighbour)) {
    for (int column = 0; column < 6; ++column) {
      const bool rotates = column >= 3;
      const int axis = column % 3;
      const double step = rotates ? small : small * side;
      Vectors u = no_u, rotation = no_rotation;
      for (const Index node : group) {
        if (!rotates) u(axis, node) = step;
        else if (model.rotation_of_node[node] >= 0) rotation(axis, model.rotation_of_node[node]) = step;
      }
      if (rotates && rotation.isZero(0)) continue;
      ahead.to(model, u, rotation);
      behind.to(model, -u, -rotation);
      for (const Index node : group) {
        const Index own = model.rotation_of_node[node];
        if (rotates && own < 0) continue;
        const Eigen::Index at = (rotates ? rows.of_rotation(own) : rows.of_node(node)) + axis;
        const auto add = [&](Eigen::Index first, const Vec3& plus, const Vec3& minus) {
          for (int i = 0; i < 3; ++i) K.emplace_back(first + i, at, (minus(i) - plus(i)) / (2 * step));
        };
        for (const Index next : neighbour[static_cast<std::size_t>(node)]) {
          add(rows.of_node(next), ahead.force.col(next), behind.force.col(next));
          const Index other = model.rotation_of_node[next];
          if (other >= 0) add(rows.of_rotation(other), ahead.moment.col(other), behind.moment.col(other));
        }
      }
    }
  }
}

/// k n n^T between the ends; of a spring without length to the ground, k in all directions.
void add_springs(const Model& model, const Rows& rows, Entries& K) {
  for (const load::AnyLoad& any : model.loads) {
    if (!load::is_spring(any)) continue;
    const auto& spring = std::get<load::Spring>(any);
    const Vec3 line = (spring.to < 0 ? spring.ground : Vec3(model.mesh.X.col(spring.to))) - model.mesh.X.col(spring.from);
    const double length = line.norm();
    const Mat3 along = length > 0 ? Mat3(line * line.transpose() / (length * length)) : Mat3(Mat3::Identity());
    const Mat3 stiffness = spring.stiffness * (spring.to < 0 && spring.length == 0 ? Mat3(Mat3::Identity()) : along);
    const auto add = [&](Index row, Index column, double sign) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) K.emplace_back(rows.of_node(row) + i, rows.of_node(column) + j, sign * stiffness(i, j));
    };
    add(spring.from, spring.from, 1);
    if (spring.to < 0) continue;
    add(spring.to, spring.to, 1), add(spring.from, spring.to, -1), add(spring.to, spring.from, -1);
  }
}

// ---------------------------------------------------------------------------------------------------------------
// The freedoms

/// Unit vectors of the space onto which a projector maps.
std::vector<Vec3> directions(const Mat3& projector) {
  const Eigenpairs solved = eigenpairs(0.5 * (projector + projector.transpose()));
  std::vector<Vec3> all;
  for (int i = 0; i < 3; ++i)
    if (solved.values(i) > 0.5) all.push_back(solved.vectors.col(i));
  return all;
}

/// Those combinations of some directions that have a stiffness.
std::vector<Vec3> resisted(const std::vector<Vec3>& directions, const Mat3& stiffness) {
  if (directions.empty()) return {};
  Eigen::Matrix<double, 3, Eigen::Dynamic> Q(3, static_cast<Eigen::Index>(directions.size()));
  for (std::size_t i = 0; i < directions.size(); ++i) Q.col(static_cast<Eigen::Index>(i)) = directions[i];
  const Eigenpairs solved = eigenpairs(Q.transpose() * stiffness * Q);
  std::vector<Vec3> all;
  for (Eigen::Index i = 0; i < Q.cols(); ++i)
    if (solved.values(i) > no_stiffness * stiffness.trace()) all.push_back(Q * solved.vectors.col(i));
  return all;
}

/// What is free to move: a matrix of orthonormal columns over M^(1/2), [rows of K x freedoms].
Sparse freedoms(const Model& model, const Rows& rows, const Sparse& K, std::int64_t& drilling) {
  const load::Memory held = load::prepare(model.constraints, static_cast<Index>(rows.nodes), model.rotation_of_node);
  const auto holding = [&](Index node) -> const load::ConstrainedNode* {
    const Index place = held.row_of_node[node];
    return place < 0 || held.nodes[place].count == 0 ? nullptr : &held.nodes[place];
  };
  Entries entries;
  Eigen::Index count = 0;
  const auto add = [&](Eigen::Index row, const std::vector<Vec3>& all, double mass) {
    for (const Vec3& direction : all) {
      for (int i = 0; i < 3; ++i)
        if (direction(i) != 0) entries.emplace_back(row + i, count, direction(i) / std::sqrt(mass));
      ++count;
    }
  };
  for (Index node = 0; node < rows.nodes; ++node) {
    const load::ConstrainedNode* here = holding(node);
    add(rows.of_node(node), directions(here == nullptr ? Mat3(Mat3::Identity()) : here->allowed), model.mass(node));
  }
  for (Index rotation = 0; rotation < model.inertia.size(); ++rotation) {
    const load::ConstrainedNode* here = holding(model.node_of_rotation[rotation]);
    const std::vector<Vec3> free = directions(here == nullptr ? Mat3(Mat3::Identity()) : here->allowed_rotation);
    Mat3 own;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) own(i, j) = K.coeff(rows.of_rotation(rotation) + i, rows.of_rotation(rotation) + j);
    const std::vector<Vec3> stiff = resisted(free, own);
    drilling += static_cast<std::int64_t>(free.size() - stiff.size());
    add(rows.of_rotation(rotation), stiff, model.inertia(rotation));
  }
  Sparse B(K.rows(), count);
  B.setFromTriplets(entries.begin(), entries.end());
  return B;
}

// ---------------------------------------------------------------------------------------------------------------
// The eigenvalues of A = B^T K B

/// Some eigenvalues and their vectors, in the order that was asked for.
struct Pairs {
  Eigen::VectorXd values;
  Dense vectors;
  bool complete = true;
};

using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// An operator without what has been found of it, as Spectra wants it.
struct Remainder {
  using Scalar = double;
  Operator apply;
  Eigen::Index size;
  Dense found;

  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  Eigen::VectorXd rest(Eigen::VectorXd x) const {
    if (found.cols() > 0) x -= found * (found.transpose() * x);
    return x;
  }
  void perform_op(const double* from, double* to) const {
    Eigen::Map<Eigen::VectorXd>(to, size) = rest(apply(rest(Eigen::Map<const Eigen::VectorXd>(from, size))));
  }
};

/// The factors of a symmetric matrix. Throws MachineError where they need more memory than there is, which the pattern tells.
class Factors : public Eigen::SimplicialLDLT<Sparse> {
 public:
  explicit Factors(const Sparse& A) {
    analyzePattern(A);
    double entries = 0;
    for (Eigen::Index column = 0; column < A.cols(); ++column) entries += m_nonZerosPerCol(column);
    constexpr double entry = sizeof(double) + sizeof(Sparse::StorageIndex);
    if (entries > std::numeric_limits<Sparse::StorageIndex>::max() || entry * entries > memory_left())
      throw MachineError(formatted("memory does not suffice: the factors of %.3g freedoms have %.3g entries, which take %.3g GB",
                                   static_cast<double>(A.cols()), entries, entry * entries / 1e9));
    factorize(A);
  }
};

/// Eigenvalues of A below a bound, by Sturm's sequence: the negative pivots of A - bound.
Eigen::Index below(const Sparse& A, double bound) {
  Sparse shifted = A;
  for (Eigen::Index i = 0; i < A.rows(); ++i) shifted.coeffRef(i, i) -= bound;
  const Factors factors(shifted);
  return (factors.vectorD().array() < 0).count();
}

/// The pairs that an operator with the vectors of A makes largest, `wanted` of them.
///
/// A single vector is blind for all but one of several equal eigenvalues. So the count of Sturm looks for what was
/// passed over, and the operator without what was found is asked for it.
/// sign  1 for the lowest of A, -1 for the highest
Pairs outermost(const Sparse& A, double scale, int sign, Eigen::Index wanted, Operator apply) {
  constexpr int passes = 8;
  Remainder remainder{.apply = std::move(apply), .size = A.rows(), .found = {}};
  Pairs pairs;
  pairs.complete = false;
  Eigen::Index missing = wanted;
  for (int pass = 0; pass < passes && missing > 0; ++pass) {
    const Eigen::Index basis = std::min(std::max<Eigen::Index>(2 * missing + 10, 40), A.rows());
    Spectra::SymEigsSolver<Remainder> solver(remainder, missing, basis);
    solver.init();
    const Eigen::Index got = solver.compute(Spectra::SortRule::LargestAlge, 3000, 1e-11);
    if (got == 0) return pairs;
    const Dense fresh = solver.eigenvectors();
    Dense all(A.rows(), remainder.found.cols() + fresh.cols());
    if (remainder.found.cols() > 0) all.leftCols(remainder.found.cols()) = remainder.found;
    Eigen::Index count = remainder.found.cols();
    for (Eigen::Index i = 0; i < fresh.cols(); ++i) {
      Eigen::VectorXd v = fresh.col(i);
      for (int twice = 0; twice < 2; ++twice) v -= all.leftCols(count) * (all.leftCols(count).transpose() * v);
      all.col(count++) = v.normalized();
    }
    // the best combinations of what has been found so far
    const Dense AQ = A * all;
    const Eigenpairs ritz = eigenpairs(0.5 * (all.transpose() * AQ + AQ.transpose() * all));
    const Dense turned = all * ritz.vectors;
    pairs.values = sign > 0 ? ritz.values : Eigen::VectorXd(ritz.values.reverse());
    pairs.vectors = sign > 0 ? turned : Dense(turned.rowwise().reverse());
    remainder.found = pairs.vectors;
    missing = std::max<Eigen::Index>(wanted - pairs.values.size(), 0);
    if (missing > 0) continue;
    const double last = pairs.values(wanted - 1), margin = std::max(1e-6 * std::abs(last), round_off * scale);
    const double bound = last - sign * margin;
    if (bound > round_off * scale) {
      const Eigen::Index exist = sign > 0 ? below(A, bound) : A.rows() - below(A, bound);
      const Eigen::Index known = (sign * (pairs.values.array() - bound) < 0).count();
      missing = std::max<Eigen::Index>(exist - known, 0);
    }
    pairs.complete = missing == 0;
  }
  const Eigen::Index kept = std::min<Eigen::Index>(wanted, pairs.values.size());
  pairs.values.conservativeResize(kept);
  pairs.vectors.conservativeResize(Eigen::NoChange, kept);
  return pairs;
}

Pairs all_of(const Sparse& A, bool descending) {
  const Eigenpairs all = eigenpairs(A);
  if (!descending) return {.values = all.values, .vectors = all.vectors};
  return {.values = all.values.reverse(), .vectors = all.vectors.rowwise().reverse()};
}

Pairs highest_of(const Sparse& A, int wanted) {
  if (A.rows() <= few) return all_of(A, true);
  const double scale = A.diagonal().maxCoeff();
  return outermost(A, scale, -1, std::min<Eigen::Index>(wanted, A.rows() - 1),
                   [&A](const Eigen::VectorXd& x) -> Eigen::VectorXd { return A * x; });
}

/// highest  [1/s2] the largest eigenvalue
Pairs lowest_of(const Sparse& A, double highest, int wanted) {
  if (A.rows() <= few) return all_of(A, false);
  Sparse shifted = A;  // rigid motions have no inverse, but a little beside them everything has
  for (Eigen::Index i = 0; i < A.rows(); ++i) shifted.coeffRef(i, i) += 1e-9 * highest;
  const Factors factors(shifted);
  check(factors.info() == Eigen::Success, "the stiffness has no factors");
  return outermost(A, highest, 1, std::min<Eigen::Index>(wanted, A.rows() - 1),
                   [&factors](const Eigen::VectorXd& x) -> Eigen::VectorXd { return factors.solve(x); });
}

/// What eigenvalues are measured in where squares of them may be no numbers: a power of two, which rounds nothing. [1/s2]
double unit_of(double size) { return (size > 1e-120 && size < 1e120) || size == 0 ? 1 : std::exp2(std::ilogb(size)); }

/// The first modes of some pairs.
///
/// highest  the largest eigenvalue, in `unit` [1/s2] as all of them
std::vector<Mode> modes_of(const Model& model, const Rows& rows, const Sparse& A, const Sparse& B, const Pairs& pairs, int wanted,
                           double highest, double unit) {
  std::vector<Mode> modes;
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(wanted, pairs.values.size()); ++i) {
    const Eigen::VectorXd& q = pairs.vectors.col(i);
    Eigen::VectorXd u = B * q;
    Eigen::Index most = 0;
    u.head(3 * rows.nodes).cwiseAbs().maxCoeff(&most);
    if (u(most) < 0) u = -u;  // of two signs always the same
    Mode mode{.frequency = std::sqrt(unit * std::max(pairs.values(i), 0.0)) / (2 * pi),
              .residual = (A * q - pairs.values(i) * q).norm() / highest,
              .shape = Eigen::Map<const Vectors>(u.data(), 3, rows.nodes),
              .rotations = Eigen::Map<const Vectors>(u.data() + 3 * rows.nodes, 3, model.inertia.size())};
    modes.push_back(std::move(mode));
  }
  return modes;
}

}  // namespace

Modes find_modes(const Model& model, int lowest, int highest) {
  check(lowest > 0 && highest > 0, "at least one mode is asked for at each end");
  const Rows rows{model.mesh.X.cols()};
  const Eigen::Index size = 3 * (rows.nodes + model.inertia.size());
  Entries entries;
  add_blocks(model, rows, entries);
  add_springs(model, rows, entries);
  Sparse K(size, size);
  K.setFromTriplets(entries.begin(), entries.end());
  const Sparse transposed = K.transpose();
  Modes modes;
  modes.asymmetry = Sparse(K - transposed).coeffs().abs().maxCoeff() / K.coeffs().abs().maxCoeff();
  K = 0.5 * (K + transposed);

  const Sparse B = freedoms(model, rows, K, modes.drilling);
  modes.freedoms = B.cols();
  State state = initial_state(model, {});
  Forces forces = make_forces(model);
  modes.voted_step = start(model, state, forces).elements.step;
  if (B.cols() == 0) return modes;
  Sparse A = B.transpose() * K * B;
  A.makeCompressed();
  constexpr double least = std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();  // below, digits are lost
  const double stiffest = K.coeffs().abs().maxCoeff();
  modes.finite = A.coeffs().isFinite().all() && (stiffest == 0 || stiffest > least);
  if (!modes.finite) return modes;
  const double unit = unit_of(A.coeffs().abs().maxCoeff());
  A /= unit;

  const Pairs top = highest_of(A, highest);
  modes.complete = top.complete;
  if (top.values.size() == 0) return modes;
  const double largest = top.values(0);
  modes.exact_step = 2 / std::sqrt(unit * largest);
  modes.highest = modes_of(model, rows, A, B, top, highest, largest, unit);
  const Pairs bottom = lowest_of(A, largest, lowest);
  modes.complete = modes.complete && bottom.complete;
  modes.lowest = modes_of(model, rows, A, B, bottom, lowest, largest, unit);
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(modes.lowest.size()); ++i)
    if (bottom.values(i) <= round_off * largest) ++modes.without_stiffness;
  return modes;
}

}  // namespace nereid::dynamics
