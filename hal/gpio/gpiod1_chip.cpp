// SPDX-License-Identifier: Apache-2.0
// Lines of a chip through libgpiod 1.6 (Debian 12). Only this file uses the interface of that library, and it is built only where that version is found.
//
// This version requests lines in groups of at most 64 with the same direction and flags. It cannot use the debouncing of the kernel, so
// hal/gpio/line_bank.cpp debounces. A line with edges is a request of its own for the kernel, which keeps 16 edges of it.
#include <gpiod.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <tuple>
#include <utility>

#include "hal/gpio/chip_refusal.hpp"
#include "hal/gpio/line_chip.hpp"

namespace nc::hal::gpio {
namespace {

// What the kernel says of a line that has no interrupt. The chip is there, since it has just been opened.
bool gives_no_interrupt(int problem) { return problem == ENODEV || problem == ENXIO; }

int flags_of(const LineSetup& line) {
  int flags = line.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  if (line.bias == Bias::kNone) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE;
  if (line.bias == Bias::kPullUp) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
  if (line.bias == Bias::kPullDown) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
  if (line.drive == Drive::kOpenDrain) flags |= GPIOD_LINE_REQUEST_FLAG_OPEN_DRAIN;
  if (line.drive == Drive::kOpenSource) flags |= GPIOD_LINE_REQUEST_FLAG_OPEN_SOURCE;
  return flags;
}

constexpr unsigned kMostChips = 256;  // of the kernel (its GPIO_DEV_MAX); they have the numbers below

// The chip with this label; *found gets the number of such chips. Null when there is not exactly one, with the errno of a chip that cannot be opened by this user,
// because then its label cannot be read. The library's own way through all chips ends where one cannot be opened, whatever chip is looked for.
gpiod_chip* chip_by_label(const std::string& label, unsigned* found) {
  *found = 0;
  int problem = ENOENT;
  gpiod_chip* match = nullptr;
  for (unsigned number = 0; number < kMostChips; ++number) {
    gpiod_chip* chip = gpiod_chip_open_by_number(number);
    if (chip == nullptr) {
      if (errno != ENOENT) problem = errno;
      continue;
    }
    const bool same = label == gpiod_chip_label(chip);
    if (same) ++*found;
    if (same && match == nullptr) match = chip;
    else gpiod_chip_close(chip);
  }
  if (*found > 1) {
    gpiod_chip_close(match);
    match = nullptr;
  }
  errno = problem;
  return match;
}

constexpr unsigned kKept = 16;  // edges of a line that the kernel keeps

// Lines with the same direction and flags, with or without edges, which are requested together.
struct Bulk {
  gpiod_line_bulk lines = GPIOD_LINE_BULK_INITIALIZER;
  bool output = false;
  bool edges = false;
  std::vector<std::size_t> places;  // index in the request for each of the lines
};
using Levels = std::array<int, GPIOD_LINE_BULK_MAX_LINES>;

class GpiodChip final : public LineChip {
 public:
  ~GpiodChip() override { release(); }

  Opening request(const std::string& chip, const std::string& consumer, std::span<const LineSetup> lines, std::span<const std::uint8_t> values, std::string* error) override {
    release();
    Opening opening = open_chip(chip, error);
    if (opening == Opening::kOpen) opening = sort_lines(lines, error);
    if (opening == Opening::kOpen) opening = request_bulks(consumer, lines, values, error);
    if (opening != Opening::kOpen) release();
    return opening;
  }

  bool read(std::vector<std::uint8_t>* values, std::string* error) override {
    for (Bulk& bulk : bulks_) {
      if (bulk.output) continue;
      Levels levels{};
      if (gpiod_line_get_value_bulk(&bulk.lines, levels.data()) != 0) return failed(name_, "cannot be read", error);
      for (std::size_t i = 0; i < bulk.places.size(); ++i) (*values)[bulk.places[i]] = levels[i] != 0 ? 1 : 0;
    }
    return true;
  }

  bool write(std::span<const std::uint8_t> values, std::string* error) override {
    for (Bulk& bulk : bulks_) {
      if (!bulk.output) continue;
      const Levels levels = levels_of(bulk, values);
      if (gpiod_line_set_value_bulk(&bulk.lines, levels.data()) != 0) return failed(name_, "cannot be written", error);
    }
    return true;
  }

  bool edges(std::vector<LineEdge>* edges, std::string* error) override {
    for (Bulk& bulk : bulks_) {
      if (!bulk.edges) continue;
      const timespec at_once{};
      gpiod_line_bulk ready = GPIOD_LINE_BULK_INITIALIZER;
      if (gpiod_line_event_wait_bulk(&bulk.lines, &at_once, &ready) < 0) return failed(name_, "cannot be asked for edges", error);
      for (unsigned i = 0; i < gpiod_line_bulk_num_lines(&ready); ++i)
        if (!read_edges(bulk, gpiod_line_bulk_get_line(&ready, i), edges)) return failed(name_, "cannot be asked for edges", error);
    }
    return true;
  }

  void release() noexcept override {
    for (std::size_t i = 0; i < requested_; ++i) gpiod_line_release_bulk(&bulks_[i].lines);
    requested_ = 0;
    bulks_.clear();
    if (chip_ != nullptr) gpiod_chip_close(chip_);
    chip_ = nullptr;
  }

 private:
  // Reads what the kernel has kept of a line that has edges.
  static bool read_edges(const Bulk& bulk, gpiod_line* line, std::vector<LineEdge>* edges) {
    std::size_t place = 0;
    for (std::size_t i = 0; i < bulk.places.size(); ++i)
      if (bulk.lines.lines[i] == line) place = bulk.places[i];
    std::array<gpiod_line_event, kKept> events{};
    const int count = gpiod_line_event_read_multiple(line, events.data(), kKept);
    for (int i = 0; i < count; ++i) {
      const gpiod_line_event& event = events[static_cast<std::size_t>(i)];
      edges->push_back({place, event.event_type == GPIOD_LINE_EVENT_RISING_EDGE, event.ts.tv_sec * 1'000'000'000LL + event.ts.tv_nsec});
    }
    return count >= 0;
  }

  Opening open_chip(const std::string& name, std::string* error) {
    name_ = name;
    unsigned found = 0;
    if (name.front() == '/') {
      chip_ = gpiod_chip_open(name.c_str());
    } else {
      chip_ = chip_by_label(name, &found);
      const int labels = errno;
      if (chip_ == nullptr && found == 0) chip_ = gpiod_chip_open_by_name(name.c_str());
      if (chip_ == nullptr && errno == ENOENT) errno = labels;
    }
    if (chip_ != nullptr) return Opening::kOpen;
    if (found > 1) {
      *error = std::to_string(found) + " chips have the label \"" + name + "\": take the path of one";
      return Opening::kRefused;
    }
    const Opening opening = opening_of(errno);
    *error = opening == Opening::kNoChip ? "there is no chip \"" + name + "\"" : "chip \"" + name + "\" cannot be opened: " + std::strerror(errno);
    return opening;
  }

  // A name that two lines have is refused.
  Opening offset_of(const LineSetup& line, unsigned* offset, std::string* error) {
    const unsigned count = gpiod_chip_num_lines(chip_);
    *offset = line.offset;
    unsigned found = line.name.empty() && line.offset < count ? 1 : 0;
    for (unsigned i = 0; i < count && !line.name.empty(); ++i) {
      gpiod_line* each = gpiod_chip_get_line(chip_, i);
      const char* name = each != nullptr ? gpiod_line_name(each) : nullptr;
      if (name == nullptr || line.name != name) continue;
      if (found++ == 0) *offset = i;
    }
    if (found == 1) return Opening::kOpen;
    *error = found > 1 ? std::to_string(found) + " lines of chip \"" + name_ + "\" have the name \"" + line.name + "\": take the offset of one"
                       : "chip \"" + name_ + "\" has no line " + line.text() + " (it has " + std::to_string(count) + " lines)";
    return Opening::kRefused;
  }

  Opening sort_lines(std::span<const LineSetup> lines, std::string* error) {
    std::map<unsigned, std::size_t> owner;
    std::map<std::tuple<bool, bool, int>, std::size_t> filling;  // for each direction, edges and flags the bulk that takes further lines
    for (std::size_t i = 0; i < lines.size(); ++i) {
      unsigned offset = 0;
      if (const Opening opening = offset_of(lines[i], &offset, error); opening != Opening::kOpen) return opening;
      const auto [other, fresh] = owner.emplace(offset, i);
      if (!fresh) return twice(name_, lines[other->second], lines[i], error);
      gpiod_line* line = gpiod_chip_get_line(chip_, offset);
      if (line == nullptr) return refused(name_, lines[i], errno, error);
      if (gpiod_line_is_used(line)) return taken(name_, lines[i], gpiod_line_consumer(line), error);
      const std::tuple<bool, bool, int> kind(lines[i].output, lines[i].edges, flags_of(lines[i]));
      const auto place = filling.find(kind);
      if (place == filling.end() || bulks_[place->second].places.size() == GPIOD_LINE_BULK_MAX_LINES) {
        filling[kind] = bulks_.size();
        bulks_.emplace_back().output = lines[i].output;
        bulks_.back().edges = lines[i].edges;
      }
      Bulk& bulk = bulks_[filling[kind]];
      gpiod_line_bulk_add(&bulk.lines, line);
      bulk.places.push_back(i);
    }
    return Opening::kOpen;
  }

  Opening request_bulks(const std::string& consumer, std::span<const LineSetup> lines, std::span<const std::uint8_t> values, std::string* error) {
    for (Bulk& bulk : bulks_) {
      const LineSetup& first = lines[bulk.places.front()];
      const Levels levels = levels_of(bulk, values);
      int result = 0;
      if (bulk.output) result = gpiod_line_request_bulk_output_flags(&bulk.lines, consumer.c_str(), flags_of(first), levels.data());
      else if (bulk.edges) result = gpiod_line_request_bulk_both_edges_events_flags(&bulk.lines, consumer.c_str(), flags_of(first));
      else result = gpiod_line_request_bulk_input_flags(&bulk.lines, consumer.c_str(), flags_of(first));
      if (result != 0 && bulk.edges && gives_no_interrupt(errno)) return without_edges(name_, first, error);
      if (result != 0) return errno == EBUSY ? taken(name_, first, nullptr, error) : refused(name_, first, errno, error);
      ++requested_;
    }
    return Opening::kOpen;
  }

  static Levels levels_of(const Bulk& bulk, std::span<const std::uint8_t> values) {
    Levels levels{};
    for (std::size_t i = 0; i < bulk.places.size(); ++i) levels[i] = values[bulk.places[i]];
    return levels;
  }

  std::string name_;
  gpiod_chip* chip_ = nullptr;
  std::vector<Bulk> bulks_;
  std::size_t requested_ = 0;  // number of bulks_, from the first on, that the kernel has granted
};

}  // namespace

std::unique_ptr<LineChip> make_gpiod_chip() {
  return std::make_unique<GpiodChip>();
}

}  // namespace nc::hal::gpio
