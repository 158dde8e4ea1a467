#include "input/text_file.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace nereid::input {

std::optional<std::string> read_text(const std::string& path, std::string& why) {
  const auto refuse = [&](const std::string& reason) {
    why = reason;
    return std::nullopt;
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) return refuse("it is a folder");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return refuse("it is a device or a pipe and no file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) return refuse(errno == 0 ? "it cannot be opened" : std::strerror(errno));
  std::string text;
  std::array<char, 1 << 14> part;  // whatever the system says of its size
  while (text.size() <= most_text && (file.read(part.data(), part.size()), file.gcount() > 0))
    text.append(part.data(), static_cast<std::size_t>(file.gcount()));
  if (file.bad()) return refuse("reading it failed");
  if (text.size() > most_text) return refuse("it is larger than " + std::to_string(most_text / 1'000'000) + " MB");
  return text;
}

}  // namespace nereid::input
