// SPDX-License-Identifier: Apache-2.0
// The runtime: a control, its machine, the scan and the feeder, and the operator's commands.
//
//   real time:     start() makes two threads, the scan (SCHED_FIFO, absolute deadlines) and the feeder;
//   stop() ends them virtual time:  step() runs the feeder once and the scan once, in the caller's thread, as
//   often as it likes:
//                  deterministic, and as fast as the processor
//
// Commands may come from several threads: one waits for the other. Everything else about a Runtime may be read from any thread.
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

namespace nc::rt {

struct RuntimeParts {
  Clock* clock = nullptr;        // required
  hal::Hal* hal = nullptr;       // required
  LadderHook* ladder = nullptr;  // none = the program of the configuration, or an empty one
  NcPort* nc = nullptr;          // none = libnc, made from the configuration
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

  // The control, for programs and tables before the start (afterwards it belongs to the feeder). Null with a
  // foreign NcPort.
  nc_control* control() { return control_; }
  const nc_control* control() const { return control_; }
  // The configuration's ladder program; null without one.
  const LadderTask* ladder() const { return own_ladder_.get(); }
  // Values of the signals, for one reader.
  SignalBoard* signals() { return board_.get(); }
  // Before the start.
  void set_sink(EventSink* sink) { feeder_->set_sink(sink); }
  // Code of an alarm: of the table of the runtime, or of the family. Not for kProgram, whose code comes with it.
  std::string alarm_code(AlarmId id) const;
  void set_printer(Printer printer) { feeder_->set_printer(std::move(printer)); }
  void set_path_sink(PathSink* sink) { feeder_->set_path_sink(sink); }

  // ---- real time ----
  // False with a sentence in *error when the machine or a thread does not come up; outputs are safe then.
  bool start(std::string* error);
  void stop();
  bool running() const { return running_; }
  std::vector<std::string> warnings() const;  // what the system did not allow; complete after the first scan
  std::int64_t first_scan_ns() const { return first_scan_ns_.load(); }  // CLOCK_MONOTONIC; 0 = not yet

  // ---- virtual time ----
  // Brings the machine up without threads. Retained devices begin with 0: the same run gives the same result.
  bool start_stepping(std::string* error);
  void step();

  // How programs are found by name. Before the start.
  void set_program_loader(ProgramLoader loader) { feeder_->set_program_loader(std::move(loader)); }
  // Called in front of new MDI blocks, to enter the present texts of the sub programs that they may call. To be set before the start.
  void set_program_refresh(ProgramRefresh refresh) { feeder_->set_program_refresh(std::move(refresh)); }
  // Says which files have changed meanwhile. Before the start.
  void set_changed_programs(ChangedPrograms changed) { feeder_->set_changed_programs(std::move(changed)); }
  // A part program that will be selected again, be MDI selected now: its place in the store must stay. Feeder thread.
  bool remembers(unsigned file) const { return feeder_->remembers(file); }

  // ---- operator ----
  // Hands the command over and waits for the answer (on virtual time by stepping).
  Answer execute(Command command);
  // Of all part systems where the command may be, as a button of the panel is; else of the first.
  Answer execute(CommandKind kind, double value = 0, std::uint32_t number = 0);
  Answer select_program(unsigned file) { return execute(CommandKind::kSelectProgram, 0, file); }
  Answer load_mdi(const std::string& text, unsigned system = 0);
  Answer select_program(unsigned system, const std::string& name);  // through the program loader
  // A device of the ladder is held at a value until it is released; "" releases all of them.
  Answer force(const std::string& device, std::int64_t value);
  Answer release(const std::string& device);
  // What the last answer means, with the reason where one is known. The thread that got it, before its next command.
  std::string explain(Answer answer) const;
  std::string forced_name(std::uint32_t number) const;

  // ---- anyone ----
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
  std::string retain_text(const ActiveAlarm& alarm) const;
  std::string ladder_fault(const ActiveAlarm& alarm) const;
  static void read_device(void* self, unsigned code, std::uint32_t number, std::uint32_t* value);
  bool find_answer(std::uint64_t ticket, bool from_feeder, Answer* answer);
  void wake_feeder();

  const Config& config_;
  RuntimeParts parts_;
  LadderHook empty_ladder_;
  std::unique_ptr<LadderTask> own_ladder_;
  std::unique_ptr<SignalBoard> board_;
  std::unique_ptr<RetainKeeper> keeper_;  // in real time only
  std::string refused_;                   // a force, under operator_
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
  bool running_ = false, stepping_ = false;
  mutable std::mutex operator_;       // one command at a time; never taken by the scan or the feeder
  std::uint64_t next_ticket_ = 1;
};

}  // namespace nc::rt
