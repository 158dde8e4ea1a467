#include "audit/audit.hpp"

#include <cmath>

#include "base/parallel.hpp"

namespace nereid::audit {

namespace {

constexpr double touching = 1e-6;  // [-] of an element: what is less deep touches
constexpr Index length = 256;      // points, faces or edges in a range, fixed so that no number of threads changes a bit
constexpr int most_crossings = 16;  // of one edge with one surface; what lies beyond them is not looked at
constexpr int looks_along = 8;     // of an edge at a shape
constexpr double along[] = {0.5, 0.25, 0.75};  // [-] where the inside part of an edge is looked at

/// Takes over what another look found.
void join(Found& found, const Found& other) {
  if (in_elements(other.worst) > in_elements(found.worst)) found.worst = other.worst;
  if (surely_in_elements(other.surest) > surely_in_elements(found.surest)) found.surest = other.surest;
  found.deepest = std::max(found.deepest, other.deepest);
}

/// Runs body(i, found) for i < count in ranges, and joins what they find in their order.
template <class Body>
void in_ranges(Index count, std::vector<Found>& parts, Found& found, Body&& body) {
  const Index ranges = (count + length - 1) / length;
  parallel_for(ranges, 2, [&](Index r) {
    parts[r] = found;
    for (Index i = r * length; i < std::min(count, (r + 1) * length); ++i) body(i, parts[r]);
  });
  for (Index r = 0; r < ranges; ++r) join(found, parts[r]);
}

bool all(Index) { return true; }  // triangles

/// A surface with where it stands.
struct Side {
  const Surface& surface;
  const Placed& placed;
};

Vec3 point(const Side& side, Index p) { return side.placed.at.col(p); }

/// A point, moved off planes of symmetry into its body: on the plane there is neither inside nor outside.
Vec3 off_planes(const Side& side, Index p) {
  return point(side, p) + touching * side.surface.size(p) * side.surface.inward.col(p);
}

/// A depth below which a point of an element of that size, in that surface, is of no interest any more.
double enough(const Found& found, double size, const Surface& other) {
  const double least = std::min(size, other.smallest);
  return std::max(touching * least, std::min(found.deepest, surely_in_elements(found.surest) * least));
}

void note(Found& found, const Depth& at) {
  if (!(at.depth > touching * at.size) || !std::isfinite(at.depth)) return;
  if (in_elements(at) > in_elements(found.worst)) found.worst = at;
  if (surely_in_elements(at) > surely_in_elements(found.surest)) found.surest = at;
  found.deepest = std::max(found.deepest, at.depth);
}

/// What a point of a body has of its own.
struct Own {
  double size, open;  // [m] of its element
  Index region;
};

/// Notes the depth of a point that is inside a skin.
void note_inside(const Side& skin, const Vec3& p, const Own& own, Found& found) {
  const double size = own.size;
  if (skin.surface.round) {
    const double depth = -geometry::over_round(skin.surface.round->shape, skin.placed.round, p).distance;
    return note(found, {depth, std::min(size, skin.surface.smallest), own.open, p, {own.region, skin.surface.face_region[0]}});
  }
  const auto counts = [&](Index t) { return skin.surface.cut[skin.surface.face_of[t]] == 0; };
  const Nearest at = nearest(skin.surface, skin.placed, p, enough(found, size, skin.surface), counts);
  if (at.triangle < 0) return;
  const Index face = skin.surface.face_of[at.triangle];
  note(found, {at.distance, std::min(size, skin.surface.face_size(face)), own.open + skin.placed.open(face), p,
               {own.region, skin.surface.face_region[face]}});
}

/// A point, moved onto the exact shape of its body where there is one.
Vec3 on_shape(const Side& side, const Vec3& p) {
  if (!side.surface.round) return p;
  const geometry::OverRound over = geometry::over_round(side.surface.round->shape, side.placed.round, p);
  return p - over.distance * over.normal;
}

bool is_inside(const Side& skin, const Vec3& p) {
  if (skin.surface.round) return geometry::over_round(skin.surface.round->shape, skin.placed.round, p).distance < 0;
  return holds(skin.placed.boxes[0], p) && winding(skin.surface, skin.placed, p) > 0;
}

/// Where an edge crosses a surface, in order; the ends of the edge are the first and the last.
struct Cuts {
  std::array<double, most_crossings + 2> s{};
  int count = 0;
};

Cuts cuts(const Side& other, const Vec3& a, const Vec3& b) {
  Cuts found;
  found.s[found.count++] = 0;
  crossings(other.surface, other.placed, a, b, -1, all, [&](Index, double s) {
    if (found.count <= most_crossings) found.s[found.count++] = std::clamp(s, 0.0, 1.0);
  });
  std::sort(found.s.begin(), found.s.begin() + found.count);
  found.s[found.count++] = 1;
  return found;
}

Box box_of(const Vec3& a, const Vec3& b) { return {a.cwiseMin(b), a.cwiseMax(b)}; }

/// The outward unit normal of a face; zero of one without an area.
Vec3 outward(const Side& side, Index face) {
  const Vec3 n = face_normal(side.surface, side.placed, face);
  const double size = n.norm();
  return size > 0 ? Vec3(n / size) : Vec3(Vec3::Zero());
}

/// What a face that has the edge leaves open. [m]
double open_along(const Side& side, Index edge) { return side.placed.open(side.surface.face_of[side.surface.owner[edge]]); }

/// Points, faces and edges of a surface that are inside a skin.
void look_inside(const Side& one, const Side& skin, std::vector<char>& inside, std::vector<Found>& parts, Found& found) {
  const Surface& surface = one.surface;
  const auto points = static_cast<Index>(surface.nodes.size());
  const Box& box = skin.placed.boxes[0];
  in_ranges(points, parts, found, [&](Index p, Found& here) {
    const Vec3 at = off_planes(one, p);
    inside[p] = is_inside(skin, at);
    if (inside[p]) note_inside(skin, at, {surface.size(p), one.placed.open_at(p), surface.region[p]}, here);
  });
  in_ranges(static_cast<Index>(surface.faces.cols()), parts, found, [&](Index f, Found& here) {
    if (surface.cut[f] != 0) return;
    const Vec3 at = surface.faces(3, f) < 0 ? Vec3((point(one, surface.faces(0, f)) + point(one, surface.faces(1, f)) +
                                                    point(one, surface.faces(2, f))) / 3)
                                            : point(one, points + f);
    const double size = surface.face_size(f);
    const Own own{size, one.placed.open(f), surface.face_region[f]};
    if (is_inside(skin, at)) note_inside(skin, at, own, here);
    if (!surface.closed || (surface.plates > 0 && f >= surface.plates)) return;  // both sides of a plate have the same middle
    const Vec3 behind = at - 0.5 * size * outward(one, f);  // also of bodies whose skins are the same
    if (is_inside(skin, behind)) note_inside(skin, behind, own, here);
  });
  in_ranges(static_cast<Index>(surface.edges.cols()), parts, found, [&](Index e, Found& here) {
    const Index first = surface.edges(0, e), last = surface.edges(1, e);
    const Vec3 a = off_planes(one, first), b = off_planes(one, last);
    if (!meet(box_of(a, b), box)) return;
    if (skin.surface.round || surface.round) {
      const Own own{std::min(surface.size(first), surface.size(last)), open_along(one, e), surface.region[first]};
      for (int i = 1; i < looks_along; ++i)
        if (const Vec3 p = on_shape(one, a + (b - a) * i / looks_along); is_inside(skin, p)) note_inside(skin, p, own, here);
      return;
    }
    const Cuts at = cuts(skin, a, b);
    if (at.count == 2 && !inside[first]) return;
    const Own own{std::min(surface.size(first), surface.size(last)), open_along(one, e), surface.region[first]};
    for (int i = 0; i + 1 < at.count; ++i) {
      if (at.s[i + 1] - at.s[i] < touching) continue;
      const auto between = [&](double part) { return Vec3(a + (at.s[i] + part * (at.s[i + 1] - at.s[i])) * (b - a)); };
      if (at.count > 2 && !is_inside(skin, between(0.5))) continue;
      for (const double part : along) note_inside(skin, between(part), own, here);
    }
  });
}

double distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double square = (b - a).squaredNorm();
  const double s = square > 0 ? std::clamp((p - a).dot(b - a) / square, 0.0, 1.0) : 0.0;
  return (p - a - s * (b - a)).norm();
}

/// How far a point of a sheet is from its rim; infinite if it has none. [m]
///
/// first, last  the points of an edge that is left out: one of the rim, on which the point lies itself
double from_rim(const Side& sheet, const Vec3& p, Index first = -1, Index last = -1) {
  double least = std::numeric_limits<double>::infinity();
  for (Index e = 0; e < sheet.surface.rim_edges.cols(); ++e) {
    const Index a = sheet.surface.rim_edges(0, e), b = sheet.surface.rim_edges(1, e);
    if ((a == first && b == last) || (a == last && b == first)) continue;
    least = std::min(least, distance(p, point(sheet, a), point(sheet, b)));
  }
  return least;
}

/// Groups the points that stand over or under a sheet by the side on which they do, as edges connect them; `reach` becomes how far
/// the farthest of its group is from the sheet. A point past the rim, or over it, stands for itself.
void find_reach(const Side& one, const Side& sheet, std::vector<char>& where, std::vector<Index>& group, std::vector<double>& reach) {
  enum : char { past, over, under };
  const auto points = static_cast<Index>(one.surface.nodes.size());
  parallel_for(points, length, [&](Index p) {
    group[p] = p;
    const Nearest at = nearest(sheet.surface, sheet.placed, point(one, p), 0, all);
    reach[p] = at.distance;
    where[p] = past;
    if (at.triangle < 0 || at.on_rim) return;
    where[p] = (point(one, p) - at.foot).dot(normal(sheet.surface, sheet.placed, at.triangle)) < 0 ? under : over;
  });
  const auto find = [&](Index p) {
    while (group[p] != p) p = group[p] = group[group[p]];
    return p;
  };
  for (Index e = 0; e < one.surface.edges.cols(); ++e) {
    const Index a = one.surface.edges(0, e), b = one.surface.edges(1, e);
    if (where[a] == past || where[a] != where[b]) continue;
    const Index first = find(a), second = find(b);
    group[std::max(first, second)] = std::min(first, second);
  }
  for (Index p = points - 1; p >= 0; --p) group[p] = find(p);
  for (Index p = 0; p < points; ++p) reach[group[p]] = std::max(reach[group[p]], reach[p]);
  for (Index p = 0; p < points; ++p) reach[p] = reach[group[p]];
}

bool crosses(const Side& one, const Side& sheet) {
  const Box& box = sheet.placed.boxes[0];
  for (Index e = 0; e < one.surface.edges.cols(); ++e) {
    const Vec3 a = point(one, one.surface.edges(0, e)), b = point(one, one.surface.edges(1, e));
    bool found = false;
    if (meet(box_of(a, b), box)) crossings(sheet.surface, sheet.placed, a, b, -1, all, [&](Index, double) { found = true; });
    if (found) return true;
  }
  return false;
}

/// How far an edge whose ends stand on one side of a sheet is on the other side in between, where a crease of the sheet cuts it; zero
/// where it is not. [m]
double behind_crease(const Side& sheet, const Vec3& a, const Vec3& b) {
  const Cuts at = cuts(sheet, a, b);
  const auto over = [&](const Vec3& p, double& distance) {
    const Nearest found = nearest(sheet.surface, sheet.placed, p, 0, all);
    distance = found.distance;
    return found.triangle >= 0 && (p - found.foot).dot(normal(sheet.surface, sheet.placed, found.triangle)) >= 0;
  };
  double away = 0, most = 0;
  const bool side = over(a, away);
  for (int i = 1; i + 2 < at.count; ++i) {
    if (at.s[i + 1] - at.s[i] < touching) continue;
    for (const double part : along)
      if (over(a + (at.s[i] + part * (at.s[i + 1] - at.s[i])) * (b - a), away) != side) most = std::max(most, away);
  }
  return most;
}

/// Edges of a surface that go through a sheet: how far it is to where they do no longer, along the body and out of half the thickness of
/// the sheet, or across the sheet. Where both ends stand on one side it is a crease of the sheet that has come in.
void look_through(const Side& one, const Side& sheet, std::vector<char>& where, std::vector<Index>& group, std::vector<double>& reach,
                  std::vector<Found>& parts, Found& found) {
  if (!crosses(one, sheet)) return;
  find_reach(one, sheet, where, group, reach);
  const Surface& surface = one.surface;
  const Box& box = sheet.placed.boxes[0];
  in_ranges(static_cast<Index>(surface.edges.cols()), parts, found, [&](Index e, Found& here) {
    const Index first = surface.edges(0, e), last = surface.edges(1, e);
    const Vec3 a = point(one, first), b = point(one, last);
    if (!meet(box_of(a, b), box)) return;
    const double size = std::min(surface.size(first), surface.size(last)), open = open_along(one, e);
    const bool one_side = group[first] == group[last];
    double crease = -1;  // not known
    crossings(sheet.surface, sheet.placed, a, b, -1, all, [&](Index t, double s) {
      const Index face = sheet.surface.face_of[t];
      const bool at_an_end = s < touching || s > 1 - touching;
      if (at_an_end && one_side) return;  // it touches from one side
      const Vec3 at = a + s * (b - a);
      if (one_side && crease < 0) crease = behind_crease(sheet, a, b);
      const double way = crease > 0 ? crease : std::min(reach[first], reach[last]);
      double depth = way + sheet.placed.half(sheet.surface.faces(0, face));
      if (depth > enough(here, size, sheet.surface)) depth = std::min(depth, from_rim(sheet, at));
      note(here, {depth, std::min(size, sheet.surface.face_size(face)), open + sheet.placed.open(face), at,
                  {surface.region[first], sheet.surface.face_region[face]}});
    });
  });
}

Side side(const Workspace& work, Index surface) { return {work.surfaces.list[surface], work.placed[surface]}; }

/// What others meet of a surface: the shell of a sheet, where there is one.
Side outside(const Workspace& work, Index surface) {
  const bool has_shell = work.surfaces.shells[surface].plates > 0;
  return has_shell ? Side{work.surfaces.shells[surface], work.shells[surface]} : side(work, surface);
}

bool shares_a_point(const Surface& surface, Index triangle, Index a, Index b) {
  const auto at = surface.faces.col(surface.face_of[triangle]);
  return (at.array() == a || at.array() == b).any();
}

bool apart(const Placed& a, const Placed& b) {
  return !a.finite || !b.finite || a.boxes.empty() || b.boxes.empty() || !meet(a.boxes[0], b.boxes[0]);
}

/// Notes in the memory what was found of two surfaces, or that they are apart.
void remember(std::array<Index, 2> pair, const Found& found, double allowed, double t, Memory& memory) {
  auto at = std::lower_bound(memory.overlaps.begin(), memory.overlaps.end(), pair,
                             [](const Overlap& one, const std::array<Index, 2>& other) { return one.surface < other; });
  const bool overlaps = found.worst.depth > 0, known = at != memory.overlaps.end() && at->surface == pair;
  if (!known && !overlaps) return;
  if (!known) at = memory.overlaps.insert(at, Overlap{});
  Overlap& overlap = *at;
  overlap.surface = pair, overlap.allowed = allowed;
  if (!overlaps) overlap.accepted = 0;
  if (memory.looks == 0) overlap.at_start = overlap.accepted = found.deepest;
  overlap.deepest = std::max(overlap.deepest, found.deepest);
  const double start = std::max(overlap.accepted, allowed);
  const double grown = (found.worst.depth - start) / found.worst.size;
  const double sure = (found.surest.depth - unsure(found.surest) - start) / found.surest.size;
  if (overlaps && (overlap.worst.depth == 0 || grown > overlap.grown)) {
    overlap.grown = std::max(grown, 0.0);
    overlap.worst = found.worst;
    overlap.time = t;
  }
  if (overlaps && sure > overlap.sure) overlap.sure = sure, overlap.surest = found.surest, overlap.sure_time = t;
}

}  // namespace

Workspace make_workspace(Surfaces surfaces) {
  Workspace work;
  work.surfaces = std::move(surfaces);
  std::size_t points = 0;
  Index most = 0;
  const auto count = [&](const Surface& surface) {
    points = std::max(points, surface.nodes.size());
    most = std::max({most, static_cast<Index>(surface.nodes.size()), static_cast<Index>(surface.faces.cols()),
                     static_cast<Index>(surface.edges.cols())});
    return make_placed(surface);
  };
  for (const Surface& surface : work.surfaces.list) work.placed.push_back(count(surface));
  for (const Surface& shell : work.surfaces.shells) work.shells.push_back(count(shell));
  work.inside.assign(points, 0);
  work.group.assign(points, 0);
  work.reach.assign(points, 0);
  work.parts.resize(most / length + 1);
  return work;
}

void place(const Vectors& x, Workspace& work) {
  for (std::size_t s = 0; s < work.placed.size(); ++s) {
    place(work.surfaces.list[s], x, work.placed[s], work.half_growth);
    place(work.surfaces.shells[s], x, work.shells[s], work.half_growth);
  }
}

Found overlap(Workspace& work, Index first, Index second) {
  Found found;
  const Side one = outside(work, first), other = outside(work, second), mid_one = side(work, first), mid_other = side(work, second);
  if (apart(one.placed, other.placed)) return found;
  if (other.surface.closed) look_inside(one, other, work.inside, work.parts, found);
  if (one.surface.closed) look_inside(other, one, work.inside, work.parts, found);
  const auto is_sheet = [](const Side& side) { return !side.surface.closed && !side.surface.round; };
  if (is_sheet(mid_other)) look_through(one, mid_other, work.inside, work.group, work.reach, work.parts, found);
  if (is_sheet(mid_one)) look_through(other, mid_one, work.inside, work.group, work.reach, work.parts, found);
  return found;
}

Found overlap_with_itself(Workspace& work, Index index) {
  Found found;
  const Side one = side(work, index);
  const Surface& surface = one.surface;
  if (!one.placed.finite || one.placed.boxes.empty()) return found;
  in_ranges(static_cast<Index>(surface.edges.cols()), work.parts, found, [&](Index e, Found& here) {
    const Index first = surface.edges(0, e), last = surface.edges(1, e);
    const Vec3 a = point(one, first), b = point(one, last);
    const double size = std::min(surface.size(first), surface.size(last));
    const auto counts = [&](Index t) { return surface.cut[surface.face_of[t]] == 0 && !shares_a_point(surface, t, first, last); };
    crossings(surface, one.placed, a, b, surface.owner[e], counts, [&](Index t, double s) {
      const Vec3 n = normal(surface, one.placed, t).normalized(), at = a + s * (b - a);
      const double up_a = (a - at).dot(n), up_b = (b - at).dot(n);
      double depth = std::min(std::abs(up_a), std::abs(up_b));
      if (!(depth > touching * size)) return;  // an end on the face: elements have slid within a plane, or it touches
      if (surface.closed) {  // the end behind the face, and how far it is from faces that look at it
        const Vec3 end = up_a < 0 ? a : b, out = one.placed.normals.col(up_a < 0 ? first : last);
        const auto looks_at_it = [&](Index other) {
          return counts(other) && normal(surface, one.placed, other).dot(out) < 0;
        };
        const double behind = std::abs(std::min(up_a, up_b));  // or it is the other that has come out: no more than that counts
        depth = std::min({depth, behind, nearest(surface, one.placed, end, 0, looks_at_it).distance});
      } else {
        depth = std::min(depth, from_rim(one, at, first, last));
      }
      const Index face = surface.face_of[t];
      const double open = one.placed.open(face) + open_along(one, e);
      note(here, {depth, std::min(size, surface.face_size(face)), open, at, {surface.region[first], surface.face_region[face]}});
    });
  });
  return found;
}

void look(const Vectors& x, double t, bool also_itself, Workspace& work, Memory& memory) {
  const auto count = static_cast<Index>(work.surfaces.list.size());
  place(x, work);
  for (Index one = 0; one < count; ++one) {
    if (!work.placed[one].finite) continue;
    if (also_itself) remember({one, one}, overlap_with_itself(work, one), 0, t, memory);
    for (Index other = one + 1; other < count; ++other) {
      if (work.surfaces.list[one].piece == work.surfaces.list[other].piece || !work.placed[other].finite) continue;
      const auto allowed = work.allowed.find({one, other});
      remember({one, other}, overlap(work, one, other), allowed == work.allowed.end() ? 0 : allowed->second, t, memory);
    }
  }
  ++memory.looks;
}

const Overlap* worst(const Memory& memory) {
  const Overlap* most = nullptr;
  for (const Overlap& overlap : memory.overlaps)
    if (most == nullptr || overlap.grown > most->grown) most = &overlap;
  return most;
}

const Overlap* surest(const Memory& memory) {
  const Overlap* most = nullptr;
  for (const Overlap& overlap : memory.overlaps)
    if (most == nullptr || overlap.sure > most->sure) most = &overlap;
  return most;
}

}  // namespace nereid::audit
