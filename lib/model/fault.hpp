#pragma once
// What is wrong with a scene: collected while it is built, and thrown together.

#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/judge.hpp"

namespace nereid::model {

/// One thing that is wrong with a scene.
struct Fault {
  std::string at;       ///< path of the part in a case, as in "contacts[0]"; empty for a scene made in C++
  std::string key;      ///< of the value in that part, as in "nodes[1]"; empty for the part as a whole
  std::string part;     ///< the part in words, as in "contact 'touch'"
  std::string message;  ///< one line
  std::string hint;     ///< as in "did you mean 'bar.x_high'?", or empty
  std::vector<mesh::Offenders> offenders = {};  ///< elements that it is about
};
using Faults = std::vector<Fault>;

/// A scene cannot be built. what() has one line per fault, "contact 'touch': message (hint)".
class SceneError : public std::exception {
 public:
  explicit SceneError(Faults all);
  const char* what() const noexcept override { return text_.c_str(); }

  Faults faults;

 private:
  std::string text_;
};

/// A part of a scene, as faults name it.
struct Part {
  std::string at, words;
};

/// The part of a named thing, as in part("contact", contact).
template <class Named>
Part part(const char* kind, const Named& one) {
  return {one.at, std::string(kind) + " '" + one.name + "'"};
}

/// The last word of a key: 'nodes' of 'contacts.nodes'.
inline std::string last_of(const std::string& key) { return key.substr(key.rfind('.') + 1); }

/// Adds a fault. Of several at one key of a part the first is kept.
void refuse(Faults&, const Part&, const std::string& key, const std::string& message, const std::string& hint = "");

/// Adds a fault unless `name`, the value of a key, is among `names`; `what` says in the plural what these are.
void expect(Faults&, const Part&, const std::string& key, const std::string& name, const std::string& what,
            const std::vector<std::string>& names);

/// Throws SceneError if there are any.
void throw_if_any(const Faults&);

}  // namespace nereid::model
