// The way of a simulation through time, step by step.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "build/simulation.hpp"
#include "march/erosions.hpp"
#include "march/observer.hpp"
#include "march/run_books.hpp"
#include "march/stage_run.hpp"
#include "march/step_count.hpp"

namespace carom {

/// Leads the state of a simulation through its stages. Marches know nothing of each other: there may be several, one
/// after the other and side by side, of one simulation or of several. Not movable, since parts refer to each other.
class March {
 public:
  /// The simulation outlives the march.
  explicit March(const Simulation& simulation);
  March(const March&) = delete;
  March& operator=(const March&) = delete;

  /// From start() on it sees what becomes of the run, after those that have been added before; it outlives the march.
  void add(Observer& observer) { observers_.push_back(&observer); }

  /// Starts the first scheme and shows the initial state. Throws RunError when there is no way to start.
  void start();
  /// Makes one step that holds, shortened and made again as often as need be, in the next stage where one has ended.
  /// Precondition: started, not failed, and not at the end. Throws RunError when the run cannot go on, or lets
  /// has_failed tell so.
  void step();
  /// The march ends at this time, in steps as before. A fixed step has to lead there; others meet it to 2^-17 of the
  /// usual step. Throws std::invalid_argument, which says why, where that cannot be. Precondition: started.
  void prolong(double end);
  /// The run ends here, before its end: for the observers.
  void leave();

  bool is_started() const { return books_.has_value(); }
  bool at_end() const;
  /// When.
  double end() const { return end_; }
  /// No further step can be made; message() says why.
  bool has_failed() const { return !message_.empty(); }
  const std::string& message() const { return message_; }

  /// Of the last step, or the initial state. Precondition: started. Valid until the next step.
  StepView view() const;
  /// Precondition of all of these: started.
  const Scheme& scheme() const { return stage_->scheme(); }
  const EnergyLedger& ledger() const { return books_->ledger(); }
  const RunMonitor& monitor() const { return books_->monitor(); }
  /// Largest strain so far of the rigid bodies that turn.
  double body_strain() const { return books_->body_strain(); }

  const State& state() const { return state_; }
  /// Gives away what holds q, v or a for those that go on looking at it, and goes on with a copy.
  std::vector<double> hand_over(std::vector<double> State::*values);
  /// On several ranks, gives all of the state to each. All ranks call it.
  void complete() { shared_.complete(); }
  /// On several ranks, gives all of the state to the first one, for as long as body() takes. All ranks call it.
  template <class Body>
  void with_all_of_it(const Body& body) {
    shared_.collect();
    body();
    shared_.release();
  }
  long long steps() const { return count_.steps(); }
  double dt_smallest() const { return count_.smallest(); }
  double dt_largest() const { return count_.largest(); }
  /// Changes of scheme and solver on the way, and why steps were cut or kept short.
  std::vector<std::string> log() const;

 private:
  template <class A>
  friend void fields(A& archive, March& x) {
    x.keep(archive);
  }
  void keep(Archive& archive);
  void keep_topology(Archive& archive);

  const Stage& stage() const { return stage_->stage(); }
  void begin_stage(std::size_t number);
  void book(const MadeStep& made);
  void erode();
  void show();

  const Simulation& s_;
  std::vector<Observer*> observers_;
  std::unique_ptr<StageRun> stage_;  ///< the present one; null before the start
  State state_, next_;
  SharedState shared_;
  std::optional<RunBooks> books_;     ///< none before the start
  std::optional<Erosions> erosions_;  ///< where cells may go
  double end_;
  StepCount count_;
  std::vector<std::string> log_;
  std::string message_;
};

}  // namespace carom
