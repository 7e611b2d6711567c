// SPDX-License-Identifier: Apache-2.0
// A stand-in for libgpiod 1.6. See gpiod_stand_in.hpp.
#include "gpiod_stand_in.hpp"

#include <gpiod.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <map>
#include <memory>

namespace nc::test {

StandIn& stand_in() {
  static StandIn computer;
  return computer;
}

}  // namespace nc::test

using nc::test::stand_in;
using nc::test::StandInChip;
using nc::test::StandInLine;

struct gpiod_line {
  gpiod_chip* chip;
  StandInLine* line;
};
struct gpiod_chip {
  StandInChip* chip;
  std::map<unsigned, std::unique_ptr<gpiod_line>> lines;
};

namespace {

gpiod_chip* open_chip(StandInChip* chip) {
  ++stand_in().open;
  return new gpiod_chip{chip, {}};
}

int fails(int problem) {
  errno = problem;
  return -1;
}

// The library requires that a bulk has 1 to 64 lines of one chip.
void expect_bulk(const gpiod_line_bulk* bulk) {
  ASSERT_GE(bulk->num_lines, 1u);
  ASSERT_LE(bulk->num_lines, static_cast<unsigned>(GPIOD_LINE_BULK_MAX_LINES));
  for (unsigned i = 0; i < bulk->num_lines; ++i) EXPECT_EQ(bulk->lines[i]->chip, bulk->lines[0]->chip);
}

int request(gpiod_line_bulk* bulk, const char* consumer, int flags, const int* levels, bool edges = false) {
  expect_bulk(bulk);
  if (stand_in().request_error != 0 && stand_in().requests >= stand_in().requests_before) return fails(stand_in().request_error);
  for (unsigned i = 0; i < bulk->num_lines; ++i)
    if (bulk->lines[i]->line->request != 0) return fails(EBUSY);
  const unsigned number = ++stand_in().requests;
  for (unsigned i = 0; i < bulk->num_lines; ++i) {
    StandInLine& line = *bulk->lines[i]->line;
    line.consumer = consumer;
    line.flags = flags;
    line.request = number;
    line.output = levels != nullptr;
    line.edges = edges;
    if (levels != nullptr) line.level = levels[i];
  }
  return 0;
}

// Values are read and written for all lines of a request, in its order.
int usable(const gpiod_line_bulk* bulk, bool output) {
  expect_bulk(bulk);
  if (bulk->lines[0]->chip->chip->gone) return fails(ENODEV);
  for (unsigned i = 0; i < bulk->num_lines; ++i) {
    const StandInLine& line = *bulk->lines[i]->line;
    if (line.request == 0 || line.output != output) return fails(EPERM);
    EXPECT_EQ(line.request, bulk->lines[0]->line->request);
  }
  return 0;
}

}  // namespace

gpiod_chip* gpiod_chip_open_by_name(const char* name) {
  errno = stand_in().open_error != 0 ? stand_in().open_error : ENOENT;
  for (StandInChip& chip : stand_in().chips)
    if (chip.name == name) {
      if (chip.open_error != 0) errno = chip.open_error;
      else if (stand_in().open_error == 0) return open_chip(&chip);
    }
  return nullptr;
}
gpiod_chip* gpiod_chip_open_by_number(unsigned number) { return gpiod_chip_open_by_name(("gpiochip" + std::to_string(number)).c_str()); }
gpiod_chip* gpiod_chip_open(const char* path) { return gpiod_chip_open_by_name(std::string(path).substr(5).c_str()); }
void gpiod_chip_close(gpiod_chip* chip) {
  --stand_in().open;
  delete chip;
}
const char* gpiod_chip_label(gpiod_chip* chip) { return chip->chip->label.c_str(); }
unsigned gpiod_chip_num_lines(gpiod_chip* chip) { return static_cast<unsigned>(chip->chip->lines.size()); }
gpiod_line* gpiod_chip_get_line(gpiod_chip* chip, unsigned offset) {
  std::unique_ptr<gpiod_line>& line = chip->lines[offset];
  if (!line) line = std::make_unique<gpiod_line>(gpiod_line{chip, &chip->chip->lines.at(offset)});
  return line.get();
}
const char* gpiod_line_name(gpiod_line* line) { return line->line->name.empty() ? nullptr : line->line->name.c_str(); }
bool gpiod_line_is_used(gpiod_line* line) { return !line->line->owner.empty() || line->line->request != 0; }
const char* gpiod_line_consumer(gpiod_line* line) { return line->line->owner.c_str(); }

int gpiod_line_request_bulk_input_flags(gpiod_line_bulk* bulk, const char* consumer, int flags) { return request(bulk, consumer, flags, nullptr); }
int gpiod_line_request_bulk_both_edges_events_flags(gpiod_line_bulk* bulk, const char* consumer, int flags) { return request(bulk, consumer, flags, nullptr, true); }
int gpiod_line_event_wait_bulk(gpiod_line_bulk* bulk, const timespec* timeout, gpiod_line_bulk* ready) {
  if (usable(bulk, false) != 0) return -1;
  EXPECT_TRUE(timeout != nullptr && timeout->tv_sec == 0 && timeout->tv_nsec == 0) << "it would wait";
  ready->num_lines = 0;
  for (unsigned i = 0; i < bulk->num_lines; ++i) {
    EXPECT_TRUE(bulk->lines[i]->line->edges);
    if (!bulk->lines[i]->line->kept.empty()) gpiod_line_bulk_add(ready, bulk->lines[i]);
  }
  return ready->num_lines > 0 ? 1 : 0;
}
int gpiod_line_event_read_multiple(gpiod_line* line, gpiod_line_event* events, unsigned most) {
  std::vector<StandInLine::Edge>& kept = line->line->kept;
  unsigned count = 0;
  for (; count < most && count < kept.size(); ++count) {
    events[count].event_type = kept[count].rising ? GPIOD_LINE_EVENT_RISING_EDGE : GPIOD_LINE_EVENT_FALLING_EDGE;
    events[count].ts = {kept[count].seconds, kept[count].nanoseconds};
  }
  kept.erase(kept.begin(), kept.begin() + count);
  return static_cast<int>(count);
}
int gpiod_line_request_bulk_output_flags(gpiod_line_bulk* bulk, const char* consumer, int flags, const int* levels) { return request(bulk, consumer, flags, levels); }
int gpiod_line_get_value_bulk(gpiod_line_bulk* bulk, int* levels) {
  if (usable(bulk, false) != 0) return -1;
  ++stand_in().reads;
  for (unsigned i = 0; i < bulk->num_lines; ++i) levels[i] = bulk->lines[i]->line->level;
  return 0;
}
int gpiod_line_set_value_bulk(gpiod_line_bulk* bulk, const int* levels) {
  if (usable(bulk, true) != 0) return -1;
  ++stand_in().writes;
  for (unsigned i = 0; i < bulk->num_lines; ++i) bulk->lines[i]->line->level = levels[i];
  return 0;
}
void gpiod_line_release_bulk(gpiod_line_bulk* bulk) {
  expect_bulk(bulk);
  for (unsigned i = 0; i < bulk->num_lines; ++i) bulk->lines[i]->line->request = 0;
}
