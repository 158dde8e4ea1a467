#include "base/replace_file.hpp"

#include <fstream>
#include <system_error>

#include "base/check.hpp"

namespace nereid {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw MachineError("cannot make the folder " + folder.string() + ": " + error.message());
}

void replace_file(const std::filesystem::path& file, std::string_view text) {
  std::filesystem::path draft = file;
  draft += ".tmp";
  {
    std::ofstream stream(draft, std::ios::binary | std::ios::trunc);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    if (!stream) throw MachineError("cannot write " + draft.string());
  }
  std::error_code error;
  std::filesystem::rename(draft, file, error);
  if (error) throw MachineError("cannot write " + file.string() + ": " + error.message());
}

}  // namespace nereid
