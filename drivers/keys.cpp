#include "drivers/keys.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

#include "drivers/meanings.hpp"
#include "output/dictionary.hpp"

namespace nereid::driver {

namespace {

using Json = nlohmann::ordered_json;

Json as_json(const std::string& program, const input::AskedKey& key) {
  const MeaningOfPath* found = meaning_of(program, key.path);
  const MeaningOfPath meaning = found == nullptr ? MeaningOfPath{} : *found;
  Json json{{"path", key.path}, {"type", key.type}};
  const auto add = [&json](const char* name, std::string_view text) {
    if (!text.empty()) json[name] = text;
  };
  add("unit", meaning.unit.empty() ? key.unit : meaning.unit), add("range", meaning.range.empty() ? key.range : meaning.range);
  add("default", meaning.otherwise.empty() ? key.otherwise : meaning.otherwise);
  if (key.required) json["required"] = true;
  if (!key.options.empty()) json["options"] = key.options;
  if (!key.where.empty()) json["where"] = key.where;
  add("meaning", meaning.text), add("example", meaning.example);
  return json;
}

/// Whether a program has a result or column: it is named among those that have it, or makes steps as all others.
bool has(const std::string& program, bool makes_steps, const output::Described& one) {
  return one.of.empty() ? makes_steps : (", " + one.of + ",").find(", " + program + ",") != std::string::npos;
}

template <class Has>
Json as_json(const std::vector<output::Described>& entries, const Has& has) {
  Json list = Json::array();
  for (const output::Described& one : entries) {
    if (!has(one)) continue;
    Json json{{"name", one.name}, {"unit", one.unit}, {"meaning", one.meaning}};
    if (!one.of.empty()) json["of"] = one.of;
    list.push_back(json);
  }
  return list;
}

}  // namespace

std::string keys_as_json(const std::string& program, bool makes_steps, const std::vector<input::AskedKey>& keys) {
  Json json{{"program", program}, {"keys", Json::array()}};
  for (const input::AskedKey& key : keys) json["keys"].push_back(as_json(program, key));
  const auto of_program = [&](const output::Described& one) { return has(program, makes_steps, one); };
  const auto any = [](const output::Described&) { return true; };
  json["results"] = as_json(output::described_results(), of_program);
  json["columns"] = as_json(output::described_columns(), of_program);
  json["fields"] = as_json(output::described_fields(), any);
  json["summary"] = as_json(output::described_summary(), any);
  return json.dump(1) + "\n";
}

}  // namespace nereid::driver
