#include "input/survey.hpp"

#include <algorithm>
#include <deque>
#include <set>

#include "base/words.hpp"
#include "input/document.hpp"
#include "input/section.hpp"

namespace nereid::input {

namespace {

using Answers = std::map<std::string, std::string>;

constexpr std::size_t most_changes = 4;   // of answers in one pass
constexpr std::size_t most_side_by_side = 3;  // of these, changes that are tried though the one before did not make them possible

/// Everything that is asked where questions are answered so.
struct Pass {
  std::vector<std::string> changed;  ///< paths of questions that are not answered by default, in the order of changing
  Survey survey;
  std::map<std::string, const Survey::Asked*> keys;  ///< by path; that which is used, if a reader asks twice
  std::set<std::string> used;                        ///< of these
  std::map<std::string, const Survey::Question*> questions;

  bool contradicts_itself = false;  ///< of its answers some do not go together, though each is sound without the others

  bool uses(const std::string& path) const { return used.count(path) > 0; }
  const Survey::Question* question(const std::string& path) const {
    const auto at = questions.find(path);
    return at == questions.end() ? nullptr : at->second;
  }
  /// What it answered.
  std::string said(const Survey::Question& question) const {
    const auto at = survey.answers.find(question.path);
    const bool fits =
        at != survey.answers.end() && std::find(question.answers.begin(), question.answers.end(), at->second) != question.answers.end();
    return fits ? at->second : question.answers.front();
  }
};

std::string section_of(const std::string& path) { return path.substr(0, path.rfind('.') + 1); }  // npos + 1 is 0

/// Whether the answer to a question may matter to a key: not of two items of different lists.
bool are_near(const std::string& question, const std::string& path) {
  const auto first = [](const std::string& all) { return all.substr(0, all.find('.')); };
  const bool both_items = first(question).ends_with("[]") && first(path).ends_with("[]");
  return !both_items || first(question) == first(path);
}

/// Whether a question is about the key itself, or whether what it lies in is given.
bool is_of(const Survey::Question& question, const std::string& path) {
  const std::string& asked = question.path;
  return path == asked || path.rfind(asked + ".", 0) == 0 || path.rfind(asked + "[]", 0) == 0;
}

/// Passes over a reader, each made once.
class Passes {
 public:
  explicit Passes(const std::function<void(const CaseFile&)>& read) : read_(read) {}

  /// The pass in which one question more is answered so.
  const Pass& with(const Pass& before, const std::string& path, const std::string& answer) {
    Answers answers = before.survey.answers;
    std::vector<std::string> changed = before.changed;
    const Survey::Question* question = before.question(path);
    std::erase(changed, path), answers.erase(path);
    if (question == nullptr || answer != question->answers.front()) answers[path] = answer, changed.push_back(path);
    return make(answers, std::move(changed));
  }

  const Pass& make(const Answers& answers, std::vector<std::string> changed) {
    const auto [at, fresh] = known_.emplace(answers, nullptr);
    if (!fresh) return *at->second;
    const auto survey = std::make_shared<Survey>();
    survey->answers = answers;
    try {
      read_(CaseFile::surveyed(survey));
    } catch (const SurveyEnds&) {
    } catch (const CaseError&) {  // a reader that ends by itself
    }
    Pass& pass = all.emplace_back();
    at->second = &pass;
    pass.changed = std::move(changed), pass.survey = std::move(*survey);
    for (const Survey::Asked& one : pass.survey.asked) {
      const Survey::Asked*& kept = pass.keys[one.key.path];
      if (kept == nullptr || (one.used && !kept->used)) kept = &one;
      if (one.used) pass.used.insert(one.key.path);
    }
    for (const std::string& path : pass.changed) {
      const Pass* fewer = without(pass, path);
      pass.contradicts_itself = pass.contradicts_itself || (fewer != nullptr && fewer->contradicts_itself);
    }
    for (const std::string& fault : pass.survey.faults) {
      const auto has_fault = [&](const std::string& path) {
        const Pass* fewer = without(pass, path);
        return fewer != nullptr && fewer->survey.faults.count(fault) > 0;
      };
      const bool is_new = all.front().survey.faults.count(fault) == 0 && std::none_of(pass.changed.begin(), pass.changed.end(), has_fault);
      pass.contradicts_itself = pass.contradicts_itself || (is_new && pass.changed.size() > 1);
    }
    for (const Survey::Question& one : pass.survey.questions) {
      const Survey::Question*& kept = pass.questions[one.path];
      if (kept == nullptr || (one.used && !kept->used)) kept = &one;
    }
    return pass;
  }

  /// The pass in which a question is answered by default, all else being equal; null if it was not made.
  const Pass* without(const Pass& pass, const std::string& path) const {
    Answers answers = pass.survey.answers;
    answers.erase(path);
    const auto at = known_.find(answers);
    return at == known_.end() ? nullptr : at->second;
  }

  std::deque<Pass> all;  // in the order of making; references stay

 private:
  std::function<void(const CaseFile&)> read_;
  std::map<Answers, Pass*> known_;
};

/// Tries answers in turn, and several together where these may belong together: in one section, or one that the other made possible.
///
/// returns  paths of questions whose answers change which keys are used
std::set<std::string> explore(Passes& passes) {
  std::set<std::string> matters;
  struct Step {
    const Pass* pass;
    const Pass* before;
    bool tells;  ///< whether each change so far has changed which keys are used
  };
  std::deque<Step> open{{&passes.make({}, {}), nullptr, true}};
  while (!open.empty()) {
    const auto [pass, before, tells] = open.front();
    open.pop_front();
    const std::string last = pass->changed.empty() ? "" : pass->changed.back();
    bool is_behind = false;  // behind the question that was changed last, so that no two are changed in both orders
    for (const Survey::Question& question : pass->survey.questions) {
      is_behind = is_behind || question.path == last;
      if (!question.used || pass->survey.answers.count(question.path) > 0) continue;
      const Survey::Question* earlier = before == nullptr ? nullptr : before->question(question.path);
      const bool became_possible = earlier == nullptr || !earlier->used;
      const bool side_by_side = is_behind && section_of(question.path) == section_of(last) &&
                                pass->changed.size() < (tells ? most_side_by_side : 2);
      if (pass->changed.size() >= most_changes) continue;
      for (std::size_t i = 1; i < question.answers.size(); ++i) {
        const auto had = [&](const std::string& answer) {
          return std::find(earlier->answers.begin(), earlier->answers.end(), answer) != earlier->answers.end();
        };
        if (!became_possible && !side_by_side && had(question.answers[i])) continue;
        const std::size_t count = passes.all.size();
        const Pass& next = passes.with(*pass, question.path, question.answers[i]);
        const bool changes = next.used != pass->used;
        if (changes && !next.contradicts_itself) matters.insert(question.path);
        if (passes.all.size() > count && !next.contradicts_itself) open.push_back({&next, pass, tells && changes});
      }
    }
  }
  for (const Pass& pass : passes.all)
    for (std::size_t i = 0; i + 1 < pass.changed.size() && !pass.contradicts_itself; ++i) {
      const Pass* without = passes.without(pass, pass.changed[i]);
      if (without != nullptr && without->used != pass.used) matters.insert(pass.changed[i]);
    }
  return matters;
}

/// Tries the answers of questions about keys that are never used, once each: what they lead to is checked all the same.
void explore_unused(Passes& passes) {
  std::set<std::string> known;
  for (const Pass& pass : passes.all)
    for (const auto& [path, question] : pass.questions)
      if (question->used) known.insert(path);
  for (std::size_t p = 0; p < passes.all.size(); ++p)
    for (std::size_t q = 0; q < passes.all[p].survey.questions.size(); ++q) {
      const Survey::Question question = passes.all[p].survey.questions[q];
      if (!known.insert(question.path).second) continue;
      for (std::size_t i = 1; i < question.answers.size(); ++i) passes.with(passes.all[p], question.path, question.answers[i]);
    }
}

void add_once(std::vector<std::string>& words, const std::string& word) {
  if (!word.empty() && std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
}

std::string joined_by(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// "contact.kind = tied | automatic", "with stages".
std::string in_words(const Survey::Question& question, const std::vector<std::string>& answers) {
  const bool is_presence = question.answers.front().empty();
  if (is_presence) return (answers.front().empty() ? "without " : "with ") + question.path;
  return question.path + " = " + joined_by(answers, " | ");
}

/// The condition that a question is to a key that some passes use; empty if there is none.
std::string condition(const std::string& question_path, const std::string& path, const std::vector<const Pass*>& users, Passes& passes) {
  std::vector<std::string> all;
  std::set<std::string> with;  // answers of the passes that use the key
  const Survey::Question* question = nullptr;
  for (const Pass* pass : users) {
    const Survey::Question* here = pass->question(question_path);
    if (here == nullptr || !here->used) continue;
    if (question == nullptr) question = here;
    if (here->answers.front() != question->answers.front()) continue;  // a key that is asked for here and only looked for there
    with.insert(pass->said(*here));
    for (const std::string& one : here->answers)
      if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  }
  if (question == nullptr || is_of(*question, path)) return "";
  const auto may_say = [&](const Pass& pass, const std::string& answer) {
    const Survey::Question* here = pass.question(question_path);
    const bool is_same = here != nullptr && here->used && here->answers.front() == question->answers.front();
    return is_same && std::find(here->answers.begin(), here->answers.end(), answer) != here->answers.end();
  };
  std::vector<std::string> kept;
  for (const std::string& one : all) {
    if (with.count(one) == 0) {
      const Pass* before = *std::find_if(users.begin(), users.end(), [&](const Pass* pass) { return may_say(*pass, one); });
      const Pass& other = passes.with(*before, question_path, one);
      const bool is_untold = question->answers.front().empty() && other.contradicts_itself;
      if (!is_untold && !other.uses(path)) continue;
    }
    kept.push_back(one);
  }
  return kept.size() == all.size() ? "" : in_words(*question, kept);
}

/// What the passes that use a key say of it.
AskedKey merged(const std::string& path, const std::vector<const Pass*>& users) {
  AskedKey key = users.front()->keys.at(path)->key;
  key.options.clear();
  std::vector<std::string> types, ranges, defaults, texts;
  for (const Pass* pass : users) {
    const AskedKey& here = pass->keys.at(path)->key;
    const Survey::Question* question = pass->question(path);
    const bool is_presence = question != nullptr && question->answers.front().empty();
    key.required = key.required && here.required && !is_presence;
    add_once(types, here.type);
    const bool is_number = here.type == "quantity" || here.type == "number" || here.type == "count";
    add_once(ranges, is_number && here.range.empty() ? "any" : here.range);
    for (const std::string& option : here.options) add_once(key.options, option);
    const bool is_new = !here.otherwise.empty() && std::find(defaults.begin(), defaults.end(), here.otherwise) == defaults.end();
    if (!is_new) continue;
    defaults.push_back(here.otherwise);
    const bool has_cause = defaults.size() > 1 && !pass->changed.empty();
    const std::string cause = has_cause ? pass->changed.back() : "";
    texts.push_back(here.otherwise + (has_cause ? " with " + cause + " = " + pass->survey.answers.at(cause) : ""));
  }
  key.type = joined_by(types, " | "), key.otherwise = joined_by(texts, "; ");
  key.range = ranges == std::vector<std::string>{"any"} ? "" : joined_by(ranges, " | ");
  return key;
}

}  // namespace

std::vector<AskedKey> asked_keys(const std::function<void(const CaseFile&)>& read) {
  Passes passes(read);
  const std::set<std::string> matters = explore(passes);
  explore_unused(passes);
  std::vector<std::string> order;  // of paths
  std::map<std::string, std::vector<const Pass*>> users;
  for (const Pass& pass : passes.all)
    for (const Survey::Asked& one : pass.survey.asked) {
      const auto [at, fresh] = users.emplace(one.key.path, std::vector<const Pass*>{});
      if (fresh) order.push_back(one.key.path);
      const bool is_user = pass.uses(one.key.path) && !pass.contradicts_itself;
      if (is_user && (at->second.empty() || at->second.back() != &pass)) at->second.push_back(&pass);
    }
  std::vector<AskedKey> all;
  const std::size_t explored = passes.all.size();
  for (const std::string& path : order) {
    const std::vector<const Pass*>& of_key = users.at(path);
    if (!of_key.empty()) {
      AskedKey key = merged(path, of_key);
      for (const std::string& question : matters) {
        if (!are_near(question, path)) continue;
        const std::string said = condition(question, path, of_key, passes);
        if (!said.empty()) key.where.push_back(said);
      }
      all.push_back(std::move(key));
      continue;
    }
    const auto asks = [&](const Pass& pass) { return pass.keys.count(path) > 0; };
    const auto first = std::find_if(passes.all.begin(), passes.all.begin() + static_cast<std::ptrdiff_t>(explored), asks);
    AskedKey key = first->keys.at(path)->key;
    key.where = {"never"};
    all.push_back(std::move(key));
  }
  return all;
}

}  // namespace nereid::input
