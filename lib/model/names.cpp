#include "model/names.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "base/words.hpp"
#include "dynamics/measure.hpp"

namespace nereid::model {

namespace {

struct Named {
  std::string name;
  Part part;
};

/// All that has an account in the ledger or stands beside those that have.
std::vector<Named> sources_of(const Scene& scene) {
  std::vector<Named> all;
  const auto add = [&all](const char* kind, const auto& list) {
    for (const auto& one : list) all.push_back({one.name, part(kind, one)});
  };
  add("body", scene.bodies), add("contact", scene.contacts), add("contact", scene.automatic_contacts);
  add("plane", scene.planes), add("plane", scene.rigid_planes);
  add("load", scene.loads), add("spring", scene.springs), add("point mass", scene.point_masses), add("section", scene.sections);
  return all;
}

void refuse_name(Faults& faults, const Part& part, const std::string& name, const std::string& why) {
  refuse(faults, part, "name", "'name' = " + name + why);
}

/// Whether the source of the ledger is the named part, a region of it, or its second pass.
bool is_of(const std::string& source, const std::string& name) {
  return source == name || source == name + "_back" || source.rfind(name + ".", 0) == 0;
}

}  // namespace

bool is_name(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), plain) && std::isdigit(static_cast<unsigned char>(name[0])) == 0;
}

std::string is_no_name(const std::string& name) {
  return "'name' = " + name + " is no name: expected letters, digits and '_', a letter first";
}

bool is_column_of_every_history(const std::string& name) { return name == "time" || name.rfind("energy_", 0) == 0; }

void check_names_given(const Scene& scene, Faults& faults) {
  std::set<std::string> taken{"gravity", "relaxation"};
  const auto look = [&](const Part& part, const std::string& name) {
    if (!is_name(name)) refuse(faults, part, "name", is_no_name(name));
    if (!taken.insert(name).second) refuse_name(faults, part, name, " is given twice");
  };
  for (const Named& one : sources_of(scene)) look(one.part, one.name);
  for (const Contact& contact : scene.contacts)
    if (contact.interface.two_passes && !taken.insert(contact.name + "_back").second)
      refuse(faults, part("contact", contact), "name",
             quote(contact.name + "_back") + " is given twice: it is the second pass of " + contact.name);
  taken.clear();
  for (const Probe& probe : scene.probes) {
    look(part("probe", probe), probe.name);
    if (probe.name == "t" || probe.name == "pi")
      refuse_name(faults, part("probe", probe), probe.name, " has a meaning in formulas: choose another");
    if (is_column_of_every_history(probe.name))
      refuse_name(faults, part("probe", probe), probe.name, " is a column of every history: choose another");
  }
  for (const Body& body : scene.bodies) {
    taken.clear();
    for (const Point& point : body.points) look(part("point", point), point.name);
  }
}

void check_columns(const Scene& scene, const dynamics::Model& model, Faults& faults) {
  const std::vector<Named> named = sources_of(scene);
  std::map<std::string, std::string> owner;  // of each column
  for (const Source& source : dynamics::sources(model))
    for (const std::string& column : dynamics::ledger_columns(source)) {
      const auto [first, fresh] = owner.emplace(column, source.name);
      if (fresh) continue;
      for (const Named& one : named)
        if (is_of(source.name, one.name))
          refuse_name(faults, one.part, one.name, " and " + quote(first->second) + " both give the history a column " + quote(column) +
                                                      ": choose another");
    }
}

}  // namespace nereid::model
