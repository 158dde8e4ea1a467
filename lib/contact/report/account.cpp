#include "contact/report/account.hpp"

#include <vector>

namespace nereid::contact {

double stored(const Memory& memory) {
  double sum = 0;
  for (const double energy : memory.stored) sum += energy;
  return sum;
}

double tangential_stored(const Memory& memory) {
  double sum = 0;
  for (const double energy : memory.tangential_stored) sum += energy;
  return sum;
}

namespace {

/// The schema of what acts by multipliers.
Source source_of_multipliers(const Sides& sides) {
  std::vector<Dissipated> takes{Dissipated::inelastic_impact};
  if (sides.friction.coefficient > 0) takes.insert(takes.begin(), Dissipated::friction);
  return {sides.name, SourceKind::interface, {Stored::restitution}, takes};
}

/// What all kinds have.
void post_sides(const SidesMemory& memory, Account& account) {
  account.work = memory.work;
  account.dissipated[Dissipated::friction] = memory.friction_dissipated - memory.friction_to_come;
  account.dissipated[Dissipated::inelastic_impact] = memory.impact;
  account.angular_impulse = memory.angular_impulse;
}

}  // namespace

Source source(const Interface& interface) {
  const bool has_friction = interface.friction.coefficient > 0;
  if (tied_by_multipliers(interface)) return {interface.name, SourceKind::interface, {}, {Dissipated::inelastic_impact}};
  if (by_multipliers(interface)) return source_of_multipliers(interface);
  std::vector<Dissipated> takes{Dissipated::damping};
  if (interface.follows_thickness) takes.push_back(Dissipated::thinning);
  if (has_friction) takes.push_back(Dissipated::friction);
  return {interface.name, SourceKind::interface,
          has_friction ? std::vector{Stored::penalty, Stored::tangential_penalty} : std::vector{Stored::penalty}, takes};
}

Source source(const EdgeContact& contact) { return source_of_multipliers(contact); }

void post(const Interface& interface, const Memory& memory, Account& account) {
  post_sides(memory, account);
  account.hold(Stored::penalty, by_multipliers(interface) ? 0 : stored(memory));
  if (!tied_by_multipliers(interface)) account.hold(Stored::restitution, memory.held);
  account.hold(Stored::tangential_penalty, tangential_stored(memory));
  account.dissipated[Dissipated::damping] = memory.damped;
  account.dissipated[Dissipated::thinning] = memory.thinned;
  account.created_by_reconnection = memory.created_by_reconnection;
}

void post(const EdgeContact&, const EdgeMemory& memory, Account& account) {
  post_sides(memory, account);
  account.hold(Stored::restitution, memory.held);
}

}  // namespace nereid::contact
