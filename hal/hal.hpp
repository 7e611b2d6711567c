// SPDX-License-Identifier: Apache-2.0
// The hardware layer as the runtime sees it: one small interface, with one folder for each kind of machine and bus.
//
// The scan calls read() first and write() last, once per cycle. Both are NC_RT: no allocation, no lock, no
// system call. A slow bus has a thread of its own, with which these functions exchange data through memory.
#pragma once

#include <string>

#include "hal/points.hpp"
#include "nc/run.h"

namespace nc::hal {

// What the machine reports to one part system.
struct SystemFeedback {
  bool actual_valid = false;          // `actual` is measured
  nc_axes actual{};                   // machine position, mm or deg
  std::int64_t actual_ns = 0;         // when that was, in nanoseconds of CLOCK_MONOTONIC; 0 = when the scan began
  std::uint32_t following_fault = 0;  // bit per axis: following error beyond its limit
  std::uint32_t drive_fault = 0;      // bit per axis: the drive reports a fault
  std::uint32_t drive_fault_code[NC_MAX_AXES] = {};  // which fault, as drive_fault_text() of hal/drive_fault.hpp takes it
  std::uint32_t place_lost = 0;       // bit per axis: since the last scan it has begun to count from a zero that nobody knows, also where a reset has taken the fault away
  std::uint32_t spindle_fault = 0;    // bit per spindle, as drive_fault
  std::uint32_t spindle_fault_code[NC_MAX_SPINDLES] = {};
  std::uint32_t not_following = 0;    // bit per axis: its drive does not follow the command, because it is off, not yet on, or moves by itself. Then the
                                      // commanded position must follow the measured one
  std::uint32_t skip = 0;             // skip signals, bit n = signal n+1
  std::uint32_t skip_latched = 0;     // of these, the signals that came where `skip_place` is, by what has latched it
  nc_axes skip_place{};               // machine position, mm or deg
  std::uint32_t unclamped = 0;        // bit per axis: the index table is unclamped (nc_inputs::unclamped)
  nc_spindle_inputs spindle[NC_MAX_SPINDLES] = {};
  double spindle_age_s[NC_MAX_SPINDLES] = {};  // as nc_inputs::spindle_age_s
  bool fin = false;                   // completion of M, S, T or B (level, FIN1 style handshake)
};

struct Feedback {
  SystemFeedback system[NC_MAX_SYSTEMS];
  bool lost = false;  // the bus does not answer: positions and points are those of before
};

// What the control commands one part system of the machine.
struct SystemCommand {
  bool enable = false;      // drives on ...
  std::uint32_t off = 0;    // ... but for these, bit per axis
  bool reset = false;       // the operator's reset is on: drives get out of their faults
  nc_axes position{};       // commanded machine position of this cycle
  nc_axes velocity{};       // mm/s or deg/s
  std::uint8_t strobe = 0;  // bit 0 M, 1 S, 2 T, 3 B
  std::uint32_t m = 0, t = 0, b = 0;
  double spindle_rev_min[NC_MAX_SPINDLES] = {};  // speed that each is wanted at
  std::uint8_t spindle_selected = 0;             // bit n: spindle n+1 is the one of the S command
  std::uint8_t spindle_synchronous = 0;          // bit n: spindle n+1 stands, then follows `spindle_turns` (synchronous tap)
  double spindle_turns = 0;                      // revolutions since it was taken over, signed
  std::uint8_t servo_on = 0;                     // bit i: axis i, which is a spindle too, is to hold its position (C axis)
  std::uint8_t servo_ready = 0;                  // bit i: and `position` is what it follows
  std::uint64_t serial = 0;  // item in execution
  nc_source source{};        // and where it stands
  bool running = false;      // a program is in execution
  bool idle = false;         // no program is in execution or interrupted
  std::uint32_t unclamp = 0;  // bit per axis: the index table is to be unclamped
  std::uint16_t current_limit[NC_MAX_AXES] = {};  // percent of the rated current of each drive, 0 = the drive's own limit
  std::uint32_t stop_homing = 0;  // bit per axis: a drive that homes by itself comes to rest and gives that up
};

struct Command {
  SystemCommand system[NC_MAX_SYSTEMS];
};

class Hal {
 public:
  virtual ~Hal() = default;
  // Called before the first scan, in an ordinary thread. False with a sentence in *error when the machine cannot be
  // reached.
  virtual bool start(const PointImage& initial, std::string* error) = 0;
  // Called at the beginning of a scan: fills the feedback and the *input* points of the image. NC_RT.
  virtual void read(Feedback* feedback, PointImage* image) noexcept = 0;
  // Called at the end of a scan: takes the set-points and the *output* points of the image. NC_RT.
  virtual void write(const Command& command, const PointImage& image) noexcept = 0;
  // Called after the last scan, and after a failed start: sets outputs to their safe values and switches drives off.
  virtual void stop() noexcept = 0;
};

}  // namespace nc::hal
