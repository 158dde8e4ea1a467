#include "contact/multiplier/crossing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "contact/connect.hpp"
#include "contact/data/workspace.hpp"
#include "contact/multiplier/enforce.hpp"
#include "contact/multiplier/predict.hpp"
#include "contact/search/edge_pairs.hpp"
#include "contact/tracking/edge_over_edge.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/box.hpp"
#include "mesh/disc.hpp"
#include "mesh/placement.hpp"
#include "mesh/skin.hpp"

namespace nereid::contact::crossing_test {
namespace {

/// Two square bars, 1 x 1 x 6 m, the upper one along x and the lower one turned by `degrees` from it; both stand on their ridges, `gap`
/// apart.
struct Bars {
  mesh::Mesh mesh;
  EdgeContact contact;
  EdgeMemory memory;

  Bars(double degrees, double gap, int cells = 3) {
    const double turn = std::acos(-1.0) / 180;
    const auto bar = [&](const char* name) {
      mesh::Mesh one = mesh::box(name, {{-3, -0.5, -0.5}, {3, 0.5, 0.5}, {cells, 1, 1}});
      one.surfaces.push_back({std::string(name) + ".skin", mesh::skin(one.X, one.hexahedra).facets});
      return mesh::rotated_about(std::move(one), Vec3::UnitX(), 45 * turn, Vec3::Zero());
    };
    mesh::Mesh lower = mesh::rotated_about(bar("lower"), Vec3::UnitZ(), degrees * turn, Vec3::Zero());
    mesh = mesh::join(mesh::moved(bar("upper"), {0, 0, std::sqrt(2.0) + gap}), lower);
    contact.edges = edges_of(mesh, mesh::surface(mesh, "upper.skin"), {});
    contact.base_edges = edges_of(mesh, mesh::surface(mesh, "lower.skin"), {});
    contact.margin = 0.3;
    contact.depth = 0.5;
    contact.apexes = nodes_of(contact.edges), contact.base_nodes = nodes_of(contact.base_edges);
  }

  /// The pair of edges that are over each other, of all that a search lists.
  Over only() {
    EdgeWorkspace workspace(contact);
    const InitialGaps gaps = connect(contact, mesh.X, memory, workspace);
    EXPECT_GT(gaps.pairs, 0);
    Over found;
    int count = 0;
    for (const EdgePair& pair : memory.edge_pairs) {
      const Over at = over(contact, mesh.X, pair.edge, pair.base_edge, pair.in_face, 0);
      if (at.is && at.normal.z() > 0.99) found = at, ++count;  // and not at the ends of the bars
    }
    EXPECT_EQ(count, 1);
    return found;
  }
};

TEST(Over, RidgesThatCrossTouchAtOnePointAtAnyAngle) {
  for (const double degrees : {90.0, 45.0, 5.0, 1.0, 0.1}) {
    for (const double gap : {0.01, 0.0, -0.01}) {
      const Over at = Bars(degrees, gap).only();
      EXPECT_NEAR(at.height, gap, 1e-10) << degrees;
      EXPECT_NEAR(at.normal.z(), 1, 1e-12);
      EXPECT_NEAR(at.first, 0.5, 1e-9);
      EXPECT_NEAR(at.second, 0.5, 1e-9);
    }
  }
}

/// A block on another, turned by any angle and tilted by a little, and what random ways of nodes against each other make of its edges: how
/// many pairs lay flat, and how many of them are over each other after `times` the way that `stays_flat` allows.
struct Flat {
  int pairs = 0, over = 0;
};
Flat moved_flat_edges(double times, bool plates) {
  Flat found;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    const auto box = [plates](const char* name, int cells) {
      if (plates) {
        mesh::Mesh one = mesh::sheet(name, {.length = 2, .width = 2, .cells_along = cells, .cells_across = cells});
        one.surfaces.push_back({std::string(name) + ".skin", mesh::both_sides(one.triangles[0].nodes)});
        return mesh::moved(std::move(one), {-1, -1, std::string(name) == "base" ? 1.0 : 0.0});
      }
      mesh::Mesh one = mesh::box(name, {{-1, -1, 0}, {1, 1, 1}, {cells, cells, 1}});
      one.surfaces.push_back({std::string(name) + ".skin", mesh::skin(one.X, one.hexahedra).facets});
      return one;
    };
    mesh::Mesh block = mesh::rotated_about(box("block", 2), Vec3::UnitZ(), 3 * any(random), Vec3::Zero());
    block = mesh::rotated_about(std::move(block), Vec3::UnitX(), 0.1 * any(random), Vec3::Zero());
    const mesh::Mesh mesh = mesh::join(mesh::moved(std::move(block), {0.3 * any(random), 0, 1}), box("base", 3));
    EdgeContact contact;
    contact.edges = edges_of(mesh, mesh::surface(mesh, "block.skin"), {});
    contact.base_edges = edges_of(mesh, mesh::surface(mesh, "base.skin"), {});
    for (Index edge = 0; edge < contact.edges.nodes.cols(); ++edge)
      for (Index base = 0; base < contact.base_edges.nodes.cols(); ++base) {
        const bool ridges = is_ridge(contact.edges, mesh.X, edge) && is_ridge(contact.base_edges, mesh.X, base);
        const double room = ridges ? 0 : stays_flat(contact, mesh.X, edge, base);
        if (!(room > 0)) continue;
        ++found.pairs;
        EXPECT_FALSE(over(contact, mesh.X, edge, base, true, 0).is);
        Vectors x = mesh.X;
        for (int i = 0; i < 5; ++i) {
          for (Eigen::Index node = 0; node < x.cols(); ++node)
            x(2, node) = mesh.X(2, node) + std::copysign(0.5 * times * room, any(random));  // what turns facets most
          if (!over(contact, x, edge, base, true, 0).is) continue;
          ++found.over;
          break;
        }
      }
  }
  return found;
}

TEST(StaysFlat, NoEdgeComesOverAnotherOneWithinItsWay) {
  const Flat within = moved_flat_edges(1, false), beyond = moved_flat_edges(24, false);
  EXPECT_GT(within.pairs, 5000);
  EXPECT_EQ(within.over, 0);
  EXPECT_GT(beyond.over, 50);  // facets turn most where all nodes do their worst, and few do
}

TEST(StaysFlat, NoEdgeOfPlatesComesOverAnotherOneWithinItsWay) {
  const Flat within = moved_flat_edges(1, true), beyond = moved_flat_edges(24, true);
  EXPECT_GT(within.pairs, 2000);
  EXPECT_EQ(within.over, 0);
  EXPECT_GT(beyond.over, 10);
}

/// Of two sheets that cross, each with a crease along its middle that turns by `degrees`, how many edges are over each other: the crest of
/// the lower one is up, and that of the upper one down or up.
int crossing_crests(double degrees, bool upper_down) {
  const double slope = std::tan(0.5 * degrees * std::acos(-1.0) / 180), gap = 0.01;
  const auto roof = [&](const char* name, double sign) {
    mesh::Mesh one = mesh::sheet(name, {.length = 2, .width = 1, .cells_along = 2, .cells_across = 1});
    for (auto at : one.X.colwise()) at.z() = -sign * slope * std::abs(at.x() - 1);
    one.surfaces.push_back({std::string(name) + ".skin", mesh::both_sides(one.triangles[0].nodes)});
    return one;
  };
  const double quarter = 0.5 * std::acos(-1.0);
  mesh::Mesh upper = mesh::rotated_about(roof("upper", upper_down ? -1 : 1), Vec3::UnitZ(), quarter, Vec3::Zero());
  const mesh::Mesh mesh = mesh::join(mesh::moved(std::move(upper), {1.5, -0.5, gap}), roof("lower", 1));
  EdgeContact contact;
  contact.edges = edges_of(mesh, mesh::surface(mesh, "upper.skin"), {});
  contact.base_edges = edges_of(mesh, mesh::surface(mesh, "lower.skin"), {});
  contact.margin = 0.3, contact.depth = 0.5;
  contact.apexes = nodes_of(contact.edges), contact.base_nodes = nodes_of(contact.base_edges);
  EdgeMemory memory;
  EdgeWorkspace workspace(contact);
  connect(contact, mesh.X, memory, workspace);
  int count = 0;
  for (const EdgePair& pair : memory.edge_pairs) {
    const Over at = over(contact, mesh.X, pair.edge, pair.base_edge, pair.in_face, 0);
    if (!at.is || std::abs(at.first - 0.5) > 1e-9 || std::abs(at.second - 0.5) > 1e-9) continue;  // rims cross rims elsewhere
    ++count;
    EXPECT_NEAR(at.height, gap, 1e-12);
  }
  return count;
}

TEST(Over, CrestsOfCurvedSheetsCrossThoughTheyTurnByLittle) {
  for (const double degrees : {6.0, 12.0, 19.0, 25.0}) EXPECT_EQ(crossing_crests(degrees, true), 1) << degrees;
  EXPECT_EQ(crossing_crests(12, false), 0) << "a sheet that bends away is left to its nodes";
  EXPECT_EQ(crossing_crests(4, true), 0) << "what it leaves open is small";
}

TEST(Over, ParallelRidgesAreLeftToTheirNodes) {
  Bars bars(0, 0.01);
  EdgeWorkspace workspace(bars.contact);
  connect(bars.contact, bars.mesh.X, bars.memory, workspace);
  EXPECT_FALSE(bars.memory.edge_pairs.empty());
  for (const EdgePair& pair : bars.memory.edge_pairs)
    EXPECT_FALSE(over(bars.contact, bars.mesh.X, pair.edge, pair.base_edge, pair.in_face, 0).is);
}

TEST(Over, EndsWhereTheNextEdgeBegins) {
  for (const double along : {0.0, 0.4, 0.999, 1.001, 1.7}) {  // the upper bar has a node at 1 m
    Bars bars(90, 0.01);
    for (const Index node : mesh::node_set(bars.mesh, "upper")) bars.mesh.X(0, node) -= along;
    const Over at = bars.only();
    const double place = std::fmod(along + 1, 2.0) / 2;  // from one end or the other
    EXPECT_NEAR(std::abs(at.first - 0.5), std::abs(place - 0.5), 1e-9) << along;
  }
}

/// Makes the ridge below the upper bar turn by 60 degrees, and tilts the bar about it, so that one flank rises by one degree, and the other
/// by 59.
void lay_flank_flat(bool towards_y, Bars& bars) {
  const double degrees = towards_y ? -29 : 29;
  const Mat3 turn = Eigen::AngleAxisd(degrees * std::acos(-1.0) / 180, Vec3::UnitX()).toRotationMatrix();
  const Subset upper = mesh::node_set(bars.mesh, "upper");
  double lowest = 1e300;
  for (const Index node : upper) lowest = std::min(lowest, bars.mesh.X(2, node)), bars.mesh.X(1, node) *= std::sqrt(3.0);
  const Vec3 ridge(0, 0, lowest);
  for (const Index node : upper) bars.mesh.X.col(node) = ridge + turn * (bars.mesh.X.col(node) - ridge);
}

TEST(Over, LeavesTheEndOfAnEdgeToItsNodeOnlyWhereThatIsOverAFace) {
  for (const bool flat : {true, false}) {
    Bars bars(90, 0.01);
    lay_flank_flat(flat, bars);
    for (const Index node : mesh::node_set(bars.mesh, "upper")) bars.mesh.X(1, node) += 0.99;  // the lower bar has a node at 1 m
    EdgeWorkspace workspace(bars.contact);
    connect(bars.contact, bars.mesh.X, bars.memory, workspace);
    int count = 0;
    for (const EdgePair& pair : bars.memory.edge_pairs) {
      const Over at = over(bars.contact, bars.mesh.X, pair.edge, pair.base_edge, pair.in_face, 0);
      count += at.is && at.normal.z() > 0.99 && at.height < 0.011;  // not the other ridge of the flat flank
    }
    EXPECT_EQ(count, flat ? 0 : 1);
  }
}

TEST(ConnectEdges, SeesRidgesThatStartInEachOther) {
  Bars apart(90, 0.01), in_each_other(90, -0.01), through(90, -1.3);
  const auto gaps = [](Bars& bars) {
    EdgeWorkspace workspace(bars.contact);
    return connect(bars.contact, bars.mesh.X, bars.memory, workspace);
  };
  EXPECT_EQ(gaps(apart).penetrating, 0);
  EXPECT_EQ(gaps(in_each_other).penetrating, 1);
  EXPECT_NEAR(gaps(in_each_other).deepest, 0.01, 1e-12);
  for (const Crossing& crossing : in_each_other.memory.crossings) {
    if (crossing.side == 0) continue;
    EXPECT_NEAR(crossing.level, -0.01, 1e-12);  // what is accepted makes no force
  }
  EXPECT_EQ(gaps(through).penetrating, 0);  // the ridges behind are far behind: the audit sees that overlap
}

TEST(SearchCrossings, LeavesOutEdgesThatAreNowhere) {
  Bars bars(90, 0.01);
  EdgeWorkspace workspace(bars.contact);
  connect(bars.contact, bars.mesh.X, bars.memory, workspace);
  EXPECT_FALSE(bars.memory.edge_pairs.empty());
  for (const double nowhere : {std::nan(""), HUGE_VAL, 1e200}) {
    for (const Index node : mesh::node_set(bars.mesh, "upper")) bars.mesh.X(node % 3, node) = nowhere;
    search(bars.contact, bars.mesh.X, bars.memory, workspace);
    EXPECT_TRUE(bars.memory.edge_pairs.empty());
  }
}

TEST(SearchCrossings, KeepsWhatPairsRemember) {
  Bars bars(90, 0.01);
  EdgeWorkspace workspace(bars.contact);
  connect(bars.contact, bars.mesh.X, bars.memory, workspace);
  ASSERT_FALSE(bars.memory.edge_pairs.empty());
  bars.memory.crossings = {crossing_of(bars.memory.edge_pairs[0])};
  bars.memory.crossings[0].restitution.held = 3;
  search(bars.contact, bars.mesh.X, bars.memory, workspace);
  ASSERT_EQ(bars.memory.crossings.size(), 1);
  EXPECT_EQ(bars.memory.crossings[0].restitution.held, 3);
  for (const Index node : mesh::node_set(bars.mesh, "upper")) bars.mesh.X(2, node) += 5;
  search(bars.contact, bars.mesh.X, bars.memory, workspace);
  EXPECT_TRUE(bars.memory.edge_pairs.empty());
  EXPECT_TRUE(bars.memory.crossings.empty());
  EXPECT_EQ(bars.memory.impact, 3);  // what is let go is lost
}

/// Finds the conditions of bars of unit masses, step after step.
struct Steps {
  static constexpr double h = 1e-3;  // s
  const Vectors none{3, 0};
  const Scalars no_inertia;
  const std::vector<const Mat3*> no_rotations;
  Vectors x;
  Multipliers all;

  explicit Steps(const Bars& bars)
      : x(bars.mesh.X), all(make_multipliers(std::vector<AnyContact>{bars.contact}, {}, static_cast<Index>(x.cols()), 0)) {}

  /// With all nodes on their way to `next` within a step.
  void find(Bars& bars, EdgeWorkspace& workspace, const Vectors& next) {
    const Vectors v = (next - x) / h, force = Vectors::Zero(3, x.cols());
    const Scalars mass = Scalars::Ones(x.cols());
    const std::vector<Index> turns(static_cast<std::size_t>(x.cols()), -1);
    const std::vector<const Mat3*> allowed(static_cast<std::size_t>(x.cols()), nullptr);
    const Motion m{x, v, none, force, none, mass, no_inertia, turns, allowed, no_rotations, h, h};
    all.conditions.clear(), all.contactors.clear();
    look_ahead(bars.contact.apexes, m, all), look_ahead(bars.contact.base_nodes, m, all);
    find_conditions(bars.contact, m, bars.memory, workspace, all);
    x = next;
  }
};

TEST(FindCrossings, DoesNotTakeRidgesThatTurnPastEachOtherForOnesThatMeet) {
  // the ridges away from each other, on top and below: parallel for a moment, where their lines are across moves past the end of both
  const auto turned = [](double degrees, double across) {
    Bars bars(degrees, 0.5, 1);
    const double angle = degrees * std::acos(-1.0) / 180;
    for (const Index node : mesh::node_set(bars.mesh, "lower")) bars.mesh.X.col(node) += Vec3(1, -std::tan(angle) * (across - 1), 0);
    return bars;
  };
  Bars bars = turned(-1, 3.2);
  bars.contact.margin = 4;  // so that a search lists them
  EdgeWorkspace workspace(bars.contact);
  connect(bars.contact, bars.mesh.X, bars.memory, workspace);
  Steps steps(bars);
  for (const double degrees : {1.0, 2.0}) {
    steps.find(bars, workspace, turned(degrees, 2.5).mesh.X);
    for (const Condition& c : steps.all.conditions) EXPECT_GT(c.gap, -0.1) << degrees;
  }
}

/// How many conditions hold the ridges of two bars apart in a step in which the upper one goes `along` and falls by twice the gap. An edge
/// of it ends 0.2 m past the lower ridge at the start; with more than one cell the next edge of its ridge follows there.
std::ptrdiff_t held_as_they_pass(int cells, double along) {
  const double gap = 0.1, past = 0.2, length = 6.0 / cells;
  Bars bars(90, gap, cells);
  for (const Index node : mesh::node_set(bars.mesh, "upper")) bars.mesh.X(0, node) += 0.5 * length - past;
  EdgeWorkspace workspace(bars.contact);
  connect(bars.contact, bars.mesh.X, bars.memory, workspace);
  Vectors next = bars.mesh.X;
  for (const Index node : mesh::node_set(bars.mesh, "upper")) next.col(node) += Vec3(along, 0, -2 * gap);
  Steps steps(bars);
  steps.find(bars, workspace, next);
  const auto holds = [&](const Condition& c) { return c.normal.z() > 0.99 && std::abs(c.gap - gap) < 1e-12 && c.least > c.free; };
  return std::count_if(steps.all.conditions.begin(), steps.all.conditions.end(), holds);
}

TEST(FindCrossings, LetsEdgesPassThatLeaveEachOtherSidewaysBeforeTheirLinesMeet) {
  EXPECT_EQ(held_as_they_pass(1, 0.39), 1);  // half of it until the lines meet
  EXPECT_EQ(held_as_they_pass(1, 0.41), 0);
  EXPECT_EQ(held_as_they_pass(3, 0.5), 1);  // by the next edge
}

TEST(FindCrossings, GoesOnWithAnOverlapThatWasAccepted) {
  for (const double overlap : {0.002, 0.02, 0.2}) {  // 0.5 m is the depth of an element
    Bars bars(90, -overlap);
    EdgeWorkspace workspace(bars.contact);
    connect(bars.contact, bars.mesh.X, bars.memory, workspace);
    Steps steps(bars);
    for (int step = 0; step < 2; ++step) {
      steps.find(bars, workspace, steps.x);
      ASSERT_EQ(steps.all.conditions.size(), 1) << overlap;
      EXPECT_NEAR(steps.all.conditions[0].gap, 0, 1e-12);
    }
  }
}

TEST(FindCrossings, HoldsEdgesApartByHalfOfThePlatesOfBothSidesWhicheverIsThicker) {
  constexpr double apart = 0.3, height = 0.01;
  for (const double one : {0.0, 0.05, 0.15})
    for (const double other : {0.0, 0.08, 0.12}) {
      Bars bars(90, apart);
      bars.contact.height = height;
      bars.contact.edges.half = Scalars::Constant(bars.contact.edges.nodes.cols(), one);
      bars.contact.base_edges.half = Scalars::Constant(bars.contact.base_edges.nodes.cols(), other);
      EdgeWorkspace workspace(bars.contact);
      connect(bars.contact, bars.mesh.X, bars.memory, workspace);
      Vectors closer = bars.mesh.X;
      for (const Index node : mesh::node_set(bars.mesh, "upper")) closer(2, node) -= apart;
      Steps steps(bars);
      steps.find(bars, workspace, closer);
      double least = infinite;
      for (const Condition& c : steps.all.conditions)
        if (c.normal.z() > 0.99) least = std::min(least, c.gap);
      EXPECT_NEAR(least, apart - height - one - other, 1e-12) << one << " " << other;
    }
}

TEST(FindCrossings, HoldsAFaceThatLeansWhereTheyAreOverEachOther) {
  Bars bars(90, 0.001, 1);
  EdgeWorkspace workspace(bars.contact);
  connect(bars.contact, bars.mesh.X, bars.memory, workspace);
  const EdgePair pair = bars.memory.edge_pairs.front();
  const Over before = over(bars.contact, bars.mesh.X, pair.edge, pair.base_edge, false, 0);
  ASSERT_TRUE(before.is);
  for (const Index node : mesh::node_set(bars.mesh, "upper"))  // one flank of the upper bar comes down to 0.1 below its ridge
    if (bars.mesh.X(1, node) > 0.1) bars.mesh.X(2, node) = bars.mesh.X(2, bars.contact.edges.nodes(0, pair.edge)) - 0.1;
  EXPECT_FALSE(over(bars.contact, bars.mesh.X, pair.edge, pair.base_edge, false, 0).is);
  EXPECT_TRUE(over(bars.contact, bars.mesh.X, pair.edge, pair.base_edge, false, before.side).is);
}

TEST(FindCrossings, HoldsARidgeThatIsFlattenedWhereTheyAreOverEachOther) {
  Bars bars(90, 0.001);
  lay_flank_flat(true, bars);
  const double half = std::sqrt(0.5);
  const auto turned = [&](double degrees) {  // the upper ridge of the lower bar
    Vectors x = bars.mesh.X;
    for (const Index node : mesh::node_set(bars.mesh, "lower"))
      if (std::abs(x(2, node)) < 1e-9) x(2, node) = half * (1 - std::tan(0.5 * degrees * std::acos(-1.0) / 180));
    return x;
  };
  const Vectors flat = turned(10);
  bars.mesh.X = turned(25);
  EdgeWorkspace workspace(bars.contact);
  connect(bars.contact, bars.mesh.X, bars.memory, workspace);
  Steps steps(bars);
  for (const Vectors& next : {bars.mesh.X, flat}) steps.find(bars, workspace, next);
  search(bars.contact, flat, bars.memory, workspace);
  const auto is_held_in_face = [](const Crossing& crossing) { return crossing.in_face && crossing.side != 0; };
  EXPECT_TRUE(std::any_of(bars.memory.crossings.begin(), bars.memory.crossings.end(), is_held_in_face));
  steps.find(bars, workspace, flat);
  const auto is_held = [](const Condition& c) { return std::abs(c.gap - 0.001) < 1e-12 && c.normal.z() > 0.999; };
  EXPECT_EQ(std::count_if(steps.all.conditions.begin(), steps.all.conditions.end(), is_held), 1);
}

TEST(FindCrossings, HoldsARidgeOffTheEdgesWithinAFaceWhereItStandsUp) {
  // the upper bar lies flat or on its ridge over the flat top of the lower one, between whose elements are edges
  for (const bool stands : {true, false}) {
    Bars bars(0, 0);
    for (const Index node : mesh::node_set(bars.mesh, "lower")) {
      const Vec3 X = bars.mesh.X.col(node);
      bars.mesh.X.col(node) = Vec3(X.x() + 0.4, (X.y() + X.z()) / std::sqrt(2.0) + 0.1, (X.z() - X.y()) / std::sqrt(2.0) - 0.5);
    }
    for (const Index node : mesh::node_set(bars.mesh, "upper")) {
      const double y = bars.mesh.X(1, node), z = bars.mesh.X(2, node) - std::sqrt(2.0);
      if (stands) bars.mesh.X(2, node) = z + std::sqrt(0.5);
      else bars.mesh.X(1, node) = (y + z) / std::sqrt(2.0), bars.mesh.X(2, node) = (z - y) / std::sqrt(2.0) + 0.5;
    }
    EdgeWorkspace workspace(bars.contact);
    connect(bars.contact, bars.mesh.X, bars.memory, workspace);
    int count = 0, listed = 0;
    for (const EdgePair& pair : bars.memory.edge_pairs) {
      if (!pair.in_face) continue;
      ++listed;
      const Over at = over(bars.contact, bars.mesh.X, pair.edge, pair.base_edge, true, 0);
      if (at.is && std::abs(at.height) < 1e-9) ++count;
    }
    EXPECT_GT(listed, 0);
    if (stands) EXPECT_GT(count, 0);
    else EXPECT_EQ(count, 0);
  }
}

TEST(StaysBeside, HoldsForNodesThatGoByNoMoreInAnyDirection) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> one(-1, 1);
  EdgeContact contact;
  for (Edges* edges : {&contact.edges, &contact.base_edges}) {
    edges->nodes.resize(2, 1), edges->across.setConstant(2, 1, -1), edges->area.setOnes(1);
    edges->of_plates.assign(1, 1);
  }
  contact.edges.nodes << 0, 1;
  contact.base_edges.nodes << 2, 3;
  int beside = 0;
  double largest = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Vectors x = Vectors::NullaryExpr(3, 4, [&] { return one(random); });
    const double way = stays_beside(contact, x, 0, 0);
    if (!(way > 0)) continue;
    ++beside, largest = std::max(largest, way);
    for (int k = 0; k < 20; ++k) {
      Vectors moved = x;
      for (auto node : moved.colwise()) node += 0.5 * way * Vec3(one(random), one(random), one(random)).normalized();  // apart by `way`
      EXPECT_FALSE(over(contact, moved, 0, 0, false, 0).is) << trial;
    }
  }
  EXPECT_GT(beside, 5000);
  EXPECT_GT(largest, 0.1);
}

/// How many pairs were left alone, and how many conditions there were, while a bar that lies flat on the elements of another one tips over
/// an edge until it stands on its ridge.
struct Tipped {
  std::size_t left_alone = 0, conditions = 0;
};
Tipped tip(bool looks_at_all) {
  Bars bars(0, 0);
  for (const Index node : mesh::node_set(bars.mesh, "lower")) {
    const Vec3 X = bars.mesh.X.col(node);
    bars.mesh.X.col(node) = Vec3(X.x() + 0.4, (X.y() + X.z()) / std::sqrt(2.0) + 0.1, (X.z() - X.y()) / std::sqrt(2.0) - 0.5);
  }
  const Vectors standing = bars.mesh.X;
  const auto tipped = [&](double degrees) {  // about its ridge below
    const Mat3 turn = Eigen::AngleAxisd((degrees - 45) * std::acos(-1.0) / 180, Vec3::UnitX()).toRotationMatrix();
    const Vec3 ridge(0, 0, std::sqrt(0.5));
    Vectors x = standing;
    for (const Index node : mesh::node_set(bars.mesh, "upper")) x.col(node) = turn * (standing.col(node) - ridge);
    return x;
  };
  bars.mesh.X = tipped(0);
  EdgeWorkspace workspace(bars.contact);
  connect(bars.contact, bars.mesh.X, bars.memory, workspace);
  Steps steps(bars);
  Tipped found;
  for (int i = 1; i <= 8000; ++i) {
    for (EdgePair& pair : bars.memory.edge_pairs)
      if (looks_at_all) pair.flat = -INFINITY;
    const auto is_left = [&](const EdgePair& pair) { return pair.flat > bars.memory.way; };
    found.left_alone += static_cast<std::size_t>(std::count_if(bars.memory.edge_pairs.begin(), bars.memory.edge_pairs.end(), is_left));
    steps.find(bars, workspace, tipped(0.005 * i));
    found.conditions += steps.all.conditions.size();
  }
  return found;
}

TEST(FindCrossings, LeavesEdgesThatLieFlatAloneUntilTheyStandUp) {
  const Tipped some = tip(false), all = tip(true);
  EXPECT_EQ(some.conditions, all.conditions);
  EXPECT_GT(some.conditions, 1000);
  EXPECT_EQ(all.left_alone, 0);
  EXPECT_GT(some.left_alone, 1000);
}

/// Two fans of rims of plates that cross and rub, from random places with random masses and speeds; nodes are shared within a fan.
struct Fans {
  EdgeContact contact;
  EdgeMemory memory;
  Vectors x, v;
  Scalars mass;

  Fans(std::mt19937& random, int edges, double half) {
    std::uniform_real_distribution<double> one(-1, 1);
    const Eigen::Index nodes = 2 * (edges + 1);
    x.resize(3, nodes), v.resize(3, nodes), mass.resize(nodes);
    for (Eigen::Index node = 0; node < nodes; ++node) {
      const bool above = node <= edges;
      for (int i = 0; i < 3; ++i) x(i, node) = one(random), v(i, node) = one(random);
      x(2, node) = (above ? 1 : -1) * (half + 0.02 * one(random));
      v(2, node) -= above ? 2 : -2;
      mass(node) = std::pow(10, one(random));
    }
    const auto fan = [&](Index first) {
      Edges all;
      all.nodes.resize(2, edges), all.across.setConstant(2, edges, -1), all.area.setOnes(edges), all.half.setConstant(edges, half);
      for (Index e = 0; e < edges; ++e) all.nodes.col(e) << first, first + e + 1;
      all.of_plates.assign(static_cast<std::size_t>(edges), 1);
      return all;
    };
      contact.edges = fan(0), contact.base_edges = fan(static_cast<Index>(edges) + 1);
    contact.margin = 3, contact.depth = 1, contact.friction.coefficient = 1;
    contact.apexes = nodes_of(contact.edges), contact.base_nodes = nodes_of(contact.base_edges);
  }
};

TEST(Enforce, CreatesNothingWhereEdgesCrossAndRubWhateverTheMassesAndAngles) {
  std::mt19937 random(7);
  const Vectors none(3, 0);
  const Scalars no_inertia;
  const std::vector<const Mat3*> no_rotations;
  int touching = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Fans fans(random, 3, 0.3);
    EdgeWorkspace workspace(fans.contact);
    connect(fans.contact, fans.x, fans.memory, workspace);
    fans.memory.crossings.clear();
    const auto nodes = static_cast<Index>(fans.x.cols());
    const Vectors force = Vectors::Zero(3, nodes);
    const std::vector<Index> turns(static_cast<std::size_t>(nodes), -1);
    const std::vector<const Mat3*> allowed(static_cast<std::size_t>(nodes), nullptr);
    const Motion m{fans.x, fans.v, none, force, none, fans.mass, no_inertia, turns, allowed, no_rotations, 0.01, 0.01};
    const std::vector<AnyContact> contacts{fans.contact};
    std::vector<AnyMemory> memories{fans.memory};
    std::vector<AnyWorkspace> workspaces{workspace};
    Multipliers all = make_multipliers(contacts, {}, nodes, 0);
    enforce(contacts, {}, m, 1, memories, {}, workspaces, std::numeric_limits<double>::infinity(), false, all);
    const auto energy = [&](const Vectors& v) { return 0.5 * (v.colwise().squaredNorm().transpose().array() * fans.mass.array()).sum(); };
    touching += sides(memories[0]).force.isZero(0) ? 0 : 1;
    EXPECT_LT(energy(all.velocity), 1.01 * energy(fans.v)) << trial;  // iterations end before every rate is zero
    Vec3 gained = Vec3::Zero();
    for (Index node = 0; node < nodes / 2; ++node) gained += fans.mass(node) * (all.velocity.col(node) - fans.v.col(node));
    EXPECT_LT((gained - m.dt * sides(memories[0]).force).norm(), 1e-9 * (1 + gained.norm())) << trial << ", normal forces and friction";
  }
  EXPECT_GT(touching, 500);
}

}  // namespace
}  // namespace nereid::contact::crossing_test
