#pragma once
// All kinds of contact between bodies. A new kind is one line in each list.

#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "contact/data/workspace.hpp"

namespace nereid::contact {

/// Every kind of contact that the code supports.
using AnyContact = std::variant<Interface, EdgeContact>;
using AnyMemory = std::variant<Memory, EdgeMemory>;             ///< what each remembers
using AnyWorkspace = std::variant<Workspace, EdgeWorkspace>;    ///< what each works with

namespace detail {
template <class Kind, class... Kinds>
constexpr std::size_t place_of(const std::variant<Kinds...>*) {
  std::size_t place = 0;
  ((std::is_same_v<Kind, Kinds> ? true : (++place, false)) || ...);
  return place;
}
}  // namespace detail

/// What a kind remembers, and works with.
template <class Kind>
using MemoryOf = std::variant_alternative_t<detail::place_of<Kind>(static_cast<AnyContact*>(nullptr)), AnyMemory>;
template <class Kind>
using WorkspaceOf = std::variant_alternative_t<detail::place_of<Kind>(static_cast<AnyContact*>(nullptr)), AnyWorkspace>;

/// Calls visit(contact, memory), each of its own type.
template <class Any, class Visit>
decltype(auto) with_memory(const AnyContact& contact, Any& memory, Visit&& visit) {
  return std::visit([&](const auto& one) -> decltype(auto) { return visit(one, std::get<MemoryOf<std::decay_t<decltype(one)>>>(memory)); },
                    contact);
}

/// Calls visit(contact, memory, workspace).
template <class Visit>
decltype(auto) with_all(const AnyContact& contact, AnyMemory& memory, AnyWorkspace& workspace, Visit&& visit) {
  return with_memory(contact, memory, [&](const auto& one, auto& remembered) -> decltype(auto) {
    return visit(one, remembered, std::get<WorkspaceOf<std::decay_t<decltype(one)>>>(workspace));
  });
}

/// What all kinds have.
inline const Sides& sides(const AnyContact& contact) {
  return std::visit([](const auto& one) -> const Sides& { return one; }, contact);
}
inline const SidesMemory& sides(const AnyMemory& memory) {
  return std::visit([](const auto& one) -> const SidesMemory& { return one; }, memory);
}
inline AnyWorkspace make_workspace(const AnyContact& contact) {
  return std::visit([](const auto& one) { return AnyWorkspace(WorkspaceOf<std::decay_t<decltype(one)>>(one)); }, contact);
}

/// Apexes over a base surface, or null.
inline const Interface* interface_of(const AnyContact& contact) { return std::get_if<Interface>(&contact); }

inline bool follows(const AnyContact& contact) {
  return std::visit([](const auto& one) { return follows(one); }, contact);
}
inline double side_of(const AnyContact& contact) {
  return std::visit([](const auto& one) { return side_of(one); }, contact);
}

/// Whether a contact acts by multipliers, and whether it is a tie that does.
inline bool by_multipliers(const EdgeContact&) { return true; }
inline bool tied_by_multipliers(const EdgeContact&) { return false; }
inline bool by_multipliers(const AnyContact& contact) {
  return std::visit([](const auto& one) { return by_multipliers(one); }, contact);
}
inline bool tied_by_multipliers(const AnyContact& contact) {
  return std::visit([](const auto& one) { return tied_by_multipliers(one); }, contact);
}

/// How many are passes of apexes, and not edges.
inline std::size_t passes_of(const std::vector<AnyContact>& all) {
  std::size_t count = 0;
  for (const AnyContact& one : all) count += std::holds_alternative<Interface>(one);
  return count;
}

}  // namespace nereid::contact
