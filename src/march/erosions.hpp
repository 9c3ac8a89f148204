// When cells go.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "build/simulation.hpp"
#include "model/topology.hpp"

namespace carom {

/// What has gone so far, for the log: one for each of Model::erosion.
struct ErodedSoFar {
  std::size_t cells = 0;
  double first = 0.0, last = 0.0;  ///< when
};
template <class A>
void fields(A& archive, ErodedSoFar& x) {
  archive("cells", x.cells);
  archive("first", x.first);
  archive("last", x.last);
}

/// Looks at the end of each step which cells go.
class Erosions {
 public:
  /// The simulation outlives the object.
  explicit Erosions(const Simulation& simulation);

  /// By solid cell, 0 of those that have gone once these go at the end of the step that has led to the state; empty
  /// when none goes.
  std::vector<std::uint8_t> next(const State& state) const;
  /// Takes note of them.
  void note(const State& state, const std::vector<std::uint8_t>& next);
  std::vector<std::string> log() const;

  const Topologies& topologies() const { return topologies_; }
  std::vector<ErodedSoFar>& so_far() { return so_far_; }

 private:
  /// What the cells have come to, by solid cell, where a criterion asks for it.
  struct Reached {
    std::vector<double> plastic_strain, damage;
  };
  std::vector<double> largest(const char* variable, std::optional<double> Erosion::*criterion,
                              const State& state) const;
  bool goes(const Erosion& erosion, Index cell, const State& state, const Reached& reached) const;

  const Simulation& s_;
  Topologies topologies_;
  std::vector<ErodedSoFar> so_far_;
};

}  // namespace carom
