#include "element/block.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <set>

#include "base/parallel.hpp"
#include "mesh/box.hpp"

namespace nereid::element::block_test {
namespace {

using material::Elastic;
using material::J2Bilinear;
using material::J2Mixed;
using Point = Vector<double>;

const Elastic elastic{2.0, 3.0, 0.3};
const J2Bilinear plastic{2.0, 3.0, 0.3, 0.01, 0.3};
const J2Mixed mixed{2.0, 3.0, 0.3, 0.01, 0.3, 0.25};  // remembers a tensor too

/// A distorted block of hexahedra, or of the triangles of its upper face; two tiles and some
/// fillers.
struct Scene {
  mesh::Mesh mesh;
  AnyBlock block;
  Vectors x, v, w;
  Memory memory;
  TileForces forces;
  TileReports reports;

  BlockLimit move(double dt) {
    x += dt * v;
    return advance(block, x, dt * v, dt * w, dt, memory, forces, reports);
  }
};

mesh::Mesh distorted_box() {
  std::srand(5);
  mesh::Mesh mesh = mesh::box("box", {Vec3(0, 0, 0), Vec3(9, 7, 3), {9, 7, 3}});
  mesh.X += 0.1 * Vectors::Random(3, mesh.X.cols());
  mesh.triangles.push_back({"skin", mesh::surface(mesh, "box.z_high").facets});
  return mesh;
}

Scene finish(mesh::Mesh mesh, AnyBlock block) {
  const auto count = mesh.X.cols();
  std::vector<Index> column;
  for (Index n = 0; n < count; ++n) column.push_back(n);
  if (rotates(block)) set_rotations(block, column);
  Scene scene{mesh,
              block,
              mesh.X,
              0.1 * Vectors::Random(3, count),
              0.1 * Vectors::Random(3, count),
              initial_memory(block),
              tile_forces(block),
              tile_reports(block)};
  return scene;
}
const Hexahedron::Options dashpots{.hourglass = 0.05, .viscosity = {}, .hourglass_kind = Hexahedron::Hourglass::viscous};
const FullHexahedron::Options eight_points{};
Scene solids(const AnyLaw& law, const AnyHexahedronOptions& options = {}) {
  mesh::Mesh mesh = distorted_box();
  AnyBlock block = element::solids(mesh, "box", law, options);
  return finish(std::move(mesh), std::move(block));
}
Scene skin(const AnyLaw& law) {
  mesh::Mesh mesh = distorted_box();
  AnyBlock block = plates(mesh, "skin", law, {.thickness = 0.1, .viscosity = {}});
  return finish(std::move(mesh), std::move(block));
}

/// What the tiles exert, summed by node.
Vectors by_node(const Scene& s, const Vectors& slots) {
  Vectors sum = Vectors::Zero(3, s.x.cols());
  for (std::size_t p = 0; p < tiling(s.block).node.size(); ++p)
    sum.col(tiling(s.block).node[p]) += slots.col(p);
  return sum;
}

template <std::size_t count>
double total(const std::array<double, count>& channels) {
  double sum = 0;
  for (const double channel : channels) sum += channel;
  return sum;
}
template <class Channel>
double total(const Channels<Channel>& channels) {
  double sum = 0;
  for (std::size_t c = 0; c < words_of_stored.size(); ++c) sum += channels[static_cast<Channel>(c)];
  return sum;
}

/// The part of the viscosity that an element got in the last step.
template <class Kind, class Law>
Shares<double, Kind::axes> shares(const Block<Kind, Law>& block, const TileReports& reports, Index element) {
  const auto& all = block.tiling.element;
  const auto lane = static_cast<std::size_t>(std::find(all.begin(), all.end(), element) - all.begin());  // the first is no filler
  const std::size_t pack = lane / lanes;
  const auto of_pack = shares_of<Kind::axes, Kind::sides>(reports.departures.spread.data(), pack,
                                                          block.beside.data() + pack * Kind::sides * lanes);
  Shares<double, Kind::axes> share;
  for (std::size_t k = 0; k < share.size(); ++k) share[k] = of_pack[k][lane % lanes];
  return share;
}

Point column(const Vectors& x, Index n) { return {x(0, n), x(1, n), x(2, n)}; }

template <class Kind, class Law>
void solids_are_the_sum_of_their_elements(const Law& law, const typename Kind::Options& options) {
  Scene s = solids(law, options);
  const auto& block = std::get<Block<Kind, Law>>(s.block);
  ASSERT_GT(block.tiling.tiles.size(), 1u);
  std::vector<typename Kind::template Memory<double, Law>> one(block.nodes.cols());
  for (int step = 0; step < 3; ++step) {
    const BlockLimit limit = s.move(0.1);
    Vectors force = Vectors::Zero(3, s.x.cols());
    double least_step = 1e300, least_size = 1e300, stored = 0, dissipated = 0;
    Index step_at = -1, size_at = -1;
    for (Index e = 0; e < block.nodes.cols(); ++e) {
      std::array<Point, 8> X, x, v, f;
      for (int a = 0; a < 8; ++a) {
        const Index n = block.nodes(a, e);
        X[a] = column(s.mesh.X, n), x[a] = column(s.x, n), v[a] = 0.1 * column(s.v, n);
      }
      const auto report = advance(law, block.options, constants(law, block.options, X), shares(block, s.reports, e), x, v, 0.1, one[e], f);
      for (int a = 0; a < 8; ++a) force.col(block.nodes(a, e)) += Vec3(f[a].x, f[a].y, f[a].z);
      if (report.step < least_step) least_step = report.step, step_at = e;
      if (report.volume_ratio < least_size) least_size = report.volume_ratio, size_at = e;
      stored += total(report.stored);
      dissipated += total(report.dissipated);
    }
    EXPECT_LT((by_node(s, s.forces.force) - force).norm(), 1e-12 * force.norm());
    EXPECT_NEAR(limit.step, least_step, 1e-12 * least_step);
    EXPECT_NEAR(limit.volume_ratio, least_size, 1e-12);
    EXPECT_EQ(limit.step_element, step_at);
    EXPECT_EQ(limit.volume_element, size_at);
    double reported = 0, lost = 0;
    for (const auto& report : s.reports.tile) {
      reported += total(report.stored);
      lost += total(report.dissipated);
    }
    EXPECT_NEAR(reported, stored, 1e-12 * std::abs(stored)) << "fillers contribute nothing";
    EXPECT_NEAR(lost, dissipated, 1e-12 * dissipated);
  }
}

TEST(Block, OfHexahedraIsTheSumOfItsElements) {
  for (const auto& options : {Hexahedron::Options{}, dashpots}) {
    solids_are_the_sum_of_their_elements<Hexahedron>(plastic, options);
    solids_are_the_sum_of_their_elements<Hexahedron>(mixed, options);
  }
  solids_are_the_sum_of_their_elements<FullHexahedron>(elastic, eight_points);
  solids_are_the_sum_of_their_elements<FullHexahedron>(plastic, eight_points);
  solids_are_the_sum_of_their_elements<FullHexahedron>(mixed, eight_points);
}

template <class Law>
void plates_are_the_sum_of_their_elements(const Law& law) {
  Scene s = skin(law);
  const auto& block = std::get<Block<Plate, Law>>(s.block);
  std::vector<Plate::Memory<double, Law>> one(block.nodes.cols());
  for (int step = 0; step < 3; ++step) {
    const BlockLimit limit = s.move(0.1);
    Vectors force = Vectors::Zero(3, s.x.cols()), moment = force;
    double least_step = 1e300, least_size = 1e300;
    for (Index e = 0; e < block.nodes.cols(); ++e) {
      std::array<Point, 3> X, x, v, w, f, m;
      for (int a = 0; a < 3; ++a) {
        const Index n = block.nodes(a, e);
        X[a] = column(s.mesh.X, n), x[a] = column(s.x, n), v[a] = 0.1 * column(s.v, n),
        w[a] = 0.1 * column(s.w, n);
      }
      const auto report = advance(law, block.options, block.layers,
                                  constants(law, block.options, X), shares(block, s.reports, e), x, v, w, 0.1, one[e], f, m);
      for (int a = 0; a < 3; ++a) {
        force.col(block.nodes(a, e)) += Vec3(f[a].x, f[a].y, f[a].z);
        moment.col(block.nodes(a, e)) += Vec3(m[a].x, m[a].y, m[a].z);
      }
      least_step = std::min(least_step, report.step),
      least_size = std::min(least_size, report.volume_ratio);
    }
    EXPECT_LT((by_node(s, s.forces.force) - force).norm(), 1e-12 * force.norm());
    EXPECT_LT((by_node(s, s.forces.moment) - moment).norm(), 1e-12 * moment.norm());
    EXPECT_NEAR(limit.step, least_step, 1e-12 * least_step);
    EXPECT_NEAR(limit.volume_ratio, least_size, 1e-12);
  }
}

TEST(Block, OfPlatesIsTheSumOfItsElements) {
  plates_are_the_sum_of_their_elements(plastic);
  plates_are_the_sum_of_their_elements(mixed);
}

TEST(Block, WorkIsStoredOrDissipatedUpToTheSecondOrderOfTheStep) {
  for (Scene start : {solids(elastic), solids(plastic), solids(mixed), solids(plastic, dashpots),
                      solids(elastic, eight_points), solids(plastic, eight_points), solids(mixed, eight_points),
                      skin(elastic), skin(plastic), skin(mixed)}) {
    const auto left_over = [&](int steps) {
      Scene s = start;
      for (int step = 0; step < steps; ++step) s.move(0.2 / steps);
      EXPECT_LT(s.memory.work, 0);
      EXPECT_GE(s.memory.dissipated[Dissipated::plastic], 0);
      EXPECT_GT(s.memory.dissipated[Dissipated::viscous], 0);
      return (s.memory.work + total(s.memory.stored) + total(s.memory.dissipated)) / s.memory.work;
    };
    EXPECT_LT(std::abs(left_over(20)), 1e-2);
    EXPECT_LT(std::abs(left_over(160)), 2e-4);
  }
}

TEST(Block, ElasticCycleGivesItsWorkBack) {
  const Viscosity none{.linear = 0, .quadratic = 0};
  for (const AnyHexahedronOptions& options :
       {AnyHexahedronOptions(Hexahedron::Options{.viscosity = none}),
        AnyHexahedronOptions(FullHexahedron::Options{.viscosity = none})}) {
    Scene s = solids(elastic, options);
    double most = 0;
    constexpr int steps = 400;
    for (int step = 0; step < steps; ++step) {  // out along half a cosine, and back
      const Vectors to = s.mesh.X + 0.01 * (1 - std::cos(2 * pi * (step + 1) / steps)) * Vectors(s.w);
      s.v = to - s.x;
      s.move(1.0);
      most = std::max(most, -s.memory.work);
    }
    EXPECT_LT(std::abs(s.memory.work), 1e-6 * most);
    EXPECT_LT(std::abs(total(s.memory.stored)), 1e-6 * most);
  }
}

TEST(Block, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const Scene& start : {solids(plastic), solids(plastic, dashpots), solids(plastic, eight_points), skin(plastic)}) {
    std::vector<double> rows;
    Vectors force;
    for (const int count : {1, 2, 4}) {
      use_threads(count);
      Scene s = start;
      for (int step = 0; step < 3; ++step) s.move(0.1);
      if (count == 1) {
        rows = s.memory.rows, force = s.forces.force;
        rows.insert(rows.end(), s.memory.along.begin(), s.memory.along.end());
        rows.push_back(s.memory.work);
        continue;
      }
      s.memory.rows.insert(s.memory.rows.end(), s.memory.along.begin(), s.memory.along.end());
      s.memory.rows.push_back(s.memory.work);
      EXPECT_EQ(rows, s.memory.rows);
      EXPECT_TRUE(force == s.forces.force);
    }
  }
  use_threads(1);
}

TEST(Block, NamesAnInvertedElement) {
  for (Scene s : {solids(elastic), solids(elastic, eight_points)}) {
    const Index element = 100;
    const Connectivity& corners = nodes(s.block);
    // swap lower and upper face of this one element; its neighbours are torn, but less
    Vectors x = s.x;
    for (int a = 0; a < 4; ++a) {
      x.col(corners(a, element)) = s.x.col(corners(a + 4, element));
      x.col(corners(a + 4, element)) = s.x.col(corners(a, element));
    }
    const BlockLimit limit = advance(s.block, x, Vectors::Zero(3, x.cols()), s.w, 0.0, s.memory, s.forces, s.reports);
    EXPECT_LT(limit.volume_ratio, 0);
    EXPECT_EQ(limit.volume_element, element);
  }
}

TEST(Block, ReportsPositionsThatAreNoNumbersWhereverTheyAre) {
  for (const Scene& start : {solids(elastic), solids(elastic, eight_points), skin(elastic)}) {
    const Connectivity& corners = nodes(start.block);
    for (Index element = 0; element < corners.cols(); element += 7) {
      Scene s = start;
      s.x(1, corners(0, element)) = std::numeric_limits<double>::quiet_NaN();
      const BlockLimit limit = s.move(0.0);
      EXPECT_TRUE(std::isnan(limit.volume_ratio)) << "element " << element;
      ASSERT_GE(limit.volume_element, 0);
      bool touches = false;
      for (Index a = 0; a < corners.rows(); ++a)
        touches |= corners(a, limit.volume_element) == corners(0, element);
      EXPECT_TRUE(touches);
    }
  }
}

TEST(Block, MassIsThatOfTheBodyInEqualPositiveShares) {
  Scene s = solids(elastic);
  Scalars mass = Scalars::Zero(s.x.cols());
  add_mass(s.block, mass);
  EXPECT_GT(mass.minCoeff(), 0);
  const auto& block = std::get<Block<Hexahedron, Elastic>>(s.block);
  Scalars shares = Scalars::Zero(s.x.cols());
  for (Index e = 0; e < block.nodes.cols(); ++e) {
    std::array<Point, 8> X;
    for (int a = 0; a < 8; ++a) X[a] = column(s.mesh.X, block.nodes(a, e));
    for (int a = 0; a < 8; ++a)
      shares(block.nodes(a, e)) += constants(elastic, block.options, X).mass / 8;
  }
  EXPECT_LT((mass - shares).norm(), 1e-13);

  mesh::Mesh plain = mesh::box("box", {Vec3(0, 0, 0), Vec3(9, 7, 3), {9, 7, 3}});
  Scalars whole = Scalars::Zero(plain.X.cols());
  add_mass(hexahedra(plain, "box", elastic, {}), whole);
  EXPECT_NEAR(whole.sum(), 2.0 * 9 * 7 * 3, 1e-11);
}

TEST(Block, OfPlatesHasMassAndRotaryInertiaOfTheSkin) {
  mesh::Mesh plain = mesh::box("box", {Vec3(0, 0, 0), Vec3(9, 7, 3), {9, 7, 3}});
  plain.triangles.push_back({"skin", mesh::surface(plain, "box.z_high").facets});
  AnyBlock block =
      plates(plain, "skin", elastic,
             {.thickness = 0.1, .rotary_inertia = Plate::RotaryInertia::physical, .viscosity = {}});
  // only the nodes of the skin have columns of angular velocity
  std::vector<Index> column(plain.X.cols(), -1);
  Index columns = 0;
  for (const Index n : mesh::surface_nodes(mesh::surface(plain, "box.z_high")))
    column[n] = columns++;
  set_rotations(block, column);
  Scalars mass = Scalars::Zero(plain.X.cols()), inertia = Scalars::Zero(columns);
  add_mass(block, mass);
  add_rotary_inertia(block, inertia);
  EXPECT_NEAR(mass.sum(), 2.0 * 9 * 7 * 0.1, 1e-12);
  EXPECT_GT(inertia.minCoeff(), 0);
  for (Index n = 0; n < plain.X.cols(); ++n) {
    if (column[n] < 0) {
      EXPECT_EQ(mass(n), 0);
    } else {
      EXPECT_NEAR(inertia(column[n]), mass(n) * 0.01 / 12, 1e-16);
    }
  }
}

/// Stress whose six components differ, from a strain that is uniform in space.
const Mat3 gradient = 1e-4 * (Mat3() << 1, 8, 4, 2, -3, 1, 2, 9, 5).finished();

TEST(Block, FieldsShowStressAsXxYyZzXyYzXz) {
  for (Scene s : {solids(plastic), solids(plastic, eight_points)}) {
    s.v = gradient * s.x;
    s.move(1.0);
    const std::vector<Field> shown = fields(s.block, s.mesh.X, s.x, s.memory);
    ASSERT_EQ(shown.size(), 4u);
    EXPECT_EQ(shown[0].name, "stress");
    EXPECT_EQ(shown[0].components, (std::vector<std::string>{"XX", "YY", "ZZ", "XY", "YZ", "XZ"}));
    const Symmetric<double> hooke =
        material::hooke(plastic, Symmetric<double>{1e-4, -3e-4, 5e-4, 5e-4, 5e-4, 3e-4});
    Eigen::Matrix<double, 6, 1> expected;
    expected << hooke.xx, hooke.yy, hooke.zz, 2 * 3 / 2.6 * 5e-4, 2 * 3 / 2.6 * 5e-4,
        2 * 3 / 2.6 * 3e-4;
    for (Index e = 0; e < nodes(s.block).cols(); ++e) {
      const auto stress = shown[0].values.col(e);
      EXPECT_LT((stress - expected).norm(), 5e-3 * expected.norm());
      const Symmetric<double> t{stress(0), stress(1), stress(2), stress(3), stress(4), stress(5)};
      EXPECT_NEAR(shown[1].values(0, e), material::von_mises(t), 1e-15);
      EXPECT_NEAR(shown[2].values(0, e), material::pressure(t), 1e-17);
      EXPECT_EQ(shown[3].values(0, e), 0) << "elastic so far";
    }
    EXPECT_EQ(shown[1].name, "von_mises");
    EXPECT_EQ(shown[2].name, "pressure");
    EXPECT_EQ(shown[3].name, "plastic_strain");
  }
}

TEST(Block, FieldsOfEightPointsAreMeansAndLargestValues) {
  Scene s = solids(plastic, eight_points);
  for (int step = 0; step < 3; ++step) s.move(0.1);
  const auto& block = std::get<Block<FullHexahedron, J2Bilinear>>(s.block);
  const auto shown = fields(s.block, s.mesh.X, s.x, s.memory);
  for (Index e = 0; e < block.nodes.cols(); e += 17) {
    FullHexahedron::Memory<double, J2Bilinear> one{};
    Vectors x = s.mesh.X;
    for (int step = 0; step < 3; ++step) {
      x += 0.1 * s.v;
      std::array<Point, 8> X, at, v, f;
      for (int a = 0; a < 8; ++a) {
        const Index n = block.nodes(a, e);
        X[a] = column(s.mesh.X, n), at[a] = column(x, n), v[a] = 0.1 * column(s.v, n);
      }
      advance(plastic, block.options, constants(plastic, block.options, X), {1, 1, 1}, at, v, 0.1, one, f);
    }
    double xy = 0, mises = 0, strain = 0;
    for (const auto& point : one.points) {
      xy += point.stress.xy / 8;
      mises = std::max(mises, material::von_mises(point.stress));
      strain = std::max(strain, point.internal.scalar[0]);
    }
    EXPECT_GT(strain, 0);
    EXPECT_NEAR(shown[0].values(3, e), xy, 1e-13);
    EXPECT_NEAR(shown[1].values(0, e), mises, 1e-13);
    EXPECT_NEAR(shown[3].values(0, e), strain, 1e-13);
  }
}

TEST(Block, FieldsTellSixDistinctValuesApart) {
  // each component by itself: where it is put in, there it comes out
  const int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  for (int c = 0; c < 6; ++c) {
    Scene s = solids(elastic);
    Mat3 strain = Mat3::Zero();
    strain(at[c][0], at[c][1]) = strain(at[c][1], at[c][0]) = 1e-5;
    s.v = strain * s.x;
    s.move(1.0);
    const Eigen::MatrixXd stress = fields(s.block, s.mesh.X, s.x, s.memory)[0].values;
    for (Index e = 0; e < stress.cols(); e += 11) {
      Eigen::Index largest_row = -1;
      stress.col(e).cwiseAbs().maxCoeff(&largest_row);
      EXPECT_EQ(largest_row, c);
    }
  }
}

TEST(Block, FieldsOfPlatesAreInTheGlobalFrame) {
  mesh::Mesh mesh = mesh::box("box", {Vec3(0, 0, 0), Vec3(3, 2, 1), {3, 2, 1}});
  mesh.triangles.push_back({"skin", mesh::surface(mesh, "box.z_high").facets});
  const Mat3 R = Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  mesh.X = R * mesh.X;
  AnyBlock block = plates(mesh, "skin", elastic, {.thickness = 0.1, .viscosity = {}});
  Scene s = finish(std::move(mesh), std::move(block));
  Mat3 strain = Mat3::Zero();
  strain.topLeftCorner<2, 2>() << 1e-6, 3e-6, 3e-6, -4e-6;
  s.v = R * strain * R.transpose() * s.x, s.w.setZero();
  s.move(1.0);
  const Plane<double> p = material::hooke(elastic, Plane<double>{1e-6, -4e-6, 3e-6});
  Mat3 stress = Mat3::Zero();
  stress.topLeftCorner<2, 2>() << p.xx, p.xy, p.xy, p.yy;
  stress = R * stress * R.transpose();
  Eigen::Matrix<double, 6, 1> expected;
  expected << stress(0, 0), stress(1, 1), stress(2, 2), stress(0, 1), stress(1, 2), stress(0, 2);
  std::set<double> distinct(expected.data(), expected.data() + 6);
  EXPECT_EQ(distinct.size(), 6u);
  const auto shown = fields(s.block, s.mesh.X, s.x, s.memory);
  std::vector<std::string> names;
  for (const Field& field : shown) names.push_back(field.name);
  EXPECT_EQ(names, (std::vector<std::string>{"stress_top", "stress_bottom", "stress_membrane", "von_mises_top", "von_mises_bottom",
                                             "von_mises_membrane"}));
  for (Index e = 0; e < nodes(s.block).cols(); ++e) {
    for (int place = 0; place < 3; ++place) {
      EXPECT_LT((shown[place].values.col(e) - expected).norm(), 1e-4 * expected.norm());
      EXPECT_NEAR(shown[3 + place].values(0, e), material::von_mises(p), 1e-4 * material::von_mises(p));
    }
  }
}

TEST(Block, FieldsShowTheLogarithmicStrainOfALargeMotion) {
  const Mat3 F = (Mat3() << 1.2, 0.3, -0.1, 0, 0.8, 0.2, 0.1, 0, 1.1).finished();
  const Symmetric<double> hencky = hencky_strain(F);
  Eigen::Matrix<double, 6, 1> expected;
  expected << hencky.xx, hencky.yy, hencky.zz, hencky.xy, hencky.yz, hencky.xz;
  const auto only = [](const Shown& one) { return one.quantity == "strain"; };
  for (const Scene& s : {solids(elastic), solids(elastic, eight_points)}) {
    const auto shown = fields(s.block, s.mesh.X, F * s.mesh.X, s.memory, only);
    ASSERT_EQ(shown.size(), 1U);
    EXPECT_EQ(shown[0].unit, "1");
    for (Index e = 0; e < nodes(s.block).cols(); ++e) EXPECT_LT((shown[0].values.col(e) - expected).norm(), 1e-13);
  }
  const Scene plate = skin(elastic);  // whose in-plane strain is that of its triangles, whatever the direction of its sides
  const Mat3 R = Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const auto shown = fields(plate.block, plate.mesh.X, R * plate.mesh.X, plate.memory, only);
  ASSERT_EQ(shown.size(), 4U);
  EXPECT_EQ(shown[3].name, "strain_membrane");
  for (const Field& field : shown) EXPECT_LT(field.values.norm(), 1e-12);
}

TEST(Block, KnowsItsNameAndItsStores) {
  const Scene solid = solids(elastic), plate = skin(elastic);
  EXPECT_EQ(name(solid.block), "box");
  EXPECT_EQ(name(plate.block), "skin");
  EXPECT_FALSE(rotates(solid.block));
  EXPECT_TRUE(rotates(plate.block));
  using In = std::vector<Stored>;
  using Out = std::vector<Dissipated>;
  EXPECT_EQ(stored_channels(solid.block), (In{Stored::elastic, Stored::hourglass, Stored::distortion}));
  EXPECT_EQ(dissipated_channels(solid.block), (Out{Dissipated::plastic, Dissipated::viscous}));
  EXPECT_EQ(stored_channels(plate.block), (In{Stored::elastic, Stored::transverse_shear, Stored::residual_bending, Stored::drilling}));
  EXPECT_EQ(dissipated_channels(plate.block), (Out{Dissipated::plastic, Dissipated::viscous}));
  EXPECT_EQ(stored_channels(solids(elastic, dashpots).block), (In{Stored::elastic, Stored::distortion}));
  EXPECT_EQ(dissipated_channels(solids(elastic, dashpots).block), (Out{Dissipated::plastic, Dissipated::viscous, Dissipated::hourglass}));
  EXPECT_EQ(stored_channels(solids(elastic, eight_points).block), (In{Stored::elastic, Stored::distortion}));
  EXPECT_EQ(dissipated_channels(solids(elastic, eight_points).block), (Out{Dissipated::plastic, Dissipated::viscous}));
}

TEST(Block, PostsItsWorkAndItsEnergiesSinceTheStart) {
  for (Scene s : {solids(plastic), solids(plastic, dashpots), solids(plastic, eight_points), skin(plastic)}) {
    s.move(0.1);
    Account account;
    for (const Stored channel : stored_channels(s.block)) account.at_start[channel] = s.memory.stored[channel];
    s.move(0.1);
    post(s.block, s.memory, account);
    EXPECT_EQ(account.work, s.memory.work);
    EXPECT_EQ(total(account.dissipated), total(s.memory.dissipated)) << "every channel is posted";
    EXPECT_NEAR(total(account.stored), total(s.memory.stored) - total(account.at_start), 1e-12 * total(s.memory.stored));
  }
}

TEST(Block, OfFluidHasTheAngularImpulseOfItsForcesByTheTrapezoidalRule) {
  Scene s = solids(material::LinearFluid{2, 100}, Fluid::Options{.viscosity = {}, .pressure = 5, .gravity = {0.3, -0.2, 0.7}});
  const auto moment = [&s] {
    const Vectors force = by_node(s, s.forces.force);
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index n = 0; n < force.cols(); ++n) sum += s.x.col(n).cross(force.col(n));
    return sum;
  };
  s.v *= 10;  // at the start both centres of an element are one
  s.move(0);
  Vec3 expected = Vec3::Zero(), before = moment();
  EXPECT_EQ(s.memory.angular_impulse, Vec3::Zero()) << "no time has passed";
  for (const double dt : {0.1, 0.02, 0.05}) {
    s.move(dt);
    const Vec3 now = moment();
    expected += 0.5 * dt * (before + now), before = now;
    EXPECT_LT((s.memory.angular_impulse - expected).norm(), 1e-9 * expected.norm());
  }
}

TEST(Block, KnowsHowDeepItIsBehindASurface) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3(0, 0, 0), Vec3(2, 3, 4), {1, 1, 1}});
  for (const AnyHexahedronOptions& options : {AnyHexahedronOptions(Hexahedron::Options{}), AnyHexahedronOptions(eight_points)}) {
    const AnyBlock block = element::solids(mesh, "box", elastic, options);
    EXPECT_NEAR(depth(block, mesh.X, 0, 6.0), 4.0, 1e-14);
    EXPECT_EQ(thickness(block), 0);
  }
  const Scene plate = skin(elastic);
  EXPECT_EQ(depth(plate.block, plate.mesh.X, 0, 6.0), 0.1);
  EXPECT_EQ(thickness(plate.block), 0.1);
}

}  // namespace
}  // namespace nereid::element::block_test
