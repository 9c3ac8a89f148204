#include "parallel/ranks.hpp"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "parallel/threads.hpp"

namespace carom {
namespace {

class Alone final : public Ranks {
 public:
  std::size_t count() const override { return 1; }
  std::size_t own() const override { return 0; }
  void send(std::size_t, std::span<const double>) override { throw std::logic_error("there is no other rank"); }
  void receive(std::size_t, std::vector<double>&) override { throw std::logic_error("there is no other rank"); }
  Traffic sent() const override { return {}; }
};

thread_local Ranks* current = nullptr;

int communicator = -987654;  // a number that libmpiseq expects

/// The messages between the ranks of one process.
class Post {
 public:
  explicit Post(std::size_t count) : count_(count), on_the_way_(count * count) {}
  std::size_t count() const { return count_; }
  void put(std::size_t from, std::size_t to, std::span<const double> values) {
    const std::scoped_lock lock(mutex_);
    on_the_way_[from * count_ + to].emplace_back(values.begin(), values.end());
    has_come_.notify_all();
  }
  std::vector<double> take(std::size_t from, std::size_t to) {
    std::unique_lock lock(mutex_);
    std::deque<std::vector<double>>& messages = on_the_way_[from * count_ + to];
    has_come_.wait(lock, [&] { return !messages.empty() || failure_; });
    if (messages.empty()) throw std::runtime_error("another rank has ended with an error");
    std::vector<double> values = std::move(messages.front());
    messages.pop_front();
    return values;
  }
  void fail(const std::exception_ptr& failure) {
    const std::scoped_lock lock(mutex_);
    if (!failure_) failure_ = failure;
    has_come_.notify_all();
  }
  /// Of the first rank that failed; null: none has.
  std::exception_ptr failure() const { return failure_; }

 private:
  std::size_t count_;
  std::mutex mutex_;
  std::condition_variable has_come_;
  std::vector<std::deque<std::vector<double>>> on_the_way_;  ///< [from count + to]
  std::exception_ptr failure_;
};

class RankOfProcess final : public Ranks {
 public:
  RankOfProcess(Post& post, std::size_t own) : post_(post), own_(own) {}
  std::size_t count() const override { return post_.count(); }
  std::size_t own() const override { return own_; }
  void send(std::size_t to, std::span<const double> values) override {
    post_.put(own_, to, values);
    ++sent_.messages;
    sent_.values += values.size();
  }
  void receive(std::size_t from, std::vector<double>& values) override { values = post_.take(from, own_); }
  Traffic sent() const override { return sent_; }

 private:
  Post& post_;
  std::size_t own_;
  Traffic sent_;
};

}  // namespace

Ranks& ranks() {
  static Alone alone;
  return current == nullptr ? alone : *current;
}

void Ranks::gather(std::span<const double> given, std::span<const std::size_t> sizes, std::vector<double>& all) {
  for (std::size_t r = 0; r < count(); ++r)
    if (r != own()) send(r, given);
  all.clear();
  for (std::size_t r = 0; r < count(); ++r) {
    const std::vector<double> taken = r == own() ? std::vector<double>(given.begin(), given.end()) : receive(r);
    if (taken.size() != sizes[r]) throw std::logic_error("ranks exchange vectors of different sizes");
    all.insert(all.end(), taken.begin(), taken.end());
  }
}

void run_as(Ranks& own, const std::function<void()>& body) {
  struct Restore {
    Ranks* before;
    ~Restore() { current = before; }
  } const restore{current};
  current = &own;
  body();
}

bool same_on_all_ranks(double value) {
  if (ranks().count() == 1) return true;
  std::vector<double> all;
  ranks().gather({&value, 1}, std::vector<std::size_t>(ranks().count(), 1), all);
  return std::ranges::all_of(all, [&](double other) { return other == value; });
}

bool on_any_rank(bool is_so) {
  return !same_on_all_ranks(is_so ? 1.0 : 0.0) || is_so;
}

int own_communicator() {
  return communicator;
}

void set_own_communicator(int own) {
  communicator = own;
}

void run_on_ranks(std::size_t count, const std::function<void()>& body) {
  Post post(count);
  {
    std::vector<std::jthread> threads;
    for (std::size_t r = 0; r < count; ++r)
      threads.emplace_back([&post, &body, r] {
        RankOfProcess own(post, r);
        const ThreadScope one(1);
        try {
          run_as(own, body);
        } catch (...) {
          post.fail(std::current_exception());
        }
      });
  }
  if (post.failure()) std::rethrow_exception(post.failure());
}

EntryRange share_of(std::size_t rank, std::size_t ranks, std::size_t n) {
  return {rank * n / ranks, (rank + 1) * n / ranks};
}

EntryRange own_share_of(std::size_t n) {
  return share_of(ranks().own(), ranks().count(), n);
}

std::size_t sharer_of(std::size_t entry, std::size_t ranks, std::size_t n) {
  std::size_t rank = entry * ranks / std::max<std::size_t>(1, n);
  while (entry >= share_of(rank, ranks, n).end) ++rank;
  while (entry < share_of(rank, ranks, n).begin) --rank;
  return rank;
}

std::pair<double, std::size_t> largest_on_ranks(double value, std::size_t position) {
  if (ranks().count() == 1) return {value, position};
  std::vector<double> all;
  ranks().gather(std::array{value, static_cast<double>(position)}, std::vector<std::size_t>(ranks().count(), 2), all);
  std::pair largest{value, position};
  for (std::size_t k = 0; k < all.size(); k += 2) {
    const std::pair its{all[k], static_cast<std::size_t>(all[k + 1])};
    if (its.first > largest.first || (its.first == largest.first && its.second < largest.second)) largest = its;
  }
  return largest;
}

RangesInPieces::RangesInPieces(std::span<const EntryRange> ranges) : ranges_(ranges) {
  for (const EntryRange& range : ranges) left_ += range.size();
}

std::size_t RangesInPieces::next_size(std::size_t width) const {
  constexpr std::size_t values = 1U << 17U;  // 1 MB
  return width * std::min(left_, std::max<std::size_t>(1, values / width));
}

void RangesInPieces::next(std::size_t width, const std::function<void(std::size_t, std::size_t)>& body) {
  for (std::size_t wanted = next_size(width) / width; wanted > 0;) {
    const EntryRange& range = ranges_.front();
    const std::size_t begin = range.begin + done_, size = std::min(wanted, range.size() - done_);
    if (size > 0) body(width * begin, width * (begin + size));
    wanted -= size;
    left_ -= size;
    done_ += size;
    if (done_ < range.size()) continue;
    ranges_ = ranges_.subspan(1);
    done_ = 0;
  }
}

void Exchange::gather(std::span<double> values, std::size_t width) const {
  const std::size_t count = of_ranks_.size(), own_rank = ranks().own();
  if (count == 1) return;
  thread_local std::vector<double> own, all;  // memory that is new costs more than what is copied to it
  std::vector<RangesInPieces> left(of_ranks_.begin(), of_ranks_.end());
  std::vector<std::size_t> sizes(count);
  while (std::ranges::any_of(left, [](const RangesInPieces& of_rank) { return of_rank.left() > 0; })) {
    for (std::size_t r = 0; r < count; ++r) sizes[r] = left[r].next_size(width);
    own.clear();
    left[own_rank].next(width, [&](std::size_t begin, std::size_t end) {
      own.insert(own.end(), values.begin() + static_cast<std::ptrdiff_t>(begin),
                 values.begin() + static_cast<std::ptrdiff_t>(end));
    });
    ranks().gather(own, sizes, all);
    auto next = all.cbegin();
    for (std::size_t r = 0; r < count; ++r) {
      if (r != own_rank)
        left[r].next(width, [&](std::size_t begin, std::size_t end) {
          const auto last = next + static_cast<std::ptrdiff_t>(end - begin);
          std::copy(next, last, values.begin() + static_cast<std::ptrdiff_t>(begin));
          next = last;
        });
      else
        next += static_cast<std::ptrdiff_t>(sizes[r]);
    }
  }
}

void Exchange::collect(std::span<double> values, std::size_t width) const {
  const std::size_t own_rank = ranks().own();
  const auto at = [&](std::size_t value) { return values.begin() + static_cast<std::ptrdiff_t>(value); };
  thread_local std::vector<double> piece;
  for (std::size_t r = 1; r < of_ranks_.size(); ++r) {
    if (own_rank != 0 && own_rank != r) continue;
    for (RangesInPieces left(of_ranks_[r]); left.left() > 0;) {
      if (own_rank == 0) {
        ranks().receive(r, piece);
        auto next = piece.cbegin();
        left.next(width, [&](std::size_t begin, std::size_t end) {
          std::copy_n(next, end - begin, at(begin));
          next += static_cast<std::ptrdiff_t>(end - begin);
        });
      } else {
        piece.clear();
        left.next(width, [&](std::size_t begin, std::size_t end) { piece.insert(piece.end(), at(begin), at(end)); });
        ranks().send(0, piece);
        ranks().settle();
      }
    }
  }
}

}  // namespace carom
