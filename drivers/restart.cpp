#include "drivers/restart.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "base/archive.hpp"
#include "base/check.hpp"
#include "base/checksum.hpp"
#include "base/memory.hpp"
#include "base/replace_file.hpp"
#include "base/words.hpp"
#include "dynamics/archive.hpp"
#include "model/stages.hpp"
#include "output/run_folder.hpp"

namespace nereid::grid {

template <class Archive>
void visit(Archive& archive, CollectionMark& mark) {
  auto& [times, replaced] = mark;
  archive(times, replaced);
}

}  // namespace nereid::grid

namespace nereid::driver {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view head = "Nereid checkpoint ";  // then the version, and the end of the line
constexpr int version = 19;

fs::path file_in(const fs::path& folder) { return folder / output::checkpoint_name; }

template <class Archive>
void visit(Archive& archive, output::RecorderMark& mark) {
  auto& [history, frame, body, contact, walls] = mark;
  archive(history, frame, body, contact, walls);
}

template <class Archive>
void visit(Archive& archive, Checkpoint& one) {
  auto& [driver, case_hash, resolved, fingerprint, time, results, state] = one;
  archive(driver, case_hash, resolved, fingerprint, time);
  visit(archive, results);
  archive(state);
}

struct Text {
  std::string operator()(double value) const { return shortest(value); }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(const std::string& value) const { return value; }
  std::string operator()(const std::vector<double>& values) const {
    std::vector<std::string> words;
    for (const double value : values) words.push_back(shortest(value));
    return "[" + joined(words) + "]";
  }
  std::string operator()(const std::vector<std::string>& values) const { return "[" + joined(values) + "]"; }
};

/// Why a case is not that of a checkpoint: the first key of which it says something else, or nothing.
std::string difference(const std::vector<std::string>& then, const std::vector<std::string>& now) {
  const auto key = [](const std::string& line) { return line.substr(0, line.find(" = ")); };
  std::map<std::string, std::string> left;
  for (const std::string& line : now) left.emplace(key(line), line);
  for (const std::string& line : then) {
    const auto here = left.find(key(line));
    if (here == left.end()) return "it says '" + line + "', and this case has nothing of it";
    if (here->second != line) return "it says '" + line + "', and this case '" + here->second + "'";
    left.erase(here);
  }
  return left.empty() ? "its hash is another one" : "it has nothing of this, and this case '" + left.begin()->second + "'";
}

}  // namespace

std::vector<std::string> lines_of(const std::vector<Resolved>& resolved) {
  std::vector<std::string> lines;
  for (const Resolved& one : resolved)
    lines.push_back(one.path + " = " + std::visit(Text{}, one.value) + (one.unit.empty() || one.unit == "1" ? "" : " " + one.unit));
  return lines;
}

void write_checkpoint(const fs::path& folder, const Checkpoint& checkpoint) {
  Writer body, file;
  visit(body, const_cast<Checkpoint&>(checkpoint));  // which names members and changes none
  file(checksum(body.bytes()), body.bytes());
  replace_file(file_in(folder), std::string(head) + std::to_string(version) + "\n" + file.bytes());
}

std::optional<Checkpoint> read_checkpoint(const fs::path& folder) {
  const fs::path path = file_in(folder);
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  const auto refuse = [&](const std::string& why) { return BadCheckpoint(path.string() + ": " + why); };
  if (!fs::is_regular_file(path, error)) throw refuse("it is no file");  // to open a pipe takes as long as nobody writes to it
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(head.size(), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (bytes != head) throw refuse(stream.bad() ? "it cannot be read" : "it is no checkpoint");
  if (static_cast<double>(fs::file_size(path, error)) > memory_left())
    throw MachineError("memory does not suffice to read " + path.string());
  bytes.append(std::istreambuf_iterator<char>(stream), {});
  if (!stream.good() && !stream.eof()) throw refuse("it cannot be read");
  const std::string mine = std::to_string(version) + "\n";
  if (bytes.compare(head.size(), mine.size(), mine) != 0) {
    const std::string other = bytes.substr(head.size(), std::min<std::size_t>(bytes.find('\n') - head.size(), 20));
    throw refuse("it is of " + (find_unprintable(other) == std::string::npos ? "version '" + other + "'" : "another version") +
                 ", and this program reads version " + std::to_string(version));
  }
  try {
    Reader file(std::string_view(bytes).substr(head.size() + mine.size()));
    std::uint64_t sum = 0;
    std::string body;
    file(sum, body);
    if (sum != checksum(body) || !file.is_at_end()) throw refuse("it is damaged: its checksum is another one");
    Reader reader(body);
    Checkpoint checkpoint;
    visit(reader, checkpoint);
    return checkpoint;
  } catch (const DamagedArchive& damaged) {
    throw refuse(damaged.what());
  }
}

void remove_checkpoint(const fs::path& folder) {
  std::error_code error;  // one that stays does no harm: the end would be reached again
  fs::remove(file_in(folder), error);
  fs::remove(draft_of(file_in(folder)), error);  // of a run that was killed as it wrote
}

void go_back_to(const Checkpoint& then, const Checkpoint& now, model::Simulation& simulation) {
  if (then.driver != now.driver) throw BadCheckpoint("the checkpoint is of driver '" + then.driver + "'");
  if (then.resolved != now.resolved || then.case_hash != now.case_hash)
    throw BadCheckpoint("the checkpoint is of another case: " + difference(then.resolved, now.resolved));
  if (then.fingerprint != now.fingerprint) throw BadCheckpoint("the checkpoint is of another mesh: a file that the case reads has changed");
  try {
    simulation.state = dynamics::state_of(simulation.model, then.state);
    if (!simulation.stages.empty()) model::set_model_of_stage(simulation);
  } catch (const DamagedArchive& damaged) {
    throw BadCheckpoint(std::string("the state in the checkpoint is not of this model: ") + damaged.what());
  }
}

}  // namespace nereid::driver
