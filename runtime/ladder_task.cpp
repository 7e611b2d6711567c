// SPDX-License-Identifier: Apache-2.0
// The ladder program in the scan.
#include "runtime/ladder_task.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace nc::rt {
namespace {

constexpr std::size_t kLargestProgram = 8u << 20;  // bytes of text

bool read_text(const std::string& path, std::string* text, std::string* error) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    *error = std::string("cannot be read: ") + std::strerror(errno);
    return false;
  }
  std::ostringstream all;
  all << file.rdbuf();
  if (!file || !all) {
    *error = "cannot be read";
    return false;
  }
  *text = all.str();
  if (text->size() <= kLargestProgram) return true;
  *error = "larger than " + std::to_string(kLargestProgram >> 20) + " MB";
  return false;
}

}  // namespace

std::unique_ptr<LadderTask> LadderTask::create(const Config& config, std::vector<ConfigError>* errors) {
  std::unique_ptr<LadderTask> task(new LadderTask);
  if (!task->load(config, errors)) return nullptr;
  return task;
}

void LadderTask::add_signals(const Config& config, ladder::DeviceTable* table) {
  for (const Signal& signal : machine_signals(config.nc)) {
    const bool writable = signal.row->direction == SignalDirection::kToNc;
    const auto device = table->add(signal.name, signal.row->type, writable, signal.row->meaning);
    if (device < 0) continue;  // the names of the table differ (a test says so)
    (writable ? to_nc_ : from_nc_)
        .push_back({signal.row, signal.system, signal.index, static_cast<std::uint32_t>(device)});
  }
}

// A point has its own name; "<name>.good" is its quality.
void LadderTask::add_points(const Config& config, ladder::DeviceTable* table, std::vector<ConfigError>* errors) {
  for (unsigned p = 0; p < config.points.size(); ++p) {
    const hal::Point& point = config.points.at(p);
    const auto type =
        point.type == hal::PointType::kBit ? ladder::DeviceType::kBit : ladder::DeviceType::kWord32;
    const bool output = point.direction == hal::PointDirection::kOutput;
    const auto device = table->add(point.name, type, output, "point of the machine");
    const auto good = table->add(point.name + ".good", ladder::DeviceType::kBit, false, "the bus of the point answers");
    if (device < 0 || good < 0) {
      errors->push_back({config.file, 0, "point", "\"" + point.name + "\" is the name of a signal"});
      continue;
    }
    const auto index = static_cast<std::uint16_t>(p);
    (output ? outputs_ : inputs_).push_back({index, type, static_cast<std::uint32_t>(device)});
    quality_.push_back({index, ladder::DeviceType::kBit, static_cast<std::uint32_t>(good)});
  }
}

bool LadderTask::load(const Config& config, std::vector<ConfigError>* errors) {
  ladder::DeviceTable table;
  add_signals(config, &table);
  add_points(config, &table, errors);
  if (!errors->empty()) return false;
  const std::string path = config.ladder_file();
  std::string text, error;
  if (!read_text(path, &text, &error)) {
    errors->push_back({path, 0, "", error});
    return false;
  }
  ladder::CompileOptions options;
  options.scan_s = config.cycle_us * 1e-6;
  std::vector<ladder::Error> found;
  if (!ladder::compile(text, path, table, options, &program_, &found)) {
    for (const ladder::Error& e : found) errors->push_back({e.file, e.line, e.instruction, e.message});
    return false;
  }
  for (const ladder::Error& e : program_.warnings()) warnings_.push_back(e.text());
  engine_ = std::make_unique<ladder::Engine>(program_);
  devices_ = engine_->make_image();
  for (const SignalPlace& place : to_nc_) set(place.row->type, place.device, place.row->safe);
  for (const PointPlace& place : outputs_)
    set(place.type, place.device, static_cast<std::int32_t>(config.points.at(place.point).initial));
  return true;
}

std::int32_t LadderTask::get(const ladder::DeviceType type, std::uint32_t device) const noexcept {
  switch (type) {
    case ladder::DeviceType::kBit:
      return devices_.bit[device];
    case ladder::DeviceType::kWord16:
      return devices_.word[device];
    case ladder::DeviceType::kWord32:
      return devices_.word32(device);
  }
  return 0;
}

void LadderTask::set(ladder::DeviceType type, std::uint32_t device, std::int32_t value) noexcept {
  switch (type) {
    case ladder::DeviceType::kBit:
      devices_.bit[device] = value != 0;
      break;
    case ladder::DeviceType::kWord16:
      devices_.word[device] = static_cast<std::int16_t>(value);
      break;
    case ladder::DeviceType::kWord32:
      devices_.set_word32(device, value);
      break;
  }
}

void LadderTask::scan(LadderImage* image) noexcept {
  for (const SignalPlace& place : from_nc_)
    set(place.row->type, place.device, place.row->read(*image, place.system, place.index));
  hal::PointImage& points = *image->points;
  for (const PointPlace& place : inputs_)
    set(place.type, place.device, static_cast<std::int32_t>(points.value[place.point]));
  // Outputs as they stand: the NC program may have switched them since.
  for (const PointPlace& place : outputs_)
    set(place.type, place.device, static_cast<std::int32_t>(points.value[place.point]));
  for (const PointPlace& place : quality_) devices_.bit[place.device] = points.good[place.point];
  engine_->scan(&devices_);
  if (engine_->fault() != ladder::kNoFault) {  // signals as if there were no program; outputs as they are
    image->requests->stopped = true;
    image->requests->stopped_line = engine_->fault_line();
    for (const SignalPlace& place : to_nc_) place.row->write(place.row->safe, image, place.system, place.index);
    return;
  }
  for (const PointPlace& place : outputs_)
    points.value[place.point] = static_cast<std::uint32_t>(get(place.type, place.device));
  for (const SignalPlace& place : to_nc_)
    place.row->write(get(place.row->type, place.device), image, place.system, place.index);
}

}  // namespace nc::rt
