#include "model/fault.hpp"

#include <algorithm>

#include "base/words.hpp"

namespace nereid::model {

SceneError::SceneError(Faults all) : faults(std::move(all)) {
  for (const Fault& fault : faults) {
    text_ += (text_.empty() ? "" : "\n") + fault.part + ": " + fault.message;
    if (!fault.hint.empty()) text_ += " (" + fault.hint + ")";
  }
}

void refuse(Faults& faults, const Part& part, const std::string& key, const std::string& message, const std::string& hint) {
  const auto same = [&](const Fault& one) { return one.at == part.at && one.part == part.words && one.key == key; };
  if (std::none_of(faults.begin(), faults.end(), same)) faults.push_back({part.at, key, part.words, message, hint});
}

void expect(Faults& faults, const Part& part, const std::string& key, const std::string& name, const std::string& what,
            const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const std::string known = names.empty() ? "there are no " + what : what + " are " + listed(names);
  refuse(faults, part, key, quote(key.substr(0, key.find('['))) + " = " + name + " is unknown: " + known, nearest(name, names));
}

void throw_if_any(const Faults& faults) {
  if (!faults.empty()) throw SceneError(faults);
}

}  // namespace nereid::model
