#pragma once
// Bodies of Kernels, for the sources that instantiate them: one per kind of element.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>

#include "base/check.hpp"
#include "base/dense.hpp"
#include "base/gather.hpp"
#include "base/parallel.hpp"
#include "element/held.hpp"
#include "element/kernels.hpp"

namespace nereid::element {

constexpr Index most_slots = 128 * 8;  // of a tile: 128 elements that share no node

/// Rows that one element of a block remembers.
template <class Kind, class Law>
int memory_rows(const Block<Kind, Law>& block) {
  return Kind::template Memory<double, Law>::rows(block.options);
}

/// Calls visit(row, address) for the rows of a pack's memory, in order.
template <class Kind, class Law, class Memory, class Visit>
void each_row(const Block<Kind, Law>& block, Memory& memory, double* at, Visit&& visit) {
  const auto next = [&](auto& row) {
    visit(row, at);
    at += lanes;
  };
  memory.each_row(next, block.options);
}

inline void scatter(const Vector<Pack>& v, const Index* slot, int filled, double* local) {
  alignas(64) double lane[3][lanes];
  write_lanes(v.x, lane[0]), write_lanes(v.y, lane[1]), write_lanes(v.z, lane[2]);
  for (int l = 0; l < filled; ++l) {
    double* to = local + 3 * slot[l];
    for (int axis = 0; axis < 3; ++axis) to[axis] += lane[axis][l];
  }
}

inline double sum_of_products(const double* a, const double* b, Index count) {
  Pack sums[4] = {Pack(0.0), Pack(0.0), Pack(0.0), Pack(0.0)};  // additions that need not wait for one another
  Index i = 0;
  for (int chain = 0; i + lanes <= count; i += lanes, chain = (chain + 1) % 4) {
    Pack x, y;
    read_lanes(a + i, x), read_lanes(b + i, y);
    sums[chain] += x * y;
  }
  const Pack packed = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  double sum = 0;
  for (int lane = 0; lane < lanes; ++lane) sum += packed[lane];
  for (; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

/// Lane numbers as a pack, to tell filled lanes from fillers.
inline Pack lane_numbers() {
  return Pack([](auto lane) { return static_cast<double>(static_cast<int>(lane)); });
}

template <class Kind, class Law>
void advance_tile(const Block<Kind, Law>& block, const Tile& tile, const Vectors& x, const Vectors& dx,
                  const Vectors& rotation, double dt, const Departures& departures, Memory& memory, TileForces& forces,
                  TileReport& report) {
  double* rows = memory.rows.data();
  const bool is_viscous = acts(block.options.viscosity);
  constexpr int corners = Kind::nodes;
  alignas(64) double x_here[3 * most_slots], dx_here[3 * most_slots];
  alignas(64) double rotation_here[Kind::rotates ? 3 * most_slots : 1];
  for (Index p = 0; p < tile.nodes; ++p) {
    const Index node = block.tiling.node[tile.first_node + p];
    for (int axis = 0; axis < 3; ++axis) {
      x_here[3 * p + axis] = x(axis, node);
      dx_here[3 * p + axis] = dx(axis, node);
      if constexpr (Kind::rotates) rotation_here[3 * p + axis] = rotation(axis, block.rotation_column[tile.first_node + p]);
    }
  }
  double* force_here = forces.force.data() + 3 * static_cast<std::size_t>(tile.first_node);
  double* moment_here = Kind::rotates ? forces.moment.data() + 3 * static_cast<std::size_t>(tile.first_node) : nullptr;
  const auto work_of_forces = [&] {
    double sum = sum_of_products(force_here, dx_here, 3 * tile.nodes);
    if constexpr (Kind::rotates) sum += sum_of_products(moment_here, rotation_here, 3 * tile.nodes);
    return sum;
  };
  const double with_old_forces = work_of_forces();
  std::fill_n(force_here, 3 * tile.nodes, 0.0);
  if constexpr (Kind::rotates) std::fill_n(moment_here, 3 * tile.nodes, 0.0);

  const int memory_size = memory_rows(block) * lanes;
  constexpr int constants_size = Kind::template Constants<double>::rows * lanes;
  const Pack lane = lane_numbers();
  std::array<Pack, Kind::stored_channels.size()> stored{};
  std::array<Pack, Kind::dissipated_channels.size()> dissipated{};
  std::array<Pack, Kind::arms> arm{};
  Pack step(1e300), volume_ratio(1e300), step_at(-1.0), volume_at(-1.0);
  for (Index pack = tile.first_pack; pack < tile.first_pack + tile.packs; ++pack) {
    const Index* slot = block.tiling.slot.data() + static_cast<std::size_t>(pack) * corners * lanes;
    std::array<Vector<Pack>, corners> xs, dxs, fs;
    for (int a = 0; a < corners; ++a) {
      xs[a] = gather(x_here, slot + a * lanes);
      dxs[a] = gather(dx_here, slot + a * lanes);
    }
    typename Kind::template Constants<Pack> constants;
    const double* constant = block.constants.data() + static_cast<std::size_t>(pack) * constants_size;
    constants.each_row([&](Pack& row) { read_lanes(constant, row), constant += lanes; });
    typename Kind::template Memory<Pack, Law> own_memory;
    double* at = rows + static_cast<std::size_t>(pack) * memory_size;
    each_row(block, own_memory, at, [](Pack& row, const double* from) { read_lanes(from, row); });
    Shares<Pack, Kind::axes> share{};
    if (is_viscous)
      share = shares_of<Kind::axes, Kind::sides>(departures.spread.data(), static_cast<std::size_t>(pack),
                                                 block.beside.data() + static_cast<std::size_t>(pack) * Kind::sides * lanes);

    Report<Pack, Kind> here;
    const int filled = block.tiling.filled[pack];
    if constexpr (Kind::rotates) {
      std::array<Vector<Pack>, corners> rotations, ms;
      for (int a = 0; a < corners; ++a) rotations[a] = gather(rotation_here, slot + a * lanes);
      here = advance(block.law, block.options, block.layers, constants, share, xs, dxs, rotations, Pack(dt), own_memory, fs, ms);
      for (int a = 0; a < corners; ++a) scatter(ms[a], slot + a * lanes, filled, moment_here);
    } else {
      here = advance(block.law, block.options, constants, share, xs, dxs, Pack(dt), own_memory, fs);
    }
    for (int a = 0; a < corners; ++a) scatter(fs[a], slot + a * lanes, filled, force_here);
    if constexpr (Kind::layered) {
      if (Kind::template thins<Law>(block.options)) {
        const Pack thickness = thickness_left(block.law, block.layers, constants, xs, own_memory);
        for (int l = 0; l < filled; ++l) forces.thickness(block.tiling.element[pack * lanes + l]) = thickness[l];
      }
    }
    each_row(block, own_memory, at, [](const Pack& row, double* to) { write_lanes(row, to); });
    if (is_viscous) {
      double* along = memory.along.data() + static_cast<std::size_t>(pack) * Kind::axes * lanes;
      for (const Pack& strain : here.along) write_lanes(strain, along), along += lanes;
    }

    const auto own = lane < Pack(static_cast<double>(filled));
    const Pack zero(0.0), number = Pack(static_cast<double>(pack) * lanes) + lane;
    for (std::size_t c = 0; c < stored.size(); ++c) stored[c] += select(own, here.stored[c], zero);
    for (std::size_t c = 0; c < dissipated.size(); ++c) dissipated[c] += select(own, here.dissipated[c], zero);
    for (std::size_t c = 0; c < arm.size(); ++c) arm[c] += select(own, here.arm[c], zero);
    const auto shorter = !(here.step >= step);  // also where either is NaN, so that `step_at` is always that of `step`
    step_at = select(shorter, number, step_at);
    step = select(shorter, here.step, step);
    const auto worse = here.volume_ratio < volume_ratio || here.volume_ratio != here.volume_ratio;  // NaN is worst, and stays
    volume_at = select(worse, number, volume_at);
    volume_ratio = select(worse, here.volume_ratio, volume_ratio);
  }

  report = {.work = 0.5 * (with_old_forces + work_of_forces()), .stored = {}, .dissipated = {}, .step = 1e300, .volume_ratio = 1e300,
            .step_element = -1, .volume_element = -1, .arm = {}};
  for (int l = 0; l < lanes; ++l) {
    for (std::size_t c = 0; c < arm.size(); ++c) report.arm[c] += arm[c][l];
    for (std::size_t c = 0; c < stored.size(); ++c) report.stored[Kind::stored_channels[c]] += stored[c][l];
    for (std::size_t c = 0; c < dissipated.size(); ++c) report.dissipated[Kind::dissipated_channels[c]] += dissipated[c][l];
    if (step[l] < report.step) {
      report.step = step[l];
      report.step_element = block.tiling.element[static_cast<std::size_t>(step_at[l])];
    }
    if (volume_ratio[l] < report.volume_ratio || std::isnan(volume_ratio[l])) {
      report.volume_ratio = volume_ratio[l];
      report.volume_element = block.tiling.element[static_cast<std::size_t>(volume_at[l])];
    }
  }
}

/// Calls visit(pack, lane, constants) for each lane of a block, fillers included.
template <class Kind, class Law, class Visit>
void each_lane(const Block<Kind, Law>& block, Visit&& visit) {
  constexpr int rows = Kind::template Constants<double>::rows;
  for (std::size_t pack = 0; pack < block.tiling.filled.size(); ++pack) {
    for (int lane = 0; lane < lanes; ++lane) {
      typename Kind::template Constants<double> constants;
      const double* from = block.constants.data() + pack * rows * lanes + lane;
      constants.each_row([&](double& row) { row = *from, from += lanes; });
      visit(pack, lane, constants);
    }
  }
}

/// The same for each element.
template <class Kind, class Law, class Visit>
void each_element(const Block<Kind, Law>& block, Visit&& visit) {
  each_lane(block, [&](std::size_t pack, int lane, const auto& constants) {
    if (lane < block.tiling.filled[pack]) visit(pack, lane, constants);
  });
}

template <class Kind, class Law>
typename Kind::template Memory<double, Law> read_memory(const Block<Kind, Law>& block, const Memory& memory,
                                                        std::size_t pack, int lane) {
  typename Kind::template Memory<double, Law> here{};
  auto* at = const_cast<double*>(memory.rows.data()) + pack * memory_rows(block) * lanes + lane;
  each_row(block, here, at, [](double& row, const double* from) { row = *from; });
  return here;
}

inline Vector<double> column(const Vectors& x, Index node) { return {x(0, node), x(1, node), x(2, node)}; }

/// What one element shows at one place. Tensors in the global frame.
template <class Law>
struct Output {
  Symmetric<double> stress;  // [Pa]
  double mises;              // [Pa]
  std::array<double, Law::internal.size()> internal;
  Symmetric<double> strain;  // [-] where it is wanted
};

/// The nodes of an element. [m]
template <class Kind, class Law>
std::array<Vector<double>, Kind::nodes> corners_of(const Block<Kind, Law>& block, const Vectors& x, Index element) {
  std::array<Vector<double>, Kind::nodes> corners;
  for (int a = 0; a < Kind::nodes; ++a) corners[a] = column(x, block.nodes(a, element));
  return corners;
}

/// Strain of the deformation gradient of a hexahedron, a mean over its reference volume.
inline Symmetric<double> strain_of(const std::array<Vector<double>, 8>& X, const std::array<Vector<double>, 8>& x) {
  const Matrix<double> F =
      mean_gradient(scaled(0.125, sums_by_mode(x)), volume_gradient(scaled(0.125, sums_by_mode(X))));
  return hencky_strain(Mat3{{F.x.x, F.x.y, F.x.z}, {F.y.x, F.y.y, F.y.z}, {F.z.x, F.z.y, F.z.z}});
}

template <class Law, class Corners>
Output<Law> output_of(const Hexahedron::Memory<double, Law>& memory, const Block<Hexahedron, Law>&, const Corners& X, const Corners& x,
                      Place, bool with_strain) {
  return {memory.stress, material::von_mises(memory.stress), memory.internal.scalar,
          with_strain ? strain_of(X, x) : Symmetric<double>{}};
}
template <class Law, class Corners>
Output<Law> output_of(const FullHexahedron::Memory<double, Law>& memory, const Block<FullHexahedron, Law>&, const Corners& X,
                      const Corners& x, Place, bool with_strain) {
  Symmetric<double> sum{0, 0, 0, 0, 0, 0};
  Output<Law> shown{};
  for (const auto& point : memory.points) {
    sum = sum + point.stress;
    shown.mises = std::max(shown.mises, material::von_mises(point.stress));
    for (std::size_t i = 0; i < shown.internal.size(); ++i) shown.internal[i] = std::max(shown.internal[i], point.internal.scalar[i]);
  }
  shown.stress = (1.0 / FullHexahedron::gauss_points) * sum;
  if (with_strain) shown.strain = strain_of(X, x);
  return shown;
}
template <class Law, class Corners>
Output<Law> output_of(const Fluid::Memory<double, Law>& memory, const Block<Fluid, Law>& block, const Corners& X, const Corners& x, Place,
                      bool with_strain) {
  const auto volume = [](const Corners& at) { return volume_gradient(scaled(0.125, sums_by_mode(at))).volume; };
  const double before = volume(X), now = volume(x), p = memory.state.pressure;
  const double mass = block.law.density * before, reference = now / memory.state.ratio;
  return {{-p, -p, -p, 0, 0, 0}, 0, {mass / now, memory.state.energy * reference / mass, material::void_part(block.law, memory.state)},
          with_strain ? strain_of(X, x) : Symmetric<double>{}};
}
template <class Law, class Corners>
Output<Law> output_of(const Plate::Memory<double, Law>& memory, const Block<Plate, Law>& block, const Corners& X, const Corners& x,
                      Place place, bool with_strain) {
  const PlateShape<double> now = plate_shape(x);
  const auto& [e1, e2, e3] = now.frame;
  const Matrix<double> Q{{e1.x, e2.x, e3.x}, {e1.y, e2.y, e3.y}, {e1.z, e2.z, e3.z}};
  const AtPlace<Law> at = at_place(block.law, block.layers, memory, place);
  Output<Law> shown{rotate(Q, Symmetric<double>{at.stress.xx, at.stress.yy, 0, at.stress.xy, 0, 0}), material::von_mises(at.stress),
                    at.internal.scalar, {}};
  if (with_strain) shown.strain = rotate(Q, strain_at_place(block.law, plate_shape(X), now, memory, at.stress, place));
  return shown;
}

template <class Kind, class Law>
BlockLimit Kernels<Kind, Law>::advance(const Block<Kind, Law>& block, const Vectors& x, const Vectors& dx, const Vectors& rotation,
                                 double dt, Memory& memory, TileForces& forces, TileReports& reports) {
  const double time = dt > 0 ? dt : 1;  // where none passes, nothing moves, and all rates are zero
  if (acts(block.options.viscosity)) find_departures(block.tiling, block.beside, memory.along, reports.departures);
  parallel_for(static_cast<Index>(block.tiling.tiles.size()), 2, [&](Index t) {
    advance_tile(block, block.tiling.tiles[t], x, dx, rotation, time, reports.departures, memory, forces, reports.tile[t]);
  });
  BlockLimit limit;
  if constexpr (Kind::arms > 0) {
    Vec3 arm = Vec3::Zero();
    for (const TileReport& report : reports.tile) arm += Vec3(report.arm[0], report.arm[1], report.arm[2]);
    const auto& g = block.options.gravity;
    memory.angular_impulse += 0.5 * dt * (memory.arm + arm).cross(Vec3(g[0], g[1], g[2]));
    memory.arm = arm;
  }
  for (const TileReport& report : reports.tile) {
    memory.work += report.work;
    for (const Stored channel : Kind::stored_channels) memory.stored[channel] += report.stored[channel];
    for (const Dissipated channel : Kind::dissipated_channels) memory.dissipated[channel] += report.dissipated[channel];
    if (report.step < limit.step) limit.step = report.step, limit.step_element = report.step_element;
    if (report.volume_ratio < limit.volume_ratio || std::isnan(report.volume_ratio)) {
      limit.volume_ratio = report.volume_ratio, limit.volume_element = report.volume_element;
    }
  }
  return limit;
}

template <class Kind, class Law>
Block<Kind, Law> Kernels<Kind, Law>::make(const mesh::Mesh& mesh, const std::string& name, const Connectivity& nodes,
                                          const Law& law, const typename Kind::Options& options) {
  Block<Kind, Law> block{.name = name, .law = law, .options = options, .nodes = nodes,
                         .tiling = cut_into_tiles(nodes, mesh.X), .constants = {}, .start = {}, .layers = {}, .beside = {},
                         .rotation_column = {}};
  if (acts(options.viscosity)) block.beside = places_beside(block.tiling, nodes);
  if constexpr (Kind::layered) block.layers = gauss_layers(options.layers);
  const std::size_t packs = block.tiling.filled.size();
  constexpr int rows = Kind::template Constants<double>::rows;
  block.constants.resize(packs * rows * lanes);
  for (std::size_t pack = 0; pack < packs; ++pack) {
    for (int lane = 0; lane < lanes; ++lane) {
      const Index element = block.tiling.element[pack * lanes + lane];
      std::array<Vector<double>, Kind::nodes> X;
      for (int a = 0; a < Kind::nodes; ++a) {
        const auto column = mesh.X.col(nodes(a, element));
        X[a] = {column.x(), column.y(), column.z()};
      }
      auto values = constants(law, options, X);
      double* to = block.constants.data() + pack * rows * lanes + lane;
      values.each_row([&](double& row) { *to = row, to += lanes; });
      if constexpr (std::is_same_v<Kind, Fluid>) block.start.push_back(start_of(law, options, X));
    }
  }
  return block;
}

template <class Kind, class Law>
Memory Kernels<Kind, Law>::initial_memory(const Block<Kind, Law>& block) {
  Memory memory;
  const std::size_t packs = block.tiling.filled.size();
  memory.rows.resize(packs * memory_rows(block) * lanes);
  if (acts(block.options.viscosity)) memory.along.assign(packs * Kind::axes * lanes, 0.0);
  if constexpr (std::is_same_v<Kind, Fluid>) {
    // fillers keep zeros where the energy is summed, and have a volume, so that nothing divides by zero
    each_lane(block, [&](std::size_t pack, int lane, const auto& constants) {
      auto here = at_start(block.law, block.start[pack * lanes + static_cast<std::size_t>(lane)]);
      each_row(block, here, memory.rows.data() + pack * memory_rows(block) * lanes + lane, [](double row, double* to) { *to = row; });
      if (lane < block.tiling.filled[pack]) memory.stored[Stored::compression] += here.state.energy * constants.reference;
    });
  } else {
    typename Kind::template Memory<double, Law> at_rest{};
    at_rest.each_internal([&](auto& internal) { internal = material::fresh_like(internal, block.law); });
    for (std::size_t pack = 0; pack < packs; ++pack)
      each_row(block, at_rest, memory.rows.data() + pack * memory_rows(block) * lanes,
               [](double row, double* to) { std::fill_n(to, lanes, row); });
  }
  return memory;
}

template <class Kind, class Law>
void Kernels<Kind, Law>::add_mass(const Block<Kind, Law>& block, Scalars& mass) {
  each_element(block, [&](std::size_t pack, int lane, const auto& constants) {
    const Index element = block.tiling.element[pack * lanes + lane];
    for (Index a = 0; a < block.nodes.rows(); ++a) {
      double& at_node = mass(block.nodes(a, element));
      if constexpr (std::is_same_v<Kind, Fluid>) at_node += 1 / constants.per_node[static_cast<std::size_t>(a)];
      else at_node += constants.mass / static_cast<double>(block.nodes.rows());
    }
  });
}

template <class Kind, class Law>
Scalars Kernels<Kind, Law>::element_masses(const Block<Kind, Law>& block) {
  Scalars mass(block.tiling.elements);
  each_element(block, [&](std::size_t pack, int lane, const auto& constants) {
    mass(block.tiling.element[pack * lanes + lane]) = constants.mass;
  });
  return mass;
}

template <class Kind, class Law>
void Kernels<Kind, Law>::add_rotary_inertia([[maybe_unused]] const Block<Kind, Law>& block,
                                            [[maybe_unused]] Scalars& inertia) {
  if constexpr (Kind::rotates) {
    each_element(block, [&](std::size_t pack, int lane, const auto& constants) {
      for (int a = 0; a < Kind::nodes; ++a) {
        const std::size_t slot = (pack * Kind::nodes + a) * lanes + lane;
        // the tile of this pack starts at the largest first_pack not beyond it
        const auto after = std::upper_bound(
            block.tiling.tiles.begin(), block.tiling.tiles.end(), static_cast<Index>(pack),
            [](Index p, const Tile& tile) { return p < tile.first_pack; });
        const Index at = std::prev(after)->first_node + block.tiling.slot[slot];
        inertia(block.rotation_column[at]) += constants.mass * constants.gyration / Kind::nodes;
      }
    });
  }
}

template <class Kind, class Law>
Thinned Kernels<Kind, Law>::thinned([[maybe_unused]] const Block<Kind, Law>& block, [[maybe_unused]] const Vectors& x,
                                    [[maybe_unused]] const Memory& memory) {
  Thinned most;
  if constexpr (Kind::layered) {
    each_element(block, [&](std::size_t pack, int lane, const auto& constants) {
      const Index element = block.tiling.element[pack * lanes + lane];
      const std::array corners{column(x, block.nodes(0, element)), column(x, block.nodes(1, element)), column(x, block.nodes(2, element))};
      const double left = thickness_left(block.law, block.layers, constants, corners, read_memory(block, memory, pack, lane));
      const double ratio = left / block.options.thickness;
      if (std::abs(std::log(ratio)) > std::abs(std::log(most.ratio))) most = {ratio, element};
    });
  }
  return most;
}

template <class Kind, class Law>
Pressed Kernels<Kind, Law>::pressed([[maybe_unused]] const Block<Kind, Law>& block, [[maybe_unused]] const Memory& memory) {
  Pressed most;
  if constexpr (std::is_same_v<Law, material::Elastic> && !Kind::layered) {
    const auto look = [&](const Symmetric<double>& stress, Index element) {
      // no principal stress is below -pressure - 2/3 of von Mises's
      if (!(material::pressure(stress) + material::von_mises(stress) / 1.5 > most.ratio * block.law.young)) return;
      Mat3 s;
      s << stress.xx, stress.xy, stress.xz, stress.xy, stress.yy, stress.yz, stress.xz, stress.yz, stress.zz;
      const Vec3 principal = eigenvalues(s);  // an even pressure folds nothing
      const double pressed = std::min(-principal(0), principal(2) - principal(0)) / block.law.young;
      if (pressed > most.ratio) most = {pressed, element};
    };
    each_element(block, [&](std::size_t pack, int lane, const auto&) {
      const auto here = read_memory(block, memory, pack, lane);
      const Index element = block.tiling.element[pack * lanes + lane];
      if constexpr (std::is_same_v<Kind, Hexahedron>) look(here.stress, element);
      else for (const auto& point : here.points) look(point.stress, element);
    });
  }
  return most;
}

template <class Kind, class Law>
std::vector<Held> Kernels<Kind, Law>::held([[maybe_unused]] const Block<Kind, Law>& block, [[maybe_unused]] const Vectors& x,
                                           [[maybe_unused]] const Memory& memory) {
  std::vector<Held> all;
  if constexpr (!Kind::layered && !std::is_same_v<Kind, Fluid>) {
    all.resize(static_cast<std::size_t>(block.tiling.elements));
    each_element(block, [&](std::size_t pack, int lane, const auto& constants) {
      const Index element = block.tiling.element[pack * lanes + lane];
      all[static_cast<std::size_t>(element)] =
          held_by(block, constants, read_memory(block, memory, pack, lane), corners_of(block, x, element));
    });
  }
  return all;
}

template <class Kind, class Law>
std::vector<Field> Kernels<Kind, Law>::fields(const Block<Kind, Law>& block, const Vectors& X, const Vectors& x, const Memory& memory,
                                              const Wanted& wanted) {
  using Row = Eigen::MatrixXd::ColXpr;
  std::vector<Field> list;
  std::vector<std::function<void(const Output<Law>&, Row)>> fill;  // beside the list
  std::vector<Place> places;                                       // beside the list
  const auto add = [&](std::string_view quantity, std::string_view unit, bool tensor, auto&& put) {
    const auto at = [&](Place place) {
      if (!wanted({quantity, place})) return;
      list.push_back({name({quantity, place}), std::string(unit), {}, Eigen::MatrixXd(tensor ? 6 : 1, block.tiling.elements)});
      if (tensor) list.back().components = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
      fill.push_back(put), places.push_back(place);
    };
    if constexpr (Kind::layered) std::for_each(places_of_plates.begin(), places_of_plates.end(), at);
    else at(Place::none);
  };
  const auto components = [](const Symmetric<double>& s, Row row) { row << s.xx, s.yy, s.zz, s.xy, s.yz, s.xz; };
  add("stress", "Pa", true, [&](const Output<Law>& shown, Row row) { components(shown.stress, row); });
  add("von_mises", "Pa", false, [](const Output<Law>& shown, Row row) { row(0) = shown.mises; });
  add("pressure", "Pa", false, [](const Output<Law>& shown, Row row) { row(0) = material::pressure(shown.stress); });
  for (std::size_t i = 0; i < Law::internal.size(); ++i)
    add(Law::internal[i].name, Law::internal[i].unit, false, [i](const Output<Law>& shown, Row row) { row(0) = shown.internal[i]; });
  const std::size_t before = list.size();
  add("strain", "1", true, [&](const Output<Law>& shown, Row row) { components(shown.strain, row); });
  const bool with_strain = list.size() > before;
  if constexpr (Kind::layered)
    if (Kind::template thins<Law>(block.options) && wanted({"thickness", Place::none}))
      list.push_back({"thickness", "m", {}, Eigen::MatrixXd(1, block.tiling.elements)});

  each_element(block, [&](std::size_t pack, int lane, [[maybe_unused]] const auto& constants) {
    const Index element = block.tiling.element[pack * lanes + lane];
    const auto from = corners_of(block, X, element), to = corners_of(block, x, element);
    const auto here = read_memory(block, memory, pack, lane);
    std::array<std::optional<Output<Law>>, 1 + places_of_plates.size()> shown;
    for (std::size_t f = 0; f < fill.size(); ++f) {
      auto& at = shown[static_cast<std::size_t>(places[f])];
      if (!at) at = output_of(here, block, from, to, places[f], with_strain);
      fill[f](*at, list[f].values.col(element));
    }
    if constexpr (Kind::layered)
      if (list.size() > fill.size()) list.back().values(0, element) = thickness_left(block.law, block.layers, constants, to, here);
  });
  return list;
}

/// Which number of an element a quantity and one of its components are.
struct Number {
  enum class Kind { stress, von_mises, pressure, internal, strain } kind;
  std::size_t index = 0;  ///< of a component or an internal variable
};

template <class Law>
Number number_of(std::string_view quantity, int component) {
  const auto index = static_cast<std::size_t>(component);
  if (quantity == "stress") return {Number::Kind::stress, index};
  if (quantity == "von_mises") return {Number::Kind::von_mises};
  if (quantity == "pressure") return {Number::Kind::pressure};
  if (quantity == "strain") return {Number::Kind::strain, index};
  for (std::size_t i = 0; i < Law::internal.size(); ++i)
    if (Law::internal[i].name == quantity) return {Number::Kind::internal, i};
  check(false, "a block has no such quantity");
  return {};
}

template <class T>
NEREID_HOT T component_of(const Symmetric<T>& s, std::size_t index) {
  return index == 0 ? s.xx : index == 1 ? s.yy : index == 2 ? s.zz : index == 3 ? s.xy : index == 4 ? s.yz : s.xz;
}

/// A number of one point; zero of strain, which is none.
template <class T, class All>
NEREID_HOT T at_point(const Symmetric<T>& stress, const All& internal, const Number& which) {
  if (which.kind == Number::Kind::stress) return component_of(stress, which.index);
  if (which.kind == Number::Kind::von_mises) return material::von_mises(stress);
  if (which.kind == Number::Kind::pressure) return material::pressure(stress);
  if constexpr (std::tuple_size_v<All> > 0)
    if (which.kind == Number::Kind::internal) return internal[which.index];
  return T(0.0);
}

/// A number of a hexahedron as output_of() has it, but for strain.
template <class T, class Law>
NEREID_HOT T value_of(const Hexahedron::Memory<T, Law>& memory, const Number& which) {
  return at_point(memory.stress, memory.internal.scalar, which);
}
template <class T, class Law>
NEREID_HOT T value_of(const FullHexahedron::Memory<T, Law>& memory, const Number& which) {
  T sum(0.0), largest(0.0);
  for (const auto& point : memory.points) {
    const T here = at_point(point.stress, point.internal.scalar, which);
    sum = sum + here, largest = larger(largest, here);
  }
  const bool is_mean = which.kind == Number::Kind::stress || which.kind == Number::Kind::pressure;
  return is_mean ? T(1.0 / FullHexahedron::gauss_points) * sum : largest;
}
template <class T, class Law>
NEREID_HOT T value_of(const Fluid::Memory<T, Law>& memory, const Number& which) {
  const T p = memory.state.pressure, zero(0.0);
  if (which.kind == Number::Kind::stress) return which.index < 3 ? -p : zero;
  return which.kind == Number::Kind::pressure ? p : zero;
}
template <class Law>
double value_of(const Output<Law>& shown, const Number& which) {
  return which.kind == Number::Kind::von_mises ? shown.mises
         : which.kind == Number::Kind::strain  ? component_of(shown.strain, which.index)
                                               : at_point(shown.stress, shown.internal, which);
}

/// A number of each element of a pack, as output_of() has it.
template <class Kind, class Law>
Pack values_of(const Block<Kind, Law>& block, const Vectors& X, const Vectors& x, const Memory& memory, Place place, const Number& which,
               std::size_t pack) {
  Pack values(0.0);
  const bool of_fluid = std::is_same_v<Kind, Fluid> && which.kind == Number::Kind::internal;  // they need volumes
  if (Kind::layered || of_fluid || which.kind == Number::Kind::strain) {
    const bool is_strain = which.kind == Number::Kind::strain;
    for (int lane = 0; lane < block.tiling.filled[pack]; ++lane) {
      const Index element = block.tiling.element[pack * lanes + lane];
      values[lane] = value_of(output_of(read_memory(block, memory, pack, lane), block, corners_of(block, X, element),
                                        corners_of(block, x, element), place, is_strain),
                              which);
    }
  } else if constexpr (!Kind::layered) {
    typename Kind::template Memory<Pack, Law> here;
    auto* at = const_cast<double*>(memory.rows.data()) + pack * memory_rows(block) * lanes;
    each_row(block, here, at, [](Pack& row, const double* from) { read_lanes(from, row); });
    values = value_of(here, which);
  }
  return values;
}

template <class Kind, class Law>
Reduced Kernels<Kind, Law>::reduce(const Block<Kind, Law>& block, const Vectors& X, const Vectors& x, const Memory& memory,
                                   const Shown& shown, int component) {
  const Number which = number_of<Law>(shown.quantity, component);
  std::vector<Reduced> parts(block.tiling.tiles.size());
  parallel_for(static_cast<Index>(parts.size()), 8, [&](Index t) {
    const Tile& tile = block.tiling.tiles[t];
    constexpr int rows = Kind::template Constants<double>::rows;
    const Pack lane = lane_numbers(), nothing(0.0);
    Pack largest(-std::numeric_limits<double>::infinity()), sum(0.0), mass(0.0);
    for (auto pack = static_cast<std::size_t>(tile.first_pack); pack < static_cast<std::size_t>(tile.first_pack + tile.packs); ++pack) {
      typename Kind::template Constants<Pack> constants;
      const double* from = block.constants.data() + pack * rows * lanes;
      constants.each_row([&](Pack& row) { read_lanes(from, row), from += lanes; });
      const Pack values = values_of(block, X, x, memory, shown.place, which, pack);
      const auto own = lane < Pack(static_cast<double>(block.tiling.filled[pack]));
      largest = select(own, larger(values, largest), largest);
      sum += select(own, constants.mass * values, nothing), mass += select(own, constants.mass, nothing);
    }
    Reduced all;
    for (int l = 0; l < lanes; ++l) add({largest[l], sum[l], mass[l]}, all);
    parts[t] = all;
  });
  Reduced all;
  for (const Reduced& part : parts) add(part, all);
  return all;
}

template <class Kind, class Law>
Reduced Kernels<Kind, Law>::reduce_picked(const Block<Kind, Law>& block, const Vectors& X, const Vectors& x, const Memory& memory,
                                          const Shown& shown, int component, const Picked& picked) {
  const Number which = number_of<Law>(shown.quantity, component);
  Reduced all;
  for (std::size_t i = 0; i < picked.place.size(); ++i) {
    const std::size_t pack = picked.place[i] / lanes;
    const int lane = static_cast<int>(picked.place[i] % lanes);
    const Index element = block.tiling.element[picked.place[i]];
    const double value = value_of(output_of(read_memory(block, memory, pack, lane), block, corners_of(block, X, element),
                                            corners_of(block, x, element), shown.place, which.kind == Number::Kind::strain),
                                  which);
    add({value, picked.mass[i] * value, picked.mass[i]}, all);
  }
  return all;
}

template <class Kind, class Law>
constexpr auto kernels_of() {
  if constexpr (may_have<Kind, Law>) {
    using K = Kernels<Kind, Law>;
    return std::tuple(&K::make, &K::add_mass, &K::element_masses, &K::add_rotary_inertia, &K::initial_memory, &K::advance, &K::thinned,
                      &K::pressed, &K::held, &K::reduce, &K::reduce_picked, &K::fields);
  } else {
    return std::tuple();
  }
}

/// The kernels of a kind with each law that it may have. A source that keeps them in a variable has them compiled.
template <class Kind, class... Laws>
constexpr auto kernels_of_each_law(const std::variant<Laws...>*) {
  return std::tuple_cat(kernels_of<Kind, Laws>()...);
}

}  // namespace nereid::element
