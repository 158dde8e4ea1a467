#pragma once
#include <cstdint>
#include <string_view>

namespace nereid {

/// A number that tells whether bytes have changed: FNV-1a of 64 bits, offset and prime as published.
inline std::uint64_t checksum(std::string_view bytes, std::uint64_t state = 0xcbf29ce484222325U) {
  for (const char c : bytes) state = (state ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return state;
}

}  // namespace nereid
