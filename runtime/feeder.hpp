// SPDX-License-Identifier: Apache-2.0
// The feeder: reads ahead of the machine, takes what the machine has executed, completes resets, selects
// programs. It belongs to one ordinary thread (or, on virtual time, to the same thread as the scan, in
// turns); it may allocate.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "runtime/command.hpp"
#include "runtime/scan.hpp"

namespace nc::rt {

// What was executed, in order: the runtime's side of the item stream.
class EventSink {
 public:
  virtual ~EventSink() = default;
  virtual void executed(unsigned system, const nc_event& event) = 0;  // feeder thread
};

// The executed path, one sample per scan.
class PathSink {
 public:
  virtual ~PathSink() = default;
  virtual void moved(const PositionSample& sample) = 0;  // feeder thread
};

// What the feeder knows and readers want.
struct FeederInfo {
  struct Selected {
    bool any = false, mdi = false;
    std::uint32_t file = 0;
  };
  // Of one part system; what another does changes nothing of it.
  struct System {
    Selected selected;            // at its head or running
    bool ended = false;           // the last run came to its end (M02, M30); a reset, and a program that is selected, begin anew
    bool ended_ok = false;        // ... without an alarm
    std::uint64_t runs = 0;       // that ended
    std::uint32_t main_line = 0;  // line of the main program that was finished last
    std::uint64_t begun_again = 0;  // passes that M99 of the main program has begun, since it was selected or loaded
    std::uint32_t again_line = 0;   // where that M99 stands
    bool alarm = false;             // program_alarm holds
    nc_alarm program_alarm{};
    std::uint32_t alarm_calls = 0;  // blocks that led there, outermost first
    nc_source alarm_call[NC_MAX_CALLS] = {};
    std::string print_trouble;  // why a line that was printed is lost, the first reason since the last reset
    bool modal_known = false;
    nc_modal modal{};  // that the last finished block left
    // Bit a: axis a is shown within one turn, in machine and in workpiece coordinates (axis_shown.hpp).
    std::uint32_t machine_turn = 0, work_turn = 0;
  };
  System system[NC_MAX_SYSTEMS];
  std::uint64_t events = 0;     // items executed
  std::uint64_t dropped = 0;    // events that were not fetched in time
  // What is said to the operator.
  struct Message {
    unsigned system = 0;  // whose it is
    std::string text;
  };
  static constexpr std::size_t kMessagesKept = 64;
  std::uint64_t messages = 0;      // so far, of all part systems
  std::vector<Message> said;       // the last of them, oldest first
  // Those behind the first `seen`, as far as they are kept.
  std::span<const Message> messages_since(std::uint64_t seen) const {
    return std::span(said).last(static_cast<std::size_t>(std::min<std::uint64_t>(messages - seen, said.size())));
  }
};

// Enters the program of this name into the store: feeder thread, while nothing runs.
// With a sentence when it cannot.
using ProgramLoader = std::function<bool(const std::string& name, unsigned* file, std::string* error)>;
// New MDI blocks are in the control: what they call counts as it is in the files now. Feeder thread, while nothing runs.
using ProgramRefresh = std::function<void()>;
// Files whose programs run as they were when they were selected or called, and are others now: "part.nc, O77"; "" = none. Feeder thread, when a
// part program begins.
using ChangedPrograms = std::function<std::string()>;
// Takes what programs print (POPEN, DPRNT, PCLOS) when the machine gets there: feeder thread. Returns why a line could not be written,
// "" when it is.
using Printer = std::function<std::string(const nc_text& text)>;
// kSelectProgram with this number selects the program given by name.
inline constexpr std::uint32_t kProgramByName = ~0u;

class Feeder {
 public:
  Feeder(unsigned systems, NcPort* nc, Scan* scan);

  // One period: commands, a reset that waits, feeding, events.
  void step();

  // ---- operator's thread (the same as Scan::post) ----
  bool post(const Command& command) { return commands_.push(command); }
  bool poll_answer(CommandAnswer* answer) { return answers_.pop(answer); }
  // Gives a command up that takes too long: from then on it does nothing. False: it acts already, and its answer comes at once.
  bool take_back(std::uint64_t ticket) { return claim(ticket); }
  void set_mdi_text(const std::string& text);  // before kLoadMdi, which takes it
  void set_program_name(const std::string& name);  // before kSelectProgram with kProgramByName

  // ---- feeder thread ----
  bool remembers(unsigned file) const;

  // ---- any thread ----
  FeederInfo info() const;
  // Why the last command was refused, where there is more to say than its answer says; "" = nothing.
  std::string refusal() const;

  // ---- the thread of the retained data ----
  // A copy of what the executed blocks have left is asked for, and taken when it is there.
  enum Kept { kVariables, kTables, kKeptCount };
  void want(Kept what) { kept_[what].wanted.store(true, std::memory_order_release); }
  bool take(Kept what, std::string* bytes);

  // Before the threads start.
  void set_sink(EventSink* sink) { sink_ = sink; }
  void set_program_loader(ProgramLoader loader) { loader_ = std::move(loader); }
  void set_program_refresh(ProgramRefresh refresh) { refresh_ = std::move(refresh); }
  void set_changed_programs(ChangedPrograms changed) { changed_ = std::move(changed); }
  void set_printer(Printer printer) { printer_ = std::move(printer); }
  void set_path_sink(PathSink* sink) {
    path_sink_ = sink;
    scan_->record_positions();
  }

 private:
  Answer apply(const Command& command);
  Answer select(const Command& command);
  Answer load_mdi(const Command& command);
  bool claim(std::uint64_t ticket);
  Answer refuse(Answer answer, std::string why);
  void leave_kept();
  void follow_ladder();
  void follow_outputs();
  void complete_reset();
  void feed();
  void take_events();
  void take_messages();
  void print(unsigned system, const nc_text* text);
  void tell_changes();
  void tell(std::string message, unsigned system);
  void take_alarm();
  void take_modal();
  void take_turns(unsigned system);
  void take_mark(unsigned system, const nc_event& event);
  void nothing_has_run(unsigned system);
  void rewind_ended();

  const unsigned systems_;
  NcPort* nc_;
  Scan* scan_;
  EventSink* sink_ = nullptr;
  PathSink* path_sink_ = nullptr;
  Printer printer_;

  struct System {
    bool selected = false, mdi = false;
    std::uint32_t file = 0;
    bool ended = false;    // the end item has been executed
    bool alarmed = false;  // behind an alarm item
    bool part = false;     // a part program was selected, perhaps before the MDI blocks ...
    std::uint32_t part_file = 0;  // ... and this is it
    std::string blocks;           // of MDI, as they were loaded
    // Nothing is selected, but for what is remembered.
    void clear() { *this = {false, false, 0, false, false, part, part_file, {}}; }
    void take_part(std::uint32_t number) { *this = {true, false, number, false, false, true, number, {}}; }
    void take_mdi(std::string text) { *this = {true, true, 0, false, false, part, part_file, std::move(text)}; }
  };
  void restore_parts();
  void tell_what_is_loaded();
  System system_[NC_MAX_SYSTEMS];
  Snapshot seen_;  // of this step

  static constexpr unsigned kCommands = 64;  // of one step
  SpscQueue<Command, kCommands> commands_;
  SpscQueue<CommandAnswer, 2 * kCommands> answers_;
  std::atomic<std::uint64_t> claimed_{0};  // the newest command that acts, or that was given up; tickets rise from 1
  mutable std::mutex mutex_;  // guards info_ and mdi_text_; never taken by the scan
  FeederInfo info_;
  std::string mdi_text_, program_name_;  // handed over with a command
  ProgramLoader loader_;
  ProgramRefresh refresh_;
  ChangedPrograms changed_;
  bool was_active_[NC_MAX_SYSTEMS] = {};
  std::uint32_t modal_id_[NC_MAX_SYSTEMS] = {};
  std::string refusal_;  // under mutex_
  std::uint32_t operator_switches_[NC_MAX_SYSTEMS] = {}, switches_[NC_MAX_SYSTEMS] = {};  // given, and in force
  std::uint32_t found_[NC_WORDS] = {}, found_bits_[NC_WORDS] = {};  // of the macro outputs, not yet told to the control
  std::uint32_t recalculated_[NC_MAX_SYSTEMS] = {};  // requests of the ladder that were done
  struct KeptCopy {
    std::atomic<bool> wanted{false};
    bool ready = false;  // under mutex_, with bytes
    std::string bytes;
  };
  KeptCopy kept_[kKeptCount];
};

}  // namespace nc::rt
