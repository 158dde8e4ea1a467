#pragma once
// Which rigid bodies touch as the shapes that they are, and what they touch so.

#include <optional>

#include "dynamics/connect.hpp"

namespace nereid::dynamics {

/// The rigid body that has a surface, if it touches there as a shape; null if it has none, or the surface is not all of its round side.
const rigid::Body* round_body_of(const Model&, const mesh::Surface&);

/// What a contact between two surfaces has of shapes, if one of both is of such a body; nothing by a penalty, of ties, and where heights
/// of contact are not those of the plates.
///
/// between  what both surfaces have together
std::optional<contact::Shapes> shapes_of_pair(const Model&, const mesh::Surface& apexes, const mesh::Surface& base,
                                              const InterfaceOptions&, const contact::Between& between);

/// What an automatic contact has of shapes, between bodies whose skins these are. Pairs that touch so are taken out of Bodies::touch.
///
/// apexes  nodes of the contact, whose thickness may grow
contact::Shapes shapes_of_bodies(const Model&, const std::vector<const mesh::Surface*>& skins, const Subset& apexes,
                                 const InterfaceOptions&, contact::Bodies&);

}  // namespace nereid::dynamics
