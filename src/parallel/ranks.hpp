// Ranks: computations side by side that share a run. Each has all that is not shared out, and tells the others what is.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace carom {

/// What a rank has given to others.
struct Traffic {
  std::size_t messages = 0, values = 0;
};

/// One rank as it sees the others. Messages from one rank to another arrive in the order in which they were sent.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual std::size_t count() const = 0;
  /// The number of this one, from 0 on.
  virtual std::size_t own() const = 0;
  /// Does not wait for the other rank to receive.
  virtual void send(std::size_t to, std::span<const double> values) = 0;
  /// Waits, and overwrites the values. Throws std::runtime_error when the other rank has ended with an error.
  virtual void receive(std::size_t from, std::vector<double>& values) = 0;
  std::vector<double> receive(std::size_t from) {
    std::vector<double> values;
    receive(from, values);
    return values;
  }
  /// Waits until the others have received what this one has sent: long messages go on only while a process waits. After
  /// the last receive() of what all ranks send to each other at the same time.
  virtual void settle() {}
  /// Overwrites `all` by what the ranks give, one after the other; sizes: how many values each gives. All ranks call
  /// it.
  virtual void gather(std::span<const double> own, std::span<const std::size_t> sizes, std::vector<double>& all);
  /// How many ranks, this one included, may use some of the cores that this one may use.
  virtual int on_same_cores() const { return 1; }
  /// All that this one has sent so far.
  virtual Traffic sent() const = 0;
};

/// The ranks of the run that the calling thread takes part in; by itself it is the only one.
Ranks& ranks();

/// Runs body() as the rank `own`.
void run_as(Ranks& own, const std::function<void()>& body);

/// True on every rank if it is on any of them. All ranks call it, and none goes on before.
bool on_any_rank(bool is_so);

/// True on every rank if all of them give the same value. All ranks call it.
bool same_on_all_ranks(double value);

/// The communicator of this process alone, as Fortran sees it (MPI 4.0, 19.3.4), for libraries that are given one: that
/// of the MPI of one process which MUMPS brings along, until a job has one.
int own_communicator();
void set_own_communicator(int communicator);

/// Runs body() on `count` ranks, each a thread of this process with one thread of its own for loops, and waits for
/// all. Throws what the first of them to fail threw; the others end at their next receive.
void run_on_ranks(std::size_t count, const std::function<void()>& body);

/// Entries [begin, end) of a vector.
struct EntryRange {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
  bool has(std::size_t entry) const { return entry >= begin && entry < end; }
};

/// Calls body(begin, end) for the entries of [0, n) that are in none of the ranges, which stand in their order.
template <class Body>
void each_gap(std::span<const EntryRange> ranges, std::size_t n, const Body& body) {
  std::size_t next = 0;
  for (const EntryRange& range : ranges) {
    if (next < range.begin) body(next, range.begin);
    next = next < range.end ? range.end : next;
  }
  if (next < n) body(next, n);
}

/// Entries of ranges that follow each other, some at a time: messages have a largest size, so that their memory is
/// small beside that of a model.
class RangesInPieces {
 public:
  explicit RangesInPieces(std::span<const EntryRange> ranges);
  /// Entries that are left.
  std::size_t left() const { return left_; }
  /// How many values of `width` each the next piece has.
  std::size_t next_size(std::size_t width) const;
  /// Calls body(begin, end) for the values of the next piece.
  void next(std::size_t width, const std::function<void(std::size_t, std::size_t)>& body);

 private:
  std::span<const EntryRange> ranges_;
  std::size_t done_ = 0, left_ = 0;  ///< entries: of the first range; of all
};

/// The share of a rank in n entries that follow each other: rank r of R has those from r n / R on.
EntryRange share_of(std::size_t rank, std::size_t ranks, std::size_t n);
/// That of the calling thread's rank.
EntryRange own_share_of(std::size_t n);
/// The rank whose share the entry is.
std::size_t sharer_of(std::size_t entry, std::size_t ranks, std::size_t n);

/// The largest value that any rank gives, with the position that this rank gives it; of equal ones the first position.
/// All ranks call it.
std::pair<double, std::size_t> largest_on_ranks(double value, std::size_t position);

/// Vectors of which each rank knows entries of its own: gather() gives them to all, collect() to the first.
class Exchange {
 public:
  /// The entries of each rank; no entry is of two ranks.
  explicit Exchange(std::vector<std::vector<EntryRange>> of_ranks) : of_ranks_(std::move(of_ranks)) {}

  /// Afterwards every rank has the entries of all ranks, each of `width` values. All ranks call it, for vectors of the
  /// same size.
  void gather(std::span<double> values, std::size_t width = 1) const;
  /// Afterwards the first rank has them, whose vector alone changes.
  void collect(std::span<double> values, std::size_t width = 1) const;

 private:
  std::vector<std::vector<EntryRange>> of_ranks_;
};

}  // namespace carom
