// A law alone: one point of material without element, mesh or time.
//
//        stress |        ____       Along each segment of a path every component is led to a strain
//               |   ____/           or to a stress: xx by its strain and all others free of stress
//               |  /                is uniaxial stress, xx alone with all others held uniaxial strain.
//               | /
//               +------------ strain
//
// Question  Which stress, which internal variables and how much work stored and dissipated does a law answer with?
// Answer    verification/uniaxial_stress/README.md and its neighbours
// Run       material_point cases/material_point/cycle.yaml --out out/material_point

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/words.hpp"
#include "drivers/driver.hpp"
#include "material/mixed_control.hpp"
#include "model/values.hpp"

using namespace nereid;

constexpr std::array<const char*, 6> names_in_space{"xx", "yy", "zz", "xy", "yz", "xz"};
constexpr std::array<const char*, 3> names_in_plane{"xx", "yy", "xy"};

enum class Lead { keeps_strain, to_strain, to_stress };

/// One component along one segment.
struct Target {
  Lead lead = Lead::keeps_strain;
  double value = 0;  // [-] or [Pa], at the end of the segment
};

struct Segment {
  int increments;
  double duration;               // [s]
  std::array<Target, 6> target;  // in the order of the names
};

struct Case {
  bool plate;
  element::AnyLaw material;
  std::vector<Segment> path;
};

constexpr int most_increments = 1000000;  // of a segment; a row of history each

Segment read_segment(const input::Section& section, bool plate) {
  Segment segment{.increments = section.count("increments", 1, most_increments),
                  .duration = section.quantity_or("duration", 1, dim::time, input::positive),
                  .target = {}};
  const auto strain = section.section_or_empty("strain"), stress = section.section_or_empty("stress");
  const auto read_component = [&](const char* name, Target& target) {
    if (strain.has(name)) target = {Lead::to_strain, strain.number(name)};
    if (!stress.has(name)) return;
    target = {Lead::to_stress, stress.quantity(name, dim::stress)};
    if (strain.has(name)) stress.fault(name, std::string("'") + name + "' is led by its strain already");
  };
  if (plate)
    for (std::size_t i = 0; i < names_in_plane.size(); ++i) read_component(names_in_plane[i], segment.target[i]);
  else
    for (std::size_t i = 0; i < names_in_space.size(); ++i) read_component(names_in_space[i], segment.target[i]);
  return segment;
}

Case read(const input::Section& root) {
  const bool plate = root.choice_or("kind", "solid", {"solid", "plate"}) == "plate";
  Case c{.plate = plate,
         .material = plate ? input::read_plate_law(root.section("material")) : input::read_law(root.section("material")),
         .path = {}};
  double rows = 0;
  for (const input::Section& section : root.list("path", 1)) rows += c.path.emplace_back(read_segment(section, c.plate)).increments;
  if (rows > model::most_rows)
    root.fault("path", "'path' gives " + formatted("%.3g", rows) + " rows of the history: expected at most ten million");
  return c;
}

/// Columns of history.csv for a law, in the order of row_of.
template <class Law, template <class> class S, std::size_t rows>
std::vector<output::Column> columns_of(const std::array<const char*, rows>& names) {
  std::vector<output::Column> columns;
  for (const char* name : names) columns.push_back({std::string("strain_") + name, "1"});
  for (const char* name : names) columns.push_back({std::string("stress_") + name, "Pa"});
  for (const auto& [name, unit] : Law::internal) columns.push_back({std::string(name), std::string(unit)});
  for (const auto& [tensor, unit] : Law::tensors)
    for (const char* name : names) columns.push_back({std::string(tensor) + "_" + name, std::string(unit)});
  columns.push_back({"work_stored", "J/m^3"});
  columns.push_back({"work_dissipated", "J/m^3"});
  return columns;
}

template <class Law, template <class> class S>
std::vector<double> row_of(const material::Point<Law, S>& point) {
  std::vector<double> row;
  const auto add = [&row](const S<double>& tensor) {
    for (const double value : material::components<double, S>(tensor)) row.push_back(value);
  };
  add(point.strain);
  add(point.stress);
  for (const double value : point.internal.scalar) row.push_back(value);
  for (const S<double>& tensor : point.internal.tensor) add(tensor);
  row.push_back(point.stored);
  row.push_back(point.dissipated);
  return row;
}

/// Walks the path to its end or to the last increment with finite numbers; the column `time` counts segments.
template <class Law, template <class> class S, std::size_t rows>
driver::Answer walk(const Law& law, const std::vector<Segment>& path, const std::array<const char*, rows>& names) {
  driver::Answer answer{.columns = columns_of<Law, S>(names), .time = {0}, .rows = {}, .results = {}};
  auto point = material::point_of<S>(law);
  answer.rows.push_back(row_of(point));
  int most_rounds = 0;
  for (std::size_t s = 0; s < path.size() && answer.stopped.empty(); ++s) {
    const Segment& segment = path[s];
    const auto strain = material::components<double, S>(point.strain), stress = material::components<double, S>(point.stress);
    for (int i = 1; i <= segment.increments; ++i) {
      const double part = static_cast<double>(i) / segment.increments;
      material::Goal<S> goal;
      for (std::size_t c = 0; c < rows; ++c) {
        const Target& target = segment.target[c];
        goal.strain[c] = target.lead != Lead::to_stress;
        const double from = goal.strain[c] ? strain[c] : stress[c];
        goal.target[c] = target.lead == Lead::keeps_strain ? from : from + part * (target.value - from);
      }
      const material::Sought sought = material::advance(law, goal, point, segment.duration / segment.increments);
      if (!sought.found) {
        answer.stopped = "not_converged";
        answer.reason = "no strain was found for the stresses of increment " + std::to_string(i) + " of path[" + std::to_string(s) + "]";
        break;
      }
      const std::vector<double> row = row_of(point);
      const auto wrong = std::find_if(row.begin(), row.end(), [](double value) { return !std::isfinite(value); });
      if (wrong != row.end()) {
        answer.stopped = "not_finite";
        answer.reason = answer.columns[static_cast<std::size_t>(wrong - row.begin())].name + " is no finite number at increment " +
                        std::to_string(i) + " of path[" + std::to_string(s) + "]";
        break;
      }
      most_rounds = std::max(most_rounds, sought.rounds);
      answer.time.push_back(static_cast<double>(s) + part);
      answer.rows.push_back(row);
    }
  }
  for (std::size_t c = 0; c < answer.columns.size(); ++c)
    answer.results.push_back({answer.columns[c].name, answer.rows.back()[c], answer.columns[c].unit});
  answer.results.push_back({"rounds_of_newton", static_cast<double>(most_rounds), "1"});
  return answer;
}

std::function<driver::Answer()> plan(const input::CaseFile& file) {
  const Case c = read(file.root());
  file.finish();
  return [c] {
    return std::visit(
        [&c](const auto& law) -> driver::Answer {
          using Law = std::decay_t<decltype(law)>;
          if constexpr (material::PlateLaw<Law>) {
            if (c.plate) return walk<Law, Plane>(law, c.path, names_in_plane);
          }
          if constexpr (material::Law<Law>) return walk<Law, Symmetric>(law, c.path, names_in_space);
          throw InternalError("the reader has no fluids here");
        },
        c.material);
  };
}

int main(int argc, char** argv) { return driver::answer(argc, argv, "material_point", plan); }
