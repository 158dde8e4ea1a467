#pragma once
// Natural frequencies: the small free vibrations of a model about its reference positions.
//
//     K u = omega^2 M u
//
// K is the model's own stiffness, by differences of the forces with which its elements answer small displacements;
// M is the lumped mass and rotary inertia of the run. So the frequencies are those of the program, errors of its
// elements included, and 2 / omega of the highest is the longest step that a run without damping can take.
// See docs/theory/modes.md.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// One free vibration.
struct Mode {
  double frequency = 0;  ///< [Hz]
  double residual = 0;   ///< [-] |K u - omega^2 M u| over that of the highest mode's K u, in the norm of M^-1
  Vectors shape;         ///< displacement, [3 x nodes], with u^T M u = 1 together with the rotations
  Vectors rotations;     ///< rotation of the plates, [3 x plate nodes]
};

struct Modes {
  std::vector<Mode> lowest;   ///< frequencies ascending, those of rigid motions included
  std::vector<Mode> highest;  ///< descending
  int without_stiffness = 0;  ///< of the lowest: rigid motions and mechanisms, whose frequencies are round-off
  double asymmetry = 0;       ///< [-] largest |K - K^T| over the largest |K|
  double exact_step = 0;      ///< [s] 2 / omega of the highest mode
  double voted_step = 0;      ///< [s] that the elements and springs ask for at the start of a run
  std::int64_t freedoms = 0;  ///< displacements and rotations that were free to move
  std::int64_t drilling = 0;  ///< rotations that no element resists, about the normal of a flat plate: left out
  bool finite = true;         ///< else stiffness or stiffness over mass is beyond what numbers hold, and there are no modes
  bool complete = true;       ///< as many as were asked for were found, and Sturm's count says that none was passed over
};

/// Finds modes of a model after finalize(). Planes constrain as they do at the start, those that move stand still.
///
/// Interfaces, rigid planes, floors and loads have no part in it; springs pull along their lines, without the
/// pull that they have at the start. A model with fewer freedoms than are asked for gives what it has.
/// lowest, highest  how many, at least 1 each
Modes find_modes(const Model&, int lowest, int highest);

}  // namespace nereid::dynamics
