// SPDX-License-Identifier: Apache-2.0
// The runtime: a control, its machine, the scan and the feeder, and the operator's commands.
//
//   real time:     start() makes two threads, the scan (SCHED_FIFO, absolute deadlines) and the feeder; stop() ends them
//   virtual time:  each step() runs the feeder once and the scan once in the caller's thread: a run is deterministic, and as fast as the
//                  processor allows
//
// Commands may come from several threads; they are executed one after the other. Everything that "anyone" may read may be read from any thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/feeder.hpp"
#include "runtime/ladder_task.hpp"
#include "runtime/retain/keeper.hpp"
#include "runtime/rt_thread.hpp"
#include "runtime/scan.hpp"
#include "runtime/signals/signal_board.hpp"
#include "runtime/tools/tool_labels.hpp"
#include "runtime/trace/trace_tap.hpp"

namespace nc::rt {

struct RuntimeParts {
  Clock* clock = nullptr;        // required
  hal::Hal* hal = nullptr;       // required
  LadderHook* ladder = nullptr;  // null = the ladder program of the configuration, or none
  NcPort* nc = nullptr;          // null = libnc, created from the configuration
};

class Runtime {
 public:
  // Makes the control and applies the configuration. Null with the errors when the control refuses something.
  // `config` and the parts must outlive the runtime.
  static std::unique_ptr<Runtime> create(const Config& config, const RuntimeParts& parts,
                                         std::vector<ConfigError>* errors);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  // The control, to load programs and tables before the start; afterwards it belongs to the feeder. Null when RuntimeParts::nc
  // is given.
  nc_control* control() { return control_; }
  const nc_control* control() const { return control_; }
  // The configuration's ladder program; null without one.
  const LadderTask* ladder() const { return own_ladder_.get(); }
  LadderTask* ladder() { return own_ladder_.get(); }
  // The values of the signals, for a single reader.
  SignalBoard* signals() { return board_.get(); }
  // Records signals in the scan, for a single owner.
  trace::TraceTap* trace() { return trace_.get(); }
  // Names and pockets of tools, which the control does not have. They are changed in jobs of the feeder thread.
  ToolLabelTable* tool_labels() { return &tool_labels_; }
  // To be set before the start.
  void set_sink(EventSink* sink) { feeder_->set_sink(sink); }
  // Code of an alarm: of the table of the runtime, or of the family. Not for kProgram, whose code comes with it.
  std::string alarm_code(AlarmId id) const;
  void set_printer(Printer printer) { feeder_->set_printer(std::move(printer)); }
  // The tap of the history (runtime/history/), told of every scan. To be set before the start.
  void set_history(history::ScanTap* tap) { scan_->set_history(tap); }
  void set_path_sink(PathSink* sink) { feeder_->set_path_sink(sink); }

  // ---- real time ----
  // False with a sentence in *error when the machine or a thread cannot be started; the outputs are safe then.
  bool start(std::string* error);
  void stop();
  bool running() const { return running_; }
  std::vector<std::string> warnings() const;  // of the configuration, and of what the system did not allow; complete after the first scan
  std::int64_t first_scan_ns() const { return first_scan_ns_.load(); }  // CLOCK_MONOTONIC; 0 = not yet

  // ---- virtual time ----
  // Starts the machine without threads. Retained devices begin with 0, so that the same run always gives the same result.
  bool start_stepping(std::string* error);
  void step();

  // Finds programs by name. To be set before the start.
  void set_program_loader(ProgramLoader loader) { feeder_->set_program_loader(std::move(loader)); }
  // Called after new MDI blocks have been loaded, to enter the present texts of the programs that they may call. To be set before the start.
  void set_program_refresh(ProgramRefresh refresh) { feeder_->set_program_refresh(std::move(refresh)); }
  // Gives the SHA-256 of a program in the store. To be set before the start.
  void set_program_hash(ProgramHash hash) { feeder_->set_program_hash(std::move(hash)); }
  // Says which files of programs have changed since they were read. To be set before the start.
  void set_changed_programs(ChangedPrograms changed) { feeder_->set_changed_programs(std::move(changed)); }
  // Says which part programs may begin; null = all of them. To be set before the start; must outlive the runtime.
  void set_start_gate(StartGate* gate) {
    gate_ = gate;
    feeder_->set_start_gate(gate);
  }
  StartGate* start_gate() const { return gate_; }
  // True for a part program that is selected, or that will be selected again after MDI: its entry in the store must stay. Feeder thread.
  bool remembers(unsigned file) const { return feeder_->remembers(file); }
  // For who gives the control its texts: nothing more is to be read of them in this step of the feeder (Feeder::reads_too_long()). Feeder thread.
  bool reads_too_long() const { return feeder_->reads_too_long(); }
  // The control ends, and nobody waits any more for what the feeder reads. Any thread.
  void leave() { feeder_->leave(); }

  // ---- operator ----
  // Hands over the command and waits for the answer; on virtual time it calls step() meanwhile. One that moves something is taken back by a feed hold that comes
  // from now on and before it is executed, or since Command::holds.
  Answer execute(Command command);
  // A feed hold waits for no other command, as for a selection whose disk does not answer: the scan holds with its next run. The number of the request; 0 = there is no such part system, or
  // no scan runs in real time. Any thread.
  std::uint64_t ask_hold(unsigned system);
  // Waits until the scan has done it. Any thread.
  Answer await_hold(std::uint64_t number, unsigned system);
  // Whether the axes have been at rest behind it, also where they move again. Any thread.
  bool has_stood(std::uint64_t number, unsigned system) const;
  // The feed holds that have been asked for so far (Command::holds); the part systems of which one has come since it was so many, one bit each. Any thread.
  std::uint64_t holds() const { return scan_->hold_door().asked(); }
  std::uint32_t held_since(std::uint64_t holds) const { return scan_->hold_door().asked_since(holds); }
  // The command is for all part systems if that is possible (takes_all_systems()), as from a button of the panel; otherwise it is for the first one.
  Answer execute(CommandKind kind, double value = 0, std::uint32_t number = 0);
  Answer select_program(unsigned file) { return execute(CommandKind::kSelectProgram, 0, file); }
  Answer load_mdi(const std::string& text, unsigned system = 0);
  Answer select_program(unsigned system, const std::string& name);  // the program loader finds the program
  // Begins to look for a place in the selected program. What comes of it is in FeederInfo::System::restart.
  Answer find_restart(unsigned system, const RestartWish& wish);
  // Calls `job` in the feeder thread, to read the tables of the control. It may be called even when the answer is kNoAnswer, so it owns what it needs.
  Answer look(ControlJob job);
  // The same for a job that changes tables: offsets, variables, parameters. Refused while a program is in execution or interrupted, and during a reset, because
  // the blocks that were read ahead have used the old values. Programs that are ready to start are read again with the new ones.
  Answer change(ControlJob job);
  // A device of the ladder is held at a value until it is released; "" releases all of them.
  Answer force(const std::string& device, std::int64_t value);
  Answer release(const std::string& device);
  // What the last answer means, with its reason when that is known. To be called by the thread that got the answer, before its next command.
  std::string explain(Answer answer) const;
  // Gives a device of the ladder a value once, before its next run.
  Answer write_device(const std::string& device, std::int64_t value);
  std::string forced_name(std::uint32_t number) const;

  // ---- anyone ----
  // Who has written what in the tables; null on virtual time and without services. From the start on.
  WriterTable* writers() const { return writers_.get(); }
  Snapshot snapshot() const { return scan_->snapshot(); }
  FeederInfo info() const { return feeder_->info(); }
  const ScanStatistics& statistics() const { return scan_->statistics(); }
  const Config& config() const { return config_; }
  // One line for an active alarm: code, axis, text, place.
  std::string alarm_text(const ActiveAlarm& alarm) const;

 private:
  Runtime(const Config& config, const RuntimeParts& parts);
  bool make_control(std::vector<ConfigError>* errors);
  bool bring_up(std::string* error);
  void scan_thread();
  void feeder_thread();
  Answer execute_alone(Command command);
  Answer with_job(CommandKind kind, ControlJob job);
  std::string retain_text(const ActiveAlarm& alarm) const;
  std::string ladder_fault(const ActiveAlarm& alarm) const;
  Answer act_on_device(CommandKind kind, std::int64_t value, const std::function<std::int64_t()>& find);
  static void read_device(void* self, unsigned code, std::uint32_t number, std::uint32_t* value);
  bool find_answer(std::uint64_t ticket, bool from_feeder, Answer* answer);
  void wake_feeder();
  void save_when_asked();
  void save_new_taps();

  const Config& config_;
  RuntimeParts parts_;
  LadderHook empty_ladder_;
  std::unique_ptr<LadderTask> own_ladder_;
  std::unique_ptr<SignalBoard> board_;
  std::unique_ptr<trace::TraceTap> trace_;
  ToolLabelTable tool_labels_;
  std::unique_ptr<WriterTable> writers_;  // in real time, with services
  std::unique_ptr<RetainKeeper> keeper_;  // in real time only
  nc_tap tap_told_[NC_MAX_SYSTEMS] = {};  // that the keeper has been told of
  std::uint32_t save_told_ = 0;           // request to write at once that the keeper has been told of
  std::string found_place_;               // where the power failed before this start; "" = nowhere
  bool is_still_checked();
  StartGate* gate_ = nullptr;
  std::string refused_;                   // why a force was refused; guarded by operator_
  struct FreeMemory {
    void operator()(void* memory) const;
  };
  std::unique_ptr<void, FreeMemory> memory_;
  nc_control* control_ = nullptr;
  std::unique_ptr<NcPort> own_nc_;
  std::unique_ptr<Scan> scan_;
  std::unique_ptr<Feeder> feeder_;

  RtThread scan_thread_, feeder_thread_;
  std::atomic<bool> stop_scan_{false}, stop_feeder_{false};
  std::atomic<std::int64_t> first_scan_ns_{0};
  std::atomic<bool> thread_warnings_ready_{false};
  std::vector<std::string> warnings_, thread_warnings_;
  int wake_fd_ = -1;
  std::atomic<bool> running_{false};
  bool stepping_ = false;
  mutable std::mutex operator_;       // one command at a time; never taken by the scan or the feeder
  std::uint64_t next_ticket_ = 1;
};

}  // namespace nc::rt
