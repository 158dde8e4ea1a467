#include "drivers/accuracy.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/words.hpp"
#include "drivers/driver.hpp"
#include "mesh/split.hpp"

namespace nereid::driver {

namespace {

std::string percent(double part) { return formatted("%.2g %%", 100 * part); }
std::string rounded(double value) { return formatted("%.6g", value); }

/// The result of a name, or the first that is a number and not zero; null if there is none.
const output::Result* find(const std::vector<output::Result>& results, const std::string& name) {
  for (const output::Result& result : results)
    if (name.empty() ? std::isfinite(result.value) && result.value != 0 : result.name == name) return &result;
  return nullptr;
}

std::string names_of(const std::vector<output::Result>& results) {
  std::vector<std::string> names;
  for (const output::Result& result : results) names.push_back(result.name);
  return listed(names);
}

}  // namespace

double part_of(const std::string& text) {
  double value = 0;
  const char* last = text.data() + text.size();
  const auto read = std::from_chars(text.data(), last, value);
  if (read.ec != std::errc{}) return 0;
  std::string_view unit(read.ptr, static_cast<std::size_t>(last - read.ptr));
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  if (!unit.empty() && unit != "%") return 0;
  const double part = unit.empty() ? value : value / 100;
  return part > 0 && part < 1 ? part : 0;
}

std::string why_not_finer(const std::vector<input::CaseMesh>& meshes, bool all_rigid) {
  const std::string files = input::names_from_files(meshes), stay = input::names_that_stay(meshes);
  if (files.empty() && input::counts_of_cells(meshes).empty()) return "the case has no counts of cells to make finer";
  if (all_rigid) return "all bodies are rigid: their meshes are geometry, and no error of a mesh can be estimated";
  if (!stay.empty()) return "the mesh of " + stay + " keeps its one cell in every direction: no estimate can be made without its error";
  return "";
}

std::vector<std::string> left_out(const std::vector<input::CaseMesh>& meshes) {
  std::vector<std::string> names, lines;
  for (const input::CaseMesh& mesh : meshes)
    if (!mesh.rigid && !mesh.from_file && std::find(mesh.counts.begin(), mesh.counts.end(), 1) != mesh.counts.end())
      names.push_back(mesh.name.empty() ? "the case" : quote(mesh.name));
  const std::string files = input::names_from_files(meshes);
  if (!files.empty())
    lines.push_back("the estimate excludes the geometry of " + files + ": a split mesh keeps the straight edges of its file");
  if (!names.empty()) lines.push_back("the estimate excludes directions that have one cell and keep it: in " + joined(names));
  return lines;
}

std::string duration(double seconds) {
  return seconds < 60 ? formatted("%.2g s", seconds) : rounded(std::ceil(seconds / 60)) + " min";
}

Factors factors_of(const std::vector<input::CaseMesh>& meshes) {
  const std::vector<int> counts = input::counts_of_cells(meshes);
  const std::string files = input::names_from_files(meshes);
  const std::vector<double> splits(mesh::split_factors.begin(), mesh::split_factors.end());
  const std::vector<double> even = even_factors(counts, files.empty() ? std::vector<double>{} : splits);
  if (files.empty()) return {even, first_factor(even, counts), "no finer mesh keeps the proportions of the cells"};
  return {even, 1, "meshes from files are split by 2 or by 4 only, also " + files};
}

std::string run_to_target(const Target& target, const Factors& factors, const RunOnce& run,
                          const std::function<void(const std::string&)>& say, int& status) {
  constexpr std::size_t looks = 1;  // before the second mesh nothing can be said of an error
  constexpr int most_folded = 2;
  std::vector<Level> levels;
  std::string name = target.of;
  double refine = factors.first;
  for (int folded = 0; refine > 0;) {
    double error = 0;
    const Judge judge = [&](const Ran& ran, std::vector<output::Result>& results) {
      const output::Result* found = find(ran.results, name);
      if (found == nullptr || levels.size() < looks) return;
      std::vector<Level> all = levels;
      all.push_back({refine, found->value, ran.updates, ran.seconds});
      double updates = 0;
      for (const Level& level : all) updates += level.updates;
      results.push_back({found->name + "_mesh_error", mesh_error(all).error, found->unit});
      results.push_back({"element_updates_in_all", updates, "1"});
    };
    const Ran ran = run(refine, levels.size() < looks, judge);
    if (ran.status == interrupted) return status = interrupted, "";
    if (ran.status != done) {  // a coarse mesh may fold, or be refused, where a finer one is not
      status = ran.status;
      if (++folded > most_folded) return "the runs stopped, the last with refine " + rounded(refine);
      refine = next_factor(factors.all, {{refine, 0, 0, 0}}, 0);
      continue;
    }
    const output::Result* found = find(ran.results, name);
    if (found == nullptr && name.empty()) return "no result of the case is a number other than zero";
    if (found == nullptr) return status = bad_case, quote(name) + " is no result of this case; there are " + names_of(ran.results);
    if (!std::isfinite(found->value)) return quote(found->name) + " is no number with refine " + rounded(refine);
    name = found->name;
    levels.push_back({refine, found->value, ran.updates, ran.seconds});
    std::string line = "refine " + rounded(refine) + ": " + name + " = " + rounded(found->value) + " " + found->unit;
    const double wanted = target.part * std::abs(found->value);
    if (levels.size() > looks) {
      error = mesh_error(levels).error;
      line += ", estimated error " + (found->value != 0 ? percent(error / std::abs(found->value)) : rounded(error) + " " + found->unit);
    }
    say(line);
    status = done;
    if (levels.size() > looks && error <= wanted) return "";
    if (levels.size() > looks && !(wanted > 0)) return name + " is zero: an error relative to it is not defined";
    const double next = next_factor(factors.all, levels, wanted);
    const double seconds = next > 0 ? levels.back().seconds * updates_at(levels, next) / std::max(1.0, levels.back().updates) : 0;
    if (seconds > target.longest)
      return "the next mesh, refine " + rounded(next) + ", would take about " + duration(seconds);
    refine = next;
  }
  return factors.at_end;
}

}  // namespace nereid::driver
