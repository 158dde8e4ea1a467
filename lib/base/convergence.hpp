#pragma once
// How far a result is from what finer meshes would give: observed order, and Roache's index of grid convergence.

#include <vector>

namespace nereid {

/// A result on a mesh that is `refine` times as fine as that of the case, and what it cost.
struct Level {
  double refine = 1;   ///< [-]
  double value = 0;    ///< of the result
  double updates = 0;  ///< of elements
  double seconds = 0;
};

/// Error of the finest of some levels.
struct MeshError {
  double error;  ///< in the unit of the result; infinite with one level
  double order;  ///< p of f(h) = f0 + C h^p through the finest three; NaN where they show none
};

/// The error of the finest level by the finest three, whose ratios need not be equal.
///
///     1.25 |f2 - f1| / ((h2/h1)^p - 1),   p at most 3/2,   (f3 - f2)/(f2 - f1) = (h3^p - h2^p)/(h2^p - h1^p)
///
/// Where there is no p between 0.5 and 3, it is three times the spread of the three; of two levels it is 3 |f2 - f1| / (h2/h1 - 1), as of
/// an order of one (Roache 1994).
///
/// levels  by rising refine
MeshError mesh_error(const std::vector<Level>& levels);

/// Factors on counts of cells that rounding moves by no more than a fiftieth, rising: sixths from 1/6 to 64, or those that are given.
///
/// counts  of the case, above one
/// among   rising; empty: sixths
std::vector<double> even_factors(const std::vector<int>& counts, std::vector<double> among = {});

/// The first even factor that leaves a quarter of the cells in a direction, and at least two.
double first_factor(const std::vector<double>& even, const std::vector<int>& counts);

/// The next mesh on the way to a target, or 0 where even factors end: half as fine again until there are three, then as
/// fine as that order asks for, but no more than twice as fine.
///
/// target  in the unit of the result
double next_factor(const std::vector<double>& even, const std::vector<Level>& levels, double target);

/// How many updates a level would take, by the last two levels; with one level as in three dimensions and time.
double updates_at(const std::vector<Level>& levels, double refine);

}  // namespace nereid
