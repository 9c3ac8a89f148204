#include "mesh/hdf5_tree.hpp"

#include <fmt/format.h>

#include <cstring>
#include <limits>

#include "base/errors.hpp"
#include "mesh/hdf5_visitor.hpp"
#include "mesh/isolated_process.hpp"

namespace carom {

namespace {

constexpr const char* kAdvice = "The file is damaged or not what it seems; write or copy it again.";

/// Takes records apart; the layout is described in hdf5_visitor.hpp.
class Decoder {
 public:
  Decoder(std::string_view stream, const std::string& source) : stream_(stream), source_(source) {}

  Hdf5Tree run() {
    Hdf5Tree tree;
    for (;;) {
      switch (static_cast<Hdf5Record>(scalar<char>())) {
        case Hdf5Record::group:
          tree.groups.insert(text());
          break;
        case Hdf5Record::attribute: {
          const std::string path = text();
          tree.attributes[path] = scalar<std::int64_t>();
          break;
        }
        case Hdf5Record::integers:
          read_data_set<std::int64_t>(tree);
          break;
        case Hdf5Record::reals:
          read_data_set<double>(tree);
          break;
        case Hdf5Record::failure: {
          const std::string path = text();
          const std::string found = text();
          const std::string expected = text();
          throw CaseError({source_, 0, 0}, path, found, expected, kAdvice);
        }
        case Hdf5Record::end:
          return tree;
        default:
          incomplete();
      }
    }
  }

 private:
  template <class T>
  T scalar() {
    T value{};
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }

  std::string text() { return std::string(take(scalar<std::uint64_t>())); }

  template <class T>
  void read_data_set(Hdf5Tree& tree) {
    const std::string path = text();
    Hdf5Tree::DataSet set;
    const auto rank = scalar<std::uint8_t>();
    std::uint64_t count = 1;
    for (std::uint8_t i = 0; i < rank; ++i) {
      set.extents.push_back(scalar<std::uint64_t>());
      if (set.extents.back() != 0 && count > std::numeric_limits<std::uint32_t>::max() / set.extents.back())
        incomplete();
      count *= set.extents.back();
    }
    const std::string_view bytes = take(count * sizeof(T));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
    set.values = std::move(values);
    tree.data_sets[path] = std::move(set);
  }

  std::string_view take(std::uint64_t size) {
    if (size > stream_.size() - position_) incomplete();
    position_ += size;
    return stream_.substr(position_ - size, size);
  }

  [[noreturn]] void incomplete() const {
    throw CaseError({source_, 0, 0}, "HDF5", "data that end too early", "a whole HDF5 file", kAdvice);
  }

  std::string_view stream_;
  const std::string& source_;
  std::size_t position_ = 0;
};

}  // namespace

Hdf5Tree decode_hdf5_tree(std::string_view stream, const std::string& source) {
  return Decoder(stream, source).run();
}

Hdf5Tree read_hdf5_tree(std::string_view bytes, const std::string& source,
                        const std::function<bool(const std::string& path)>& wanted) {
  constexpr std::size_t kMegabyte = 1 << 20;
  const IsolationLimits limits{.memory_bytes = 256 * kMegabyte + 8 * bytes.size(),
                               .output_bytes = 64 * kMegabyte + 16 * bytes.size(),
                               .cpu_seconds = static_cast<unsigned>(2 + bytes.size() / (16 * kMegabyte))};
  const IsolatedResult result = run_isolated(limits, [&](int fd) { visit_hdf5(bytes, wanted, fd); });
  if (!result.failure.empty())
    throw CaseError({source, 0, 0}, "HDF5", fmt::format("bytes that libhdf5 cannot read ({})", result.failure),
                    "a whole HDF5 file", kAdvice);
  return decode_hdf5_tree(result.output, source);
}

}  // namespace carom
