#include "view/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "output/frame.hpp"
#include "view/frame_file.hpp"

namespace carom {

namespace {

/// What tells where things are, and is no field to look at.
constexpr std::array<std::string_view, 5> kNames{"part", "contact", "node_number", "cell_number", ghost_type};

bool is_field(const StoredArray& array) {
  return std::find(kNames.begin(), kNames.end(), array.name) == kNames.end();
}

std::vector<std::int64_t> whole_numbers(const StoredArray* found, std::span<const Index> entries) {
  std::vector<std::int64_t> values;
  if (found == nullptr) return values;
  const StoredArray array = *found;  // its bytes go with it
  for (const Index i : entries) values.push_back(static_cast<std::int64_t>(array.at(static_cast<std::size_t>(i))));
  return values;
}

std::vector<float> values_at(const StoredArray& found, std::span<const Index> entries) {
  const StoredArray array = found;  // its bytes go with it
  std::vector<float> values;
  const auto components = static_cast<std::size_t>(array.components);
  values.reserve(entries.size() * components);
  for (const Index i : entries)
    for (std::size_t c = 0; c < components; ++c)
      values.push_back(static_cast<float>(array.at(static_cast<std::size_t>(i), c)));
  return values;
}

/// Per node the part of a cell that it belongs to.
std::vector<Index> parts_of_nodes(const Scene& scene) {
  std::vector<Index> part(scene.surface.nodes.size());
  for (const SeenTriangle& t : scene.surface.triangles)
    for (const Index n : t.node) part[static_cast<std::size_t>(n)] = scene.part[static_cast<std::size_t>(t.cell)];
  return part;
}

/// Where each of `some`, in any order, stands in `all`.
std::vector<Index> places(const std::vector<Index>& some, const std::vector<Index>& all) {
  std::vector<std::pair<Index, Index>> order;
  for (std::size_t i = 0; i < all.size(); ++i) order.emplace_back(all[i], static_cast<Index>(i));
  std::sort(order.begin(), order.end());
  std::vector<Index> found;
  for (const Index wanted : some)
    found.push_back(std::lower_bound(order.begin(), order.end(), std::pair<Index, Index>{wanted, 0})->second);
  return found;
}

template <class T>
std::vector<T> taken(const std::vector<T>& all, std::span<const Index> places, std::size_t components = 1) {
  std::vector<T> some;
  if (all.empty()) return some;
  for (const Index p : places)
    for (std::size_t c = 0; c < components; ++c) some.push_back(all[static_cast<std::size_t>(p) * components + c]);
  return some;
}

/// By cell the first of the frames in which it has gone (output/vtu.hpp), or never; empty where none may go.
std::vector<Index> first_gone(std::span<const std::string> frames) {
  std::vector<Index> gone;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const FrameFile frame(frames[f]);
    const StoredArray* hidden = frame.cell_field(ghost_type);
    if (hidden == nullptr) return {};
    if (f == 0) gone.assign(frame.cells(), never);
    for (std::size_t k = 0; k < std::min(gone.size(), frame.cells()); ++k)
      if (gone[k] == never && hidden->at(k) == hidden_cell) gone[k] = static_cast<Index>(f);
  }
  return gone;
}

/// What has gone has no values.
void forget_gone(Scene& scene) {
  const SurfaceEnds ends = ends_of(scene.surface);
  for (SceneField& field : scene.fields) {
    const std::vector<Index>& end = field.at_cells ? ends.of_cells : ends.of_nodes;
    const auto components = static_cast<std::size_t>(field.components);
    for (std::size_t f = 0; f < field.frames.size(); ++f)
      for (std::size_t i = 0; i < field.frames[f].size(); ++i)
        if (static_cast<Index>(f) >= end[i / components]) field.frames[f][i] = std::numeric_limits<float>::quiet_NaN();
  }
}

void add_frame(Scene& scene, const FrameFile& frame) {
  std::erase_if(scene.fields, [&frame](const SceneField& field) {
    return (field.at_cells ? frame.cell_field(field.name) : frame.point_field(field.name)) == nullptr;
  });
  for (SceneField& field : scene.fields) {
    const StoredArray& array = *(field.at_cells ? frame.cell_field(field.name) : frame.point_field(field.name));
    if (array.components != field.components)
      throw std::runtime_error(fmt::format("the frames disagree about the components of {}", field.name));
    field.frames.push_back(values_at(array, field.at_cells ? scene.surface.cells : scene.surface.nodes));
  }
}

}  // namespace

std::size_t Scene::value_count() const {
  std::size_t count = 0;
  for (const SceneField& f : fields)
    count += static_cast<std::size_t>(f.components) * (f.at_cells ? surface.cells.size() : surface.nodes.size());
  return count;
}

Scene read_scene(std::span<const std::string> frames, const std::string& part, std::size_t most) {
  Scene scene;
  const FrameFile first(frames.front());
  scene.all_nodes = first.points();
  const auto describe = [&] {
    const auto part_numbers = whole_numbers(first.cell_field(part), scene.surface.cells);
    scene.part.assign(part_numbers.begin(), part_numbers.end());
    scene.part.resize(scene.surface.cells.size());
    scene.reference.clear();
    const StoredArray& points = first.coordinates();
    for (const Index n : scene.surface.nodes) {
      const auto i = static_cast<std::size_t>(n);
      scene.reference.push_back({points.at(i, 0), points.at(i, 1), points.at(i, 2)});
    }
  };
  scene.surface = seen_surface(first.mesh(), first_gone(frames));
  scene.surface_nodes = scene.surface.nodes.size();
  describe();
  if (scene.surface.nodes.size() > most) {
    scene.surface = coarsened(scene.surface, scene.reference, parts_of_nodes(scene), most);
    describe();
  }
  scene.node_numbers = whole_numbers(first.point_field("node_number"), scene.surface.nodes);
  scene.cell_numbers = whole_numbers(first.cell_field("cell_number"), scene.surface.cells);
  for (const StoredArray& array : first.point_fields())
    if (is_field(array)) scene.fields.push_back({array.name, array.components, false, {}});
  for (const StoredArray& array : first.cell_fields())
    if (is_field(array)) scene.fields.push_back({array.name, array.components, true, {}});
  add_frame(scene, first);
  for (const std::string& path : frames.subspan(1)) {
    const FrameFile frame(path);
    if (frame.points() != first.points() || frame.cells() != first.cells())
      throw std::runtime_error(fmt::format("{}: it has not the mesh of {}", path, frames.front()));
    add_frame(scene, frame);
  }
  if (scene.surface.changes()) forget_gone(scene);
  return scene;
}

Scene coarsened(const Scene& scene, std::size_t most) {
  Scene coarse;
  coarse.surface = coarsened(scene.surface, scene.reference, parts_of_nodes(scene), most);
  const std::vector<Index> nodes = places(coarse.surface.nodes, scene.surface.nodes);
  const std::vector<Index> cells = places(coarse.surface.cells, scene.surface.cells);
  coarse.reference = taken(scene.reference, nodes);
  coarse.node_numbers = taken(scene.node_numbers, nodes);
  coarse.cell_numbers = taken(scene.cell_numbers, cells);
  coarse.part = taken(scene.part, cells);
  coarse.all_nodes = scene.all_nodes;
  coarse.surface_nodes = scene.surface_nodes;
  for (const SceneField& field : scene.fields) {
    coarse.fields.push_back({field.name, field.components, field.at_cells, {}});
    for (const std::vector<float>& values : field.frames)
      coarse.fields.back().frames.push_back(
          taken(values, field.at_cells ? cells : nodes, static_cast<std::size_t>(field.components)));
  }
  return coarse;
}

std::vector<std::size_t> evenly(std::size_t all, std::size_t some) {
  std::vector<std::size_t> chosen;
  if (some >= all) some = all;
  for (std::size_t i = 0; i < some; ++i) chosen.push_back(some == 1 ? all - 1 : i * (all - 1) / (some - 1));
  return chosen;
}

}  // namespace carom
