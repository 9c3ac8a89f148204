#include "march/kept_state.hpp"

#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "solid/point_history.hpp"

namespace carom {

void keep_state(Archive& archive, const Solid& solid, State& state) {
  using Lay = std::vector<double> (*)(const Solid&, std::span<const double>);
  const auto laid = [&](const std::vector<double>& history, Lay lay) {
    try {
      return lay(solid, history);
    } catch (const std::invalid_argument& e) {
      throw ArchiveError(e.what());
    }
  };
  const auto placed = [&](const std::shared_ptr<const TangentPlace>& at, Lay lay) {
    return at ? std::make_shared<const TangentPlace>(TangentPlace{at->dt, at->u, laid(at->points, lay)}) : nullptr;
  };
  std::vector<double> own = std::move(state.points);
  const std::vector<double> sent = laid(own, history_by_cell);
  state.points = sent;
  std::vector<std::shared_ptr<const TangentPlace>> own_places, sent_places;
  for (StageMemory& stage : state.stages) {
    own_places.push_back(stage.grids_at);
    stage.grids_at = placed(stage.grids_at, history_by_cell);
    sent_places.push_back(stage.grids_at);
  }
  archive("state", state);
  // What has come back unchanged keeps its own order: it went out.
  state.points = state.points == sent ? std::move(own) : laid(state.points, history_of_lanes);
  for (std::size_t i = 0; i < state.stages.size(); ++i) {
    std::shared_ptr<const TangentPlace>& at = state.stages[i].grids_at;
    at = i < sent_places.size() && at == sent_places[i] ? own_places[i] : placed(at, history_of_lanes);
  }
}

}  // namespace carom
