#include "output/summary.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "base/replace_file.hpp"

#if __has_include("nereid_commit.hpp")
#include "nereid_commit.hpp"  // written at build time by lib/output/commit.cmake
#endif
#ifndef NEREID_COMMIT
#define NEREID_COMMIT "unknown"
#endif
#ifndef NEREID_VERSION
#define NEREID_VERSION "unknown"
#endif
#ifndef NEREID_COMPILER
#define NEREID_COMPILER "unknown"
#endif
#ifndef NEREID_FLAGS
#define NEREID_FLAGS "unknown"
#endif
#ifndef NEREID_BUILD_TYPE
#define NEREID_BUILD_TYPE "unknown"
#endif

namespace nereid::output {

namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order in which a reader wants them

Json quantity(double value, const char* unit) { return {{"value", value}, {"unit", unit}}; }

Json quantity(const Vec3& value, const char* unit) {
  return {{"value", {value.x(), value.y(), value.z()}}, {"unit", unit}};
}

/// Adds a member whose name must be new.
void add_once(Json& object, const std::string& name, Json value) {
  if (object.contains(name)) throw InternalError("summary: '" + name + "' comes twice");
  object[name] = std::move(value);
}

Json ending_of(const Ending& ending) {
  return {{"word", ending.word},
          {"reason", ending.reason},
          {"time", quantity(ending.time, "s")},
          {"block", ending.block.empty() ? Json() : Json(ending.block)},
          {"element", ending.element < 0 ? Json() : Json(ending.element)}};
}

Json results_of(const std::vector<Result>& results) {
  Json object = Json::object();
  for (const Result& result : results)
    add_once(object, result.name, quantity(result.value, result.unit.c_str()));
  return object;
}

template <class Channel>
Json channels_of(const std::vector<Channel>& listed, const Channels<Channel>& values) {
  Json object = Json::object();
  for (const Channel channel : listed) add_once(object, std::string(word(channel)), quantity(values[channel], "J"));
  return object;
}

Json account_of(const Source& source, const Account& account, const dynamics::Flow& flow, double scale) {
  const double created = dynamics::created(account);
  Json relative = quantity(created / scale, "1");
  if (scale == 0) relative["value"] = nullptr;
  return {{"kind", word(source.kind)},
          {"work", quantity(account.work, "J")},
          {"stored", channels_of(source.stored, account.stored)},
          {"dissipated", channels_of(source.dissipated, account.dissipated)},
          {"created", quantity(created, "J")},
          {"created_relative", relative},
          {"passed", quantity(flow.passed, "J")},
          {"created_of_passed", quantity(flow.worst, "1")},
          {"created_by_reconnection", quantity(account.created_by_reconnection, "J")},
          {"impulse", quantity(account.impulse, "N s")},
          {"angular_impulse", quantity(account.angular_impulse, "N m s")}};
}

Json ledger_of(const std::vector<Source>& sources, const dynamics::Ledger& ledger) {
  Json accounts = Json::object();
  for (std::size_t s = 0; s < sources.size(); ++s)
    add_once(accounts, sources[s].name, account_of(sources[s], ledger.accounts[s], ledger.flows[s], energy_scale(ledger)));
  return {{"initial_kinetic", quantity(ledger.initial_kinetic, "J")},
          {"initial_available", quantity(ledger.initial_available, "J")},
          {"initial_stored", quantity(dynamics::initial_stored(ledger), "J")},
          {"external_work", quantity(ledger.external_work, "J")},
          {"energy_floor", quantity(dynamics::energy_floor(ledger), "J")},
          {"energy_scale", quantity(dynamics::energy_scale(ledger), "J")},
          {"kinetic", quantity(ledger.kinetic, "J")},
          {"integration", quantity(ledger.integration, "J")},
          {"integration_kept", quantity(ledger.integration_kept, "J")},
          {"integration_kept_relative", quantity(ledger.worst_kept, "1")},
          {"integration_swing_relative", quantity(dynamics::swing_part(ledger), "1")},
          {"energy_residual", quantity(dynamics::energy_residual(ledger), "J")},
          {"initial_momentum", quantity(ledger.initial_momentum, "kg m/s")},
          {"momentum", quantity(ledger.momentum, "kg m/s")},
          {"momentum_residual", quantity(dynamics::momentum_residual(ledger), "kg m/s")},
          {"initial_angular_momentum", quantity(ledger.initial_angular_momentum, "kg m2/s")},
          {"angular_momentum", quantity(ledger.angular_momentum, "kg m2/s")},
          {"angular_momentum_residual",
           quantity(dynamics::angular_momentum_residual(ledger), "kg m2/s")},
          {"accounts", accounts}};
}

Json overlaps_of(const std::vector<Overlap>& overlaps) {
  Json list = Json::array();
  for (const Overlap& one : overlaps)
    list.push_back({{"bodies", one.bodies},
                    {"contacts", one.contacts},
                    {"deepest", quantity(one.deepest, "m")},
                    {"elements", quantity(one.elements, "1")},
                    {"at_start", quantity(one.at_start, "m")},
                    {"place", quantity(one.place, "m")},
                    {"time", quantity(one.time, "s")}});
  return list;
}

Json touched_of(const std::vector<dynamics::Touched>& touched) {
  Json list = Json::array();
  for (const dynamics::Touched& one : touched)
    list.push_back({{"contact", one.contact},
                    {"sides", one.sides},
                    {"first_touch", quantity(one.first, "s")},
                    {"last_touch", quantity(one.last, "s")},
                    {"impulse", quantity(one.impulse, "N*s")}});
  return list;
}

Json cost_of(const Cost& cost) {
  Json all{{"elements", cost.elements},
           {"steps", cost.steps},
           {"element_updates", cost.element_updates},
           {"wall_seconds", cost.wall_seconds},
           {"nanoseconds_per_element_update", cost.nanoseconds_per_element_update},
           {"threads", cost.threads},
           {"frames", cost.frames},
           {"frames_every", quantity(cost.frames_every, "s")}};
  const contact::Spent& contact = cost.contact;
  if (contact.steps > 0)
    all["contact"] = {{"steps", contact.steps}, {"apexes", contact.apexes}, {"conditions", contact.conditions},
                      {"iterations", contact.iterations}, {"seconds", contact.seconds}};
  for (std::size_t i = 0; contact.steps > 0 && i < contact::stages; ++i)
    all["contact"]["stages"][contact::stage_names[i]] = contact.of_stage[i];
  return all;
}

/// The place of a path such as "planes[0].normal" in a tree of objects and arrays.
Json& place(Json& root, const std::string& path) {
  Json* at = &root;
  std::size_t start = 0;
  while (start < path.size()) {
    if (path[start] == '.') ++start;
    if (start < path.size() && path[start] == '[') {
      const std::size_t end = path.find(']', start);
      const std::string digits = path.substr(start + 1, end - start - 1);
      const bool number = !digits.empty() && digits.size() < 7 &&
                          digits.find_first_not_of("0123456789") == std::string::npos;
      if (end == std::string::npos || !number || !(at->is_null() || at->is_array()))
        throw InternalError("summary: no place for '" + path + "'");
      at = &(*at)[std::stoul(digits)];
      start = end + 1;
      continue;
    }
    const std::size_t end = std::min(path.find_first_of(".[", start), path.size());
    if (end == start || !(at->is_null() || at->is_object()))
      throw InternalError("summary: no place for '" + path + "'");
    at = &(*at)[path.substr(start, end - start)];
    start = end;
  }
  return *at;
}

Json resolved_of(const std::vector<Resolved>& values) {
  Json tree = Json::object();
  for (const Resolved& resolved : values) {
    Json& leaf = place(tree, resolved.path);
    // A word may stand above other values: `material: steel` and `material.density`.
    if (!(leaf.is_null() || leaf.is_object()))
      throw InternalError("summary: no place for '" + resolved.path + "'");
    add_once(leaf, "value",
             std::visit([](const auto& value) { return Json(value); }, resolved.value));
    add_once(leaf, "unit", resolved.unit.empty() ? Json() : Json(resolved.unit));
    add_once(leaf, "default", resolved.is_default);
  }
  return tree;
}

Json provenance_of(const Summary& summary) {
  const Provenance from = provenance();
  return {{"version", from.version},        {"commit", from.commit},
          {"compiler", from.compiler},      {"flags", from.flags},
          {"build_type", from.build_type},  {"native", from.native},
          {"processor", from.processor},    {"case_path", summary.case_path},
          {"case_hash", summary.case_hash}, {"resolved", resolved_of(summary.resolved)}};
}

std::string processor_model() {
  std::ifstream stream("/proc/cpuinfo");
  std::string line;
  while (std::getline(stream, line))
    if (line.rfind("model name", 0) == 0) {
      const std::size_t at = line.find_first_not_of(" \t:", line.find(':'));
      if (at != std::string::npos) return line.substr(at);
    }
  return "unknown";
}

}  // namespace

Provenance provenance() {
  Provenance from;
  from.version = NEREID_VERSION;
  from.commit = NEREID_COMMIT;
  from.compiler = NEREID_COMPILER;
  from.flags = NEREID_FLAGS;
  from.build_type = NEREID_BUILD_TYPE;
#ifdef NEREID_NATIVE
  from.native = true;
#endif
  from.processor = processor_model();
  return from;
}

std::string text_of(const Summary& summary) {
  const Json json = {{"driver", summary.driver},
                     {"ending", ending_of(summary.ending)},
                     {"results", results_of(summary.results)},
                     {"ledger", ledger_of(summary.sources, summary.ledger)},
                     {"overlaps", overlaps_of(summary.overlaps)},
                     {"touched", touched_of(summary.touched)},
                     {"cost", cost_of(summary.cost)},
                     {"provenance", provenance_of(summary)},
                     {"not_used", summary.not_used},
                     {"notes", summary.notes},
                     {"warnings", summary.warnings}};
  // Bytes that are no UTF-8, say in a file name, must not cost the summary of a whole run.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Ended ended(const std::filesystem::path& directory) {
  std::error_code error;
  const std::filesystem::path file = directory / "summary.json";
  if (!std::filesystem::is_regular_file(file, error)) return {};
  std::ifstream stream(file, std::ios::binary);
  const Json summary = Json::parse(stream, nullptr, false);  // what is no summary has not ended
  const auto word = [&](const char* place) {
    const Json::json_pointer at(place);
    return summary.is_object() && summary.contains(at) && summary[at].is_string() ? summary[at].get<std::string>() : std::string();
  };
  return {word("/ending/word"), word("/provenance/case_hash")};
}

void write_summary(const std::filesystem::path& directory, const Summary& summary) {
  const std::string text = text_of(summary);
  make_folder(directory);
  replace_file(directory / "summary.json", text);
}

}  // namespace nereid::output
