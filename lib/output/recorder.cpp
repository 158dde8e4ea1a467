#include "output/recorder.hpp"

#include "dynamics/measure.hpp"
#include "model/usual_frames.hpp"

namespace nereid::output {

Precision output_precision(const model::Recording& recording) {
  return recording.full_precision ? Precision::full : Precision::single;
}

FrameFields frame_fields(const model::Recording& recording) {
  return recording.all_fields ? FrameFields::all : FrameFields::usual;
}

std::vector<Column> columns_of(const std::vector<dynamics::Probe>& probes, const std::vector<dynamics::Probe>& ledger) {
  std::vector<Column> all;
  for (const auto* list : {&probes, &ledger})
    for (const dynamics::Probe& probe : *list)
      if (!probe.name.empty()) all.push_back({probe.name, probe.unit, probe.is_mean});
  return all;
}

std::vector<double> row_of(const dynamics::View& view, const std::vector<dynamics::Probe>& probes,
                           const std::vector<dynamics::Probe>& ledger) {
  std::vector<double> row;
  for (std::size_t p = 0; p < probes.size(); ++p)
    if (!probes[p].name.empty()) row.push_back(view.now.probes[p].last);
  dynamics::Kept none;
  for (const dynamics::Probe& probe : ledger) row.push_back(probe.value(view, none));
  return row;
}

Recorder::Recorder(const model::Simulation& simulation, const std::filesystem::path& out, bool quiet)
    : simulation_(simulation),
      probes_(simulation.probes),
      ledger_(dynamics::ledger_probes(simulation.model)),
      fields_(frame_fields(simulation.recording)),
      progress_(simulation.state.t, simulation.time.end, quiet),
      history_(out / "history.csv", columns_of(probes_, ledger_)),
      body_(out, "body", GridKind::volume, output_precision(simulation.recording)),
      contact_(out, "contact", GridKind::surface, output_precision(simulation.recording)),
      walls_(out, "walls", GridKind::surface, output_precision(simulation.recording)) {}

Recorder::Recorder(const model::Simulation& simulation, const std::filesystem::path& out, bool quiet, const RecorderMark& mark)
    : simulation_(simulation),
      probes_(simulation.probes),
      ledger_(dynamics::ledger_probes(simulation.model)),
      fields_(frame_fields(simulation.recording)),
      progress_(simulation.state.t, simulation.time.end, quiet),
      history_(out / "history.csv", columns_of(probes_, ledger_), mark.history),
      body_(out, "body", GridKind::volume, output_precision(simulation.recording), mark.body),
      contact_(out, "contact", GridKind::surface, output_precision(simulation.recording), mark.contact),
      walls_(out, "walls", GridKind::surface, output_precision(simulation.recording), mark.walls),
      frame_(mark.frame) {}

RecorderMark Recorder::mark() {
  writer_.wait();
  history_.flush();
  return {history_.bytes(), frame_, body_.mark(), contact_.mark(), walls_.mark()};
}

void Recorder::operator()(const dynamics::View& view) {
  writer_.look();
  progress_.show(view.now.t, view.now.step, view.now.dt);
  if (!view.ledger_is_current) return;
  history_.add(view.now.t, row_of(view, probes_, ledger_));
  const auto due = static_cast<std::int64_t>(view.now.t / model::frames_every(simulation_) + 1e-9);
  if (view.now.step > 0 && due <= frame_) return;
  frame_ = due;
  add_frame(view, view.now.step == 0);
}

void Recorder::finish(const dynamics::View& view) {
  progress_.done();
  add_frame(view);
  writer_.wait();
}

void Recorder::add_frame(const dynamics::View& view, bool with_walls) {
  writer_.wait();  // so that no two frames are in memory
  writer_.begin([this, with_walls, body = body_grid(view, fields_), contact = contact_grid(view, fields_),
                 walls = with_walls ? walls_grid(view) : Grid()] {
    body_.add(body);
    contact_.add(contact);
    if (with_walls) walls_.add(walls);
  });
  history_.flush();
}

}  // namespace nereid::output
