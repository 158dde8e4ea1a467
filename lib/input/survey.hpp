#pragma once
// Which keys the reader of a program asks for: found by reading an empty case, once for each answer that changes what is asked.

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace nereid::input {

class CaseFile;

/// A key of a case, as readers ask for it.
struct AskedKey {
  std::string path;               ///< as in "bodies[].material.young"
  std::string type;               ///< section, quantity, number, count, flag, word, choice, expression, and lists, as "sections"
  std::string unit;               ///< SI, of quantities; "1" of plain numbers, else empty
  std::string range;              ///< as in "0 < safety <= 10", or empty; several joined by " | "
  std::string otherwise;          ///< the default in SI, or empty; as in "1; 0.1 with kind = stiffness" if it depends on other keys
  bool required = false;          ///< in every case that uses it
  std::vector<std::string> options = {};   ///< of a choice
  /// Conditions on other keys under which it is used, as in "bodies[].material.kind = elastic | j2_curve" and "without stages". All must
  /// hold, but for those on a key that is itself not used. Empty: always. "never": it is only checked, and listed as not used.
  std::vector<std::string> where = {};
};

inline constexpr const char* above_zero = "above 0";

/// What a pass over the readers was told, and what it has been asked.
struct Survey {
  /// By path: an option of a choice, "given" of a key whose presence matters, `above_zero` of a number that is zero by default.
  std::map<std::string, std::string> answers;

  struct Asked {
    AskedKey key;
    bool used;
  };
  struct Question {
    std::string path;
    std::vector<std::string> answers;  ///< the first one is what is answered by default
    bool used;                         ///< whether the reader uses the key, with the answers so far
  };
  std::vector<Asked> asked = {};
  std::set<std::string> faults = {};  ///< of values that do not go together
  std::vector<Question> questions = {};
};

/// Thrown where a reader has read all of a surveyed case: nothing is built from it.
struct SurveyEnds {};

/// Keys of all cases that a reader reads, in the order of asking.
///
/// read  reads a case up to CaseFile::finish()
std::vector<AskedKey> asked_keys(const std::function<void(const CaseFile&)>& read);

}  // namespace nereid::input
