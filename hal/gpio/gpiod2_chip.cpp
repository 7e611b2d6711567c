// SPDX-License-Identifier: Apache-2.0
// Lines of a chip through libgpiod 2. Only this file uses the interface of that version, and it is built only where it is found; gpiod1_chip.cpp is the same for
// 1.6, and its messages are the same.
//
// This version asks for lines with the same settings at once, too, at most 64 of them. The kernel debounces, and says times by CLOCK_MONOTONIC. It keeps 16 edges for
// each line of a request.
#include <dirent.h>
#include <gpiod.h>

#include <algorithm>
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

constexpr std::size_t kMostLines = 64, kKept = 64;  // lines of a request; edges that are read at a time

template <auto Free>
struct Freer {
  template <class Object>
  void operator()(Object* object) const noexcept {
    Free(object);
  }
};
using Chip = std::unique_ptr<gpiod_chip, Freer<gpiod_chip_close>>;
using ChipInfo = std::unique_ptr<gpiod_chip_info, Freer<gpiod_chip_info_free>>;
using LineInfo = std::unique_ptr<gpiod_line_info, Freer<gpiod_line_info_free>>;
using Settings = std::unique_ptr<gpiod_line_settings, Freer<gpiod_line_settings_free>>;
using LineConfig = std::unique_ptr<gpiod_line_config, Freer<gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, Freer<gpiod_request_config_free>>;
using Request = std::unique_ptr<gpiod_line_request, Freer<gpiod_line_request_release>>;
using EdgeBuffer = std::unique_ptr<gpiod_edge_event_buffer, Freer<gpiod_edge_event_buffer_free>>;

gpiod_line_value value_of(std::uint8_t value) { return value != 0 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE; }

gpiod_line_bias bias_of(Bias bias) {
  switch (bias) {
    case Bias::kNone: return GPIOD_LINE_BIAS_DISABLED;
    case Bias::kPullUp: return GPIOD_LINE_BIAS_PULL_UP;
    case Bias::kPullDown: return GPIOD_LINE_BIAS_PULL_DOWN;
    case Bias::kAsIs: break;
  }
  return GPIOD_LINE_BIAS_AS_IS;
}

gpiod_line_drive drive_of(Drive drive) {
  if (drive == Drive::kOpenDrain) return GPIOD_LINE_DRIVE_OPEN_DRAIN;
  return drive == Drive::kOpenSource ? GPIOD_LINE_DRIVE_OPEN_SOURCE : GPIOD_LINE_DRIVE_PUSH_PULL;
}

// Paths of all chips, in the order of their names.
std::vector<std::string> chip_paths() {
  std::vector<std::string> paths;
  DIR* folder = opendir("/dev");
  if (folder == nullptr) return paths;
  while (const dirent* entry = readdir(folder))
    if (const std::string path = std::string("/dev/") + entry->d_name; gpiod_is_gpiochip_device(path.c_str())) paths.push_back(path);
  closedir(folder);
  std::sort(paths.begin(), paths.end());
  return paths;
}

// The chip with this label; *found gets the number of such chips. Null when there is not exactly one, with the errno of a chip that cannot be opened by this user,
// because then its label cannot be read.
Chip chip_by_label(const std::string& label, unsigned* found) {
  *found = 0;
  int problem = ENOENT;
  Chip match;
  for (const std::string& path : chip_paths()) {
    Chip chip(gpiod_chip_open(path.c_str()));
    const ChipInfo info(chip ? gpiod_chip_get_info(chip.get()) : nullptr);
    if (!info) problem = errno;
    if (!info || label != gpiod_chip_info_get_label(info.get())) continue;
    if (++*found == 1) match = std::move(chip);
  }
  if (*found != 1) match.reset();
  errno = problem;
  return match;
}

// What lines of one request have in common: direction, edges, active low, bias, drive, debouncing.
using Kind = std::tuple<bool, bool, bool, Bias, Drive, unsigned>;
Kind kind_of(const LineSetup& line) { return {line.output, line.edges, line.active_low, line.bias, line.drive, line.debounce_ms}; }

struct Bulk {
  std::vector<unsigned> offsets;
  std::vector<std::size_t> places;  // index in the request for each of the lines
  bool output = false, edges = false;
  Request request;
};
using Levels = std::array<gpiod_line_value, kMostLines>;

class Gpiod2Chip final : public LineChip {
 public:
  ~Gpiod2Chip() override { release(); }

  Opening request(const std::string& chip, const std::string& consumer, std::span<const LineSetup> lines, std::span<const std::uint8_t> values, std::string* error) override {
    release();
    Opening opening = open_chip(chip, error);
    if (opening == Opening::kOpen) opening = sort_lines(lines, error);
    if (opening == Opening::kOpen) opening = request_bulks(consumer, lines, values, error);
    if (opening != Opening::kOpen) release();
    return opening;
  }

  bool read(std::vector<std::uint8_t>* values, std::string* error) override {
    for (const Bulk& bulk : bulks_) {
      if (bulk.output) continue;
      Levels levels{};
      if (gpiod_line_request_get_values(bulk.request.get(), levels.data()) != 0) return failed(name_, "cannot be read", error);
      for (std::size_t i = 0; i < bulk.places.size(); ++i) (*values)[bulk.places[i]] = levels[i] == GPIOD_LINE_VALUE_ACTIVE ? 1 : 0;
    }
    return true;
  }

  bool write(std::span<const std::uint8_t> values, std::string* error) override {
    for (const Bulk& bulk : bulks_) {
      if (!bulk.output) continue;
      Levels levels{};
      for (std::size_t i = 0; i < bulk.places.size(); ++i) levels[i] = value_of(values[bulk.places[i]]);
      if (gpiod_line_request_set_values(bulk.request.get(), levels.data()) != 0) return failed(name_, "cannot be written", error);
    }
    return true;
  }

  // What does not fit into one reading waits for the next one.
  bool edges(std::vector<LineEdge>* edges, std::string* error) override {
    for (const Bulk& bulk : bulks_) {
      if (!bulk.edges) continue;
      const int ready = gpiod_line_request_wait_edge_events(bulk.request.get(), 0);
      const int count = ready > 0 ? gpiod_line_request_read_edge_events(bulk.request.get(), buffer_.get(), kKept) : ready;
      if (count < 0) return failed(name_, "cannot be asked for edges", error);
      for (int i = 0; i < count; ++i) {
        gpiod_edge_event* event = gpiod_edge_event_buffer_get_event(buffer_.get(), static_cast<unsigned long>(i));
        const auto at = std::find(bulk.offsets.begin(), bulk.offsets.end(), gpiod_edge_event_get_line_offset(event));
        if (at == bulk.offsets.end()) continue;
        const bool rising = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE;
        edges->push_back({bulk.places[static_cast<std::size_t>(at - bulk.offsets.begin())], rising, static_cast<std::int64_t>(gpiod_edge_event_get_timestamp_ns(event))});
      }
    }
    return true;
  }

  bool debounces() const override { return true; }

  void release() noexcept override {
    bulks_.clear();
    chip_.reset();
  }

 private:
  Opening open_chip(const std::string& name, std::string* error) {
    name_ = name;
    unsigned found = 0;
    if (name.front() == '/') {
      chip_.reset(gpiod_chip_open(name.c_str()));
    } else {
      chip_ = chip_by_label(name, &found);
      const int labels = errno;
      if (!chip_ && found == 0) chip_.reset(gpiod_chip_open(("/dev/" + name).c_str()));
      if (!chip_ && errno == ENOENT) errno = labels;
    }
    if (found > 1) {
      *error = std::to_string(found) + " chips have the label \"" + name + "\": take the path of one";
      return Opening::kRefused;
    }
    if (!chip_) {
      const Opening opening = opening_of(errno);
      *error = opening == Opening::kNoChip ? "there is no chip \"" + name + "\"" : "chip \"" + name + "\" cannot be opened: " + std::strerror(errno);
      return opening;
    }
    const ChipInfo info(gpiod_chip_get_info(chip_.get()));
    if (!info) return refused_chip(error);
    lines_ = static_cast<unsigned>(gpiod_chip_info_get_num_lines(info.get()));
    if (!buffer_) buffer_.reset(gpiod_edge_event_buffer_new(kKept));
    return buffer_ ? Opening::kOpen : refused_chip(error);
  }

  // A name that two lines have is refused.
  Opening offset_of(const LineSetup& line, unsigned* offset, std::string* error) {
    *offset = line.offset;
    unsigned found = line.name.empty() && line.offset < lines_ ? 1 : 0;
    for (unsigned i = 0; i < lines_ && !line.name.empty(); ++i) {
      const LineInfo info(gpiod_chip_get_line_info(chip_.get(), i));
      const char* name = info ? gpiod_line_info_get_name(info.get()) : nullptr;
      if (name == nullptr || line.name != name) continue;
      if (found++ == 0) *offset = i;
    }
    if (found == 1) return Opening::kOpen;
    *error = found > 1 ? std::to_string(found) + " lines of chip \"" + name_ + "\" have the name \"" + line.name + "\": take the offset of one"
                       : "chip \"" + name_ + "\" has no line " + line.text() + " (it has " + std::to_string(lines_) + " lines)";
    return Opening::kRefused;
  }

  Opening sort_lines(std::span<const LineSetup> lines, std::string* error) {
    std::map<unsigned, std::size_t> owner;
    std::map<Kind, std::size_t> filling;  // for each kind the bulk that takes further lines
    for (std::size_t i = 0; i < lines.size(); ++i) {
      unsigned offset = 0;
      if (const Opening opening = offset_of(lines[i], &offset, error); opening != Opening::kOpen) return opening;
      const auto [other, fresh] = owner.emplace(offset, i);
      if (!fresh) return twice(name_, lines[other->second], lines[i], error);
      const LineInfo info(gpiod_chip_get_line_info(chip_.get(), offset));
      if (!info) return refused(name_, lines[i], errno, error);
      if (gpiod_line_info_is_used(info.get())) return taken(name_, lines[i], gpiod_line_info_get_consumer(info.get()), error);
      const Kind kind = kind_of(lines[i]);
      const auto place = filling.find(kind);
      if (place == filling.end() || bulks_[place->second].places.size() == kMostLines) {
        filling[kind] = bulks_.size();
        bulks_.emplace_back();
        bulks_.back().output = lines[i].output;
        bulks_.back().edges = lines[i].edges;
      }
      Bulk& bulk = bulks_[filling[kind]];
      bulk.offsets.push_back(offset);
      bulk.places.push_back(i);
    }
    return Opening::kOpen;
  }

  Opening request_bulks(const std::string& consumer, std::span<const LineSetup> lines, std::span<const std::uint8_t> values, std::string* error) {
    for (Bulk& bulk : bulks_) {
      const LineSetup& first = lines[bulk.places.front()];
      const RequestConfig request(gpiod_request_config_new());
      const LineConfig config = config_of(bulk, first, values);
      if (!request || !config) return refused(name_, first, errno, error);
      gpiod_request_config_set_consumer(request.get(), consumer.c_str());
      bulk.request.reset(gpiod_chip_request_lines(chip_.get(), request.get(), config.get()));
      if (bulk.request) continue;
      if (first.edges && (errno == ENODEV || errno == ENXIO)) return without_edges(name_, first, error);
      return errno == EBUSY ? taken(name_, first, nullptr, error) : refused(name_, first, errno, error);
    }
    return Opening::kOpen;
  }

  // The settings of all lines of a bulk, which are those of the first one, and the first values of outputs. Null with errno when they are refused.
  static LineConfig config_of(const Bulk& bulk, const LineSetup& line, std::span<const std::uint8_t> values) {
    const Settings settings(gpiod_line_settings_new());
    LineConfig config(gpiod_line_config_new());
    if (!settings || !config) return nullptr;
    bool good = gpiod_line_settings_set_direction(settings.get(), line.output ? GPIOD_LINE_DIRECTION_OUTPUT : GPIOD_LINE_DIRECTION_INPUT) == 0;
    good = good && gpiod_line_settings_set_bias(settings.get(), bias_of(line.bias)) == 0;
    good = good && (!line.output || gpiod_line_settings_set_drive(settings.get(), drive_of(line.drive)) == 0);
    good = good && (!line.edges || gpiod_line_settings_set_edge_detection(settings.get(), GPIOD_LINE_EDGE_BOTH) == 0);
    gpiod_line_settings_set_active_low(settings.get(), line.active_low);
    if (line.debounce_ms != 0) gpiod_line_settings_set_debounce_period_us(settings.get(), line.debounce_ms * 1000UL);
    good = good && gpiod_line_config_add_line_settings(config.get(), bulk.offsets.data(), bulk.offsets.size(), settings.get()) == 0;
    Levels levels{};
    for (std::size_t i = 0; i < bulk.places.size(); ++i) levels[i] = value_of(values[bulk.places[i]]);
    good = good && (!line.output || gpiod_line_config_set_output_values(config.get(), levels.data(), bulk.places.size()) == 0);
    if (!good) config.reset();
    return config;
  }

  Opening refused_chip(std::string* error) const {
    const int problem = errno;
    *error = "chip \"" + name_ + "\" cannot be asked for its lines: " + std::strerror(problem);
    return opening_of(problem);
  }

  std::string name_;
  unsigned lines_ = 0;  // of the chip
  Chip chip_;
  EdgeBuffer buffer_;
  std::vector<Bulk> bulks_;
};

}  // namespace

std::unique_ptr<LineChip> make_gpiod_chip() {
  return std::make_unique<Gpiod2Chip>();
}

}  // namespace nc::hal::gpio
