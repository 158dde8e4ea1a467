#pragma once
// What one source of force owes an account of: energy by channel, and impulses.
//
// The schema (which sources there are, and through which channels their energy goes) belongs to a model and never
// changes; the values belong to a state. A source of force posts its values beside its own code.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.hpp"

namespace nereid {

/// Energy that a source holds and can give back.
///
/// `restitution` is kinetic energy of nodes that multipliers stopped, as long as these press; `drilling` is of plates whose nodes turn
/// about their normals, `residual_bending` of what their transverse shear bends within an element; `distortion` is that of corners of
/// hexahedra that are kept from closing. Of a fluid, `compression` is what its pressure took, `cavitation` what its bubbles took, and
/// `weight` what its weight at centroids differs from that of its nodes.
enum class Stored {
  elastic, compression, cavitation, weight, hourglass, distortion, transverse_shear, residual_bending, drilling, penalty,
  tangential_penalty, restitution, potential, external_work
};
/// Energy that a source took for good.
///
/// `thinning` is what a penalty loses as the plates that it presses become thinner; `radiated` is what left through a surface.
enum class Dissipated { plastic, viscous, hourglass, damping, friction, inelastic_impact, removed, thinning, radiated };

constexpr std::array<std::string_view, 14> words_of_stored{
    "elastic", "compression", "cavitation", "weight", "hourglass", "distortion", "transverse_shear", "residual_bending", "drilling",
    "penalty", "tangential_penalty", "restitution", "potential", "external_work"};
constexpr std::array<std::string_view, 9> words_of_dissipated{
    "plastic", "viscous", "hourglass", "damping", "friction", "inelastic_impact", "removed", "thinning", "radiated"};

constexpr std::string_view word(Stored channel) { return words_of_stored[static_cast<std::size_t>(channel)]; }
constexpr std::string_view word(Dissipated channel) { return words_of_dissipated[static_cast<std::size_t>(channel)]; }

/// One number per channel; channels that a source does not have stay zero. [J]
template <class Channel>
class Channels {
 public:
  double& operator[](Channel channel) { return value_[static_cast<std::size_t>(channel)]; }
  double operator[](Channel channel) const { return value_[static_cast<std::size_t>(channel)]; }

 private:
  std::array<double, words_of_stored.size()> value_{};
};
static_assert(words_of_dissipated.size() <= words_of_stored.size());

/// What makes forces.
enum class SourceKind {
  block, interface, rigid_plane,
  constrained, fixed, symmetry, floor, driven,          // planes
  body_force, pressure, force, moment, spring, radiation, bubble,   // loads
  relaxation, gravity
};

constexpr std::array<std::string_view, 17> words_of_source_kinds{
    "block", "interface", "rigid_plane", "constrained", "fixed", "symmetry", "floor", "driven",
    "body_force", "pressure", "force", "moment", "spring", "radiation", "bubble", "relaxation", "gravity"};

constexpr std::string_view word(SourceKind kind) { return words_of_source_kinds[static_cast<std::size_t>(kind)]; }

/// The schema of one source: its name and the channels of its energy, in the order in which results list them.
struct Source {
  std::string name;
  SourceKind kind;
  std::vector<Stored> stored;
  std::vector<Dissipated> dissipated;
};

/// The values of one source since the start.
struct Account {
  double work = 0;                     ///< [J] done on the nodes
  Channels<Stored> stored;             ///< [J] held now, less `at_start`; `external_work`: where a load takes its work from
  Channels<Stored> at_start;           ///< [J] held at the start: an initial displacement, a spring that starts loaded
  Channels<Dissipated> dissipated;     ///< [J]
  double created_by_reconnection = 0;  ///< [J] the part of created() that fell in steps of a walk
  Vec3 impulse = Vec3::Zero();         ///< [N s] given to the nodes
  Vec3 angular_impulse = Vec3::Zero(); ///< [N m s] about the origin

  /// Posts what a store holds now.
  void hold(Stored channel, double now) { stored[channel] = now - at_start[channel]; }
};

}  // namespace nereid
