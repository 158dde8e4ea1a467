#pragma once
// The state of a simulation as bytes: by element and node, so that builds for other processors read it too.

#include <string>
#include <string_view>

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// All of a state. A state that is read again and goes on has the bits of one that was never written, with the same width of vectors; with
/// another one those of its round-off.
std::string bytes_of(const Model&, const State&);

/// The state in bytes_of() the same model. DamagedArchive where they are something else.
State state_of(const Model&, std::string_view bytes);

/// A number that tells models apart: by their positions, to nine digits, what is connected, and the order in which elements are kept.
/// Builds with other instructions find the same.
std::uint64_t fingerprint(const Model&);

}  // namespace nereid::dynamics
