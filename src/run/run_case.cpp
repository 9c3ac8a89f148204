#include "run/run_case.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <new>
#include <numeric>
#include <utility>

#include "base/errors.hpp"
#include "base/terminal_text.hpp"
#include "base/version.hpp"
#include "casefile/read_case.hpp"
#include "casefile/resolved_case.hpp"
#include "math/vec3.hpp"
#include "mesh/mesh_summary.hpp"
#include "output/file_writer.hpp"
#include "output/summary.hpp"
#include "parallel/threads.hpp"
#include "report/report.hpp"
#include "run/body_scales.hpp"
#include "run/build_mesh.hpp"
#include "run/cost_estimate.hpp"
#include "run/inside_out.hpp"
#include "run/lint.hpp"
#include "run/overlap_watch.hpp"
#include "run/penetration_watch.hpp"
#include "run/recorder.hpp"
#include "run/rotation_watch.hpp"
#include "run/simulation.hpp"
#include "run/step_guard.hpp"
#include "run/verdict.hpp"

namespace carom {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

RunMonitor::StageKind kind_of(const Stage& stage) {
  return {stage.reversible_energy(), stage.settings().kind == SchemeKind::statics, is_explicit(stage.settings().kind)};
}

/// The node that moves fastest (or the first whose motion is not finite) and a solid cell that holds it.
std::string worst_place(const Simulation& s, const State& state) {
  std::size_t worst = 0;
  double fastest = -1.0;
  for (std::size_t n = 0; n < s.mesh().node_count(); ++n) {
    const double speed = norm({state.v[3 * n], state.v[3 * n + 1], state.v[3 * n + 2]});
    if (speed <= fastest) continue;
    worst = n;
    fastest = speed;
    if (!std::isfinite(speed)) break;
  }
  const Vec3& x = s.mesh().coordinates[worst];
  std::string text = fmt::format("worst node {} at ({:.4g}, {:.4g}, {:.4g}), speed {:.4g}",
                                 s.mesh().node_numbers[worst], x[0], x[1], x[2], fastest);
  for (std::size_t k = 0; k < s.solid().cell_count(); ++k) {
    const auto nodes = s.solid().nodes_of_cell(k);
    if (std::find(nodes.begin(), nodes.end(), static_cast<Index>(worst)) == nodes.end()) continue;
    const CellRef cell = s.solid().cells()[k];
    const CellBlock& block = s.mesh().blocks[static_cast<std::size_t>(cell.block)];
    return text + fmt::format(", in cell {}", block.file_numbers[static_cast<std::size_t>(cell.cell)]);
  }
  return text;
}

/// The keys that help where a run makes energy.
std::string energy_remedy(const Stage& stage) {
  const SchemeSettings& scheme = stage.settings();
  const bool has_springs = scheme.enforcement == EnforcementKind::penalty && stage.system().contact.slots() > 0;
  std::string text = stage.time().step ? "Lower time.step" : "Lower time.safety";
  if (has_springs) text += " or contact.stiffness (contact.stiffness_factor)";
  if (!is_explicit(scheme.kind)) text += ", or choose a scheme that dissipates or conserves energy";
  return text;
}

/// One run: what the loop needs and what the summary is made from.
class Run {
 public:
  Run(const Simulation& simulation, const RunOptions& options)
      : s_(simulation),
        recorder_(simulation, options.folder),
        progress_(stderr, simulation.end(), options.progress),
        state_(simulation.initial_state()),
        overlap_(simulation, state_),
        penetration_(simulation.model()),
        rotation_(simulation) {
    std::fill(state_.v.begin(), state_.v.end(), 0.0);  // they begin with their stage
  }

  void loop(const std::atomic<bool>& stop);
  void fill(Summary& summary) const;
  Recorder& recorder() { return recorder_; }
  Progress& progress() { return progress_; }
  const std::vector<std::string>& log() const { return log_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  Outcome outcome() const { return outcome_; }
  const std::string& message() const { return message_; }

 private:
  void begin_stage(const Stage& stage);
  struct GivenMotion {
    double kinetic = 0.0;
    Momentum momentum{};
  };
  GivenMotion given_motion(const Stage& stage, const std::vector<double>& v_before) const;
  void book_switch(const Stage& stage, const GivenMotion& given);
  bool march(const Stage& stage, const std::atomic<bool>& stop);
  void look_after(const Stage& stage);
  bool advance(const Stage& stage);
  double load_impulse(const Stage& stage) const;
  void note_solver();
  void record(Recorder::Moment moment);

  const Simulation& s_;
  Recorder recorder_;
  std::unique_ptr<Scheme> scheme_;
  std::optional<StepGuard> steps_;
  Progress progress_;
  State state_, next_;
  OverlapWatch overlap_;
  PenetrationWatch penetration_;
  RotationWatch rotation_;
  std::optional<EnergyLedger> ledger_;
  std::optional<RunMonitor> monitor_;
  std::size_t stage_number_ = 0;  ///< of the next stage
  long long step_ = 0;
  double dt_ = 0.0;                    ///< of the last step
  int iterations_ = 0;                 ///< of the last step
  std::vector<std::string> log_;       ///< changes of scheme and solver on the way
  std::vector<std::string> warnings_;  ///< of the guards
  std::string solver_;                 ///< Scheme::solver_name after the last step
  double dt_smallest_ = 0.0, dt_largest_ = 0.0;
  double body_strain_ = 0.0;  ///< largest so far
  Outcome outcome_ = Outcome::good;
  std::string message_;
};

/// What the velocities of the state have more than those before, by the mass of the stage.
Run::GivenMotion Run::given_motion(const Stage& stage, const std::vector<double>& v_before) const {
  std::vector<double> p(v_before.size());
  stage.mass().apply(v_before, p);
  const double kinetic_before = 0.5 * std::inner_product(p.begin(), p.end(), v_before.begin(), 0.0);
  const MomentArms arms(stage.system(), state_.q);
  std::array<double, 6> before{};
  for (std::size_t i = 0; i < p.size(); ++i) add_with_moment(arms.at(i / 3), i % 3, p[i], before.data());
  GivenMotion given{scheme_->forces().stored.kinetic - kinetic_before, scheme_->forces().total_momentum};
  for (std::size_t c = 0; c < 3; ++c) {
    given.momentum.linear[c] -= before[c];
    given.momentum.angular[c] -= before[3 + c];
  }
  return given;
}

/// Makes the stage's scheme and lets it take the state over.
void Run::begin_stage(const Stage& stage) {
  scheme_ = stage.make_scheme();
  solver_ = scheme_->solver_name();
  steps_.emplace(stage);
  const std::size_t number = stage_number_++;
  const bool was_static = number > 0 && s_.stages()[number - 1]->settings().kind == SchemeKind::statics;
  const std::vector<double> v_before = state_.v;
  const bool gives_velocities = s_.begin_velocities(number, state_);
  try {
    scheme_->start(state_, stage.dt());
  } catch (const std::runtime_error& e) {
    throw RunError(static_cast<int>(step_), state_.t, e.what());
  }
  if (ledger_) {
    book_switch(stage, was_static || gives_velocities ? given_motion(stage, v_before) : GivenMotion{});
    return;
  }
  ledger_.emplace(scheme_->forces().stored, scheme_->forces().total_momentum, reach(s_.mesh()));
  const std::vector<double>& masses = stage.mass().node_diagonal();
  monitor_.emplace(*ledger_,
                   RunMonitor::Bodies{std::accumulate(masses.begin(), masses.end(), 0.0),
                                      rest_energy(s_.solid(), reach(s_.mesh())), momenta_of(s_.model())},
                   kind_of(stage));
  record(Recorder::Moment::during);
}

/// Another scheme may have another mass, and starts from accelerations of its own: what the stored energies jump by is
/// the scheme's doing (ledger: algorithmic), what the momentum jumps by an impulse that the log names. What velocities
/// that begin with the stage add is initial energy.
void Run::book_switch(const Stage& stage, const GivenMotion& given) {
  ledger_->give(given.kinetic, given.momentum);
  const EnergyTerms before = ledger_->now(), &after = scheme_->forces().stored;
  LedgerIncrement jump;
  jump.energy = change_of_stored(before, after);
  jump.energy.algorithmic = -jump.energy.mechanical();
  const Momentum now = scheme_->forces().total_momentum;
  for (std::size_t c = 0; c < 3; ++c) {
    jump.impulse.linear[c] = now.linear[c] - ledger_->momentum().linear[c] - given.momentum.linear[c];
    jump.impulse.angular[c] = now.angular[c] - ledger_->momentum().angular[c] - given.momentum.angular[c];
  }
  ledger_->add(jump, now);
  monitor_->begin_stage(kind_of(stage));
  log_.push_back(fmt::format("stage: at t = {:.6g} from step {} on: {}; stored energy jumps by {:.3g}", state_.t, step_,
                             stage.name(), jump.energy.mechanical()));
}

void Run::record(Recorder::Moment moment) {
  recorder_.record(
      {step_, dt_, iterations_, state_, scheme_->forces(), *ledger_, scheme_->end_weight(), scheme_->contact_within()},
      moment);
}

/// What is looked at beside the books: the stable step of bodies that change, and the rotation of small-strain parts.
void Run::look_after(const Stage& stage) {
  const bool at_end = steps_->control().at_end();
  if (!at_end) steps_->follow_stable_step(state_, step_);
  std::string warning = rotation_.look(state_, step_, is_explicit(stage.settings().kind), at_end);
  if (!warning.empty()) warnings_.push_back(std::move(warning));
}

/// A tangent that is not positive definite makes the scheme change its solver, once in a stage.
void Run::note_solver() {
  std::string now = scheme_->solver_name();
  if (now == solver_) return;
  log_.push_back(fmt::format("solver: at t = {:.6g} from step {} on: {}", state_.t, step_, now));
  solver_ = std::move(now);
}

/// Magnitude of the impulse of the loads over a step, by their forces at its end; static stages have none.
double Run::load_impulse(const Stage& stage) const {
  if (s_.model().loads.empty() || stage.settings().kind == SchemeKind::statics) return 0.0;
  const std::vector<double>& f = scheme_->forces().external;
  const auto sum = parallel_sums<3>(f.size(), [&f](std::size_t i, std::array<double, 3>& s) { s[i % 3] += f[i]; });
  return norm(sum) * dt_;
}

/// One accepted step. Returns false when the run cannot go on; message_ says why.
bool Run::advance(const Stage& stage) {
  StepReport report;
  steps_->limit_motion(state_, *scheme_->forces().rows.rows, step_ + 1);
  EnergyGuard::Books books;
  for (;;) {
    const double dt = steps_->control().dt();
    // A hundredth of the ledger's bound (1e-10 of the energy), shared out over the time of the run; what a step leaves
    // unbooked is at most its residual's work.
    const double tolerance = 1e-12 * ledger_->scale() * dt / s_.end();
    report = scheme_->step(state_, {steps_->control().t_end_of_step(), dt, tolerance}, next_);
    if (report.converged && !std::isfinite(scheme_->forces().stored.mechanical())) {
      scheme_->take_back();
      report.converged = false;
      report.failure = "the energy is not finite";
    }
    if (report.converged) {
      books = {report.books.energy.quadrature, report.books.energy.algorithmic, monitor_->scale()};
      if (!steps_->is_to_be_repeated(state_, next_, scheme_->forces(), books, step_ + 1)) break;
      scheme_->take_back();
      continue;
    }
    if (steps_->shorten(state_, step_ + 1)) continue;
    record(Recorder::Moment::last);
    if (const std::string inverted = inside_out(s_, next_.q); !inverted.empty()) report.failure = inverted;
    message_ = fmt::format("step {} from t = {:.6g} failed: {}{}", step_ + 1, state_.t, report.failure,
                           stage.time().fixed ? "; the case fixes the step, so it was not halved" : "");
    outcome_ = Outcome::error;
    return false;
  }
  std::swap(state_, next_);
  dt_ = steps_->control().dt();
  iterations_ = std::max(report.iterations, report.linear_iterations);
  steps_->accept(books);
  ++step_;
  note_solver();
  dt_smallest_ = step_ == 1 ? dt_ : std::min(dt_smallest_, dt_);
  dt_largest_ = std::max(dt_largest_, dt_);
  ledger_->add(report.books, scheme_->forces().total_momentum);
  monitor_->update(load_impulse(stage));
  body_strain_ = std::max(body_strain_, s_.solid().body_strain(state_.q));
  const std::string alarm = monitor_->alarm(s_.given().guards.energy_growth);
  const bool last = (steps_->control().at_end() && stage.end() == s_.end()) || !alarm.empty();
  record(last ? Recorder::Moment::last : Recorder::Moment::during);
  penetration_.look(scheme_->forces().rows, state_.q);
  overlap_.look(state_, last ? OverlapWatch::Moment::last : OverlapWatch::Moment::during);
  progress_.update({state_.t, step_, dt_, iterations_, monitor_->relative_imbalance()});
  if (alarm.empty()) look_after(stage);
  if (alarm.empty()) return true;
  message_ = fmt::format("stopped after step {}, t = {:.6g}: {}; {}", step_, state_.t, alarm, worst_place(s_, state_));
  const std::string remedy = s_.given().contacts.empty() ? "" : touch_remedy(stage);
  message_ += ". " + (remedy.empty() ? energy_remedy(stage) : remedy);
  outcome_ = Outcome::error;
  return false;
}

/// False when the run has ended before the stage has.
bool Run::march(const Stage& stage, const std::atomic<bool>& stop) {
  begin_stage(stage);
  while (!steps_->control().at_end()) {
    if (!advance(stage)) return false;
    if (!stop.load() || (steps_->control().at_end() && stage.end() == s_.end())) continue;
    record(Recorder::Moment::last);
    outcome_ = Outcome::stopped;
    message_ = fmt::format("interrupted after step {}, t = {:.6g} of {:.6g}", step_, state_.t, s_.end());
    return false;
  }
  return true;
}

void Run::loop(const std::atomic<bool>& stop) {
  for (const auto& stage : s_.stages()) {
    if (!march(*stage, stop)) return;
  }
}

VerdictItem body_strain_item(double strain) {
  constexpr double limit = 1e-3;
  return {"rigid body strain", strain, limit, strain <= limit,
          "largest strain of the rigid bodies that turn, which should have none: is their rigidity high enough?"};
}

/// Round-off, but where a scheme keeps the angular momentum of turning bodies to its order only, and where parts of
/// small strain stand beside others.
double angular_limit(const Simulation& s) {
  const auto keeps_it = [](const auto& stage) {
    switch (stage->settings().kind) {
      case SchemeKind::central_differences:
      case SchemeKind::cd_lagrange:
      case SchemeKind::forward_increment:
      case SchemeKind::modified_mass:
      case SchemeKind::energy_momentum:
        return true;
      default:
        return false;
    }
  };
  const auto is_small_strain = [](const Part& part) { return std::holds_alternative<LinearElastic>(part.material); };
  const std::vector<Part>& parts = s.model().parts;
  // Moments are taken where nodes stand; the internal forces of small strain and springs balance where nodes stood.
  const bool is_mixed = !s.solid().is_linear() &&
                        (!s.model().springs.empty() || std::any_of(parts.begin(), parts.end(), is_small_strain));
  const bool is_kept = !is_mixed && std::all_of(s.stages().begin(), s.stages().end(), keeps_it);
  const bool exact = s.solid().is_linear() || is_kept;
  return exact ? 1e-9 : 1e-2;
}

/// The modified mass keeps its energy to 2 % without trend (docs/schemes.md), all others make none to speak of.
double gain_limit(const Simulation& s) {
  const auto is_modified = [](const auto& stage) { return stage->settings().kind == SchemeKind::modified_mass; };
  return std::any_of(s.stages().begin(), s.stages().end(), is_modified) ? 0.02 : 0.005;
}

/// All schemes of the run, in their order.
std::string scheme_names(const Simulation& s) {
  std::string names;
  for (const auto& stage : s.stages()) names += (names.empty() ? "" : "; then ") + stage->name();
  return names;
}

void Run::fill(Summary& summary) const {
  summary.scheme = {scheme_names(s_), scheme_ ? scheme_->solver_name() : "", dt_smallest_, dt_largest_, step_, s_.end(),
                    state_.t};
  for (const auto& stage : s_.stages()) {
    const Stage::MassNotes& notes = stage->mass_notes();
    if (notes.added > summary.scheme.added_mass) {
      summary.scheme.added_mass = notes.added;
      summary.scheme.added_mass_share = notes.added_share;
    }
    summary.scheme.mass_notes.insert(summary.scheme.mass_notes.end(), notes.lines.begin(), notes.lines.end());
  }
  double stage_begin = 0.0;
  for (const auto& stage : s_.stages()) {
    summary.scheme.stages.push_back({stage->name(), stage_begin, stage->end()});
    stage_begin = stage->end();
  }
  recorder_.fill(summary);
  if (!ledger_) return;
  const EnergyTerms e = ledger_->now();
  for (const EnergyTerm& term : energy_terms) summary.ledger.push_back({std::string(term.name), e.*term.value});
  summary.ledger.push_back({"imbalance", ledger_->imbalance()});
  const std::array<double, 6> aster = aster_values(ledger_->aster());
  for (std::size_t i = 0; i < aster.size(); ++i) summary.code_aster.push_back({std::string(aster_names[i]), aster[i]});
  const Momentum begin = ledger_->initial_momentum(), end = ledger_->momentum(), impulse = ledger_->impulse();
  summary.linear_momentum = {begin.linear, end.linear, impulse.linear, monitor_->linear_momentum_error()};
  summary.angular_momentum = {begin.angular, end.angular, impulse.angular, monitor_->angular_momentum_error()};
  summary.checks = recorder_.checks();
  // Energies at whole steps and the one that explicit schemes keep, differ by h^2/8 a.Ma with central differences.
  const double lent = 0.25 * dt_largest_ * dt_largest_ * scheme_->forces().inertia_power;
  summary.verdict = monitor_->items({angular_limit(s_), gain_limit(s_), lent});
  summary.verdict.push_back(penetration_.item());
  summary.verdict.push_back(overlap_.item());
  if (!s_.model().turning_bodies.empty()) summary.verdict.push_back(body_strain_item(body_strain_));
}

Summary summary_of(const Simulation& s) {
  Summary summary;
  summary.program = {version(), compiler(), std::string(name(s.solid().isa())), thread_count()};
  summary.case_info = {s.given().file, s.given().title, std::string(name(s.given().units))};
  summary.mesh.nodes = given_nodes(s.given(), s.mesh());
  summary.mesh.cells = s.solid().cell_count();
  summary.mesh.reach = reach(s.mesh());
  for (const std::string& group : s.mesh().group_names()) {
    const auto cells = s.mesh().cell_groups.find(group);
    summary.mesh.groups.push_back(
        {group, s.mesh().nodes_of(group).size(), cells == s.mesh().cell_groups.end() ? 0 : cells->second.size()});
  }
  return summary;
}

/// Fails what did not pass; "good" and "failed" only for runs that reached the end.
void judge(Summary& summary) {
  const auto failed = [](const auto& list) {
    return std::count_if(list.begin(), list.end(), [](const auto& item) { return !item.pass; });
  };
  const auto checks = failed(summary.checks), items = failed(summary.verdict);
  if (summary.outcome != Outcome::good) return;
  if (checks + items > 0) summary.outcome = Outcome::failed;
  std::string verdict = fmt::format("{} of {} verdict items passed",
                                    summary.verdict.size() - static_cast<std::size_t>(items), summary.verdict.size());
  const char* before = " (not ";
  for (const VerdictItem& item : summary.verdict) {
    if (!item.pass) verdict += std::exchange(before, ", ") + item.name;
  }
  if (items > 0) verdict += ")";
  summary.message = summary.checks.empty() ? verdict + "; no checks: nothing was compared"
                                           : fmt::format("{} of {} checks and {}",
                                                         summary.checks.size() - static_cast<std::size_t>(checks),
                                                         summary.checks.size(), verdict);
}

/// To stderr; when that has gone, the results are still in the folder.
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  std::fputs(terminal_text(fmt::format(format, std::forward<Values>(values)...)).c_str(), stderr);
}

void say_lines(std::string_view kind, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) say("{}: {}\n", kind, line);
}

void print_verdict(const Summary& summary, const std::string& folder) {
  for (const VerdictItem& item : summary.verdict) {
    if (!item.pass) say("FAILED  {}: {:.3g}, limit {:.3g} ({})\n", item.name, item.value, item.limit, item.explanation);
  }
  for (const CheckSummary& check : summary.checks) {
    const bool reached = check.time <= summary.scheme.time_reached;
    if (!check.pass && reached) {
      say("FAILED  check {} at t = {:.6g}: {:.10g}, reference {:.10g}, difference {:.3g} ({})\n", check.name,
          check.time, check.value, check.reference, check.difference, check.source);
    }
  }
  say("{}: {}\n", to_string(summary.outcome), summary.message);
  say("{} step{} in {:.3g} s; results in {}, open {}/report.html\n", summary.scheme.steps,
      summary.scheme.steps == 1 ? "" : "s", summary.cost.wall_seconds, folder, folder);
}

/// The case with its mesh file as seen from the results folder, so that the resolved case can be run there.
Case beside(Case given, const std::string& folder) {
  namespace fs = std::filesystem;
  std::string& file = given.mesh.file.value;
  if (!file.empty() && !fs::path(file).is_absolute())
    file = fs::proximate(fs::path(given.file).parent_path() / file, folder).generic_string();
  return given;
}

ExitCode exit_code(Outcome outcome) {
  switch (outcome) {
    case Outcome::good:
      return ExitCode::good;
    case Outcome::failed:
      return ExitCode::verdict_failed;
    case Outcome::stopped:
    case Outcome::error:
      break;
  }
  return ExitCode::run_failed;
}

}  // namespace

ExitCode run_case(const std::string& case_file, const RunOptions& options, const std::atomic<bool>& stop) {
  const Clock::time_point begin = Clock::now();
  set_threads(options.threads);
  const Case given = read_case(case_file);
  const bool quiet = options.progress == ProgressMode::quiet;
  const Simulation simulation(given);
  std::vector<std::string> warnings = lint_warnings(simulation);
  for (std::string& warning : cost_warnings(simulation, options.folder)) warnings.push_back(std::move(warning));
  Run run(simulation, options);
  std::vector<std::string> notes = simulation.notes();
  notes.insert(notes.end(), run.recorder().notes().begin(), run.recorder().notes().end());
  if (!quiet) {
    say_lines("warning", warnings);
    say_lines("note", notes);
  }
  write_file(options.folder + "/case.resolved.toml", resolved_toml(beside(given, options.folder)));
  write_file(options.folder + "/mesh.txt", mesh_summary(simulation.mesh()));
  Summary summary = summary_of(simulation);
  summary.warnings = warnings;
  summary.notes = std::move(notes);
  const double setup_seconds = seconds_since(begin);
  const Clock::time_point stepping = Clock::now();
  summary.outcome = Outcome::error;
  try {
    run.loop(stop);
    summary.outcome = run.outcome();
    summary.message = run.message();
  } catch (const RunError& e) {
    summary.message = e.what();
  } catch (const OutputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    summary.message = "the run could not go on: memory ran out; " + memory_statement(simulation);
  } catch (const std::exception& e) {  // a factorisation that fails
    summary.message = fmt::format("the run could not go on: {}", e.what());
  }
  const double step_seconds = seconds_since(stepping);
  run.progress().finish("");
  if (!quiet) {
    for (const std::string& line : run.log()) say("{}\n", line);
  }
  summary.notes.insert(summary.notes.end(), run.log().begin(), run.log().end());
  summary.warnings.insert(summary.warnings.end(), run.warnings().begin(), run.warnings().end());
  if (!quiet) say_lines("warning", run.warnings());
  run.recorder().close();
  run.fill(summary);
  summary.cost = {
      seconds_since(begin), cpu_seconds(), {{"setup", setup_seconds}, {"steps", step_seconds}}, peak_memory()};
  judge(summary);
  write_summary(options.folder + "/summary.json", summary);
  write_report(options.folder);
  const bool is_good = summary.outcome == Outcome::good;
  if (quiet && !is_good) say_lines("warning", summary.warnings);
  if (!quiet || !is_good) print_verdict(summary, options.folder);
  return exit_code(summary.outcome);
}

}  // namespace carom
