#include "output/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace carom {

namespace {

constexpr std::chrono::milliseconds kLiveInterval{100};
constexpr double kLineEvery = 0.05;
constexpr int kDefaultWidth = 80;

int terminal_width(std::FILE* stream) {
  winsize size{};
  if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kDefaultWidth;
  return size.ws_col;
}

double share_of_time(double t, double t_end) {
  if (!(t_end > 0.0) || !std::isfinite(t)) return 0.0;
  return std::clamp(t / t_end, 0.0, 1.0);
}

double share_of_steps(const ProgressUpdate& now) {
  const double made = static_cast<double>(now.step), all = made + now.steps_left;
  return all > 0.0 && std::isfinite(all) ? std::clamp(made / all, 0.0, 1.0) : 0.0;
}

/// Unicode eighths of a block; `width` columns, three bytes each.
std::string bar(double fraction, int width) {
  const auto full = static_cast<int>(fraction * width);
  std::string text;
  for (int i = 0; i < width; ++i) text += i < full ? "█" : "░";
  return text;
}

/// What stands beside the bar, most important first; every character is one column.
std::vector<std::string> entries(const ProgressUpdate& now, double seconds_left) {
  const double percent = std::floor(100.0 * share_of_steps(now) + 1e-9);
  std::vector<std::string> list{fmt::format("{:3.0f} %", percent), fmt::format("t {:.4g}", now.t)};
  if (std::isfinite(seconds_left)) list.push_back("left " + duration_text(seconds_left));
  list.push_back(fmt::format("step {}", now.step));
  list.push_back(fmt::format("dt {:.3g}", now.dt));
  if (now.iterations > 0) list.push_back(fmt::format("it {}", now.iterations));
  list.push_back(fmt::format("kinetic {:.3g}", now.kinetic));
  if (now.force > 0.0) list.push_back(fmt::format("force {:.3g}", now.force));
  list.push_back(fmt::format("energy error {:.1e}", now.energy_error));
  return list;
}

/// A terminal or pipe that has gone must not end a run, so its errors are passed over.
void show(std::FILE* stream, const std::string& text) {
  std::fputs(text.c_str(), stream);
  std::fflush(stream);
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 59.5) return fmt::format("{:.0f} s", seconds);
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string progress_share(double t, double t_end, std::optional<double> seconds_left) {
  std::string text = t_end > 0.0 ? fmt::format("{:.0f} % of the time", 100.0 * share_of_time(t, t_end)) : "";
  if (seconds_left) text += fmt::format(", about {} left", duration_text(*seconds_left));
  return text;
}

std::string progress_line(const ProgressUpdate& now, double seconds_left, int width) {
  constexpr int kShortestBar = 8, kLongestBar = 30;
  std::string text;
  for (const std::string& entry : entries(now, seconds_left)) {
    const std::string longer = text.empty() ? entry : text + "  " + entry;
    if (static_cast<int>(longer.size()) > width) break;
    text = longer;
  }
  const int room = std::min(width - static_cast<int>(text.size()) - 1, kLongestBar);
  if (room < kShortestBar) return text;
  return bar(share_of_steps(now), room) + " " + text;
}

Progress::Progress(std::FILE* stream, ProgressMode mode)
    : stream_(stream), mode_(mode), last_shown_(Clock::now() - kLiveInterval) {
  if (mode_ == ProgressMode::automatic) {
    mode_ = ::isatty(::fileno(stream)) != 0 ? ProgressMode::live : ProgressMode::lines;
  }
}

void Progress::update(const ProgressUpdate& now) {
  if (mode_ != ProgressMode::quiet) follow(now);
  if (mode_ == ProgressMode::live) {
    show_live(now);
  } else if (mode_ == ProgressMode::lines) {
    show_line(now);
  }
}

/// What came before the first step, such as a factorisation, does not come again; and steps that take longer than
/// others, as in contact, are soon all that is looked at.
void Progress::follow(const ProgressUpdate& now) {
  constexpr std::chrono::milliseconds apart(100);
  constexpr std::size_t most = 50;
  const Clock::time_point time = Clock::now();
  if (!marks_.empty() && time - marks_.back().time < apart) return;
  marks_.push_back({time, now.step});
  if (marks_.size() > most) marks_.pop_front();
}

double Progress::seconds_left(const ProgressUpdate& now) const {
  if (now.steps_left == 0.0) return 0.0;
  if (marks_.empty() || now.step <= marks_.front().step) return std::numeric_limits<double>::quiet_NaN();
  return std::chrono::duration<double>(Clock::now() - marks_.front().time).count() * now.steps_left /
         static_cast<double>(now.step - marks_.front().step);
}

void Progress::show_live(const ProgressUpdate& now) {
  const Clock::time_point time = Clock::now();
  if (time - last_shown_ < kLiveInterval) return;
  last_shown_ = time;
  // The last column stays free: a full line would wrap on some terminals.
  show(stream_, fmt::format("\r{}\x1b[K", progress_line(now, seconds_left(now), terminal_width(stream_) - 1)));
  live_shown_ = true;
}

void Progress::show_line(const ProgressUpdate& now) {
  const double fraction = share_of_steps(now);
  if (fraction < next_line_ - 1e-9) return;
  next_line_ = kLineEvery * (std::floor(fraction / kLineEvery + 1e-9) + 1.0);
  show(stream_, fmt::format("{}\n", fmt::join(entries(now, seconds_left(now)), "  ")));
}

void Progress::clear_live() {
  if (!live_shown_) return;
  show(stream_, "\r\x1b[K");
  live_shown_ = false;
}

void Progress::finish(std::string_view message) {
  if (mode_ == ProgressMode::quiet) return;
  clear_live();
  if (!message.empty()) show(stream_, std::string(message) + "\n");
}

}  // namespace carom
