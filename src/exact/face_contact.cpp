#include "exact/face_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/types.hpp"

namespace carom {

namespace {

constexpr double rounding = 1e-12;

/// value + slope s, s >= 0 the time since now
struct Linear {
  double value = 0.0;
  double slope = 0.0;
};

/// Smallest s > 0 at which gap - integral of w from 0 to s vanishes; a face that has just parted (gap = 0, w <= 0)
/// is not a root. Infinity if there is none.
double time_to_close(double gap, const Linear& w) {
  const double discriminant = w.value * w.value + 2.0 * w.slope * gap;
  if (discriminant < 0.0) return infinity;
  if (w.value > 0.0) return 2.0 * gap / (w.value + std::sqrt(discriminant));
  return w.slope > 0.0 ? (std::sqrt(discriminant) - w.value) / w.slope : infinity;
}

/// Marches from event to event.
class Solver {
 public:
  Solver(const BarFace& left, const BarFace& right, double gap, double until)
      : result_{{PiecewiseLinear(0.5 * left.velocity), PiecewiseLinear(0.5 * right.velocity)},
                PiecewiseLinear(0.0),
                {},
                {}},
        faces_{left, right},
        until_(until),
        gap_(gap),
        closed_(gap == 0.0) {
    for (const BarFace& face : faces_) {
      compliance_ += 1.0 / face.impedance;
      acceleration_scale_ += std::abs(face.acceleration);
      if (std::isfinite(face.round_trip)) time_tolerance_ += rounding * face.round_trip;
    }
  }

  FaceContact solve() {
    while (now_ < until_) {
      pass_arrived_fronts();
      const Linear w = approach();
      if (!closed_ && time_to_close(gap_, w) <= time_tolerance_) close();
      if (closed_ && (w.value > 0.0 || (w.value == 0.0 && w.slope >= 0.0)))
        contact(w);
      else
        flight(w);
    }
    for (PiecewiseLinear* function : {&result_.waves[0], &result_.waves[1], &result_.force}) function->end_at(until_);
    return std::move(result_);
  }

 private:
  const PiecewiseLinear::Piece& incoming(std::size_t i) const { return result_.waves[i].pieces()[arrived_[i]]; }
  double front_time(std::size_t i) const {
    const auto& pieces = result_.waves[i].pieces();
    return arrived_[i] + 1 < pieces.size() ? pieces[arrived_[i] + 1].begin + faces_[i].round_trip : infinity;
  }
  /// To be asked after record: a front that leaves the face now may be the next to come back.
  double next_event() const { return std::min({front_time(0), front_time(1), until_}); }

  void pass_arrived_fronts() {
    for (std::size_t i = 0; i < 2; ++i)
      while (front_time(i) <= now_ + time_tolerance_) ++arrived_[i];
  }

  /// f_i(t - T_i)
  Linear returned_wave(std::size_t i) const {
    if (arrived_[i] == 0) return {incoming(i).value, 0.0};
    return {incoming(i).at(now_ - faces_[i].round_trip), incoming(i).slope};
  }

  /// w
  Linear approach() {
    std::array<Linear, 2> v;
    for (std::size_t i = 0; i < 2; ++i) {
      const Linear g = returned_wave(i);
      v[i] = {faces_[i].acceleration * now_ + 2.0 * g.value, faces_[i].acceleration + 2.0 * g.slope};
      speed_scale_ = std::max(speed_scale_, std::abs(v[i].value));
    }
    Linear w{v[0].value - v[1].value, v[0].slope - v[1].slope};
    if (std::abs(w.value) <= rounding * speed_scale_) w.value = 0.0;
    if (std::abs(w.slope) <= rounding * acceleration_scale_) w.slope = 0.0;
    return w;
  }

  void close() {
    closed_ = true;
    gap_ = 0.0;
  }

  void contact(const Linear& w) {
    const Linear force{w.value / compliance_, w.slope / compliance_};
    record(force);
    double end = next_event();
    if (w.slope < 0.0 && now_ - w.value / w.slope < end - time_tolerance_) end = now_ - w.value / w.slope;
    const double span = end - now_, impulse = span * (force.value + 0.5 * force.slope * span);
    auto& phases = result_.phases;
    if (!phases.empty() && phases.back().end == now_ && (phases.back().impulse > 0.0) == (impulse > 0.0)) {
      phases.back().end = end;
      phases.back().impulse += impulse;
    } else {
      phases.push_back({now_, end, impulse});
    }
    now_ = end;
  }

  void flight(const Linear& w) {
    if (!result_.phases.empty() && result_.phases.back().end == now_) result_.releases.push_back(now_);
    closed_ = false;
    record({});
    const double next = next_event(), span = next - now_, closing = time_to_close(gap_, w);
    if (closing <= span + time_tolerance_) {
      close();
      now_ += closing;
    } else {
      gap_ -= span * (w.value + 0.5 * w.slope * span);
      now_ = next;
    }
  }

  void record(const Linear& force) {
    append(result_.force, force, speed_scale_ / compliance_);
    for (std::size_t i = 0; i < 2; ++i) {
      const Linear g = returned_wave(i);
      const double share = (i == 0 ? -1.0 : 1.0) / faces_[i].impedance;
      append(result_.waves[i], {g.value + share * force.value, g.slope + share * force.slope}, speed_scale_);
    }
  }

  /// A new piece, unless the last one goes on.
  void append(PiecewiseLinear& function, const Linear& piece, double scale) const {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const PiecewiseLinear::Piece& last = function.pieces().back();
    if (std::abs(piece.value - last.at(now_)) > 4.0 * epsilon * scale || piece.slope != last.slope)
      function.append(now_, piece.value, piece.slope);
  }

  FaceContact result_;
  std::array<BarFace, 2> faces_;
  double until_;
  std::array<std::size_t, 2> arrived_{};  // last piece of f_i that has come back to the face
  double now_ = 0.0, gap_, compliance_ = 0.0;
  double time_tolerance_ = 0.0, speed_scale_ = 0.0, acceleration_scale_ = 0.0;
  bool closed_;
};

}  // namespace

FaceContact solve_face_contact(const BarFace& left, const BarFace& right, double gap, double until) {
  return Solver(left, right, gap, until).solve();
}

}  // namespace carom
