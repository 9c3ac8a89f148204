// A job of as many processes as mpirun starts: messages by MPI.
#include "parallel/job.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace carom {
namespace {

constexpr int tag = 1;

/// The processes of this machine whose cores are not all others than those of this one.
int processes_on_own_cores() {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int count = 0;
  MPI_Comm_size(machine, &count);
  cpu_set_t own;
  if (sched_getaffinity(0, sizeof own, &own) != 0) std::memset(&own, 0xff, sizeof own);  // all of very many
  std::vector<cpu_set_t> all(static_cast<std::size_t>(count));
  MPI_Allgather(&own, sizeof own, MPI_BYTE, all.data(), sizeof own, MPI_BYTE, machine);
  MPI_Comm_free(&machine);
  return static_cast<int>(std::ranges::count_if(all, [&](const cpu_set_t& other) {
    cpu_set_t both;
    CPU_AND(&both, &own, &other);
    return CPU_COUNT(&both) > 0;
  }));
}

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int count = 0, own = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    MPI_Comm_rank(MPI_COMM_WORLD, &own);
    count_ = static_cast<std::size_t>(count);
    own_ = static_cast<std::size_t>(own);
    MPI_Comm_dup(MPI_COMM_WORLD, &gathers_);  // the end of the job is agreed on beside them
    on_same_cores_ = processes_on_own_cores();
  }
  std::size_t count() const override { return count_; }
  std::size_t own() const override { return own_; }
  void send(std::size_t to, std::span<const double> values) override {
    forget_sent();
    Letter& letter = on_the_way_.emplace_back();
    if (const auto spare = spare_.lower_bound(values.size()); spare != spare_.end())
      letter.values = std::move(spare_.extract(spare).mapped());
    letter.values.assign(values.begin(), values.end());
    MPI_Isend(letter.values.data(), static_cast<int>(values.size()), MPI_DOUBLE, static_cast<int>(to), tag,
              MPI_COMM_WORLD, &letter.request);
    ++sent_.messages;
    sent_.values += values.size();
  }
  void receive(std::size_t from, std::vector<double>& values) override {
    MPI_Status status;
    MPI_Probe(static_cast<int>(from), tag, MPI_COMM_WORLD, &status);
    int size = 0;
    MPI_Get_count(&status, MPI_DOUBLE, &size);
    values.resize(static_cast<std::size_t>(size));
    MPI_Recv(values.data(), size, MPI_DOUBLE, static_cast<int>(from), tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  }
  void settle() override {
    for (Letter& letter : on_the_way_) MPI_Wait(&letter.request, MPI_STATUS_IGNORE);
    forget_sent();
  }
  void gather(std::span<const double> own, std::span<const std::size_t> sizes, std::vector<double>& all) override {
    std::vector<int> counts(sizes.begin(), sizes.end()), first(1, 0);
    for (const int count : counts) first.push_back(first.back() + count);
    all.resize(static_cast<std::size_t>(first.back()));
    MPI_Allgatherv(own.data(), static_cast<int>(own.size()), MPI_DOUBLE, all.data(), counts.data(), first.data(),
                   MPI_DOUBLE, gathers_);
    // As by recursive doubling, whatever MPI does.
    sent_.messages += static_cast<std::size_t>(std::bit_width(count_ - 1));
    sent_.values += all.size() * (count_ - 1) / count_;
  }
  int on_same_cores() const override { return on_same_cores_; }
  Traffic sent() const override { return sent_; }

 private:
  struct Letter {
    std::vector<double> values;
    MPI_Request request = MPI_REQUEST_NULL;
  };

  void forget_sent() {
    int is_done = 1;
    while (!on_the_way_.empty()) {
      MPI_Test(&on_the_way_.front().request, &is_done, MPI_STATUS_IGNORE);
      if (is_done == 0) return;
      std::vector<double>& values = on_the_way_.front().values;
      spare_.emplace(values.capacity(), std::move(values));
      on_the_way_.pop_front();
    }
  }

  std::size_t count_ = 0, own_ = 0;
  int on_same_cores_ = 1;
  MPI_Comm gathers_ = MPI_COMM_NULL;
  std::deque<Letter> on_the_way_;                          ///< MPI still reads their values
  std::multimap<std::size_t, std::vector<double>> spare_;  ///< by size, memory of letters that have arrived
  Traffic sent_;
};

std::unique_ptr<MpiRanks> of_job;

/// Waits until all processes have come here, of which one with an error gives up after a while: those that wait for
/// its messages never come. is_common: whether all of them have an error.
bool all_have_come(bool has_error, bool& is_common) {
  constexpr std::chrono::seconds patience{2};
  int all = has_error ? 1 : 0;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD, &request);
  const auto begin = std::chrono::steady_clock::now();
  for (;;) {
    int is_done = 0;
    MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
    is_common = is_done != 0 && all == 1;
    if (is_done != 0) return true;
    if (has_error && std::chrono::steady_clock::now() - begin > patience) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace

int run_job(int argc, char** argv, const std::function<JobEnd()>& body, const std::function<void(std::string)>& tell) {
  int given = 0;  // MPI is called by the main thread alone
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &given);
  set_own_communicator(MPI_Comm_c2f(MPI_COMM_SELF));
  of_job = std::make_unique<MpiRanks>();
  const std::size_t own = of_job->own(), count = of_job->count();
  const JobEnd end = body();
  const bool has_error = !end.error.empty();
  bool is_common = false;
  const bool have_come = all_have_come(has_error, is_common);
  if (has_error && own == 0) tell(end.error);
  if (has_error && own > 0 && !is_common) tell(fmt::format("rank {} of {}: {}", own, count, end.error));
  if (!have_come) {
    constexpr std::chrono::milliseconds until_it_is_read{300};  // mpirun passes on what was said while processes live
    std::this_thread::sleep_for(until_it_is_read);
    MPI_Abort(MPI_COMM_WORLD, end.code);
  }
  of_job.reset();
  MPI_Finalize();
  return own == 0 || has_error ? end.code : 0;  // the others judge nothing
}

Ranks& job_ranks() {
  return *of_job;
}

}  // namespace carom
