#include "grid/file_sets.hpp"

#include <algorithm>
#include <set>

#include "base/words.hpp"

namespace nereid::grid {
namespace {

constexpr std::size_t most_groups = 32;  // of numbers that differ: an array with more of them numbers its things

bool starts_with(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

/// Of one component, finite and not of VTK or gmsh, whose arrays of ghosts and of entities are no sets.
bool may_name(const Field& field) {
  return field.values.rows() == 1 && field.values.size() > 0 && field.values.allFinite() && !starts_with(field.name, "vtk") &&
         field.name != "gmsh:geometrical" && field.name != "gmsh:dim_tags";
}

/// The numbers that an array of whole numbers has, or none if there are too many for groups.
std::set<double> groups_of(const Field& field) {
  std::set<double> found;
  if (!field.integer) return found;
  for (const double value : field.values.reshaped())
    if (found.insert(value).second && found.size() > most_groups) return {};
  return found;
}

/// Whether every point or cell has a value of its own, so that these are its number and no group.
bool are_numbers(const Field& field, const std::set<double>& groups) {
  return static_cast<Eigen::Index>(groups.size()) == field.values.size() && *groups.begin() >= 0;  // -1 stands for none
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == at) parts.emplace_back();
    else parts.back() += c;
  return parts;
}

std::string join(const std::vector<std::string>& names, const std::string& with) {
  std::string text;
  for (const std::string& name : names) text += (&name == names.data() ? "" : with) + name;
  return text;
}

/// The names of which an array is called "a-b-c", so many, or where meshio 5.3 and later put that between the names once more, as in
/// "aa-bb" of a and b; none if it is neither.
std::vector<std::string> names_between(const std::string& name, char at, std::size_t count) {
  std::vector<std::string> parts = split(name, at);
  if (parts.size() == count) {
    const std::vector<std::string> halves{parts.front().substr(0, parts.front().size() / 2), parts.back().substr(parts.back().size() / 2)};
    if (count != 2 || join(halves, join(halves, {at})) != name) return parts;
    return halves;
  }
  if (parts.size() != (count - 1) * (count - 1) + 1) return {};
  const std::string last = parts.back();
  parts.resize(count);
  parts.front() = parts.front().substr(0, parts.front().size() / 2), parts.back() = last.substr(last.size() / 2);
  return join(parts, join(parts, {at})) == name ? parts : std::vector<std::string>{};
}

/// The names that are joined to the name of an array, so many; none if they can be told in no way, or in two.
std::vector<std::string> joined_names(const std::string& name, std::size_t count) {
  if (count == 1) return {name};
  std::vector<std::string> found;
  for (const char at : {'-', '_', '#', '+', '/'}) {  // of which meshio takes the first that is in no name
    std::vector<std::string> names = names_between(name, at, count);
    if (names.empty() || std::any_of(names.begin(), names.end(), [](const auto& one) { return one.empty(); })) continue;
    if (!found.empty()) return {};
    found = std::move(names);
  }
  return found;
}

FileSet points_with(const Field& field, double value, const std::string& name) {
  FileSet set{name, {}};
  for (Eigen::Index point = 0; point < field.values.cols(); ++point)
    if (field.values(0, point) == value) set.points.push_back(static_cast<Index>(point));
  return set;
}

}  // namespace

std::vector<FileSet> point_sets(const Contents& file, std::vector<std::string>& warnings) {
  std::vector<FileSet> sets;
  for (const Field& field : file.point_fields) {
    if (!may_name(field)) continue;
    const auto values = field.values.array();
    if ((values == 0 || values == 1).all()) {
      if ((values == 1).any() && (field.integer || (values == 0).any())) sets.push_back(points_with(field, 1, field.name));
      continue;
    }
    const std::set<double> groups = groups_of(field);
    if (groups.size() < 2 || are_numbers(field, groups)) continue;
    const double last = *groups.rbegin();
    const bool from_none = *groups.begin() == -1 && last >= 0 && last <= most_groups;
    const auto count = static_cast<std::size_t>(from_none ? last + 1 : 0);
    const std::vector<std::string> names = from_none ? joined_names(field.name, count) : std::vector<std::string>{};
    for (std::size_t n = 0; n < names.size(); ++n)
      if (FileSet set = points_with(field, static_cast<double>(n), names[n]); !set.points.empty()) sets.push_back(std::move(set));
    if (names.size() > 1)
      warnings.push_back("its point array " + quote(field.name) + " holds the sets " + joined(names) +
                         " in one, so that a point of two of them is in the last alone");
    if (names.empty())
      warnings.push_back("its point array " + quote(field.name) + " looks like sets of points, and is not used: expected is an array of 0 "
                         "and 1 for each");
  }
  return sets;
}

std::map<int, std::string> group_names(const Contents& file, int dimension) {
  std::map<int, std::string> names;
  for (const Field& field : file.fields)
    if (field.integer && field.values.size() == 2 && field.values(1) == dimension && !field.name.empty())
      names.emplace(static_cast<int>(field.values(0)), field.name);
  return names;
}

std::vector<std::string> unused_regions(const Contents& file, const std::string& used) {
  std::vector<std::string> warnings;
  for (const Field& field : file.cell_fields)
    if (const auto groups = groups_of(field); field.name != used && may_name(field) && groups.size() > 1 && !are_numbers(field, groups))
      warnings.push_back("its cell array " + quote(field.name) +
                         " looks like regions, and is not used: 'region_array' names the one that is");
  return warnings;
}

}  // namespace nereid::grid
