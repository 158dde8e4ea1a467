// Contact elements at random: is the gradient of the height what the paper's B must be?
//
//        * apex          tetrahedral element   apex over a facet of three nodes
//       /|\              triangular element    apex over an edge of two
//      / | \             line element          apex over one node
//     1--|--2
//       \3/              Every so often all nodes but the spread along x are squeezed into a sliver.
//
// Question  Is B the gradient of the height; does it exert no net force and no net moment; does it turn with the
//           element and forget the order of its nodes?
// Answer    verification/contact_elements/README.md
// Run       contact_elements cases/contact_elements/random.yaml --out out/contact_elements

#include <algorithm>
#include <cmath>
#include <random>

#include "drivers/driver.hpp"
#include "geometry/height.hpp"

using namespace nereid;
using geometry::Printing;

using Point = Vector<double>;

enum class Formula { height, corrected, printed };

struct Case {
  int elements;      // of each kind
  int seed;
  double slivers;    // [-] share of squeezed elements
  double squeeze;    // [-] how much thinner these are
  double step;       // [-] of differences, over the smallest length that the height divides by
  Formula formula;   // of the tetrahedral element
};

Case read(const input::Section& root) {
  Case c{.elements = root.count("elements", 1, 1000000),
         .seed = root.count_or("seed", 7, 0),
         .slivers = root.number_or("slivers", 0.25, input::within(0, 1)),
         .squeeze = root.number_or("squeeze", 100, input::at_least(1)),
         .step = root.number_or("step", 1e-3, input::between(0, 0.1)),
         .formula = Formula::height};
  const std::string formula = root.choice_or("formula", "height", {"height", "corrected", "printed"});
  if (formula != "height") c.formula = formula == "printed" ? Formula::printed : Formula::corrected;
  return c;
}

/// The nodes of one element, the apex last. [m]
template <int nodes>
using Element = std::array<Point, nodes + 1>;

template <int nodes>
geometry::Height<double, nodes> height_over(const Element<nodes>& x) {
  std::array<Point, nodes> base;
  std::copy_n(x.begin(), nodes, base.begin());
  if constexpr (nodes == 3) return geometry::facet_height(base, x[nodes]);
  else if constexpr (nodes == 2) return geometry::edge_height(base, x[nodes]);
  else return geometry::vertex_height(base, x[nodes]);
}

template <int nodes>
Element<nodes> gradient(const Element<nodes>& x, Formula formula) {
  if constexpr (nodes == 3) {
    if (formula != Formula::height) {
      const auto printing = formula == Formula::printed ? Printing::as_printed : Printing::corrected;
      return geometry::paper_gradient({x[0], x[1], x[2]}, x[3], printing);
    }
  }
  return geometry::height_gradient(height_over<nodes>(x));
}

/// The longest edge, and the smallest length that the height divides by. [m]
struct Lengths {
  double longest = 0, least = 0;
};
template <int nodes>
Lengths lengths_of(const Element<nodes>& x) {
  Lengths of;
  double longest_of_base = 0;
  for (int a = 0; a <= nodes; ++a)
    for (int b = 0; b < a; ++b) {
      of.longest = std::max(of.longest, norm(x[a] - x[b]));
      if (a < nodes) longest_of_base = std::max(longest_of_base, norm(x[a] - x[b]));
    }
  if constexpr (nodes == 3) of.least = norm(cross(x[1] - x[0], x[2] - x[0])) / longest_of_base;
  else of.least = std::abs(height_over<nodes>(x).height);
  if constexpr (nodes == 2) of.least = std::min(of.least, longest_of_base);
  return of;
}

/// Central differences of the height, of the fourth order in their step. [-]
template <int nodes>
Element<nodes> by_differences(const Element<nodes>& x, double step) {
  Element<nodes> B;
  for (int a = 0; a <= nodes; ++a)
    for (int i = 0; i < 3; ++i) {
      const auto height = [&](double by) {
        Element<nodes> moved = x;
        moved[a][i] += by;
        return height_over<nodes>(moved).height;
      };
      B[a][i] = (8 * (height(step) - height(-step)) - (height(2 * step) - height(-2 * step))) / (12 * step);
    }
  return B;
}

template <int nodes>
double largest(const Element<nodes>& B) {
  double most = 0;
  for (const Point& b : B) most = std::max(most, norm(b));
  return most;
}
template <int nodes>
double difference(const Element<nodes>& a, const Element<nodes>& b) {
  double most = 0;
  for (int n = 0; n <= nodes; ++n) most = std::max(most, norm(a[n] - b[n]));
  return most;
}

/// Numbers between -1 and 1, the same on every machine.
class Numbers {
 public:
  explicit Numbers(int seed) : random_(static_cast<std::uint32_t>(seed)) {}
  double next() { return random_() / 2147483648.0 - 1.0; }
  Point point(double squeeze) { const double x = next(), y = next(), z = next(); return {x, y / squeeze, z / squeeze}; }

 private:
  std::mt19937 random_;
};

/// What is wrong with one element, all over the length of its largest B. [-]
struct Errors {
  double gradient = 0, force = 0, moment = 0, motion = 0, order = 0;
  void see(const Errors& one) {
    gradient = std::max(gradient, one.gradient);
    force = std::max(force, one.force);
    moment = std::max(moment, one.moment);
    motion = std::max(motion, one.motion);
    order = std::max(order, one.order);
  }
};

/// B of the base nodes in another order: of a facet turned on, of an edge exchanged.
template <int nodes>
double error_of_order(const Element<nodes>& x, const Element<nodes>& B, Formula formula) {
  double most = 0;
  for (int by = 1; by < nodes; ++by) {
    Element<nodes> turned = x;
    for (int a = 0; a < nodes; ++a) turned[a] = x[(a + by) % nodes];
    const Element<nodes> there = gradient<nodes>(turned, formula);
    for (int a = 0; a < nodes; ++a) most = std::max(most, norm(there[a] - B[(a + by) % nodes]));
    most = std::max(most, norm(there[nodes] - B[nodes]));
  }
  return most;
}

template <int nodes>
Errors errors_of(const Element<nodes>& x, const Case& c, Numbers& numbers) {
  const Lengths lengths = lengths_of<nodes>(x);
  const Element<nodes> B = gradient<nodes>(x, c.formula);
  const double size = largest<nodes>(B);
  Point force{0, 0, 0}, moment{0, 0, 0};
  for (int a = 0; a <= nodes; ++a) force = force + B[a], moment = moment + cross(x[a], B[a]);

  const Matrix<double> Q = cayley_rotation(Point{3 * numbers.next(), 3 * numbers.next(), 3 * numbers.next()});
  const Point shift{numbers.next(), numbers.next(), numbers.next()};
  Element<nodes> moved = x, turned = B;
  for (int a = 0; a <= nodes; ++a) moved[a] = Q * x[a] + shift, turned[a] = Q * B[a];
  return {.gradient = difference<nodes>(B, by_differences<nodes>(x, c.step * lengths.least)) / size,
          .force = norm(force) / size,
          .moment = norm(moment) / (size * lengths.longest),
          .motion = difference<nodes>(gradient<nodes>(moved, c.formula), turned) / size,
          .order = error_of_order<nodes>(x, B, c.formula) / size};
}

/// All elements with so many base nodes: a row of history each, the largest errors as results.
template <int nodes>
void look_at(const Case& c, const std::string& name, Numbers& numbers, driver::Answer& answer) {
  Errors worst;
  double sharpest = 0;
  for (int e = 0; e < c.elements; ++e) {
    const double squeeze = 0.5 * (numbers.next() + 1) < c.slivers ? c.squeeze : 1;
    Element<nodes> x;
    for (Point& point : x) point = numbers.point(squeeze);
    const Lengths lengths = lengths_of<nodes>(x);
    const double sharpness = lengths.longest / lengths.least;
    const Errors one = errors_of<nodes>(x, c, numbers);
    worst.see(one);
    sharpest = std::max(sharpest, sharpness);
    answer.time.push_back(static_cast<double>(answer.rows.size()));
    answer.rows.push_back({static_cast<double>(nodes), sharpness, one.gradient, one.force, one.moment, one.motion, one.order});
  }
  answer.results.insert(answer.results.end(), {{name + "_gradient", worst.gradient, "1"},
                                               {name + "_force", worst.force, "1"},
                                               {name + "_moment", worst.moment, "1"},
                                               {name + "_motion", worst.motion, "1"},
                                               {name + "_order", worst.order, "1"},
                                               {name + "_sharpest", sharpest, "1"}});
}

std::function<driver::Answer()> plan(const input::CaseFile& file) {
  const Case c = read(file.root());
  file.finish();
  return [c] {
    driver::Answer answer{.columns = {{"base_nodes", "1"}, {"sharpness", "1"}, {"gradient", "1"}, {"force", "1"}, {"moment", "1"},
                                      {"motion", "1"}, {"order", "1"}},
                          .time = {}, .rows = {}, .results = {}};
    Numbers numbers(c.seed);
    look_at<3>(c, "tetrahedral", numbers, answer);
    look_at<2>(c, "triangular", numbers, answer);
    look_at<1>(c, "line", numbers, answer);
    return answer;
  };
}

int main(int argc, char** argv) { return driver::answer(argc, argv, "contact_elements", plan); }
