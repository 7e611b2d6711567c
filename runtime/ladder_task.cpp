// SPDX-License-Identifier: Apache-2.0
// The ladder program in the scan.
#include "runtime/ladder_task.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace nc::rt {
namespace {

constexpr std::size_t kLargestProgram = 8u << 20;  // bytes of text

// Only regular files are read: opening a pipe would block, and reading a device may never end.
bool read_text(const std::string& path, std::string* text, std::string* error) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat status {};
  if (file < 0 || fstat(file, &status) != 0) {
    *error = std::string("cannot be read: ") + std::strerror(errno);
  } else if (!S_ISREG(status.st_mode)) {
    *error = S_ISDIR(status.st_mode) ? "is a folder, not a ladder program" : "is no file: a ladder program is text in a file";
  } else if (status.st_size == 0) {
    *error = "is empty: a ladder program has at least END";
  } else if (static_cast<std::uint64_t>(status.st_size) > kLargestProgram) {
    *error = "larger than " + std::to_string(kLargestProgram >> 20) + " MB";
  } else {
    text->resize(static_cast<std::size_t>(status.st_size));
    const ssize_t got = pread(file, text->data(), text->size(), 0);
    if (got < 0) *error = std::string("cannot be read: ") + std::strerror(errno);
    else text->resize(static_cast<std::size_t>(got));
  }
  if (file >= 0) close(file);
  return error->empty();
}

ladder::DeviceType point_device(const hal::Point& point) {
  return point.type == hal::PointType::kBit ? ladder::DeviceType::kBit : ladder::DeviceType::kWord32;
}

}  // namespace

std::unique_ptr<LadderTask> LadderTask::create(const Config& config, std::vector<ConfigError>* errors) {
  std::unique_ptr<LadderTask> task(new LadderTask);
  if (!task->load(config, errors)) return nullptr;
  return task;
}

// The device of a point has the name of the point; the device "<name>.good" is its quality. The program must not write an output point that
// the configuration connects with a signal of the NC, or that the control sets for an axis: its value would count for nothing.
ladder::DeviceTable LadderTask::device_table(const Config& config, std::vector<ConfigError>* errors) {
  ladder::DeviceTable table;
  for (const Signal& signal : machine_signals(config.nc))  // all names differ, which a test checks
    (void)table.add(signal.name, signal.row->type, signal.row->direction == SignalDirection::kToNc, signal.row->meaning);
  for (unsigned p = 0; p < config.points.size(); ++p) {
    const hal::Point& point = config.points.at(p);
    const bool output = point.direction == hal::PointDirection::kOutput && !config.is_wired_output(p) && !config.is_set_for_axis(p);
    const auto device = table.add(point.name, point_device(point), output,
                                  point.meaning.empty() ? "point of the machine" : point.meaning);
    const auto good = table.add(point.name + ".good", ladder::DeviceType::kBit, false, "the bus of the point answers");
    if (device < 0 || good < 0)
      errors->push_back({config.file, 0, "point", "\"" + point.name + "\" is the name of a signal"});
  }
  return table;
}

void LadderTask::find_places(const Config& config, const ladder::DeviceTable& table) {
  const std::vector<Signal> signals = machine_signals(config.nc);
  to_nc_.reserve(signals.size());  // no reallocation, because by_signal_ holds pointers into it
  for (const Signal& signal : signals) {
    const bool writable = signal.row->direction == SignalDirection::kToNc;
    (writable ? to_nc_ : from_nc_)
        .push_back({signal.row, signal.system, signal.index, table.find(signal.name)->index});
    by_signal_.push_back(writable ? &to_nc_.back() : nullptr);
  }
  for (unsigned p = 0; p < config.points.size(); ++p) {
    const hal::Point& point = config.points.at(p);
    const ladder::Device& device = *table.find(point.name);
    const auto index = static_cast<std::uint16_t>(p);
    (device.writable ? outputs_ : inputs_).push_back({index, device.type, device.index});
    quality_.push_back({index, ladder::DeviceType::kBit, table.find(point.name + ".good")->index});
  }
}

void LadderTask::set_start_values(ladder::DeviceImage* image) const {
  for (const SignalPlace& place : to_nc_) image->set_value(place.row->type, place.device, place.row->safe);
  for (const PointPlace& place : outputs_) image->set_value(place.type, place.device, static_cast<std::int32_t>(points_->at(place.point).initial));
}

bool LadderTask::compile(const std::string& text, const std::string& file, ladder::Program* program, std::vector<ladder::Error>* errors) const {
  if (!ladder::compile(text, file, table_, options_, program, errors)) return false;
  if (program->instruction_count() != 0) return true;
  errors->push_back({file, 0, "", "holds no instruction: a ladder program has at least END"});
  return false;
}

bool LadderTask::load(const Config& config, std::vector<ConfigError>* errors) {
  const std::size_t before = errors->size();
  table_ = device_table(config, errors);
  const std::string path = config.ladder_file();
  std::string text, error;
  const ConfigPlace& place = config.ladder.program_place;
  if (!read_text(path, &text, &error)) errors->push_back({config.file, place.line, place.key, path + ": " + error});
  if (errors->size() != before) return false;
  options_.scan_s = config.cycle_us * 1e-6;
  options_.retain_counters = config.ladder.retain_counters;
  options_.retain_d_first = config.ladder.retain_d_first;
  options_.retain_d_count = config.ladder.retain_d_count;
  std::vector<ladder::Error> found;
  if (!compile(text, path, &program_, &found)) {
    for (const ladder::Error& e : found) errors->push_back({e.file, e.line, e.instruction, e.message});
    return false;
  }
  for (const ladder::Error& e : program_.warnings()) warnings_.push_back(e.text());
  engine_ = std::make_unique<ladder::Engine>(program_);
  names_ = std::make_unique<ladder::Engine>(program_);
  devices_ = engine_->make_image();
  ranges_ = engine_->retained();
  points_ = &config.points;
  find_places(config, table_);
  set_start_values(&devices_);
  fresh_ = copied_ = devices_;
  return true;
}

std::int32_t LadderTask::signal(unsigned place) const noexcept {
  const SignalPlace* to_nc = by_signal_[place];
  if (to_nc == nullptr) return 0;
  return fault() != ladder::kNoFault ? to_nc->row->safe : devices_.value(to_nc->row->type, to_nc->device);
}

void LadderTask::restart() noexcept {
  forces_.forget();
  copy_retained(devices_, &fresh_);
  std::copy(fresh_.bit.begin(), fresh_.bit.end(), devices_.bit.begin());
  std::copy(fresh_.word.begin(), fresh_.word.end(), devices_.word.begin());
  engine_->reset_fault();
  kept_fault_ = kept_line_ = 0;
  fault_kept_.store(false, std::memory_order_release);
}

// ---- forced devices, and reading one device from another thread ----

std::optional<ladder::Device> LadderTask::find_device(const std::string& name) const {
  const std::lock_guard lock(find_mutex_);
  const ladder::Device* device = names_->find(name);
  return device == nullptr ? std::nullopt : std::optional<ladder::Device>(*device);
}

std::int64_t LadderTask::force_number(const std::string& name, std::int64_t value, std::string* error) {
  const auto refuse = [&](const std::string& why) {
    *error = why;
    return std::int64_t{-1};
  };
  const std::optional<ladder::Device> device = find_device(name);
  if (!device) return refuse("no such device '" + name + "'");
  if (device->name.size() > 2 && (device->name.substr(0, 2) == "SM" || device->name.substr(0, 2) == "SD") &&
      device->name[2] >= '0' && device->name[2] <= '9')
    return refuse("'" + name + "' belongs to the engine and cannot be forced");
  if (!ForceTable::fits(device->type, value))
    return refuse(std::to_string(value) + " is not possible: '" + name + "' " +
                  (device->type == ladder::DeviceType::kBit      ? "is a bit"
                   : device->type == ladder::DeviceType::kWord16 ? "has 16 bits"
                                                                 : "has 32 bits"));
  int point = -1;
  for (const auto* places : {&inputs_, &outputs_})
    for (const PointPlace& place : *places)
      if (place.device == device->index &&
          (place.type == ladder::DeviceType::kBit) == (device->type == ladder::DeviceType::kBit))
        point = place.point;
  const bool output = point >= 0 && points_->at(static_cast<unsigned>(point)).direction == hal::PointDirection::kOutput;
  const std::int64_t number = forces_.number_of(device->name, *device, point, output);
  return number >= 0 ? number : refuse("too many different devices have been forced since the start");
}

std::int64_t LadderTask::write_number(const std::string& name, std::int64_t value, std::string* error) {
  if (const auto device = find_device(name); device && !device->writable) {
    *error = "'" + name + "' gets its value from the machine or from the NC in each scan: force it";
    return -1;
  }
  return force_number(name, value, error);
}

std::uint32_t LadderTask::read_device(const std::string& name, bool direct) {
  constexpr auto kPatience = std::chrono::milliseconds(200);
  const auto device = find_device(name);
  if (!device) return 0;
  if (direct) return static_cast<std::uint32_t>(devices_.value(device->type, device->index));
  question_.type = device->type;
  question_.index = device->index;
  question_.turn.store(kWanted, std::memory_order_release);
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  while (question_.turn.load(std::memory_order_acquire) != kFilled) {
    if (std::chrono::steady_clock::now() > give_up) {
      unsigned wanted = kWanted;
      if (question_.turn.compare_exchange_strong(wanted, kIdle)) return 0;
      break;  // the answer has come just now
    }
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  const auto value = static_cast<std::uint32_t>(question_.value);
  question_.turn.store(kIdle, std::memory_order_release);
  return value;
}

// ---- retained devices ----

void LadderTask::copy_retained(const ladder::DeviceImage& from, ladder::DeviceImage* to) const noexcept {
  for (const ladder::RetainedRange& range : ranges_) {
    if (range.words) std::copy_n(from.word.begin() + range.first, range.count, to->word.begin() + range.first);
    else std::copy_n(from.bit.begin() + range.first, range.count, to->bit.begin() + range.first);
  }
}

std::vector<RetainedRow> LadderTask::rows_of(const ladder::DeviceImage& image) const {
  std::vector<RetainedRow> rows;
  for (const ladder::RetainedRange& range : ranges_) {
    RetainedRow row{range.name, range.number, std::vector<std::int16_t>(range.count)};
    for (std::uint32_t i = 0; i < range.count; ++i)
      row.values[i] = static_cast<std::int16_t>(range.words ? image.word[range.first + i] : image.bit[range.first + i]);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<RetainedRow> LadderTask::retained() const {
  return rows_of(devices_);
}

// Sets the devices that were retained when the rows were written and are retained now. All others are skipped.
void LadderTask::restore(const std::vector<RetainedRow>& rows) {
  for (const ladder::RetainedRange& range : ranges_)
    for (const RetainedRow& row : rows) {
      if (row.name != range.name) continue;
      for (std::size_t i = 0; i < row.values.size(); ++i) {
        const std::uint64_t number = std::uint64_t{row.first} + i;
        if (number < range.number || number >= std::uint64_t{range.number} + range.count) continue;
        const auto place = range.first + static_cast<std::uint32_t>(number - range.number);
        if (range.words) devices_.word[place] = row.values[i];
        else devices_.bit[place] = row.values[i] != 0;
      }
    }
}

void LadderTask::want_retained() {
  if (turn_.load(std::memory_order_relaxed) == kIdle) turn_.store(kWanted, std::memory_order_release);
}

bool LadderTask::take_retained(std::vector<RetainedRow>* rows) {
  if (turn_.load(std::memory_order_acquire) != kFilled) return false;
  *rows = rows_of(copied_);
  turn_.store(kIdle, std::memory_order_release);
  return true;
}

// ---- the scan ----

// Answers the question of read_device(), if there is one.
void LadderTask::answer() noexcept {
  if (question_.turn.load(std::memory_order_acquire) != kWanted) return;
  question_.value = devices_.value(question_.type, question_.index);
  question_.turn.store(kFilled, std::memory_order_release);
}

void LadderTask::hold_outputs(hal::PointImage* points) noexcept {
  if (forces_.any() && fault() == ladder::kNoFault) forces_.hold_outputs(points);
}

void LadderTask::scan(LadderImage* image) noexcept {
  take_swap(image->points);
  for (const SignalPlace& place : from_nc_)
    devices_.set_value(place.row->type, place.device, place.row->read(*image, place.system, place.index));
  hal::PointImage& points = *image->points;
  const bool forced = forces_.any() && fault() == ladder::kNoFault;
  if (forced) {
    forces_.begin(&devices_, &points);
    forces_.hold_inputs(&points);
  }
  for (const PointPlace& place : inputs_)
    devices_.set_value(place.type, place.device, static_cast<std::int32_t>(points.value[place.point]));
  // The output devices start from the output points, because the NC program may have switched them since the last scan.
  for (const PointPlace& place : outputs_)
    devices_.set_value(place.type, place.device, static_cast<std::int32_t>(points.value[place.point]));
  for (const PointPlace& place : quality_) devices_.bit[place.device] = points.good[place.point];
  unsigned held = 0;
  const ladder::Hold* const holds = forced ? forces_.holds(&held) : nullptr;
  if (forced) forces_.hold_devices(&devices_);
  std::uint8_t* const flow = look_.begin();
  if (kept_fault_ == ladder::kNoFault) engine_->scan(&devices_, holds, held, flow);
  look_.end(devices_, image->status->scan);
  answer();
  if (turn_.load(std::memory_order_acquire) == kWanted) {
    copy_retained(devices_, &copied_);
    turn_.store(kFilled, std::memory_order_release);
  }
  if (fault() != ladder::kNoFault) {  // signals to the NC get their safe values; output points keep theirs
    image->requests->stopped = true;
    image->requests->stopped_line = kept_fault_ != ladder::kNoFault ? kept_line_ : engine_->fault_line();
    image->requests->stopped_fault = fault();
    for (const SignalPlace& place : to_nc_) place.row->write(place.row->safe, image, place.system, place.index);
    return;
  }
  for (const PointPlace& place : outputs_)
    points.value[place.point] = static_cast<std::uint32_t>(devices_.value(place.type, place.device));
  for (const SignalPlace& place : to_nc_)
    place.row->write(devices_.value(place.row->type, place.device), image, place.system, place.index);
}

}  // namespace nc::rt
