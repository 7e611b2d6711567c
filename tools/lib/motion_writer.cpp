// SPDX-License-Identifier: Apache-2.0
// See motion_writer.hpp.
#include "tools/lib/motion_writer.hpp"

#include <bit>
#include <charconv>
#include <cstring>

#include "tools/lib/number_text.hpp"

namespace nc::tools {
namespace {

constexpr int kDecimals = 12;
constexpr size_t kPositionText = 360;  // any double with 12 decimals and a comma

char* put_position(char* at, double value) {
  *at++ = ',';
  const auto end = std::to_chars(at, at + kPositionText - 1, value, std::chars_format::fixed, kDecimals).ptr;
  // A number that is rounded to zero is written without a sign, so that the same position always gives the same text.
  bool zero = *at == '-';
  for (const char* c = at + 1; zero && c < end; ++c) zero = *c == '0' || *c == '.';
  if (!zero) return end;
  std::memmove(at, at + 1, static_cast<size_t>(end - at - 1));
  return end - 1;
}

void put_little_endian(char* at, double value) {
  uint64_t bits = std::bit_cast<uint64_t>(value);
  for (size_t i = 0; i < sizeof bits; ++i, bits >>= 8) at[i] = static_cast<char>(bits & 0xFF);
}

}  // namespace

bool MotionCycles::counts(const nc_outputs& out) {
  bool counts = out.run_s > last_run_s_;
  last_run_s_ = out.run_s;
  for (unsigned i = 0; i < axis_count_; ++i) counts = counts || out.command.v[i] != last_.v[i];
  last_ = out.command;
  return counts;
}

MotionWriter::MotionWriter(OutputFile* out, const nc_config& config, MotionFormat format)
    : out_(*out),
      system_(config.system[0]),
      cycle_s_(config.cycle_s),
      format_(format),
      cycles_(system_.axis_count) {}

void MotionWriter::begin(const nc_axes& start) {
  if (format_ == MotionFormat::kCsv) {
    char* const head = out_.reserve(2 * NC_MAX_AXES + 2);
    size_t size = 0;
    head[size++] = 't';
    for (unsigned i = 0; i < system_.axis_count; ++i) {
      head[size++] = ',';
      head[size++] = system_.axis[i].name;
    }
    head[size++] = '\n';
    out_.advance(size);
  }
  cycles_.begin(start);
  row(start);
}

void MotionWriter::cycle(const nc_outputs& out) {
  if (cycles_.counts(out)) row(out.command);
}

void MotionWriter::row(const nc_axes& position) {
  const double t = static_cast<double>(rows_++) * cycle_s_;
  if (format_ == MotionFormat::kF64) {
    char* const to = out_.reserve(sizeof(double) * (NC_MAX_AXES + 1));
    put_little_endian(to, t);
    for (unsigned i = 0; i < system_.axis_count; ++i)
      put_little_endian(to + sizeof(double) * (i + 1), position.v[i]);
    out_.advance(sizeof(double) * (system_.axis_count + 1));
    return;
  }
  char* const to = out_.reserve(kNumberText + kPositionText * NC_MAX_AXES + 1);
  char* at = to + number_text(t, to);
  for (unsigned i = 0; i < system_.axis_count; ++i) at = put_position(at, position.v[i]);
  *at++ = '\n';
  out_.advance(static_cast<size_t>(at - to));
}

}  // namespace nc::tools
