#pragma once
// Flat bodies of plates, in the plane z = 0.

#include <string>

#include "mesh/cylinder.hpp"

namespace nereid::mesh {

/// A round plate about the origin, with the O-grid of a cylinder's end.
struct Disc {
  double radius;  ///< [m]
  Revolution turn;
  int cells_core, cells_ring;
};

/// A sector of a round plate, or of a ring where inner_radius > 0, with the grid of a wedge's end.
struct WedgeDisc {
  double radius;  ///< [m]
  double angle;   ///< [rad] as of Wedge
  int cells_around, cells_radial;
  double inner_radius = 0;  ///< [m]
};

/// How the quadrilaterals of a sheet are cut in two.
enum class Cuts {
  columns,  ///< alternately from column to column along x: six triangles meet at each inner node, masses are even
  crossed   ///< as on a chess board: symmetric about both middles if cells are even; four or eight triangles meet
};

/// A rectangle, x from 0 to length and y from 0 to width.
struct Sheet {
  double length, width;  ///< [m]
  int cells_along, cells_across;
  Cuts cuts = Cuts::columns;
};

/// Triangles, region `name`, normals along +z. Surfaces `name.top` (normals along +z) and `name.bottom`; node sets
/// `name` (all), `name.rim`, `name.centre` (the node at the origin) and, where turn is quarter, `name.x_plane`,
/// `name.y_plane`. Its area is that of the polygon whose corners lie on the circle.
Mesh disc(const std::string& name, const Disc&);

/// The same of a sector: node sets `name`, `name.rim`, `name.first_plane`, `name.second_plane` and `name.centre`, or
/// `name.inner_rim` where there is a hole.
Mesh wedge_disc(const std::string& name, const WedgeDisc&);

/// Triangles, region `name`, normals along +z. Surfaces `name.top`, `name.bottom`; node sets `name` (all),
/// `name.x_low`, `name.x_high`, `name.y_low`, `name.y_high`. The first side of each triangle lies along x.
Mesh sheet(const std::string& name, const Sheet&);

}  // namespace nereid::mesh
