#include "contact/multiplier/predict.hpp"

namespace nereid::contact {

namespace {

/// per_time  [1/s] of this step and the next one together
NEREID_HOT void predict_positions(Index node, double per_time, const Motion& m, Multipliers& all) {
  const Vec3 way = m.next * all.velocity.col(node);
  all.ahead.col(node) = m.x.col(node) + way;
  all.way.col(node) = per_time * (m.dt * m.v.col(node) + way);
}

}  // namespace

void predict_positions(const Subset& nodes, const Motion& m, Multipliers& all) {
  const double per_time = 1 / (m.dt + m.next);
  for (const Index node : nodes) predict_positions(node, per_time, m, all);
}

void look_ahead(const Subset& nodes, const Motion& m, Multipliers& all) {
  const double h = 0.5 * (m.dt + m.next), per_time = 1 / (m.dt + m.next);
  for (const Index node : nodes) {
    all.shared(node) = all.rubbed(node) = 0;
    all.mobility(node) = 1 / m.mass(node);
    Vec3 change = h * all.mobility(node) * m.force.col(node);
    if (m.allowed[node]) change = *m.allowed[node] * change;
    all.velocity.col(node) = m.v.col(node) + change;
    predict_positions(node, per_time, m, all);
    const Index turns = m.rotation_of_node[node];
    if (turns < 0) continue;
    Vec3 turn = h / m.inertia(turns) * m.moment.col(turns);
    if (m.allowed_rotation[turns]) turn = *m.allowed_rotation[turns] * turn;
    all.spin.col(turns) = m.omega.col(turns) + turn;
  }
}

}  // namespace nereid::contact
