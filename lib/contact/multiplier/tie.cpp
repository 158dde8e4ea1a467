#include "contact/multiplier/tie.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.hpp"
#include "contact/multiplier/condition.hpp"
#include "contact/surface/foot.hpp"
#include "contact/tracking/element.hpp"

namespace nereid::contact {

namespace {

constexpr double solved = 1e-12;         // of the impulses of an interface: the solver ends when all that is missing would take less
constexpr double drawn_back = 0.2;       // of d in a step: it is round-off of positions, and all of it at once has five times its noise
constexpr double stands_still = 1e-14;   // of the speed of a tie's nodes: slower is standing still
constexpr double contradiction = 1e-14;  // of what is missing, by energy: no impulses do more to it
constexpr int most_iterations = 200;
constexpr int most_turns = 8;            // of linear solutions, where facets turn under ties with a height
constexpr double of_a_turn = 1e-9;       // of what is missing, by energy: one of them need not be better, since facets turn by more
constexpr Index grain = 2048;            // a thread takes longer to wake than to do less
constexpr double past_border = 0.05;     // of the size of a facet

/// Derivatives of the shape functions of a facet or face at the point of a tie. [-]
struct Slopes {
  std::array<double, 4> by_a, by_b;
};
Slopes slopes(const HeldTie& tie) {
  if (tie.nodes == 4) return {{-1, 1, 0, 0}, {-1, 0, 1, 0}};
  const double a = -tie.weight[2] - tie.weight[4], b = -tie.weight[2] - tie.weight[3];
  return {{b - 1, b, -b, 1 - b}, {a - 1, a, 1 - a, -a}};
}

/// How a point of the base moves with its coordinates. [m]
struct Tangents {
  Vec3 by_a, by_b;
  Vec3 area() const { return by_a.cross(by_b); }
};
Tangents tangents(const HeldTie& b, const Slopes& slope, const Vectors& x) {
  Tangents sum{Vec3::Zero(), Vec3::Zero()};
  for (int I = 1; I < b.nodes - 1; ++I) {  // differences, so that they keep their digits far from the origin
    const Vec3 side = x.col(b.node[I + 1]) - x.col(b.node[1]);
    sum.by_a += slope.by_a[I] * side, sum.by_b += slope.by_b[I] * side;
  }
  return sum;
}

/// Puts a tie on its nodes.
void set_nodes(const Interface& interface, const Tie& tie, HeldTie& b) {
  const Half& half = interface.base.half[tie.facet];
  b.facet = tie.facet;
  b.nodes = tie.on_face ? 5 : 4;
  b.first = tie.on_face ? half.cut : 0;
  for (int I = 0; I < 3; ++I) b.node[I + 1] = interface.base.facets((b.first + I) % 3, tie.facet);
  b.node[4] = half.fourth;
}
HeldTie held_tie(const Interface& interface, Index a) {
  HeldTie b;
  b.node[0] = interface.apexes[a], b.weight[0] = 1;
  set_nodes(interface, interface.ties[a], b);
  return b;
}
void set_weights(const Tie& tie, HeldTie& b) {
  b.height = tie.height;
  for (int I = 0; I < 3; ++I) b.weight[I + 1] = -tie.weight[(b.first + I) % 3];
  b.weight[4] = -tie.weight[3];
}

/// The rate with which d would be smaller by `drawn_back` at the end of the step to come, less that which the nodes have. [m/s]
///
/// The base turns during the step: beyond the linear rate d changes by -h (n' - n - dn).
Vec3 missing(const HeldTie& b, const Motion& m, const Vectors& v) {
  const Vec3 linear = -drawn_back / m.next * b.off - rate(b, v);
  if (b.height == 0) return linear;
  const Slopes slope = slopes(b);
  const Tangents here = tangents(b, slope, m.x), change = tangents(b, slope, v);
  const Tangents there{here.by_a + m.next * change.by_a, here.by_b + m.next * change.by_b};
  Vec3 turn = (there.area().normalized() - b.normal) / m.next;
  for (int I = 0; I < b.nodes - 1; ++I) turn += b.normal.dot(v.col(b.node[I + 1])) * b.gradient[I];
  return linear + b.height * turn;
}

/// Geometry of a tie at t.
void place(const Interface& interface, Index a, const Vectors& x, HeldTie& b) {
  set_weights(interface.ties[a], b);
  const Slopes slope = slopes(b);
  const Tangents along = tangents(b, slope, x);
  const Vec3 area = along.area();
  const double size = area.norm();
  b.normal = area / size;
  b.off = x.col(b.node[0]) - b.height * b.normal;
  for (int I = 1; I < b.nodes; ++I) b.off += b.weight[I] * x.col(b.node[I]);
  if (b.height == 0) return;
  const Vec3 of_a = along.by_b.cross(b.normal) / size, of_b = b.normal.cross(along.by_a) / size;  // gradients of a and b
  for (int I = 0; I < b.nodes - 1; ++I) b.gradient[I] = slope.by_a[I] * of_a + slope.by_b[I] * of_b;
}

/// The foot of an apex that slides, from a facet on; false where it stands past the border of the base.
///
/// foot  its height is not used
bool find_foot(const Interface& interface, const Vectors& x, Index a, Index from, Tie& foot, FeatureHeight& over) {
  const BaseSurface& base = interface.base;
  const Vec3 p = x.col(interface.apexes[a]);
  const Stand at = stand(base, x, p, from);
  foot.facet = at.feature.facet;
  if (is_past_border(base, x, at)) return false;
  // over its facet at a ridge too: the direction to an edge from a point on it is round-off
  const Feature feature{foot.facet, geometry::Kind::facet, 0};
  over = height_over(base, x, feature, p);
  foot.weight[3] = 0;
  foot.on_face = stand_on_face(base, x, p, feature, 0, nullptr, over, foot.weight[3]);
  std::copy(over.weight.begin(), over.weight.end(), foot.weight.begin());
  return true;
}

/// Moves a tie that slides to where its apex stands at t; returns whether its nodes are others than before.
///
/// near  its stencil of the step before says where it was, if there was one
bool slide(const Interface& interface, const Vectors& x, const Near& near, bool is_free, HeldTie& b) {
  const Index a = near.apex;
  const int nodes_before = b.nodes;
  const Index facet_before = b.facet;
  Tie foot = interface.ties[a];
  FeatureHeight over;
  const Index from = near.element.count > 0 ? near.element.stencil[0].facet : foot.facet;
  b.height = 0;
  b.off.setZero(), b.normal.setZero();
  if (is_free || !find_foot(interface, x, a, from, foot, over)) {
    b.nodes = 1, b.facet = from;
    return nodes_before != 1;
  }
  set_nodes(interface, foot, b);
  const double height = std::exchange(foot.height, 0);
  set_weights(foot, b);
  b.normal = over.normal;
  b.off = (over.height - height) * over.normal;
  return b.nodes != nodes_before || b.facet != facet_before;
}

/// The impulse that alone takes a rate, as far as the tie holds it. Of a tie that slides it has no part across the normal, not even
/// round-off: in the course of the solver nothing would take that back.
Vec3 impulse_against(const HeldTie& b, const Vec3& rate) {
  return b.slides ? Vec3(b.along * b.normal.dot(rate) * b.normal) : Vec3(b.inverse * rate);
}

/// What an impulse along the normal does to the rate along it, and the inverse of that. Nothing of an apex that is let go.
void respond_along_normal(const Motion& m, HeldTie& b) {
  double all = 0, free = 0;
  for (int j = 0; j < b.nodes; ++j) {
    const double one = b.weight[j] * b.weight[j] / m.mass(b.node[j]);
    const Mat3* let = m.allowed[b.node[j]];
    free += one;
    if (b.nodes > 1) all += let ? one * b.normal.dot(*let * b.normal) : one;
  }
  b.per_mass = free;
  b.along = all > no_response * free ? 1 / all : 0;
}

/// What an impulse on a tie does to its own rate, and the inverse of that where nodes can move. A direction in which they are held and
/// only the facet can turn counts as held.
///
/// allowed  null, or of an apex on a symmetry plane: what leads out of it the images of facets take
void respond(const Motion& m, const Mat3* allowed, HeldTie& b) {
  bool constrained = allowed != nullptr;
  double most = 0;
  for (int j = 0; j < b.nodes; ++j) {
    constrained = constrained || m.allowed[b.node[j]];
    most += b.weight[j] * b.weight[j] / m.mass(b.node[j]);
  }
  if (b.height == 0 && !constrained) {
    b.per_mass = most;
    b.inverse = Mat3::Identity() / most;
    return;
  }
  Mat3 all = Mat3::Zero(), shifts = all;
  most = 0;
  for (int j = 0; j < b.nodes; ++j) {
    Mat3 by = b.weight[j] * Mat3::Identity();
    if (j > 0 && b.height != 0) by += b.height * b.gradient[j - 1] * b.normal.transpose();
    const Mat3* let = m.allowed[b.node[j]];
    most += by.squaredNorm() / (3 * m.mass(b.node[j]));
    const double shift = b.weight[j] * b.weight[j] / m.mass(b.node[j]);
    if (let) all += by * *let * by.transpose() / m.mass(b.node[j]), shifts += shift * *let;
    else all += by * by.transpose() / m.mass(b.node[j]), shifts.diagonal().array() += shift;
  }
  b.per_mass = most;
  if (!constrained) {
    b.inverse = all.inverse();
    return;
  }
  if (allowed) shifts = *allowed * shifts * *allowed;
  const Eigen::SelfAdjointEigenSolver<Mat3> moves(shifts);
  Mat3 let = Mat3::Zero();
  for (int k = 0; k < 3; ++k)
    if (moves.eigenvalues()(k) > no_response * most) let += moves.eigenvectors().col(k) * moves.eigenvectors().col(k).transpose();
  // outside of where nodes can move it is the identity, and left out of the inverse
  b.inverse = let * (let * all * let + most * (Mat3::Identity() - let)).inverse() * let;
}

/// Velocities that impulses give to the nodes, `of` telling that of a tie, into Ties::change.
template <class Of>
void set_change(const Motion& m, Ties& all, Of&& of) {
  parallel_for(static_cast<Index>(all.nodes.size()), grain, [&](Index i) {
    const Index node = all.nodes[i];
    Vec3 sum = Vec3::Zero();
    for (Index u = all.begin[i]; u < all.begin[i + 1]; ++u) {
      const HeldTie& b = all.held[all.uses[u].tie];
      sum += part(b, all.uses[u].place, of(b));
    }
    sum /= m.mass(node);
    all.change.col(node) = m.allowed[node] ? Vec3(*m.allowed[node] * sum) : sum;
  });
}

/// Adds Ties::change to the velocities.
void give(Ties& all, Vectors& velocity) {
  for (const Index node : all.nodes) velocity.col(node) += all.change.col(node);
}

template <class Term>
double sum(Ties& all, Index first, Index last, Term&& term) {
  return ordered_sum(last - first, all.partial, [&](Index i) { return term(all.held[first + i]); });
}
template <class Term>
double sum(Ties& all, Term&& term) {
  return sum(all, 0, static_cast<Index>(all.held.size()), term);
}

/// Whether what is missing is small against the impulses, interface by interface, by energy.
///
/// enough  [J] of all of it
bool is_held(Ties& all, double enough = 0) {
  double left = 0;
  bool held = true;
  for (std::size_t i = 0; i + 1 < all.first.size(); ++i) {
    const Index first = all.first[i], last = all.first[i + 1];
    if (first == last) continue;
    const double missing = sum(all, first, last, [](const HeldTie& b) { return b.residual.dot(b.guess); });
    const double counts = sum(all, first, last, [](const HeldTie& b) {
      return solved * solved * b.per_mass * (b.impulse + b.change).squaredNorm() + b.still * b.still / b.per_mass;
    });
    left += missing;
    held = held && missing <= counts;
  }
  return held || left <= enough;
}

/// Sets what is missing with these velocities.
bool look(const Motion& m, const Vectors& velocity, Ties& all) {
  parallel_for(static_cast<Index>(all.held.size()), grain, [&](Index i) {
    HeldTie& b = all.held[i];
    b.change.setZero();
    b.residual = missing(b, m, velocity);
    b.guess = impulse_against(b, b.residual);
  });
  return is_held(all);
}

/// Adds to the impulses those that take what is missing at linear rates: conjugate residuals, preconditioned by each tie's own response.
void solve(const Motion& m, Ties& all) {
  const auto count = static_cast<Index>(all.held.size());
  const auto answer = [&] {
    set_change(m, all, [](const HeldTie& b) { return b.guess; });
    parallel_for(count, grain, [&](Index i) { all.held[i].answer = rate(all.held[i], all.change); });
    return sum(all, [](const HeldTie& b) { return b.guess.dot(b.answer); });
  };
  double power = answer();
  const double enough = all.any_height ? of_a_turn * sum(all, [](const HeldTie& b) { return b.residual.dot(b.guess); }) : 0;
  for (HeldTie& b : all.held) b.way = b.guess, b.way_answer = b.answer;
  for (int k = 0; k < most_iterations; ++k) {
    ++all.iterations;
    const double size = sum(all, [](const HeldTie& b) { return b.way_answer.dot(impulse_against(b, b.way_answer)); });
    if (!(size > 0)) return;
    const double step = power / size;
    parallel_for(count, grain, [&](Index i) {
      HeldTie& b = all.held[i];
      b.change += step * b.way;
      b.residual -= step * b.way_answer;
      b.guess = impulse_against(b, b.residual);
    });
    if (is_held(all, enough)) return;
    const double before = power;
    power = answer();
    if (!(power > contradiction * sum(all, [](const HeldTie& b) { return b.guess.dot(b.residual); }))) return;
    parallel_for(count, grain, [&](Index i) {
      HeldTie& b = all.held[i];
      b.way = b.guess + power / before * b.way;
      b.way_answer = b.answer + power / before * b.way_answer;
    });
  }
}

/// Lists the nodes of the ties, and the ties of each.
void list_nodes(Ties& all) {
  all.nodes.clear();
  all.begin.clear();
  std::fill(all.begin_of.begin(), all.begin_of.end(), 0);
  for (const HeldTie& b : all.held)
    for (int j = 0; j < b.nodes; ++j) ++all.begin_of[b.node[j]];
  Index sum = 0;
  for (std::size_t node = 0; node < all.begin_of.size(); ++node) {
    const Index uses = all.begin_of[node];
    all.has[node] = uses > 0;
    if (uses > 0) all.nodes.push_back(static_cast<Index>(node)), all.begin.push_back(sum);
    all.begin_of[node] = sum;
    sum += uses;
  }
  all.begin.push_back(sum);
  all.uses.resize(static_cast<std::size_t>(sum));
  for (std::size_t b = 0; b < all.held.size(); ++b)
    for (int j = 0; j < all.held[b].nodes; ++j) all.uses[all.begin_of[all.held[b].node[j]]++] = {static_cast<Index>(b), j};
}

/// Moves all ties that slide.
void slide_all(std::span<const AnyContact> contacts, const Vectors& x, std::span<const AnyMemory> memories, Ties& all) {
  bool others = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (all.first[i] == all.first[i + 1] || !std::get<Interface>(contacts[i]).slides) continue;
    const Interface& interface = std::get<Interface>(contacts[i]);
    const auto& memory = std::get<Memory>(memories[i]);
    parallel_for(static_cast<Index>(memory.near.size()), grain, [&](Index k) {
      HeldTie& b = all.held[all.first[i] + k];
      const Near& near = memory.near[k];
      b.has_walked = slide(interface, x, near, memory.status[near.apex] == Status::unpaired, b);
    });
    for (const HeldTie& b : ties_of(all, i)) others = others || b.has_walked;
  }
  if (others) list_nodes(all);
}

Vec3 rate_before(const HeldTie& b, const Motion& m) { return rate(b, m.v); }

/// Leaves an apex that has slid off its base without a force.
void let_go(Near& near, Memory& memory) {
  near.element.closed = false;
  near.element.count = 0;
  near.element.apex.setZero();
  memory.status[near.apex] = Status::unpaired;
  memory.gap[near.apex] = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Vec3 rate(const HeldTie& b, const Vectors& v) {
  Vec3 sum = v.col(b.node[0]);
  for (int I = 1; I < b.nodes; ++I) sum += b.weight[I] * v.col(b.node[I]);
  if (b.height == 0) return sum;
  for (int I = 0; I < b.nodes - 1; ++I) sum += b.height * b.normal.dot(v.col(b.node[I + 1])) * b.gradient[I];
  return sum;
}

Vec3 part(const HeldTie& b, int place, const Vec3& impulse) {
  if (place == 0) return impulse;
  Vec3 one = b.weight[place] * impulse;
  if (b.height != 0) one += b.height * b.gradient[place - 1].dot(impulse) * b.normal;
  return one;
}

Ties make_ties(std::span<const AnyContact> contacts, Index nodes) {
  Ties all;
  all.first.assign(1, 0);
  for (const AnyContact& contact : contacts) {
    if (tied_by_multipliers(contact)) {
      const Interface& interface = std::get<Interface>(contact);
      for (std::size_t a = 0; a < interface.ties.size(); ++a)
        if (interface.ties[a].facet >= 0) all.held.push_back(held_tie(interface, static_cast<Index>(a)));
    }
    all.first.push_back(static_cast<Index>(all.held.size()));
  }
  if (all.held.empty()) return all;
  all.has.assign(static_cast<std::size_t>(nodes), false);
  all.begin_of.assign(static_cast<std::size_t>(nodes), 0);
  all.uses.reserve(5 * all.held.size());
  all.nodes.reserve(static_cast<std::size_t>(nodes)), all.begin.reserve(static_cast<std::size_t>(nodes) + 1);
  list_nodes(all);
  all.change = Vectors::Zero(3, nodes);
  all.partial.reserve(all.held.size());
  return all;
}

void find_ties(std::span<const AnyContact> contacts, const Motion& m, std::span<const AnyMemory> memories, Vectors& velocity, Ties& all) {
  if (all.held.empty()) return;
  const double h = 0.5 * (m.dt + m.next);
  slide_all(contacts, m.x, memories, all);
  if (m.driven)
    for (const Index node : all.nodes) velocity.col(node) += m.driven->col(node);
  all.any_height = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (all.first[i] == all.first[i + 1]) continue;
    const Interface& interface = std::get<Interface>(contacts[i]);
    for (const Tie& tie : interface.ties) all.any_height = all.any_height || (tie.height != 0 && !interface.slides);
    const std::vector<Near>& near = std::get<Memory>(memories[i]).near;
    parallel_for(static_cast<Index>(near.size()), grain, [&](Index k) {
      HeldTie& b = all.held[all.first[i] + k];
      b.slides = interface.slides;
      if (b.slides) {
        respond_along_normal(m, b);
      } else {
        place(interface, near[k].apex, m.x, b);
        respond(m, allowed_of(interface, near[k].apex), b);
      }
      double fastest = 0;
      for (int j = 0; j < b.nodes; ++j) fastest = std::max(fastest, velocity.col(b.node[j]).squaredNorm());
      b.still = stands_still * std::sqrt(fastest);
      b.impulse = near[k].element.closed && m.dt > 0 ? Vec3(h * near[k].element.apex) : Vec3(Vec3::Zero());
      if (b.slides) b.impulse = b.nodes > 1 ? Vec3(b.impulse.dot(b.normal) * b.normal) : Vec3(Vec3::Zero());
    });
  }
  set_change(m, all, [](const HeldTie& b) { return b.impulse; });
  give(all, velocity);
  hold(m, velocity, all);
}

void hold(const Motion& m, Vectors& velocity, Ties& all) {
  if (all.held.empty()) return;
  for (int turn = 0; turn < most_turns; ++turn) {
    if (look(m, velocity, all)) return;
    solve(m, all);
    set_change(m, all, [](const HeldTie& b) { return b.change; });
    give(all, velocity);
    for (HeldTie& b : all.held) b.impulse += b.change;
    if (!all.any_height) return;
  }
}

void take_over(const Interface& interface, const Motion& m, std::span<const HeldTie> ties, const Vectors& velocity, Memory& memory) {
  const double h = 0.5 * (m.dt + m.next), share = share_to_come(m), half = 0.5 * m.dt;
  double power_rate = 0;
  memory.held = 0;
  for (std::size_t k = 0; k < ties.size(); ++k) {
    const HeldTie& b = ties[k];
    Near& near = memory.near[k];
    ElementForces& element = near.element;
    const Vec3 force = b.impulse / h, before = rate_before(b, m), after = rate(b, velocity);
    Stencil& hold = element.stencil[0] = {};
    Stencil& couple = element.stencil[1] = {};
    if (b.nodes == 1) {
      if (memory.status[near.apex] != Status::unpaired) ++memory.lost;
      let_go(near, memory);
      continue;
    }
    hold.facet = couple.facet = b.facet;
    hold.push = force, couple.apex = 0, couple.push = -b.height * b.normal;
    for (int I = 0; I < 3; ++I) hold.weight[(b.first + I) % 3] = -b.weight[I + 1];
    if (b.nodes == 5) hold.fourth = -b.weight[4];
    element.count = 1;
    if (b.height != 0) {
      element.count = 2;
      for (int I = 0; I < 3; ++I) couple.weight[(b.first + I) % 3] = force.dot(b.gradient[I]);
      if (b.nodes == 5) couple.fourth = force.dot(b.gradient[3]);
    }
    if (memory.feature[near.apex].facet != b.facet) ++memory.walks, ++memory.reconnections[near.apex];
    memory.feature[near.apex] = {b.facet, geometry::Kind::facet, 0};
    element.closed = true;
    element.scale = 1;
    element.apex = force;
    memory.status[near.apex] = Status::closed;
    memory.gap[near.apex] = b.off.dot(b.normal);
    memory.work += half * power(interface, memory.shares, m.v, near.apex, element);
    memory.angular_impulse += half * moment(interface, memory.shares, m.x, m.v, 0, near.apex, element);
    memory.held += share * b.impulse.dot(mean_to_come(before, after, share));
    power_rate += b.impulse.dot(after - before) / (h * h);
  }
  sum_force(m.dt, memory);
  memory.work += m.dt * m.dt / 8 * (power_rate - memory.power_rate);
  memory.power_rate = power_rate;
  // an edge of the base stops what slides over it: the most that was taken so far, since what came back later was not lost, but made
  if (interface.slides) memory.impact = std::max(memory.impact, -memory.work);
}

void book_start(const Motion& m, std::span<const HeldTie> ties, const Vectors& velocity, Memory& memory, Vectors& impulse) {
  double work = 0;
  for (const HeldTie& b : ties) {
    work += 0.5 * b.impulse.dot(rate_before(b, m) + rate(b, velocity));
    for (int j = 0; j < b.nodes; ++j) {
      const Vec3 one = part(b, j, b.impulse);
      impulse.col(b.node[j]) += one;
      memory.angular_impulse += m.x.col(b.node[j]).cross(one);
    }
    memory.impulse += b.impulse;
  }
  memory.work += work;
  memory.impact += std::max(0.0, -work);
}

bool is_past_border(const BaseSurface& base, const Vectors& x, const Stand& at) {
  return at.past > past_border * std::sqrt(area_vector(base, x, at.feature.facet).norm());
}

Tie tie_over(const Interface& interface, const Vectors& x, Index apex, Index facet) {
  const Vec3 p = x.col(interface.apexes[apex]);
  const Feature feature{facet, geometry::Kind::facet, 0};
  FeatureHeight over = height_over(interface.base, x, feature, p);
  Tie tie{.facet = facet};
  tie.on_face = by_multipliers(interface) && stand_on_face(interface.base, x, p, feature, 0, nullptr, over, tie.weight[3]);
  std::copy(over.weight.begin(), over.weight.end(), tie.weight.begin());
  // a height of round-off is none: a tie without one is simpler
  tie.height = std::abs(over.height) < 1e-9 * interface.base.longest(facet) ? 0 : over.height;
  return tie;
}

void tie_here(const Vectors& x, Interface& interface) {
  for (std::size_t a = 0; a < interface.ties.size(); ++a) {
    Tie& tie = interface.ties[a];
    if (tie.facet >= 0) tie = tie_over(interface, x, static_cast<Index>(a), tie.facet);
  }
}

Vec3 normal_of(const Interface& interface, const Near& near, const Vectors& x) {
  const Index apex = near.apex;
  HeldTie b = held_tie(interface, apex);
  if (interface.slides) {
    slide(interface, x, near, false, b);
    return b.normal;
  }
  set_weights(interface.ties[apex], b);
  return tangents(b, slopes(b), x).area().normalized();
}

}  // namespace nereid::contact
