// SPDX-License-Identifier: Apache-2.0
// The feeder reads ahead of the machine, takes the events of what the machine has executed, completes resets and selects
// programs. It belongs to one ordinary thread, in which it may allocate memory. On virtual time it runs in the same thread as the scan, alternating with
// it.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "runtime/command.hpp"
#include "runtime/restart/desk.hpp"
#include "runtime/retain/program_place.hpp"
#include "runtime/retain/writers.hpp"
#include "runtime/scan.hpp"
#include "runtime/start_gate.hpp"

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

// What the feeder shows to readers in other threads.
struct FeederInfo {
  struct Selected {
    bool any = false, mdi = false;
    std::uint32_t file = 0;
  };
  // What belongs to one part system.
  struct System {
    Selected selected;            // program that is at its head or running
    bool ended = false;           // the last run came to its end (M02, M30); false again after a reset or when a program is selected
    bool ended_ok = false;        // the last run that ended did so without an alarm
    std::uint64_t runs = 0;       // number of runs that ended, with an alarm or without
    std::uint64_t good_runs = 0;  // those without one, which is what counts parts
    std::uint32_t main_line = 0;  // line of the main program that was finished last
    std::uint64_t begun_again = 0;  // number of times that M99 of the main program has begun it again, since it was selected or loaded
    std::uint32_t again_line = 0;   // line in which that M99 stands
    bool alarm = false;             // program_alarm is valid
    nc_alarm program_alarm{};
    std::uint32_t alarm_calls = 0;  // number of entries in alarm_call: the blocks that led to the alarm, outermost first
    nc_source alarm_call[NC_MAX_CALLS] = {};
    std::string print_trouble;  // why a line that was printed is lost, the first reason since the last reset
    bool modal_known = false;
    nc_modal modal{};  // modal state after the last finished block
    // Bit a is set when axis a is shown within one turn, in machine and in workpiece coordinates (axis_shown.hpp).
    std::uint32_t machine_turn = 0, work_turn = 0;
    RestartStatus restart;  // a program that is begun inside
  };
  System system[NC_MAX_SYSTEMS];
  std::uint64_t events = 0;     // number of items executed
  std::uint64_t dropped = 0;    // number of events that were not fetched in time
  // A message to the operator.
  struct Message {
    unsigned system = 0;  // part system that it comes from
    std::string text;
  };
  static constexpr std::size_t kMessagesKept = 64;
  std::uint64_t messages = 0;      // number of messages so far, of all part systems
  std::vector<Message> said;       // the last messages, oldest first, at most kMessagesKept
  // The messages that came after the first `seen`, as far as they are kept.
  std::span<const Message> messages_since(std::uint64_t seen) const {
    return std::span(said).last(static_cast<std::size_t>(std::min<std::uint64_t>(messages - seen, said.size())));
  }
};

// Enters the program of this name into the store; false with a sentence in *error when that fails. Called in the feeder thread, while
// no program runs.
using ProgramLoader = std::function<bool(const std::string& name, unsigned* file, std::string* error)>;
// Called when new MDI blocks are in the control: the programs that they call are then taken from the files as they are now. Feeder thread, while no
// program runs.
using ProgramRefresh = std::function<void()>;
// The programs whose files have changed since they were selected or called, and which run as they were then: "part.nc, O77"; "" = none. Called
// in the feeder thread when a part program starts.
using ChangedPrograms = std::function<std::string()>;
// Gives the SHA-256 of a program in the store, "" = not known. Called in the feeder thread, while no program runs.
using ProgramHash = std::function<std::string(unsigned file)>;
// Takes what programs print (POPEN, DPRNT, PCLOS) when the machine reaches that block; called in the feeder thread. Returns the reason why a line
// could not be written, "" when it was written.
using Printer = std::function<std::string(const nc_text& text)>;
// Reads the tables of the control, or writes into them; called in the feeder thread. It may be called after the one who gave it has stopped waiting, so it
// owns what it needs.
using ControlJob = std::function<void(nc_control* control)>;
// kSelectProgram with this number selects the program given by name.
inline constexpr std::uint32_t kProgramByName = ~0u;

class Feeder {
 public:
  Feeder(unsigned systems, NcPort* nc, Scan* scan);

  // One period of the feeder: events, feeding, a reset that waits, commands.
  void step();
  // Whether this step has read for so long that a reset, or the end of the control, does not wait for it any more. Feeder thread.
  bool reads_too_long() const;
  // The control ends. Any thread.
  void leave() { leaves_.store(true, std::memory_order_relaxed); }

  // ---- operator's thread (the same as Scan::post) ----
  bool post(const Command& command) { return commands_.push(command); }
  bool poll_answer(CommandAnswer* answer) { return answers_.pop(answer); }
  // Gives up a command that takes too long; it has no effect then. False when the feeder is already executing it: then its answer comes soon.
  bool take_back(std::uint64_t ticket) { return claim(ticket); }
  void set_mdi_text(const std::string& text);  // the text for the next kLoadMdi
  void set_restart_wish(const RestartWish& wish);  // the place for the next kFindRestart
  void set_program_name(const std::string& name);  // the name for the next kSelectProgram with kProgramByName
  void set_job(ControlJob job);                    // the function for the next kLook or kChange

  // ---- feeder thread ----
  bool remembers(unsigned file) const;

  // ---- any thread ----
  FeederInfo info() const;
  // Why the last command was refused, when there is more to say than its answer does; "" otherwise.
  std::string refusal() const;

  // ---- the thread that keeps retained data ----
  // want() asks for a copy of the data as the executed blocks have left them; take() fetches it and is false until it is there.
  enum Kept { kVariables, kTables, kPlace, kStops, kKeptCount };
  void want(Kept what) { kept_[what].wanted.store(true, std::memory_order_release); }
  bool take(Kept what, std::string* bytes);
  // What is kept over power off: without what a search for a restart has written whose program has not gone on. Feeder thread, or when it has ended.
  std::string kept_variables();
  std::string kept_tables();
  // The places in the programs while a failure of the power is not acknowledged, else "" (runtime/retain/place.hpp). Feeder thread, or when it has ended.
  std::string place_bytes();
  // Where programs have stopped that did not come to their end. Feeder thread, or when it has ended.
  std::string stop_bytes() const;
  // Those of the start before. Before the threads start.
  void set_stops(const std::vector<ProgramPlace>& places);

  // Before the threads start.
  void set_sink(EventSink* sink) { sink_ = sink; }
  void set_program_loader(ProgramLoader loader) { loader_ = std::move(loader); }
  void set_program_refresh(ProgramRefresh refresh) { refresh_ = std::move(refresh); }
  void set_changed_programs(ChangedPrograms changed) { changed_ = std::move(changed); }
  void set_program_hash(ProgramHash hash) { hash_ = std::move(hash); }
  void set_start_gate(StartGate* gate) { gate_ = gate; }
  void set_printer(Printer printer) { printer_ = std::move(printer); }
  // Who has written what is noted there. Null = nobody wants to know.
  void set_writers(WriterTable* writers) { writers_ = writers; }
  // Notes who has written what up to now. Feeder thread, or when it has ended.
  void note_writers();
  void set_path_sink(PathSink* sink) {
    path_sink_ = sink;
    scan_->record_positions();
  }

 private:
  Answer apply(const Command& command);
  Answer hindrance() const;
  Answer select(const Command& command);
  bool load(const std::string& name, std::uint32_t* file, std::string* error);
  Answer load_mdi(const Command& command);
  Answer interrupt_by_mdi(const Command& command);
  void follow_mdi();
  Answer find_restart(const Command& command);
  Answer look_for(const Command& command, const RestartWish& wish);
  Answer confirm_restart(const Command& command);
  Answer cancel_restart(const Command& command);
  bool restart_place(unsigned system, const RestartWish& wish, nc_restart_place* place, std::string* what);
  bool stopped_place(unsigned system, const RestartWish& wish, nc_restart_place* place, std::string* what, CoordinatesBegun* with);
  void follow_restart();
  void follow_search();
  void begin_search(unsigned system, const SearchAsked& asked);
  void go_on_searching(unsigned system);
  void answer_search(unsigned system, SearchResult result, const std::string& why);
  void bar_start(unsigned system, SearchResult result, const std::string& why);
  void put_back_searched();
  void tell_restart();
  void follow_stops();
  ProgramPlace place_of(unsigned system, const Snapshot& now) const;
  Answer look(const Command& command);
  Answer change(const Command& command);
  nc_status read_again(std::uint32_t but = 0, const char* why = "tables or outputs were changed");
  std::uint32_t places_that_stay() const;
  bool claim(std::uint64_t ticket);
  Answer refuse(Answer answer, std::string why);
  void leave_kept();
  void note_writers_in_time();
  void note_writers_of(const std::string& variables, const std::string& tables);
  std::string copy_of(Kept what);
  std::string writer_name(unsigned system) const;
  void note_running(unsigned system, const nc_event& event);
  void follow_ladder();
  void follow_outputs();
  void complete_reset();
  void feed();
  void take_events();
  void take_messages();
  void print(unsigned system, const nc_text* text);
  void tell_changes();
  Scan::Loaded at_head(unsigned system) const;
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
  std::atomic<bool> leaves_{false};
  std::chrono::steady_clock::time_point step_began_{};
  EventSink* sink_ = nullptr;
  PathSink* path_sink_ = nullptr;
  Printer printer_;

  struct System {
    bool selected = false, mdi = false;
    std::uint32_t file = 0;
    bool ended = false;    // the end item has been executed
    bool alarmed = false;  // an alarm item has been executed
    bool part = false;     // a part program was selected, perhaps before the MDI blocks
    std::uint32_t part_file = 0;  // index of that part program in the store
    std::string blocks;           // text of the MDI blocks that were loaded
    // Blocks of MDI that wait for a start in the block stop of the program: their number (0 = none), and the item that was executed last when they came.
    std::uint32_t mdi_waits = 0;
    std::uint64_t mdi_behind = 0;
    int mdi_file = -1;   // index of their text in the store
    int mdi_depth = -1;  // level of calls of theirs that is in execution; -1 = they are not
    // Nothing is selected any more; only the part program that was selected before is remembered.
    void clear() { *this = {false, false, 0, false, false, part, part_file, {}, 0, 0}; }
    void take_part(std::uint32_t number) { *this = {true, false, number, false, false, true, number, {}, 0, 0}; }
    void take_mdi(std::string text) { *this = {true, true, 0, false, false, part, part_file, std::move(text), 0, 0}; }
  };
  void restore_parts();
  void tell_what_is_loaded();
  System system_[NC_MAX_SYSTEMS];
  std::vector<unsigned> newest_search_first() const;
  bool may_search(unsigned system) const;
  RestartDesk restart_[NC_MAX_SYSTEMS];
  std::uint64_t searches_ = 0;  // that were begun
  // An external search that is under way.
  struct Search {
    enum Step : std::uint8_t { kNothing, kChecks, kLooks } step = kNothing;
    std::uint32_t file = 0, sequence = 0;
  };
  Search search_[NC_MAX_SYSTEMS];
  // A command for which nobody waits who could give it up.
  static constexpr std::uint64_t kOfMachine = 0;
  static Command of_machine(CommandKind kind, unsigned system) {
    Command command;
    command.kind = kind;
    command.system = static_cast<std::uint8_t>(system);
    command.ticket = kOfMachine;
    return command;
  }
  // Where the program of a part system was stopped last, and where it was when the power failed.
  struct Stops {
    bool runs = false, any = false, any_power = false;
    nc_axes begun{};        // where the axes stood when the program in execution was begun
    CoordinatesBegun coordinates;  // what it was begun with
    std::string hash;       // of the part program that is selected
    ProgramPlace now, last, power;
  };
  Stops stops_[NC_MAX_SYSTEMS];
  std::uint32_t mdi_texts_ = 0;  // number of texts of MDI that have come in block stops so far
  Snapshot seen_;  // snapshot of the scan that this step goes by

  static constexpr unsigned kCommands = 64;  // at most so many are executed in one step
  SpscQueue<Command, kCommands> commands_;
  SpscQueue<CommandAnswer, 2 * kCommands> answers_;
  std::atomic<std::uint64_t> claimed_{0};  // ticket of the newest command that was executed or given up; tickets rise from 1
  mutable std::mutex mutex_;  // guards info_, mdi_text_, program_name_, job_, refusal_ and the copies in kept_; never taken by the scan
  FeederInfo info_;
  std::string mdi_text_, program_name_;  // for the next kLoadMdi or kSelectProgram
  RestartWish wish_;                     // for the next kFindRestart
  ControlJob job_;                       // for the next kLook or kChange
  ProgramLoader loader_;
  ProgramRefresh refresh_;
  ChangedPrograms changed_;
  ProgramHash hash_;
  StartGate* gate_ = nullptr;
  bool was_active_[NC_MAX_SYSTEMS] = {};
  std::uint32_t modal_id_[NC_MAX_SYSTEMS] = {};
  std::string refusal_;  // guarded by mutex_
  std::uint32_t operator_switches_[NC_MAX_SYSTEMS] = {}, switches_[NC_MAX_SYSTEMS] = {};  // skips that the operator has set; all skips in force
  std::uint32_t found_[NC_WORDS] = {}, found_bits_[NC_WORDS] = {};  // mask and values of macro outputs that the control has not been told yet
  std::uint32_t recalculated_[NC_MAX_SYSTEMS] = {};  // number of recalculations asked for by the ladder that were dealt with
  struct KeptCopy {
    std::atomic<bool> wanted{false};
    bool ready = false;  // `bytes` holds the copy; both are guarded by mutex_
    std::string bytes;
  };
  KeptCopy kept_[kKeptCount];
  WriterTable* writers_ = nullptr;
  WriterTable::Ran ran_;  // since the last look at the writers
  std::chrono::steady_clock::time_point writers_noted_{};
};

}  // namespace nc::rt
