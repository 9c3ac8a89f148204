#include "model/embedding.hpp"

namespace carom {

void Embedding::add(Index body, const TurningBody& of, std::span<const Index> nodes,
                    std::span<const Vec3> coordinates) {
  place_.resize(coordinates.size(), -1);
  for (const Index node : nodes) {
    place_[static_cast<std::size_t>(node)] = static_cast<Index>(followers_.size());
    followers_.push_back({node, body, of.nodes, corner_weights(of, coordinates[static_cast<std::size_t>(node)])});
  }
}

void Embedding::spread(std::span<double> x) const {
  for (const Follower& follower : followers_)
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (std::size_t a = 0; a < 4; ++a)
        sum += follower.weight[a] * x[3 * static_cast<std::size_t>(follower.carrier[a]) + c];
      x[3 * static_cast<std::size_t>(follower.node) + c] = sum;
    }
}

}  // namespace carom
