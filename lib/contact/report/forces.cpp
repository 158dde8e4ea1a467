#include "contact/report/forces.hpp"

#include <algorithm>
#include <span>

#include "contact/tracking/element.hpp"

namespace nereid::contact {

namespace {

/// Calls push(node, force) for what presses nodes, and rub(touch, force) for friction.
template <class Push, class Rub>
void visit_forces(const Interface& interface, const Memory& memory, Push&& push, Rub&& rub) {
  for (const Near& near : memory.near) {
    const ElementForces& element = near.element;
    if (!element.closed) continue;
    if (any_of(element.stencil, element.count, [](const Stencil& one) { return one.shares > 0; })) {
      for (int i = 0; i < element.count; ++i) for_each_force(interface, memory.shares, near.apex, element.stencil[i], push);
      continue;
    }
    push(interface.apexes[near.apex], Vec3(element.scale * element.apex));
    for (int i = 0; i < element.count; ++i) {
      const Vec3 of_stencil = element.scale * element.stencil[i].push;
      for_each_node(interface, element.stencil[i], [&](Index node, double weight, double) { push(node, Vec3(-weight * of_stencil)); });
    }
  }
  if (!(interface.friction.coefficient > 0)) return;
  for (const Near& near : memory.near)
    if (near.friction->acts) rub(near.friction->touch, near.friction->force);
}

template <class Push, class Rub>
void visit_forces(const EdgeContact&, const EdgeMemory& memory, Push&& push, Rub&& rub) {
  for (const Crossing& crossing : memory.crossings) {
    if (!crossing.closed) continue;
    for (std::size_t j = 0; j < 4; ++j) push(crossing.node[j], Vec3(crossing.weight[j] * crossing.push));
    if (crossing.friction->acts) rub(crossing.friction->touch, crossing.friction->force);
  }
}

template <class Contact, class Remembered>
void add_all(const Contact& contact, const Remembered& memory, Vectors& force, Vectors& moment) {
  visit_forces(
      contact, memory, [&](Index node, const Vec3& push) { force.col(node) += push; },
      [&](const Touch& touch, const Vec3& friction) { add_friction(touch, friction, contact.rotation_of_node, force, moment); });
}

template <class Contact, class Remembered>
void list_all(const Contact& contact, const Remembered& memory, std::vector<NodeForce>& forces) {
  visit_forces(
      contact, memory, [&](Index node, const Vec3& push) { forces.push_back({node, push, Vec3::Zero()}); },
      [&](const Touch& touch, const Vec3& friction) {
        const FrictionShares shares = share_friction(touch, friction);
        for (int i = 0; i < shares.count; ++i) forces.push_back({shares.node[i], Vec3::Zero(), shares.force[i]});
      });
}

}  // namespace

void add_forces(const Interface& interface, const Memory& memory, Vectors& force, Vectors& moment) {
  add_all(interface, memory, force, moment);
  visit_forces(
      memory.shape_points, [&](Index node, const Vec3& push) { force.col(node) += push; },
      [&](const Touch& touch, const Vec3& friction) { add_friction(touch, friction, interface.rotation_of_node, force, moment); });
}
void add_forces(const EdgeContact& contact, const EdgeMemory& memory, Vectors& force, Vectors& moment) {
  add_all(contact, memory, force, moment);
}

void list_forces(const Interface& interface, const Memory& memory, std::vector<NodeForce>& forces) {
  list_all(interface, memory, forces);
  for (const ShapePoint& point : memory.shape_points)
    for (std::size_t j = 0; point.closed && point.kind != NearKind::shape && j + 4 < static_cast<std::size_t>(point.nodes); ++j)
      forces.push_back({point.node[j], point.weight[j] * point.pressed * point.normal, point.weight[j] * point.friction});
}
void list_forces(const EdgeContact& contact, const EdgeMemory& memory, std::vector<NodeForce>& forces) {
  list_all(contact, memory, forces);
}

}  // namespace nereid::contact
