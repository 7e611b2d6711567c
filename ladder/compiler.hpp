// SPDX-License-Identifier: Apache-2.0
// The compiler: it makes one pass over the lines and resolves labels at the end.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ladder/names.hpp"
#include "ladder/rules.hpp"

namespace nc::ladder {

class Compiler {
 public:
  Compiler(const std::string& file, const DeviceTable& table, const CompileOptions& options)
      : file_(file), table_(table), options_(options), names_(table, code_.layout) {
    code_.layout = make_layout(table, 0, 0);
    code_.bits_written.assign(table.bits(), false);
    code_.words_written.assign(table.words(), false);
  }
  Compiler(const Compiler&) = delete;
  Compiler& operator=(const Compiler&) = delete;
  bool run(std::string_view text);
  std::vector<Error> take_errors() { return std::move(errors_); }
  Code take_code() { return std::move(code_); }

 private:
  // The state of a rung. A LD after an output begins a new rung, unless an ANB later joins its block with the
  // previous result, as in LD X0, OUT Y0, LD X1, OR X2, ANB, OUT Y1.
  struct Rung {
    unsigned blocks = 0;  // number of results that are not joined yet; 0 = no rung
    bool used = true;     // an output has used the result
    bool joined = false;  // the result was used or kept, so a parallel contact is not allowed any more
    bool gated = false;   // the result contains the master control
    bool before = false;  // there is a result of the previous rung, with which ANB may join
    bool gated_before = false;  // that result contains the master control
    std::size_t start = 0;   // first unit of the rung
    unsigned inherited = 0;  // number of branches (MPS) that were open when it began
    bool always = false;     // the rung is only a contact of SM400 to SM402
  };
  struct Master {
    std::uint32_t level;
    std::uint32_t gate;  // index of the bit that is on when the master control is
    unsigned line;
    std::uint64_t key;   // of its rung
  };
  struct Loop {
    unsigned id;
    std::size_t unit;  // unit of FOR
    std::uint32_t slot;
    unsigned line;
  };
  struct Label {
    std::uint32_t step;
    unsigned line;
    std::vector<unsigned> loops;
    bool sub;  // after FEND, so in a subroutine
  };
  struct Jump {
    std::size_t unit;
    std::uint32_t label;
    unsigned line;
    std::vector<unsigned> loops;
    bool sub, call;
  };
  struct Encoded {
    Mode mode;
    std::uint32_t value;
  };

  // compile.cpp
  void error(std::string message);
  void error_at(unsigned line, std::string message);
  void warning(std::string message);
  std::string source_of(unsigned line) const;
  void read_line(std::string_view text);
  bool options_hold();
  void finish();

  // statements.cpp
  void statement();
  bool operand_count(const Rule& rule, std::size_t least, std::size_t most);
  void act(const Rule& rule, bool pulse);
  void load(const Rule& rule);
  void join(const Rule& rule);
  void block(const Rule& rule);
  void branch(const Rule& rule);
  void out(const Rule& rule);
  void out_timer(const Rule& rule, const Place& place);
  void out_counter(const Place& place);
  void set_bit(bool pulse);
  void reset(bool pulse);
  void reset_range(bool pulse);
  void pulse_coil(const Rule& rule);
  void words(const Rule& rule, bool pulse);
  void alias();

  // flow.cpp
  void master(const Rule& rule);
  void master_end();
  void label(std::string_view name);
  void jump(const Rule& rule, bool pulse);
  void main_end();
  void text_end();
  void end_of_text();
  void loop(const Rule& rule);
  void loop_end();
  void resolve_labels();
  std::vector<unsigned> loop_path() const;
  bool number_after(char letter, std::string_view word, std::uint32_t limit, std::uint32_t* number);

  // rung state; statements.cpp
  bool has_result();   // an error when there is no result that AND, INV ... could work on
  bool take_result();  // an output uses the result, which must be a single block
  void gate();
  void close_rung();  // an error when a result is unused or a branch is open
  void begin_rung();
  void note_coil(const Place& place);
  void note_rising();  // a warning when the result can never rise

  // constants.cpp
  void check_constants(const Rule& rule, const Encoded* operands);
  static bool is_constant(const Encoded& operand, std::int64_t* value);
  bool check_range(const Encoded& operand, std::int64_t least, std::int64_t most);
  bool check_row(const Encoded& first, const Encoded& length, std::int64_t width);

  // operands; encode.cpp
  bool bit_operand(std::string_view word, bool written, Place* place);
  void open_word_bit(Place* place, bool written);
  void close_word_bits();
  bool encode(char letter, std::string_view word, Encoded* out);
  bool encode_constant(const Operand& operand, bool wide, bool written, Encoded* out);
  bool encode_digits(const Operand& operand, bool wide, bool written, Encoded* out);
  bool encode_row(const Operand& operand, bool written, Encoded* out);
  bool encode_words(const Operand& operand, std::uint32_t width, std::string_view word, Encoded* out);
  std::string other_width(bool wide) const;

  // memories.cpp
  void add_to_rung();
  void begin_key();
  void join_key();
  std::uint64_t key_here() const;
  void note_flow(std::string_view text);
  void remember(std::uint32_t bit);
  void note_written(const Place& place);
  void finish_memories();

  // code
  std::uint32_t new_edge();  // the memory of an edge
  std::uint32_t new_bit();   // a bit for what is within one scan
  void emit(Op op, std::uint32_t a = 0, unsigned mode = 0);
  void emit2(std::uint32_t b, std::uint32_t c);
  void emit_pulse(Op next, bool pulse);

  std::string file_;
  const DeviceTable& table_;
  const CompileOptions& options_;
  Code code_;
  Names names_;
  std::vector<Error> errors_;
  unsigned line_ = 0;
  std::vector<std::string_view> words_;
  const Rule* rule_ = nullptr;  // rule of the instruction in this line
  Rung rung_;
  unsigned label_line_ = 0;  // line of a label in front of the rung that comes, 0 = there is none
  unsigned branches_ = 0;
  unsigned branch_line_ = 0;
  std::vector<Master> masters_;
  std::vector<Loop> open_loops_;
  std::uint32_t loops_ = 0;
  std::string line_text_;             // this line with devices in the place of other names
  std::uint64_t rung_key_ = 0;        // of the lines of the rung so far
  std::uint64_t key_before_line_ = 0; // the same without this line
  std::uint64_t key_before_rung_ = 0; // that of the rung before
  std::uint32_t flows_ = 0;           // instructions that direct the flow
  std::vector<std::uint64_t> whole_rungs_ = {0};  // keys of the rungs, as far as they are read
  std::map<std::uint32_t, Label> labels_;
  std::vector<Jump> jumps_;
  std::map<std::uint64_t, unsigned> coils_;  // maps a bit, or a word and its bit, to the line of its OUT
  struct WordBit {
    std::uint32_t word, number, bit;
  };
  std::vector<WordBit> word_bits_;  // bits of words that this instruction writes; after it they are stored in their words
  bool main_ended_ = false, ended_ = false;
  std::uint32_t main_end_ = 0xffffffffu;  // unit of FEND
};

inline constexpr unsigned kMaxBlocks = 60, kMaxBranches = 32, kMaxLoops = 16;
inline constexpr std::uint32_t kMaxMasters = 15, kMaxLabel = 4095;

}  // namespace nc::ladder
