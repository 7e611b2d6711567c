// SPDX-License-Identifier: Apache-2.0
// Ladder: an instruction list with Mitsubishi mnemonics, which is compiled when it is loaded and runs once per scan.
//
//   DeviceTable table;                     // the signals and points of this machine
//   Program program;
//   std::vector<Error> errors;
//   if (!compile(text, "mill.il", table, {}, &program, &errors)) ...   // errors[i].text()
//   Engine engine(program);
//   DeviceImage image = engine.make_image();
//   for (;;) { inputs into image; engine.scan(&image); outputs out of image; }
//
// The language is described in docs/ladder.md.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ladder/devices.hpp"

namespace nc::ladder {

struct Code;  // ladder/code.hpp

// An error in a program, or (in Program::warnings) something that is probably a mistake.
struct Error {
  std::string file;
  unsigned line = 0;        // from 1; 0 = the whole file
  std::string instruction;  // the instruction without its comment: "OUT Y99"
  std::string message;
  std::string text() const;  // "mill.il:12: OUT Y99: no such device"
};

inline constexpr std::size_t kMaxTextBytes = 8u << 20;
inline constexpr unsigned kMaxInstructions = 100000;
inline constexpr unsigned kMaxErrors = 100;  // then compile() stops looking

struct CompileOptions {
  double scan_s = 0.001;               // period of scan(), 1 us to 1 s; timers take it as the time of a scan
  std::uint32_t step_budget = 200000;  // number of instructions that one scan may take beyond one pass through the program
  bool retain_counters = false;        // the counters C are retained
  std::uint32_t retain_d_first = 0;    // first D that is retained, and their number
  std::uint32_t retain_d_count = 0;
};

// A line of a program that holds an instruction or a label, as a listing shows it.
struct ListedLine {
  enum class Power : std::uint8_t { kNone, kOff, kOn };  // kNone: it was not executed in this scan, or has none, as a label
  unsigned line = 0;  // from 1
  unsigned rung = 0;  // first line of its rung
  std::string instruction;  // without its comment
  std::vector<std::string> operands;
  // The result of logic behind the instruction; of an output, in front of it. An instruction that was executed several times in the scan shows the last time.
  Power power = Power::kNone;
};

// A compiled program. Copies share the code, which never changes.
class Program {
 public:
  Program();
  unsigned instruction_count() const;
  const std::string& file() const;
  unsigned line_count() const;
  std::size_t flow_bytes() const;
  // The rungs that have a line from `first` on, whole, until there are `most` lines or more of them; more only when a rung is longer than that. `flow`: what Engine::scan() has
  // left, null = without the power. `next`, when it is not null, becomes the first line
  // of the rung behind them, 0 = there is none.
  std::vector<ListedLine> listing(unsigned first, unsigned most, const std::uint8_t* flow, unsigned* next = nullptr) const;
  const std::vector<Error>& warnings() const;
  const std::shared_ptr<const Code>& code() const { return code_; }

 private:
  friend bool compile(std::string_view, const std::string&, const DeviceTable&, const CompileOptions&,
                      Program*, std::vector<Error>*);
  std::shared_ptr<const Code> code_;
};

// Compiles a text. True when the program has no errors; only then *program is replaced. All errors are reported, up to kMaxErrors.
bool compile(std::string_view text, const std::string& file, const DeviceTable& table,
             const CompileOptions& options, Program* program, std::vector<Error>* errors);

// Why the engine has stopped. The image stays as the last instruction has left it.
enum Fault : unsigned {
  kNoFault = 0,
  kWatchdog = 1,      // the scan took more instructions than CompileOptions::step_budget allows
  kCallStack = 2,     // more than kMaxCalls subroutines inside each other
  kReturnNoCall = 3,  // RET was reached without a CALL
  kEndInCall = 4,     // END was reached inside a subroutine
  kImageSize = 5      // the image was not made by make_image() of this program
};
inline constexpr unsigned kMaxCalls = 16;

// A device that is held at a value, whatever the instructions of a scan write.
struct Hold {
  DeviceType type = DeviceType::kBit;
  std::uint32_t index = 0;
  std::int32_t value = 0;
};

// Devices that keep their values over a power cut if the runtime stores them.
struct RetainedRange {
  std::string name;  // "L", "ST contact", "ST value", "ST rest", "C contact", "C value", "D"
  bool words;        // true: in DeviceImage::word; false: in DeviceImage::bit
  std::uint32_t first;
  std::uint32_t count;
  std::uint32_t number = 0;  // number of the first device: 100 for D100
};

class Engine {
 public:
  explicit Engine(const Program& program);

  // Makes an image with the devices of the table at their indices and the internal devices after them, all 0. Edges, timers and counters
  // are in the image, so several images are independent of each other.
  DeviceImage make_image() const;

  // Makes one pass through the program. NC_RT. Does nothing after a fault. Devices that are held have their value
  // before and after each instruction, which costs each instruction a store for each of them.
  // `flow`, when it is not null, has Program::flow_bytes() bytes, all 0, which get the power flow of this scan, for Program::listing(). Such a scan runs on the interpreter that holds devices.
  void scan(DeviceImage* image, const Hold* holds = nullptr, unsigned hold_count = 0, std::uint8_t* flow = nullptr) noexcept;

  // To be called in the thread that scans.
  unsigned fault() const { return fault_; }
  unsigned fault_step() const { return fault_step_; }  // unit in the compiled code
  unsigned fault_line() const;                         // line of the source, 0 = none
  std::string fault_text() const;                      // "mill.il:40: CJ P1: ..."; empty = none
  // The same for a fault and a line that the scan has passed on. Any thread.
  std::string fault_text(unsigned fault, unsigned line) const;
  void reset_fault() { fault_ = fault_step_ = 0; }

  // A device by a name that the program may use: that of a device of the table, an alias, or an internal device (M0, D10, SM402; T0 is
  // the contact, TN0 the value). Null when there is none. Not for the scan thread, and only for one caller at a time.
  const Device* find(std::string_view name) const;

  std::vector<RetainedRange> retained() const;

 private:
  std::shared_ptr<const Code> code_;
  unsigned fault_ = 0, fault_step_ = 0;
  mutable std::map<std::string, Device, std::less<>> found_;
};

// The instructions of the language, in the order of the documentation.
struct InstructionInfo {
  const char* name;
  const char* operands;  // "s1 s2 d"; empty = none
  const char* summary;
  const char* group;
  bool pulse;  // there is a form with P after the name, which is executed on the rising edge of its condition
};
const std::vector<InstructionInfo>& instruction_table();

}  // namespace nc::ladder
