#include "contact/embedded_rows.hpp"

#include <string_view>
#include <utility>

#include "math/vec3.hpp"

namespace carom {

namespace {

/// Keeps some entries of everything that rows have one of each.
struct Keep {
  const std::vector<std::size_t>& kept;

  template <class T>
  void operator()(std::string_view name, std::vector<T>& values) const {
    if (name == "begin" || name == "node" || name == "block") return;
    for (std::size_t k = 0; k < kept.size(); ++k) values[k] = values[kept[k]];
    values.resize(kept.size());
  }
};

RowBlock scaled_block(const RowBlock& block, double weight) {
  return {scaled(block[0], weight), scaled(block[1], weight), scaled(block[2], weight)};
}

/// Adds a block to the node's among those from `first` on, the nodes of one side of a row.
void add_to_side(std::size_t first, Index node, const RowBlock& block, ConstraintRows& out) {
  for (std::size_t k = first; k < out.node.size(); ++k) {
    if (out.node[k] != node) continue;
    for (std::size_t i = 0; i < 3; ++i) out.block[k][i] = add(out.block[k][i], block[i]);
    return;
  }
  out.node.push_back(node);
  out.block.push_back(block);
}

/// The body that all nodes of a row follow, where it has two sides; -1: none.
Index only_body(const Embedding& embedding, const ConstraintRows& rows, std::size_t r) {
  const auto begin = static_cast<std::size_t>(rows.begin[r]), end = static_cast<std::size_t>(rows.begin[r + 1]);
  const auto behind = static_cast<std::size_t>(rows.behind[r]);
  if (behind == 0 || behind == end - begin) return -1;
  Index body = -1;
  for (std::size_t k = begin; k < end; ++k) {
    const Embedding::Follower* follower = embedding.find(rows.node[k]);
    if (follower == nullptr || (body >= 0 && follower->body != body)) return -1;
    body = follower->body;
  }
  return body;
}

}  // namespace

void embed(const Embedding& embedding, ConstraintRows& rows) {
  if (embedding.empty()) return;
  ConstraintRows out;
  std::vector<std::size_t> kept;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (only_body(embedding, rows, r) >= 0) continue;
    const auto begin = static_cast<std::size_t>(rows.begin[r]), end = static_cast<std::size_t>(rows.begin[r + 1]);
    const std::size_t other_side = end - static_cast<std::size_t>(rows.behind[r]);
    std::size_t side = out.node.size();
    for (std::size_t k = begin; k < end; ++k) {
      if (k == other_side) side = out.node.size();
      if (const Embedding::Follower* follower = embedding.find(rows.node[k])) {
        for (std::size_t a = 0; a < 4; ++a)
          add_to_side(side, follower->carrier[a], scaled_block(rows.block[k], follower->weight[a]), out);
      } else {
        add_to_side(side, rows.node[k], rows.block[k], out);
      }
    }
    if (other_side < end) rows.behind[r] = static_cast<Index>(out.node.size() - side);
    out.begin.push_back(static_cast<Index>(out.node.size()));
    kept.push_back(r);
  }
  Keep keep{kept};
  fields(keep, rows);
  rows.begin = std::move(out.begin);
  rows.node = std::move(out.node);
  rows.block = std::move(out.block);
}

}  // namespace carom
