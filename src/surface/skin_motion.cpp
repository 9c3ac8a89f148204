#include "surface/skin_motion.hpp"

#include <algorithm>
#include <cmath>

#include "base/types.hpp"
#include "math/vec3.hpp"

namespace carom {
namespace {

constexpr double allowed_motion = 0.25;  ///< of a cell between two looks
constexpr std::int64_t most_steps_unseen = 16;
constexpr std::int64_t work_between_folds = 100;  ///< explicit steps; a look at all of the skin costs about one

/// Largest distance between two displacements of the boxes.
double apart(const Bounds& a, const Bounds& b) {
  Vec3 most{};
  for (std::size_t i = 0; i < 3; ++i) most[i] = std::max(a.high[i] - b.low[i], b.high[i] - a.low[i]);
  return norm(most);
}

}  // namespace

SkinMotion::SkinMotion(const SkinPieces& skin) : skin_(skin), least_(skin.body_count(), infinity) {
  for (const SkinPieces::Piece& piece : skin.pieces) {
    double& least = least_[static_cast<std::size_t>(piece.body)];
    least = std::min(least, piece.length);
  }
}

void SkinMotion::looked(std::span<const double> u, bool with_folds) {
  u_.resize(3 * skin_.nodes.size());
  for (std::size_t k = 0; k < skin_.nodes.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) u_[3 * k + c] = u[3 * static_cast<std::size_t>(skin_.nodes[k]) + c];
  steps_ = scan_ = 0;
  if (with_folds) fold_work_ = 0;
}

bool SkinMotion::may_see_folds() const {
  return fold_work_ >= work_between_folds;
}

/// What bodies have done since the look.
void SkinMotion::follow(std::span<const Vec3> X, std::span<const double> u) {
  bodies_.assign(skin_.body_count(), {});
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& body = bodies_[b];
    for (auto k = static_cast<std::size_t>(skin_.first_node_of_body[b]);
         k < static_cast<std::size_t>(skin_.first_node_of_body[b + 1]); ++k) {
      const auto n = static_cast<std::size_t>(skin_.nodes[k]);
      const Vec3 now = vector_at(u, n), before = vector_at(u_, k);
      body.moved.include(subtract(now, before));
      body.way.include(add(X[n], now));
      body.way.include(add(X[n], before));
    }
  }
}

/// Largest relative motion of two bodies whose ways meet, over the smallest of their cells.
double SkinMotion::meeting() const {
  std::vector<Bounds> ways;
  for (const Body& body : bodies_) ways.push_back(body.way);
  BoxTree tree;
  tree.build(ways);
  std::vector<Index> near;
  double most = 0.0;
  for (std::size_t a = 0; a < bodies_.size(); ++a) {
    near.clear();
    tree.find(ways[a], near);
    for (const Index other : near) {
      const auto b = static_cast<std::size_t>(other);
      if (b <= a) continue;
      most = std::max(most, apart(bodies_[a].moved, bodies_[b].moved) / std::min(least_[a], least_[b]));
    }
  }
  return most;
}

/// Largest relative motion within a body, over its smallest cell.
double SkinMotion::folding() const {
  double most = 0.0;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    most = std::max(most, apart(bodies_[b].moved, bodies_[b].moved) / least_[b]);
  return most;
}

/// Largest relative motion of all, over the smallest cell.
double SkinMotion::spread() const {
  Bounds moved;
  for (const Body& body : bodies_) moved.include(body.moved);
  return apart(moved, moved) / *std::min_element(least_.begin(), least_.end());
}

LookDue SkinMotion::due(std::span<const Vec3> X, std::span<const double> u, int iterations) {
  if (skin_.body_count() == 0) return LookDue::none;
  ++steps_;
  fold_work_ += iterations > 0 ? work_between_folds : 1;
  if (steps_ < scan_) return LookDue::none;
  follow(X, u);
  if (may_see_folds() && folding() > allowed_motion) return LookDue::folds;
  if (meeting() > allowed_motion) return LookDue::bodies;
  const double per_step = spread() / static_cast<double>(steps_);
  const double free_steps = 0.5 * allowed_motion / std::max(per_step, 1e-300);
  scan_ = steps_ + std::max<std::int64_t>(
                       1, static_cast<std::int64_t>(std::min(free_steps, static_cast<double>(most_steps_unseen))));
  return LookDue::none;
}

}  // namespace carom
