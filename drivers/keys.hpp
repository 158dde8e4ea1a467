#pragma once
// What a program says of itself: the keys of its cases, its results and the contents of its files, for pages and for editors.

#include <string>
#include <vector>

#include "input/survey.hpp"

namespace nereid::driver {

/// JSON with `program` and the lists `keys`, `results`, `columns`, `fields` and `summary`: each entry has its meaning, keys an example too.
///
/// makes_steps  whether the program integrates over time, and so has the results and columns of all that do
std::string keys_as_json(const std::string& program, bool makes_steps, const std::vector<input::AskedKey>&);

}  // namespace nereid::driver
