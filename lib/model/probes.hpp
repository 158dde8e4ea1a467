#pragma once
// What probes can measure, and how: from the words of a scene to functions of a view.

#include "dynamics/probe.hpp"
#include "model/fault.hpp"
#include "model/scene.hpp"

namespace nereid::model {

/// Of what something is measured: `any_contact` of automatic ones too, which have both sides in one.
enum class Of { nodes, body, contact, any_contact, source, section, surface };

/// How it is measured: a vector or a number of a node set, a number of a node set along or about an axis, a mean over time of a node set,
/// a number of the passes of a contact. Numbers of bodies are fields of their elements with the same name, forces those of their source.
using Measurement = std::variant<std::monostate, Vec3 (*)(const dynamics::View&, const Subset& nodes),
                                 double (*)(const dynamics::View&, const Subset& nodes),
                                 double (*)(const dynamics::View&, const Subset& nodes, int axis),
                                 Vec3 (*)(const dynamics::View&, const Subset& nodes, dynamics::Kept&),
                                 Vec3 (*)(const dynamics::View&, const std::vector<std::size_t>& passes),
                                 double (*)(const dynamics::View&, const std::vector<std::size_t>& passes)>;

/// What a probe can measure.
struct Measurable {
  std::string name, unit;                    ///< SI
  Of of;
  std::vector<std::string> components = {};  ///< the first one unless the probe says; empty: it has none
  bool required = false;                     ///< the probe must say which component
  Measurement measurement = {};
};

/// All that probes can measure: quantities of motion, of force and contact, of stress, and the internal variables of all laws.
const std::vector<Measurable>& measurables();

/// The one of that name, or null.
const Measurable* find_measurable(const std::string& quantity);

/// Whether a quantity of elements has a value along a direction: a tensor.
bool is_tensor(const Measurable&);

/// The probes of a scene as a run samples them. Node sets, bodies, contacts and sources of these names must exist.
///
/// Faults: quantities and components that there are not, variables that a body's material does not have, the normal of
/// what is no plane, places beside the body, elements that there are not. After a fault the probe measures nothing.
///
/// remarks  of each probe at a place, which element it measures: a line is added
std::vector<dynamics::Probe> make_probes(const Scene&, const dynamics::Model&, const dynamics::State& at_start, Faults&,
                                         std::vector<std::string>& remarks);

}  // namespace nereid::model
