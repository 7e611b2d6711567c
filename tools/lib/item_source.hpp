// SPDX-License-Identifier: Apache-2.0
// The source of the items of an offline run and of the texts that belong to them: a control, or a list in a test.
#pragma once

#include "nc/nc.h"
#include "runtime/programs/encoding.hpp"

namespace nc::tools {

/** The part system that the offline tools run. */
inline constexpr unsigned kPartSystem = 0;

/** The calls of libnc that an offline run makes. They have the same meaning as the functions of the same name in nc/run.h and
 * nc/control.h. */
class ItemSource {
 public:
  virtual ~ItemSource() = default;
  virtual nc_status pull(uint32_t budget, nc_item* item) = 0;
  /** As pull(), but passes over moves (nc_pull_past). A source that has none of it gives every item. */
  virtual nc_status pull_past(uint32_t budget, nc_passed* /*passed*/, nc_item* item) { return pull(budget, item); }
  virtual nc_status answer(const nc_world& world) = 0;
  virtual nc_status reset() = 0;
  /** Drops what was read beyond this mark; 0 = drops everything. */
  virtual nc_status rewind(uint64_t /*serial*/) { return NC_OK; }
  /** Sets the level of the macro interrupt signal. @return true when the item pulled last must not be executed. */
  virtual bool interrupt(bool /*on*/) { return false; }
  /** The item pulled last has been executed up to this place, where the axes stand: an interrupt or a reset comes there (nc_position_set). */
  virtual void stand(const nc_axes& /*machine*/) {}
  /** F of a helix is the speed in the plane of its arc (M700 6.6). */
  virtual bool helix_in_plane() { return false; }
  /** The language has operation alarms (operation_alarm.hpp); `digits`: F1 to F5 may be feeds of one digit (M700 7.3, #1079). */
  virtual bool operation_alarms(bool* /*digits*/) { return false; }
  /** Only this part of the move pulled last is executed, from one share of its length to another. */
  virtual void part(double /*from*/, double /*to*/) {}
  /** A point of the move pulled last, or of the part of it that is executed; false when the source has none. */
  virtual bool move_point(double /*share*/, nc_axes* /*machine*/) { return false; }
  /** Workpiece zero of the move pulled last, including the tool length (nc_move_zero); false when the source has none. */
  virtual bool move_zero(nc_axes* /*zero*/) { return false; }
  /** Side of the move pulled last (nc_move_side); false when the source has none. */
  virtual bool move_side(nc_side* /*side*/, uint8_t /*plane_axis*/[2]) { return false; }
  /** Changes positions to what the counters show (nc_position_shown). */
  virtual void shown(nc_axes* /*machine*/, nc_axes* /*work*/) {}
  /** Line of the main program to which a block belongs, of the item pulled last (nc_main_line_get); 0 = not known. */
  virtual uint32_t main_line(const nc_source& source) { return source.depth == 0 ? source.line : 0; }
  /** A tool of the table of tool life has cut for so long (nc_tool_life_cut). */
  virtual void wear(unsigned /*place*/, uint32_t /*tool*/, double /*minutes*/) {}
  /** A hash of everything that can influence the program (loop_watch.hpp). */
  virtual uint64_t program_state() { return 0; }
  virtual bool alarm(nc_alarm* alarm) = 0;
  virtual bool text(uint32_t id, nc_text* text) = 0;
  /** Codes of a modal snapshot. @return their number. */
  virtual unsigned modal_codes(uint32_t id, char (*codes)[8], unsigned capacity) = 0;
  /** The M code of the optional stop. */
  virtual uint32_t optional_stop_code() { return 1; }
  virtual bool next_common(uint32_t from, uint32_t* number, double* value) = 0;
};

/** Items of one part system of a control. */
class ControlSource final : public ItemSource {
 public:
  ControlSource(nc_control* control, nc_dialect dialect, unsigned system = kPartSystem) : control_(control), dialect_(dialect), system_(system) {}
  nc_status pull(uint32_t budget, nc_item* item) override {
    part(0.0, 1.0);
    return nc_pull(control_, system_, budget, item);
  }
  nc_status pull_past(uint32_t budget, nc_passed* passed, nc_item* item) override {
    return nc_pull_past(control_, system_, budget, passed, item);
  }
  nc_status answer(const nc_world& world) override { return nc_answer(control_, system_, &world); }
  bool interrupt(bool on) override {
    bool take_back = false;
    nc_interrupt_signal(control_, system_, on, &take_back);
    return take_back;
  }
  void stand(const nc_axes& machine) override { nc_position_set(control_, system_, &machine); }
  bool helix_in_plane() override { return is_set("1235/bit0"); }
  bool operation_alarms(bool* digits) override {
    *digits = is_set("1079");
    return dialect_ == NC_DIALECT_M700;
  }
  void part(double from, double to) override {
    from_ = from;
    to_ = to;
  }
  bool move_point(double share, nc_axes* machine) override {
    return nc_move_point(control_, system_, from_ + share * (to_ - from_), machine) == NC_OK;
  }
  bool move_zero(nc_axes* zero) override { return nc_move_zero(control_, system_, zero) == NC_OK; }
  bool move_side(nc_side* side, uint8_t plane_axis[2]) override { return nc_move_side(control_, system_, side, plane_axis) == NC_OK; }
  void shown(nc_axes* machine, nc_axes* work) override {
    nc_position_shown(control_, system_, machine, work);
  }
  uint32_t main_line(const nc_source& source) override {
    uint32_t line = 0;
    nc_main_line_get(control_, system_, &source, &line);
    return line;
  }
  void wear(unsigned place, uint32_t tool, double minutes) override { nc_tool_life_cut(control_, place, tool, minutes); }
  uint64_t program_state() override {
    uint64_t hash = 0;
    nc_program_state_hash(control_, system_, &hash);
    return hash;
  }
  nc_status rewind(uint64_t serial) override { return nc_rewind(control_, system_, serial); }
  nc_status reset() override { return nc_reset(control_, system_); }
  bool alarm(nc_alarm* alarm) override {
    if (nc_alarm_get(control_, system_, alarm) != NC_OK) return false;
    rt::make_valid(alarm->detail.s, sizeof alarm->detail.s);
    return true;
  }
  bool text(uint32_t id, nc_text* text) override {
    if (nc_text_get(control_, system_, id, text) != NC_OK) return false;
    if (text->size == 0) rt::make_valid(text->s, sizeof text->s);  // size != 0: bytes of BPRNT, which stay as they are
    return true;
  }
  unsigned modal_codes(uint32_t id, char (*codes)[8], unsigned capacity) override {
    nc_modal modal;
    if (nc_modal_get(control_, system_, id, &modal) != NC_OK) return 0;
    return nc_modal_codes_get(control_, &modal, codes, capacity);
  }
  uint32_t optional_stop_code() override {
    constexpr uint32_t kMost = 999;
    uint32_t code = 0;
    while (code < kMost && nc_code_role_get(dialect_, 'M', code) != NC_CODE_OPTIONAL_STOP) ++code;
    return code;
  }
  bool next_common(uint32_t from, uint32_t* number, double* value) override {
    return nc_variable_next(control_, system_, from, number, value) == NC_OK;
  }

 private:
  bool is_set(const char* key) const {  // a parameter of M700
    double value = 0.0;
    return dialect_ == NC_DIALECT_M700 && nc_parameter_get(control_, system_, key, 0, &value) == NC_OK && value != 0.0;
  }

  nc_control* control_;
  nc_dialect dialect_;
  const unsigned system_;
  double from_ = 0.0, to_ = 1.0;  // part of the move pulled last that is executed
};

}  // namespace nc::tools
