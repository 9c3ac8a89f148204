#include "view/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <utility>

#include "output/quantities.hpp"
#include "output/readable_unit.hpp"
#include "view/frame_file.hpp"
#include "view/packed_arrays.hpp"
#include "view/scene.hpp"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostFrames = 60;      ///< as many as a run writes, and some more
constexpr std::size_t kFewestFrames = 13;    ///< before nodes are given up for times
constexpr std::size_t kMostNodes = 400'000;  ///< of a surface that is read
constexpr std::size_t kFewestNodes = 500;
constexpr std::size_t kMostValues = 60'000'000;  ///< in memory at a time

/// How much of what was recorded a page shows.
struct Detail {
  std::size_t frames = 0;
  int bits = 16;
  bool tensors = true;
};

/// Numbers from 0 to 2^bits - 2 between the smallest and the largest value; 2^bits - 1 where there is none.
struct Quantiser {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  int bits = 16;

  void see(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value), high = std::max(high, value);
  }
  std::uint32_t largest() const { return (1U << static_cast<unsigned>(bits)) - 2U; }
  std::uint32_t number(double value) const {
    if (!std::isfinite(value)) return largest() + 1U;
    const double share = high > low ? (value - low) / (high - low) : 0.0;
    return static_cast<std::uint32_t>(std::lround(share * largest()));
  }
  Json range() const { return low <= high ? Json{low, high} : Json{0.0, 0.0}; }
};

template <class Values>
std::vector<std::uint32_t> as_numbers(const Values& values) {
  std::vector<std::uint32_t> numbers;
  for (const auto value : values) numbers.push_back(static_cast<std::uint32_t>(value));
  return numbers;
}

Json pack_reference(const Scene& scene, PackedArrays& arrays) {
  Json ranges = Json::array();
  for (std::size_t c = 0; c < 3; ++c) {
    Quantiser quantiser;
    for (const Vec3& x : scene.reference) quantiser.see(x[c]);
    std::vector<std::uint32_t> numbers;
    for (const Vec3& x : scene.reference) numbers.push_back(quantiser.number(x[c]));
    arrays.add(numbers, 2);
    ranges.push_back(quantiser.range());
  }
  return ranges;
}

/// Component by component, each over its times.
Json pack_field(const SceneField& field, const std::vector<std::size_t>& times, int bits, PackedArrays& arrays) {
  const auto components = static_cast<std::size_t>(field.components);
  Json ranges = Json::array();
  for (std::size_t c = 0; c < components; ++c) {
    Quantiser quantiser;
    quantiser.bits = bits;
    const auto each = [&](std::size_t t, const auto& act) {
      const std::vector<float>& values = field.frames[t];
      for (std::size_t i = c; i < values.size(); i += components) act(static_cast<double>(values[i]));
    };
    for (const std::size_t t : times) each(t, [&](double value) { quantiser.see(value); });
    std::vector<std::uint32_t> before;
    for (const std::size_t t : times) {
      std::vector<std::uint32_t> numbers;
      each(t, [&](double value) { numbers.push_back(quantiser.number(value)); });
      before.empty() ? arrays.add(numbers, 2) : arrays.add(numbers, 2, before);
      before = std::move(numbers);
    }
    ranges.push_back(quantiser.range());
  }
  return ranges;
}

/// What the table of quantities says of a field, and by the number of its components of one that it does not have.
Quantity quantity_of(const SceneField& field) {
  const Quantity* found = find_quantity(field.name);
  if (found != nullptr && static_cast<int>(components(found->form)) == field.components) return *found;
  Quantity quantity;
  quantity.form = field.components == 3 ? Form::vector : field.components == 6 ? Form::tensor : Form::scalar;
  return quantity;
}

/// For view_field.js.
std::string_view colours_of(const Quantity& quantity) {
  if (quantity.form == Form::category) return "categories";
  if (quantity.colours == Colours::from_zero) return "from_zero";
  return quantity.colours == Colours::both_signs ? "both_signs" : "range";
}

double largest_of(const Json& ranges) {
  double largest = 0.0;
  for (const Json& range : ranges)
    for (const Json& end : range) largest = std::max(largest, std::abs(end.get<double>()));
  return largest;
}

/// Per triangle the first of the frames of these times in which it is seen, and the first after that in which it is
/// not.
void pack_lives(const SeenSurface& surface, const std::vector<std::size_t>& times, PackedArrays& arrays) {
  const auto frame = [&](Index recorded) {
    const auto found = std::lower_bound(times.begin(), times.end(), static_cast<std::size_t>(recorded));
    return static_cast<std::uint32_t>(found - times.begin());
  };
  std::vector<std::uint32_t> from, until;
  for (const SeenTriangle& t : surface.triangles) {
    from.push_back(frame(t.from));
    until.push_back(frame(t.until));
  }
  arrays.add(from, 2);
  arrays.add(until, 2);
}

/// Fields one after the other; which is written first does not matter to view.js.
Json pack_scene(const Scene& scene, const Detail& detail, const Units& units, PackedArrays& arrays) {
  Json json;
  const SeenSurface& surface = scene.surface;
  json["nodes"] = surface.nodes.size();
  json["cells"] = surface.cells.size();
  json["triangles"] = surface.triangles.size();
  json["reference"] = pack_reference(scene, arrays);
  json["numbered"] = !scene.node_numbers.empty() && !scene.cell_numbers.empty();
  if (json["numbered"].get<bool>()) {
    arrays.add(as_numbers(scene.node_numbers), 4);
    arrays.add(as_numbers(scene.cell_numbers), 4);
  }
  arrays.add(as_numbers(scene.part), 2);
  for (std::size_t a = 0; a < 3; ++a) {
    std::vector<std::uint32_t> numbers;
    for (const SeenTriangle& t : surface.triangles) numbers.push_back(static_cast<std::uint32_t>(t.node[a]));
    arrays.add(numbers, 4);
  }
  std::vector<std::uint32_t> cells, edges;
  for (const SeenTriangle& t : surface.triangles) {
    cells.push_back(static_cast<std::uint32_t>(t.cell));
    edges.push_back(t.edges);
  }
  arrays.add(cells, 4);
  arrays.add(edges, 1);
  const std::size_t recorded = scene.fields.empty() ? 0 : scene.fields.front().frames.size();
  const std::vector<std::size_t> times = evenly(recorded, detail.frames);
  json["frames"] = times.size();
  if (surface.changes()) {
    json["changes"] = true;
    pack_lives(surface, times, arrays);
  }
  json["fields"] = Json::array();
  for (const SceneField& field : scene.fields) {
    if (field.components > 3 && !detail.tensors) continue;
    const int bits = field.name == "displacement" ? 16 : detail.bits;
    Json ranges = pack_field(field, times, bits, arrays);
    const ReadableUnit unit = readable_unit(largest_of(ranges), unit_of_field(units, field.name));
    const Quantity quantity = quantity_of(field);
    json["fields"].push_back({{"name", field.name},
                              {"label", label_of(field.name)},
                              {"components", component_names(quantity.form)},
                              {"colours", colours_of(quantity)},
                              {"unit", unit.name},
                              {"power", unit.power},
                              {"at", field.at_cells ? "cell" : "node"},
                              {"bits", bits},
                              {"ranges", std::move(ranges)}});
  }
  return json;
}

/// The frames that are read, and what they are of.
struct Source {
  std::vector<double> times;
  std::vector<std::string> bodies, obstacles;
};

Source find_frames(const std::filesystem::path& folder) {
  Source source;
  const std::vector<FrameEntry> all = read_frames(folder.string());
  for (const std::size_t i : evenly(all.size(), kMostFrames)) {
    source.times.push_back(all[i].time);
    source.bodies.push_back((folder / all[i].file).string());
    if (!all[i].obstacles.empty()) source.obstacles.push_back((folder / all[i].obstacles).string());
  }
  const auto is_same = [&](const std::string& file) { return file == source.obstacles.front(); };
  if (std::all_of(source.obstacles.begin(), source.obstacles.end(), is_same) && !source.obstacles.empty())
    source.obstacles.resize(1);
  return source;
}

/// Keeps as many frames as memory may hold, by the values of one.
void keep_some(Source& source, std::size_t values) {
  const std::size_t most = std::max<std::size_t>(2, kMostValues / std::max<std::size_t>(1, values));
  if (source.bodies.size() <= most) return;
  Source kept;
  for (const std::size_t i : evenly(source.bodies.size(), most)) {
    kept.times.push_back(source.times[i]);
    kept.bodies.push_back(source.bodies[i]);
    if (source.obstacles.size() > 1) kept.obstacles.push_back(source.obstacles[i]);
  }
  if (source.obstacles.size() == 1) kept.obstacles = source.obstacles;
  source = std::move(kept);
}

/// Less of what is missed least. False when nothing is left to give up.
bool reduce(Detail& detail, std::size_t& nodes, double excess) {
  const auto fewer = [excess](std::size_t count) {
    return static_cast<std::size_t>(static_cast<double>(count) / excess);
  };
  if (detail.bits > 12) {
    detail.bits = 12;
  } else if (detail.tensors) {
    detail.tensors = false;
  } else if (detail.frames > kFewestFrames) {
    detail.frames = std::max(kFewestFrames, std::min(detail.frames - 1, fewer(detail.frames)));
  } else if (nodes > kFewestNodes) {
    nodes = std::max(kFewestNodes, std::min(nodes * 9 / 10, fewer(nodes)));
  } else {
    return false;
  }
  return true;
}

std::string note_of(const Scene& bodies, const Detail& detail, std::size_t frames, std::size_t recorded) {
  std::string note = fmt::format("The view holds the outer surface: {} of {} nodes, {} of {} instants",
                                 bodies.surface.nodes.size(), bodies.all_nodes, frames, recorded);
  if (bodies.surface.nodes.size() < bodies.surface_nodes)
    note += fmt::format(", coarser than the mesh, whose surface has {} nodes (edges of cells are not drawn)",
                        bodies.surface_nodes);
  if (!detail.tensors) note += ", no components of tensors";
  note += fmt::format(". Displacements are exact to 1/65000 of their range, the other fields to 1/{}000.",
                      detail.bits > 12 ? 65 : 4);
  return note + " The frames in fields/ hold everything (ParaView: fields.xdmf or fields.pvd).";
}

Json part_names(const Scene& scene, const std::vector<std::string>& given, std::string_view what) {
  const auto highest = std::max_element(scene.part.begin(), scene.part.end());
  const std::size_t count = highest == scene.part.end() ? 0 : static_cast<std::size_t>(*highest) + 1;
  Json names = Json::array();
  for (std::size_t p = 0; p < count; ++p)
    names.push_back(p < given.size() ? given[p] : fmt::format("{} {}", what, p + 1));
  return names;
}

}  // namespace

std::optional<View> make_view(const std::string& folder, const ViewLabels& labels, std::size_t most_bytes) {
  Source source = find_frames(folder);
  if (source.bodies.empty()) return std::nullopt;
  const std::size_t recorded = read_frames(folder).size();
  keep_some(source, read_scene(std::span(source.bodies).first(1), "part", kMostNodes).value_count());
  Scene bodies = read_scene(source.bodies, "part", kMostNodes);
  if (bodies.surface.nodes.empty()) return std::nullopt;
  std::optional<Scene> obstacles;
  if (!source.obstacles.empty()) obstacles = read_scene(source.obstacles, "contact", kMostNodes);

  Detail detail{source.times.size()};
  std::size_t nodes = bodies.surface.nodes.size();
  constexpr double best_ratio = 12.0;  // of packed arrays to their text, better than ever seen
  for (;;) {
    PackedArrays arrays;
    Json json;
    const ReadableUnit time = readable_unit(source.times.back(), labels.units.time);
    json["time_unit"] = time.name;
    json["time_power"] = time.power;
    json["length_unit"] = labels.units.length;
    if (labels.opening) json["opening"] = *labels.opening;
    json["times"] = Json::array();
    for (const std::size_t t : evenly(source.times.size(), detail.frames)) json["times"].push_back(source.times[t]);
    Json scenes = Json::array();
    scenes.push_back(pack_scene(bodies, detail, labels.units, arrays));
    scenes.back()["parts"] = part_names(bodies, labels.parts, "part");
    if (obstacles) {
      scenes.push_back(pack_scene(*obstacles, detail, labels.units, arrays));
      scenes.back()["parts"] = part_names(*obstacles, labels.contacts, "obstacle");
    }
    json["scenes"] = std::move(scenes);
    const auto is_reduced = [&](double bytes) {  // false: they are few enough, or cannot be fewer
      const double excess = bytes / static_cast<double>(most_bytes);
      if (excess <= 1.0 || !reduce(detail, nodes, excess)) return false;
      if (nodes < bodies.surface.nodes.size()) bodies = coarsened(bodies, nodes);
      return true;
    };
    if (is_reduced(static_cast<double>(arrays.size()) / best_ratio)) continue;
    json["data"] = arrays.text();
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (is_reduced(static_cast<double>(text.size()))) continue;
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
    return View{std::move(text), note_of(bodies, detail, json["times"].size(), recorded)};
  }
}

}  // namespace carom
