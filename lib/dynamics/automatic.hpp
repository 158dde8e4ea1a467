#pragma once
// Adding an automatic contact to a model: the skins of many bodies, each over every other, and over itself.

#include <string>
#include <utility>
#include <vector>

#include "dynamics/connect.hpp"

namespace nereid::dynamics {

/// A body of an automatic contact.
struct TouchingBody {
  std::string name;          ///< its skin is the surface `name`.skin
  bool touches_itself = true;
};

/// Pairs of bodies that an automatic contact leaves to others.
using PairsApart = std::vector<std::pair<std::string, std::string>>;

/// Whether two bodies are one of these pairs, in either order.
bool are_apart(const PairsApart&, const std::string& one, const std::string& other);

/// Adds an automatic contact between bodies, which finds the pairs that touch by itself.
///
/// options  without passes, heights, areas and damping: each pair has two passes, at half the thickness of plates
/// start    as in connect()
/// returns  the interface `name`, then `name`_edges where there are ridges or rims
/// Needs    a model after finalize(), with its symmetry planes
std::vector<Connected> connect_automatic(Model&, const std::string& name, const std::vector<TouchingBody>&,
                                         const PairsApart& apart, const InterfaceOptions& options, const Vectors* start = nullptr);

}  // namespace nereid::dynamics
