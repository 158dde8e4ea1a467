#pragma once
// A stack of plates with gaps, as in both drivers of a reactor's head: its case, its probes, and what its gaps hand on.

#include <string>
#include <vector>

#include "input/readers.hpp"
#include "model/build.hpp"
#include "output/summary.hpp"

namespace nereid::driver {

struct Plates {
  std::vector<double> thickness, gap;  ///< [m] from below; gap[i] lies above plate i
  double radius = 0;                   ///< [m]

  std::size_t size() const { return thickness.size(); }
};

/// Keys `thicknesses`, `gaps` and `radius`: with a gap above each plate, or, without `gap_above_last`, above each but the last.
Plates read_plates(const input::Section&, bool gap_above_last);

/// Height of the lower face of plate i above that of the lowest one. [m]
double bottom(const Plates&, std::size_t i);

/// WHAT_1 for i = 0: numbers of bodies, contacts, probes and results count from below.
std::string numbered(const std::string& what, std::size_t i);
/// Name of the body of plate i.
std::string plate(std::size_t i);

/// Probes of a body along z, called velocity_LABEL [m/s], momentum_LABEL [kg m/s] and kinetic_energy_LABEL [J].
void add_probes(const std::string& body, const std::string& label, model::Scene&);
/// Probe of the mean force of a contact along z, called force_LABEL. [N]
void add_force(const std::string& contact, const std::string& label, model::Scene&);

/// closes_LABEL [s] where the contact has touched, impulse_LABEL [N s] and peak_force_LABEL [N], upwards.
///
/// whole  what there is over what is modelled [-]
void add_strike(const model::Simulation&, const std::string& contact, const std::string& label, double whole, std::vector<output::Result>&);

}  // namespace nereid::driver
